// On which side of a plane the light is, in f32 with bounds on rounding: `side_of_light` of view_planes.rs. Joined after face_light.wgsl
// or a piece with `sum_of_sizes`; reads `light_box`, of which the first two vectors are the middle and radius, half extents and their sum.

// As in pyramid.wgsl.
const PLANE_ROUNDING: f32 = 12.0 / 16777216.0;

struct Plane {
    normal: vec3<f32>,
    // Times the sum of the sizes of an offset: how far rounding can move a height.
    slack: f32,
}

fn plane_of(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> Plane {
    let p = b - a;
    let q = c - a;
    let left = p.yzx * q.zxy;
    let right = p.zxy * q.yzx;
    let size = abs(left) + abs(right);
    return Plane(left - right, PLANE_ROUNDING * max(size.x, max(size.y, size.z)));
}

// 1 where all of the light is surely on the side that the normal points to, -1 on the other, 0 where it may be on both.
fn whole_side(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> f32 {
    let plane = plane_of(a, b, c);
    let offset = light_box[0].xyz - a;
    let height = dot(plane.normal, offset);
    let spread = min(dot(abs(plane.normal), light_box[1].xyz), length(plane.normal) * light_box[0].w) * 1.000002;
    let slack = plane.slack * (sum_of_sizes(offset) + light_box[1].w);
    return select(0.0, sign(height), abs(height) > spread + slack);
}
