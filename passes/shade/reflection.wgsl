// Cosine and highlight of a light in direction l, as reflection.rs has them; zeros where it is behind. Joined after numbers and shading.
fn phong_terms(n: vec3<f32>, l: vec3<f32>, toward_eye: vec3<f32>) -> vec2<f32> {
    let cosine = shading_dot(n, l);
    if !(cosine > 0.0) {
        return vec2<f32>(0.0);
    }
    let mirrored = 2.0 * cosine * n - l;
    let along = max(shading_dot(mirrored, toward_eye), 0.0);
    // pow of 0 is not defined everywhere.
    let highlight = select(0.0, numbers.first * pow(along, numbers.second), along > 0.0);
    return vec2<f32>(cosine, highlight);
}
