// The predicate of predicate.rs in two-float arithmetic: a number is the unevaluated sum high + low of two f32, about 48 bits.
// Signs differ from the exact ones only where a determinant is below 2^-44 of its terms and not exactly zero.
//
// WGSL lets a compiler treat float sums as real ones: (a + b) - a may become b, which would undo the error terms. Every value
// whose rounding matters passes through `held`, an exclusive or with zero bits that come from memory, so that no compiler sees
// through it. The kernel that joins this piece defines `fn opaque_zero() -> u32`: a word of a uniform that holds zero.
// Joined before: `var<storage, read> triangles: array<f32>`.

struct Wide3 {
    high: vec3<f32>,
    low: vec3<f32>,
}

fn held(value: vec3<f32>) -> vec3<f32> {
    return bitcast<vec3<f32>>(bitcast<vec3<u32>>(value) ^ vec3<u32>(opaque_zero()));
}

// a + b without error, in any order of magnitude.
fn exact_sum(a: vec3<f32>, b: vec3<f32>) -> Wide3 {
    let sum = held(a + b);
    let added = held(sum - a);
    return Wide3(sum, (a - held(sum - added)) + (b - added));
}

// a + b without error where |a| >= |b|.
fn ordered_sum(a: vec3<f32>, b: vec3<f32>) -> Wide3 {
    let sum = held(a + b);
    return Wide3(sum, b - held(sum - a));
}

// The upper 12 bits of the significand: products of such halves are exact.
fn upper_half(value: vec3<f32>) -> vec3<f32> {
    return bitcast<vec3<f32>>(bitcast<vec3<u32>>(value) & vec3<u32>(0xfffff000u));
}

// a * b without error.
fn exact_product(a: vec3<f32>, b: vec3<f32>) -> Wide3 {
    let product = held(a * b);
    let a_high = upper_half(a);
    let a_low = a - a_high;
    let b_high = upper_half(b);
    let b_low = b - b_high;
    return Wide3(product, a_low * b_low - held(held(held(product - a_high * b_high) - a_low * b_high) - a_high * b_low));
}

fn wide_product(a: Wide3, b: Wide3) -> Wide3 {
    let product = exact_product(a.high, b.high);
    return ordered_sum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

fn wide_sum(a: Wide3, b: Wide3) -> Wide3 {
    let high = exact_sum(a.high, b.high);
    let low = exact_sum(a.low, b.low);
    let sum = ordered_sum(high.high, high.low + low.high);
    return ordered_sum(sum.high, sum.low + low.low);
}

// det(p, q, r) as high + low, to about 2^-44 of its terms.
fn determinant(p: Wide3, q: Wide3, r: Wide3) -> vec2<f32> {
    let left = wide_product(Wide3(q.high.yzx, q.low.yzx), Wide3(r.high.zxy, r.low.zxy));
    let right = wide_product(Wide3(q.high.zxy, q.low.zxy), Wide3(r.high.yzx, r.low.yzx));
    let terms = wide_product(p, wide_sum(left, Wide3(-right.high, -right.low)));
    let two = wide_sum(terms, Wide3(terms.high.yzx, terms.low.yzx));
    let all = wide_sum(two, Wide3(terms.high.zxy, terms.low.zxy));
    return vec2<f32>(all.high.x, all.low.x);
}

// Sign of det(a - d, b - d, c - d): -1, 0 or 1.
fn orientation(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> f32 {
    let value = determinant(exact_sum(a, -d), exact_sum(b, -d), exact_sum(c, -d));
    // Of two equal points the terms cancel, but not to the last bit.
    return select(select(sign(value.x), sign(value.y), value.x == 0.0), 0.0, all(a == b) || all(b == c) || all(c == a));
}

fn triangle_corner(triangle: u32, corner: u32) -> vec3<f32> {
    let start = triangle * 9u + corner * 3u;
    return vec3<f32>(triangles[start], triangles[start + 1u], triangles[start + 2u]);
}

// Whether the segment from `position` to the light sample meets the closed triangle: `Pyramid::covers`. One call site of
// `orientation` in a loop, because compilers copy it into every one.
fn predicate_covers(caster: u32, position: vec3<f32>, light: vec3<f32>) -> bool {
    let a = triangle_corner(caster, 0u);
    let b = triangle_corner(caster, 1u);
    let c = triangle_corner(caster, 2u);
    var w = 0.0;
    for (var step = 0u; step < 5u; step++) {
        // Steps 0 and 1: the side of the caster's plane that P, and the light sample, is on. 2 to 4: the pyramid.
        let p = select(light, a, step < 2u);
        let q = select(select(c, b, step == 3u), select(a, b, step < 2u), step <= 2u);
        let r = select(select(a, c, step == 3u), select(b, c, step < 2u), step <= 2u);
        let side = orientation(p, q, r, select(position, light, step == 1u));
        if step == 0u {
            w = side;
        }
        let outside = select((w * side < 0.0), (w * side > 0.0), step == 1u);
        if w == 0.0 || outside {
            return false;
        }
    }
    return true;
}

// Whether some corner of the caster lies strictly on the light sample's side of the plane of triangle `own`; true when that side is
// undefined: `OwnPlane::admits`.
fn predicate_admits(own: u32, caster: u32, light: vec3<f32>) -> bool {
    let a = triangle_corner(own, 0u);
    let b = triangle_corner(own, 1u);
    let c = triangle_corner(own, 2u);
    var light_side = 0.0;
    for (var step = 0u; step < 4u; step++) {
        var point = light;
        if step > 0u {
            point = triangle_corner(caster, step - 1u);
        }
        let side = orientation(a, b, c, point);
        if step == 0u {
            light_side = side;
        }
        if light_side == 0.0 || (step > 0u && side == light_side) {
            return true;
        }
    }
    return false;
}
