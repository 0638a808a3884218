@group(0) @binding(5) var<storage, read_write> corner_light: array<f32>;

@compute @workgroup_size(64)
fn adjacent_faces(@builtin(global_invocation_id) id: vec3<u32>) {
    let corner = linear_index(id);
    if corner >= counts.x {
        return;
    }
    var least = cosine(corner);
    let vertex = corner_vertex[corner];
    if vertex < counts.y {
        least = min(least, value_of(atomicLoad(&smallest[vertex])));
    }
    corner_light[corner] = select(least, 0.0, least == NONE);
}
