// Directions and weights that lighting is made of; the same operations in the same order as shading.rs.

fn largest_of(v: vec3<f32>) -> f32 {
    return max(max(v.x, v.y), v.z);
}

fn shading_dot(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// v at length 1; zero stays zero.
fn unit(v: vec3<f32>) -> vec3<f32> {
    let largest = largest_of(abs(v));
    if !(largest > 0.0 && largest <= 3.4028234e38) {
        return vec3<f32>(0.0);
    }
    let scaled = v / largest;
    return scaled / sqrt(shading_dot(scaled, scaled));
}

// Unit normal on the side from which the corners turn counter-clockwise; zero for a degenerate triangle.
fn face_normal(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let e1 = b - a;
    let e2 = c - a;
    let largest = largest_of(max(abs(e1), abs(e2)));
    if !(largest > 0.0 && largest <= 3.4028234e38) {
        return vec3<f32>(0.0);
    }
    return unit(cross(e1 / largest, e2 / largest));
}

// Weights of the corners at a point, none negative, sum 1.
fn corner_weights(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, at: vec3<f32>) -> vec3<f32> {
    let largest = largest_of(max(abs(b - a), abs(c - a)));
    if !(largest > 0.0 && largest <= 3.4028234e38) {
        return vec3<f32>(1.0 / 3.0);
    }
    let to_a = (a - at) / largest;
    let to_b = (b - at) / largest;
    let to_c = (c - at) / largest;
    let normal = cross((b - a) / largest, (c - a) / largest);
    let areas = max(vec3<f32>(
        shading_dot(normal, cross(to_b, to_c)),
        shading_dot(normal, cross(to_c, to_a)),
        shading_dot(normal, cross(to_a, to_b))), vec3<f32>(0.0));
    let sum = areas.x + areas.y + areas.z;
    if sum > 0.0 {
        return areas / sum;
    }
    return vec3<f32>(1.0 / 3.0);
}
