// The smallest cosine around each vertex and corner, as around.rs has it. Joined after shading; the pass's kernel has binding 3, its
// light, and `light_cosine`. Cosines travel as keys that order as the numbers do, so that the smallest is an atomicMin; keys are kept inverted, so that
// the largest inverted key is wanted and zeroed memory means that nothing was counted.

@group(0) @binding(0) var<uniform> counts: vec4<u32>; // corners, vertices, entries of faces
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> corner_vertex: array<u32>;
@group(0) @binding(4) var<storage, read_write> smallest: array<atomic<u32>>;
@group(0) @binding(5) var<storage, read> face_offset: array<u32>;
@group(0) @binding(6) var<storage, read> faces: array<u32>;
@group(0) @binding(7) var<storage, read_write> corner_light: array<f32>;

const NONE: f32 = 2.0;

fn corner_at(index: u32) -> vec3<f32> {
    return vec3<f32>(triangles[3u * index], triangles[3u * index + 1u], triangles[3u * index + 2u]);
}

// The cosine of the face of a corner at that corner, or NONE if the face has no normal.
fn cosine(corner: u32) -> f32 {
    let first = corner / 3u * 3u;
    let normal = face_normal(corner_at(first), corner_at(first + 1u), corner_at(first + 2u));
    if all(normal == vec3<f32>(0.0)) {
        return NONE;
    }
    return light_cosine(normal, corner_at(corner));
}

fn key_of(value: f32) -> u32 {
    let bits = bitcast<u32>(value);
    return ~select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

fn value_of(key: u32) -> f32 {
    if key == 0u {
        return NONE;
    }
    let bits = ~key;
    return bitcast<f32>(select(~bits, bits & 0x7fffffffu, (bits & 0x80000000u) != 0u));
}

// One entry of `faces`: its vertex by bisection, its face's cosine there to the vertex's smallest.
fn step_entry(entry: u32) {
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

// One corner: the smallest around its vertex, its own face among them.
fn step_corner(corner: u32) {
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
