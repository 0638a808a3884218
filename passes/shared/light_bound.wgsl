// The convex body around the light samples and the origin of the light frame, as light_bound.rs makes it, by one workgroup: world
// offsets from the origin, in f32 with room for its rounding. Joined after shared::PRELUDE and light_frame.wgsl.

struct Request {
    // Light samples, sides, 1: ellipsoid, bits of the radius of a regular polygon around the unit circle.
    size: vec4<u32>,
    // Directions of the sides, two in each: sines and cosines of devices are too coarse.
    directions: array<vec4<f32>, 4>,
}
@group(0) @binding(0) var<uniform> request: Request;
@group(0) @binding(1) var<storage, read> light_samples: array<f32>;
@group(0) @binding(2) var<storage, read> light_frame: array<f32>;
@group(0) @binding(3) var<storage, read_write> light_body: array<f32>;

const FLAT: f32 = 1e-3;
// Coordinates along the axes err by this share of the largest offset: sums of three products, and axes after eighteen turns.
const STRAY: f32 = 4e-6;

// What each invocation found, and what all did.
var<workgroup> part_low: array<vec3<f32>, 64>;
var<workgroup> part_high: array<vec3<f32>, 64>;
var<workgroup> part_supports: array<array<f32, 8>, 64>;
var<workgroup> whole_low: vec3<f32>;
var<workgroup> whole_high: vec3<f32>;
var<workgroup> axes: mat3x3<f32>;

// The light samples, and the origin as one more.
fn offset_of(index: u32) -> vec3<f32> {
    if index >= request.size.x {
        return vec3<f32>(0.0);
    }
    let sample = vec3<f32>(light_samples[3u * index], light_samples[3u * index + 1u], light_samples[3u * index + 2u]);
    return sample - light_origin(0u);
}

// Each barrier lets one invocation read what all wrote, or all what one wrote.
fn reduce_ends(local: u32) {
    workgroupBarrier();
    if local == 0u {
        whole_low = part_low[0];
        whole_high = part_high[0];
        for (var k = 1u; k < 64u; k++) {
            whole_low = min(whole_low, part_low[k]);
            whole_high = max(whole_high, part_high[k]);
        }
    }
    workgroupBarrier();
}

fn reduce_sums(local: u32) {
    workgroupBarrier();
    if local == 0u {
        whole_low = part_low[0];
        whole_high = part_high[0];
        for (var k = 1u; k < 64u; k++) {
            whole_low += part_low[k];
            whole_high += part_high[k];
        }
    }
    workgroupBarrier();
}

// Jacobi's rotations: axes along which the spread, with squares on the diagonal and products off it, is uncorrelated.
fn principal_axes(squares: vec3<f32>, products: vec3<f32>) -> mat3x3<f32> {
    var spread = mat3x3<f32>(
        vec3<f32>(squares.x, products.x, products.y),
        vec3<f32>(products.x, squares.y, products.z),
        vec3<f32>(products.y, products.z, squares.z),
    );
    var turned = mat3x3<f32>(vec3<f32>(1.0, 0.0, 0.0), vec3<f32>(0.0, 1.0, 0.0), vec3<f32>(0.0, 0.0, 1.0));
    for (var step = 0u; step < 18u; step++) {
        let p = select(0u, 1u, step % 3u == 2u);
        let q = select(2u, 1u, step % 3u == 0u);
        let product = spread[p][q];
        if abs(product) <= 1e-7 * (spread[p][p] + spread[q][q]) {
            continue;
        }
        let cot = (spread[q][q] - spread[p][p]) / (2.0 * product);
        let tan = select(-1.0, 1.0, cot >= 0.0) / (abs(cot) + sqrt(cot * cot + 1.0));
        let cos = 1.0 / sqrt(tan * tan + 1.0);
        let sin = tan * cos;
        for (var k = 0u; k < 3u; k++) {
            let at = vec2<f32>(spread[k][p], spread[k][q]);
            spread[k][p] = cos * at.x - sin * at.y;
            spread[k][q] = sin * at.x + cos * at.y;
        }
        let row_p = spread[p];
        let row_q = spread[q];
        spread[p] = cos * row_p - sin * row_q;
        spread[q] = sin * row_p + cos * row_q;
        let axis_p = turned[p];
        let axis_q = turned[q];
        turned[p] = cos * axis_p - sin * axis_q;
        turned[q] = sin * axis_p + cos * axis_q;
    }
    return turned;
}

fn direction(k: u32) -> vec2<f32> {
    let two = request.directions[k / 2u];
    return select(two.xy, two.zw, k % 2u == 1u);
}

fn store(word: u32, value: vec3<f32>) {
    light_body[word] = value.x;
    light_body[word + 1u] = value.y;
    light_body[word + 2u] = value.z;
}

@compute @workgroup_size(64)
fn influence_light(@builtin(local_invocation_index) local: u32) {
    // Mean, in units of the largest coordinate.
    var largest = 0.0;
    for (var index = local; index <= request.size.x; index += 64u) {
        let at = abs(offset_of(index));
        largest = max(largest, max(at.x, max(at.y, at.z)));
    }
    part_low[local] = vec3<f32>(0.0);
    part_high[local] = vec3<f32>(largest);
    reduce_ends(local);
    largest = whole_high.x;
    let unit = select(1.0, largest, largest > 0.0);
    var sum = vec3<f32>(0.0);
    for (var index = local; index <= request.size.x; index += 64u) {
        sum += offset_of(index) / unit;
    }
    part_low[local] = sum;
    reduce_sums(local);
    let mean = whole_low / f32(request.size.x + 1u);

    // Spread, and its axes.
    var squares = vec3<f32>(0.0);
    var products = vec3<f32>(0.0);
    for (var index = local; index <= request.size.x; index += 64u) {
        let at = offset_of(index) / unit - mean;
        squares += at * at;
        products += at.xxy * at.yzz;
    }
    workgroupBarrier();
    part_low[local] = squares;
    part_high[local] = products;
    reduce_sums(local);
    if local == 0u {
        axes = principal_axes(whole_low, whole_high);
    }
    workgroupBarrier();

    // Extents along them.
    var low = vec3<f32>(3e38);
    var high = vec3<f32>(-3e38);
    for (var index = local; index <= request.size.x; index += 64u) {
        let at = offset_of(index) * axes;
        low = min(low, at);
        high = max(high, at);
    }
    part_low[local] = low;
    part_high[local] = high;
    reduce_ends(local);
    let middle = 0.5 * (whole_low + whole_high);
    let half = 0.5 * (whole_high - whole_low);
    var third = 0u;
    for (var k = 1u; k < 3u; k++) {
        third = select(third, k, half[k] < half[third]);
    }
    var first = select(0u, 1u, third == 0u);
    var second = select(2u, 1u, third == 2u);
    if half[second] > half[first] {
        let other = first;
        first = second;
        second = other;
    }

    // The polygon's sides, and the solid's reach.
    let unit_first = select(1.0, half[first], half[first] > 0.0);
    let unit_second = select(1.0, half[second], half[second] > 0.0);
    let scale = select(vec3<f32>(1.0), half, request.size.z == 1u && half[third] > 0.0);
    var reach = 0.0;
    var supports = array<f32, 8>(-3e38, -3e38, -3e38, -3e38, -3e38, -3e38, -3e38, -3e38);
    for (var index = local; index <= request.size.x; index += 64u) {
        let at = offset_of(index) * axes - middle;
        reach = max(reach, length(at / scale));
        for (var k = 0u; k < request.size.y; k++) {
            let along = dot(direction(k), vec2<f32>(at[first] / unit_first, at[second] / unit_second));
            supports[k] = max(supports[k], along);
        }
    }
    workgroupBarrier();
    part_low[local] = vec3<f32>(0.0);
    part_high[local] = vec3<f32>(reach);
    part_supports[local] = supports;
    reduce_ends(local);
    if local != 0u {
        return;
    }
    for (var other = 1u; other < 64u; other++) {
        for (var k = 0u; k < request.size.y; k++) {
            supports[k] = max(supports[k], part_supports[other][k]);
        }
    }

    let centre = axes * middle;
    let stray = STRAY * largest;
    for (var k = 0u; k < request.size.y; k++) {
        let corner = direction(k) * bitcast<f32>(request.size.w);
        light_body[52u + 2u * k] = corner.x;
        light_body[53u + 2u * k] = corner.y;
    }
    store(1u, centre);
    light_body[15] = f32(request.size.y);
    if half[third] <= FLAT * half[first] {
        light_body[0] = 1.0;
        light_body[13] = half[third] + 2.0 * stray;
        var far = 0.0;
        for (var k = 0u; k < request.size.y; k++) {
            let next = (k + 1u) % request.size.y;
            let a = direction(k);
            let b = direction(next);
            let determinant = a.x * b.y - a.y * b.x;
            let x = (supports[k] * b.y - supports[next] * a.y) / determinant * unit_first;
            let y = (supports[next] * a.x - supports[k] * b.x) / determinant * unit_second;
            let corner = centre + x * axes[first] + y * axes[second];
            store(28u + 3u * k, corner);
            far = max(far, abs(corner.x) + abs(corner.y) + abs(corner.z));
        }
        light_body[14] = far + 2.0 * light_body[13];
        store(25u, axes[third]);
        return;
    }
    light_body[0] = 0.0;
    light_body[13] = 0.0;
    let widened = whole_high.x * 1.00001 + stray / min(scale.x, min(scale.y, scale.z));
    var far = abs(centre.x) + abs(centre.y) + abs(centre.z);
    for (var k = 0u; k < 3u; k++) {
        let axis = axes[k] * scale[k] * widened;
        store(4u + 3u * k, axis);
        // The axes are orthogonal but for rounding, which whoever scales by these rows leaves room for.
        store(16u + 3u * k, axes[k] / (scale[k] * widened));
        far += abs(axis.x) + abs(axis.y) + abs(axis.z);
    }
    light_body[14] = far;
    store(25u, vec3<f32>(0.0));
}
