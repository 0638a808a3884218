// A caster seen from the light sample: the three planes through the light sample and its edges, and its supporting plane
// (Sintorn 2008, section 3.3), in f32 with bounds on what rounding does to them; what they cannot vouch for is left to
// predicate.wgsl, which is joined before.
//
// With u = 2^-24: an offset errs by u of itself, a component of a cross product by 4 u (|x y'| + |y x'|), a dot product by 8 u
// of the largest such component times the sum of |offset|. ROUNDING leaves a third to spare.
const ROUNDING: f32 = 12.0 / 16777216.0;

struct Pyramid {
    // xyz: normal of the plane through the light sample and an edge, towards the inside; w: times the sum of |offset|, how far
    // rounding can move the product.
    side_0: vec4<f32>,
    side_1: vec4<f32>,
    side_2: vec4<f32>,
    // Supporting plane, away from the light sample; w likewise.
    front: vec4<f32>,
    // dot(front.xyz, offset) of the plane itself, above zero; and how far rounding can move that.
    distance: f32,
    slack: f32,
    // 1 or -1: winding as the light sample sees it; 0: rounding hides it, and every test is left to the predicate.
    winding: f32,
}

// Cross product, and the bound of its rounding.
fn plane_through(a: vec3<f32>, b: vec3<f32>) -> vec4<f32> {
    let left = a.yzx * b.zxy;
    let right = a.zxy * b.yzx;
    let size = abs(left) + abs(right);
    return vec4<f32>(left - right, ROUNDING * max(size.x, max(size.y, size.z)));
}

fn sum_of_sizes(a: vec3<f32>) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

// The pyramid of triangle (a, b, c) over the light sample.
fn pyramid_of(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, light: vec3<f32>) -> Pyramid {
    let from_light = a - light;
    let front = plane_through(b - a, c - a);
    let distance = dot(front.xyz, from_light);
    let slack = front.w * sum_of_sizes(from_light);
    var winding = sign(distance);
    if !(abs(distance) > slack) {
        winding = 0.0;
    }
    let turn = vec4<f32>(vec3<f32>(winding), 1.0);
    return Pyramid(
        plane_through(from_light, b - a) * turn,
        plane_through(b - light, c - b) * turn,
        plane_through(c - light, a - c) * turn,
        front * turn,
        distance * winding,
        // Without a winding the normals are zero, and this makes every view-sample doubtful.
        select(slack, 1.0 + 2.0 * abs(distance) + slack, winding == 0.0),
        winding,
    );
}

// Whether two corners are one: such a triangle never blocks.
fn is_collapsed(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> bool {
    return all(a == b) || all(b == c) || all(c == a);
}

// A view-sample as pyramids take it: offset from the light sample, and a word that holds the triangle it lies on in its lower 24
// bits, and above them the exponent of the clearance: a caster that meets the segment to the light sample at more than this share
// of its length has a corner above the plane of that triangle, whatever rounding did. So it never is that triangle.
struct Sample {
    offset: vec3<f32>,
    own: u32,
}

const OWN_BITS: u32 = 0xffffffu;

// `own`: triangle of the view-sample, or any number past the last.
fn sample_of(place: vec3<f32>, own: u32, light: vec3<f32>) -> Sample {
    // No triangle: every share will do.
    var clearance = 0.0;
    if own < arrayLength(&triangles) / 9u {
        let a = triangle_corner(own, 0u);
        let plane = plane_through(triangle_corner(own, 1u) - a, triangle_corner(own, 2u) - a);
        let to_light = light - a;
        let to_place = place - a;
        let light_height = dot(plane.xyz, to_light);
        let side = sign(light_height);
        // At least this far above the plane is the light sample, at most so far below it the view-sample.
        let above = abs(light_height) - plane.w * sum_of_sizes(to_light);
        let below = max(plane.w * sum_of_sizes(to_place) - side * dot(plane.xyz, to_place), 0.0);
        clearance = select(1e30, 4.0 * below / above, above > 0.0 && 16.0 * below < above);
    }
    // Met at share s, the segment is at least s above - (1 - s) below over the plane. The factor of four leaves room for rounding
    // down to a power of two.
    let exponent = (bitcast<u32>(clearance) >> 23u) << 24u;
    return Sample(place - light, exponent | min(own, OWN_BITS));
}

fn sample_clearance(sample: Sample) -> f32 {
    return bitcast<f32>((sample.own >> 24u) << 23u);
}

// Verdicts; of several casters, the greatest counts.
const LIT: u32 = 0u;
// Only predicate.wgsl can tell.
const DOUBTFUL: u32 = 1u;
const BLOCKED: u32 = 2u;

// What the caster does to a view-sample, as far as f32 can vouch for it.
fn pyramid_verdict(pyramid: Pyramid, caster: u32, sample: Sample) -> u32 {
    let size = sum_of_sizes(sample.offset);
    let side = vec3<f32>(
        dot(pyramid.side_0.xyz, sample.offset),
        dot(pyramid.side_1.xyz, sample.offset),
        dot(pyramid.side_2.xyz, sample.offset),
    );
    let side_slack = size * vec3<f32>(pyramid.side_0.w, pyramid.side_1.w, pyramid.side_2.w);
    let front = dot(pyramid.front.xyz, sample.offset) - pyramid.distance;
    let front_slack = size * pyramid.front.w + pyramid.slack;
    let most = side + side_slack;
    let least = side - side_slack;
    let may = min(min(most.x, most.y), min(most.z, front + front_slack)) >= 0.0;
    // The segment is met at a share front / (front + distance) of its length.
    let clear = front - front_slack - sample_clearance(sample) * (pyramid.distance + pyramid.slack);
    let must = min(min(least.x, least.y), min(least.z, clear)) > 0.0;
    let doubtful = may && (sample.own & OWN_BITS) != caster;
    return select(select(LIT, DOUBTFUL, doubtful), BLOCKED, must);
}

// Whether the caster blocks the light sample at a doubtful view-sample.
fn pyramid_decide(caster: u32, place: vec3<f32>, own: u32, light: vec3<f32>) -> bool {
    if !predicate_covers(caster, place, light) {
        return false;
    }
    return own >= arrayLength(&triangles) / 9u || predicate_admits(own, caster, light);
}
