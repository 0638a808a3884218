// Light samples as light_box.rs holds them: the middle of their box, its half extents, and places in it, four at a time; one workgroup.
// Joined after the prelude.
const LIGHT_BLOCK: u32 = 208u;
@group(0) @binding(0) var<uniform> count: u32;
@group(0) @binding(1) var<storage, read> light_samples: array<f32>;
// For each block of 256 light samples LIGHT_BLOCK vectors: the middle and the largest distance from it; half extents and their sum; then
// xxxx, yyyy, zzzz of every four light samples, past the last that one again; then nothing, up to
// where a uniform may start.
@group(0) @binding(2) var<storage, read_write> light: array<vec4<f32>>;

var<workgroup> lows: array<vec3<f32>, 64>;
var<workgroup> highs: array<vec3<f32>, 64>;

fn light_sample(index: u32) -> vec3<f32> {
    let start = 3u * min(index, count - 1u);
    return vec3<f32>(light_samples[start], light_samples[start + 1u], light_samples[start + 2u]);
}

@compute @workgroup_size(64)
fn light_box(@builtin(local_invocation_index) local: u32) {
    var low = light_sample(local);
    var high = low;
    for (var index = local; index < count; index += GROUP) {
        low = min(low, light_sample(index));
        high = max(high, light_sample(index));
    }
    lows[local] = low;
    highs[local] = high;
    // Everyone's share of the box is in.
    workgroupBarrier();
    for (var other = 0u; other < GROUP; other++) {
        low = min(low, lows[other]);
        high = max(high, highs[other]);
    }
    let middle = 0.5 * low + 0.5 * high;
    let half = max(high - middle, middle - low);
    var far = 0.0;
    for (var index = local; index < count; index += GROUP) {
        far = max(far, length(light_sample(index) - middle));
    }
    // Nobody reads the lows any more.
    workgroupBarrier();
    lows[local] = vec3<f32>(far);
    // Everyone's distance is in.
    workgroupBarrier();
    for (var other = 0u; other < GROUP; other++) {
        far = max(far, lows[other].x);
    }
    let blocks = (count + 255u) / 256u;
    for (var block = local; block < blocks; block += GROUP) {
        light[LIGHT_BLOCK * block] = vec4<f32>(middle, far);
        light[LIGHT_BLOCK * block + 1u] = vec4<f32>(half, half.x + half.y + half.z);
    }
    let has_extent = half > vec3<f32>(0.0);
    let divisor = select(vec3<f32>(1.0), half, has_extent);
    for (var four = local; four < blocks * 64u; four += GROUP) {
        let first = light_sample(4u * four) - middle;
        let second = light_sample(4u * four + 1u) - middle;
        let third = light_sample(4u * four + 2u) - middle;
        let fourth = light_sample(4u * four + 3u) - middle;
        let place = four / 64u * LIGHT_BLOCK + 2u + 3u * (four % 64u);
        light[place] = vec4<f32>(first.x, second.x, third.x, fourth.x) / divisor.x;
        light[place + 1u] = vec4<f32>(first.y, second.y, third.y, fourth.y) / divisor.y;
        light[place + 2u] = vec4<f32>(first.z, second.z, third.z, fourth.z) / divisor.z;
    }
}
