fn arriving(row: u32, albedo: vec3<f32>) -> vec3<f32> {
    return visible_share(row) * (light_at(row) * (albedo * lighting[3u * row + 1u] + lighting[3u * row + 2u]));
}
