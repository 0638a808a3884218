fn arriving(row: u32, albedo: vec3<f32>) -> vec3<f32> {
    return visible_share(row) * (albedo * light_at(row) * lighting[3u * row + 1u]);
}
