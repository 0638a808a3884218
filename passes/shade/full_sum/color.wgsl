fn arriving(row: u32, albedo: vec3<f32>) -> vec3<f32> {
    let first = 6u * row;
    let cosines = vec3<f32>(lighting[first], lighting[first + 1u], lighting[first + 2u]);
    let highlights = vec3<f32>(lighting[first + 3u], lighting[first + 4u], lighting[first + 5u]);
    return light_color() * (albedo * cosines + highlights);
}
