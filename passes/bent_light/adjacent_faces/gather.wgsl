@group(0) @binding(5) var<storage, read> face_offset: array<u32>;
@group(0) @binding(6) var<storage, read> faces: array<u32>;

// One entry of `faces`: its vertex by bisection, its face's cosine there to the vertex's smallest.
@compute @workgroup_size(64)
fn adjacent_faces_step(@builtin(global_invocation_id) id: vec3<u32>) {
    let entry = linear_index(id);
    if entry >= counts.z {
        return;
    }
    // The last vertex whose row starts at or before the entry: rows after it start later, empty rows before it end there.
    var low = 0u;
    var high = counts.y;
    while high - low > 1u {
        let middle = low + (high - low) / 2u;
        if face_offset[middle] <= entry {
            low = middle;
        } else {
            high = middle;
        }
    }
    let face = faces[entry];
    if counts.y == 0u || face >= counts.x / 3u || entry >= face_offset[low + 1u] {
        return;
    }
    for (var k = 0u; k < 3u; k++) {
        let corner = 3u * face + k;
        if corner_vertex[corner] == low {
            let value = cosine(corner);
            if value != NONE {
                atomicMax(&smallest[low], key_of(value));
            }
            return;
        }
    }
}
