// One invocation a triangle: left out when it is closed and surely turned towards every light sample.

@group(0) @binding(0) var<uniform> size: vec4<u32>; // triangles, light samples, flag of closed meshes, 0
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> triangle_flags: array<u32>;
@group(0) @binding(3) var<storage, read> light_samples: array<f32>;
@group(0) @binding(4) var<storage, read_write> caster_state: array<u32>;
// Triangles left out.
@group(0) @binding(5) var<storage, read_write> culled: atomic<u32>;

// Rounding of the determinant, as a share of the sum of its terms' sizes: Shewchuk (1997), the first bound of orient3d, is
// 7 half units in the last place, 4.2e-7; more than doubled for devices that round less well.
const ROUNDING: f32 = 1e-6;
// Where terms are so small that they may have been flushed to zero, nothing is certain.
const TINY: f32 = 1e-30;

fn triangle_corner(index: u32, corner: u32) -> vec3<f32> {
    let word = 9u * index + 3u * corner;
    return vec3<f32>(triangles[word], triangles[word + 1u], triangles[word + 2u]);
}

// Whether `d` surely lies on the side from which a, b, c are seen counter-clockwise; false when numbers overflow.
fn surely_in_front(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> bool {
    let ab = b - a;
    let ac = c - a;
    let ad = d - a;
    let left = ab.yzx * ac.zxy;
    let right = ab.zxy * ac.yzx;
    let determinant = dot(left - right, ad);
    let sizes = dot(abs(left) + abs(right), abs(ad));
    return determinant > ROUNDING * sizes + TINY;
}

@compute @workgroup_size(64)
fn light_back_facing(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.x {
        return;
    }
    var casts = (triangle_flags[index] & size.z) == 0u;
    let a = triangle_corner(index, 0u);
    let b = triangle_corner(index, 1u);
    let c = triangle_corner(index, 2u);
    for (var s = 0u; s < size.y && !casts; s++) {
        let sample = vec3<f32>(light_samples[3u * s], light_samples[3u * s + 1u], light_samples[3u * s + 2u]);
        casts = !surely_in_front(a, b, c, sample);
    }
    caster_state[index] = select(0u, 1u, casts);
    if !casts {
        atomicAdd(&culled, 1u);
    }
}
