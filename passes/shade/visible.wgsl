// The visible share of the light and its colour as it arrives from the centre. Joined after color.
@group(0) @binding(7) var<storage, read> visible: array<f32>;

fn visible_share(row: u32) -> vec3<f32> {
    if numbers.channels == 1u {
        return vec3<f32>(visible[row]);
    }
    return vec3<f32>(visible[3u * row], visible[3u * row + 1u], visible[3u * row + 2u]);
}

fn light_at(row: u32) -> vec3<f32> {
    return light_color() / lighting[3u * row];
}
