// Counts imported rows that are no view-samples of the scene; numbers the pixels where none were imported.

@group(0) @binding(0) var<uniform> size: vec4<u32>; // rows, triangles, whether pixels were imported, 0
@group(0) @binding(1) var<storage, read> position: array<u32>; // bits of floats
@group(0) @binding(2) var<storage, read> normal: array<u32>; // bits of floats
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read_write> pixel: array<u32>;
@group(0) @binding(5) var<storage, read_write> counters: array<atomic<u32>>; // not_finite, no_such_triangle

// By the exponent's bits: a compiler may assume that floats are finite.
fn is_finite(bits: u32) -> bool {
    return (bits & 0x7f800000u) != 0x7f800000u;
}

@compute @workgroup_size(64)
fn import_check(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if row >= size.x {
        return;
    }
    if size.z == 0u {
        pixel[row] = row;
    }
    if triangle[row] == NO_TRIANGLE {
        return;
    }
    var finite = true;
    for (var axis = 0u; axis < 3u; axis++) {
        finite = finite && is_finite(position[3u * row + axis]) && is_finite(normal[3u * row + axis]);
    }
    if !finite {
        atomicAdd(&counters[0], 1u);
    }
    if triangle[row] >= size.y {
        atomicAdd(&counters[1], 1u);
    }
}
