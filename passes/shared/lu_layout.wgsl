// The layout of a look-up table: middle of the light's box and largest distance from it, and for a planar light its axes and how
// far its plane is from the middle. One workgroup; the largest of many is found twice over: each invocation its own share's, then
// all of them the same. The plane is that of light_plane.rs. Joined after the prelude.
struct Numbers {
    count: u32,
    // 1: the light is to be planar.
    planar: u32,
    // How far off its plane a light sample may lie, of the light's extent and of its largest coordinate.
    share: f32,
    rounding: f32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> light_samples: array<f32>;
@group(0) @binding(2) var<storage, read_write> lu_layout: array<f32>;
@group(0) @binding(3) var<storage, read_write> counters: array<atomic<u32>>;

var<workgroup> lows: array<vec3<f32>, 64>;
var<workgroup> highs: array<vec3<f32>, 64>;

fn light_sample(index: u32) -> vec3<f32> {
    let start = 3u * min(index, max(numbers.count, 1u) - 1u);
    return vec3<f32>(light_samples[start], light_samples[start + 1u], light_samples[start + 2u]);
}

// The longest of everyone's `own`, the same for all.
fn longest(own: vec3<f32>, local: u32) -> vec3<f32> {
    // Nobody reads the last round any more.
    workgroupBarrier();
    lows[local] = own;
    workgroupBarrier();
    var best = lows[0];
    for (var other = 1u; other < GROUP; other++) {
        best = select(best, lows[other], dot(lows[other], lows[other]) > dot(best, best));
    }
    return best;
}

fn put(start: u32, value: vec3<f32>) {
    lu_layout[start] = value.x;
    lu_layout[start + 1u] = value.y;
    lu_layout[start + 2u] = value.z;
    lu_layout[start + 3u] = 0.0;
}

@compute @workgroup_size(64)
fn lu_layout_of(@builtin(local_invocation_index) local: u32) {
    var low = light_sample(local);
    var high = low;
    for (var index = local; index < numbers.count; index += GROUP) {
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
    var own = vec3<f32>(0.0);
    for (var index = local; index < numbers.count; index += GROUP) {
        let offset = light_sample(index) - middle;
        own = select(own, offset, dot(offset, offset) > dot(own, own));
    }
    let far = longest(own, local);
    let radius = length(far);
    // Three samples make the plane; none of them need be seen from the middle, which is off it where the light is tilted.
    let origin = light_sample(0u);
    own = vec3<f32>(0.0);
    for (var index = local; index < numbers.count; index += GROUP) {
        let offset = light_sample(index) - origin;
        own = select(own, offset, dot(offset, offset) > dot(own, own));
    }
    let span = longest(own, local);
    let extent = length(span);
    let sizes = max(abs(low), abs(high));
    let tolerance = numbers.share * extent + numbers.rounding * max(max(sizes.x, sizes.y), sizes.z);
    let x = select(vec3<f32>(1.0, 0.0, 0.0), span / max(extent, 1e-38), extent > 0.0);
    own = vec3<f32>(0.0);
    for (var index = local; index < numbers.count; index += GROUP) {
        let across = cross(x, light_sample(index) - origin);
        own = select(own, across, dot(across, across) > dot(own, own));
    }
    var normal = longest(own, local);
    // A light that is a segment lies in many planes: any will do.
    let any_other = normalize(cross(x, select(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), abs(x.x) > 0.5)));
    normal = select(any_other, normal / max(length(normal), 1e-38), length(normal) > tolerance);
    // In a long and narrow light, rounding leaves a part along the axis that counts over its length.
    normal = normalize(normal - x * dot(normal, x));
    // One of two.
    normal = select(normal, -normal, dot(normal, any_other) < 0.0);
    if local == 0u {
        put(0u, middle);
        lu_layout[3] = radius;
        let is_planar = numbers.planar == 1u;
        put(4u, select(vec3<f32>(0.0), x, is_planar));
        put(8u, select(vec3<f32>(0.0), cross(normal, x), is_planar));
        put(12u, select(vec3<f32>(0.0), normal, is_planar));
        lu_layout[15] = select(0.0, dot(normal, origin - middle), is_planar);
    }
    if numbers.planar == 1u {
        for (var index = local; index < numbers.count; index += GROUP) {
            // In f32 the plane, and a distance from it, may be off by as much again.
            if abs(dot(light_sample(index) - origin, normal)) > 2.0 * tolerance {
                atomicAdd(&counters[0], 1u);
            }
        }
    }
}
