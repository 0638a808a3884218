// Numbers of every dispatch that makes a picture. Joined before the pieces that bind arrays.

struct ShadeNumbers {
    sample_count: u32,
    triangle_count: u32,
    pixel_count: u32,
    // 1: light weakens with the square of the distance.
    falls_off: u32,
    background: vec3<f32>,
    ambient: f32,
    falloff_distance: f32,
    // bent_lambert: c. phong, full_sum: specular, shininess.
    first: f32,
    second: f32,
    // Words a view-sample of `visible`: 1, or 3 for one a channel.
    channels: u32,
    // full_sum: light samples, and words of a mask.
    light_samples: u32,
    mask_words: u32,
}

@group(0) @binding(0) var<uniform> numbers: ShadeNumbers;

// Place of a view-sample that is not shaded.
const NO_PLACE: u32 = 0xffffffffu;

// What the colour of a light is divided by that lies `offset` away: 1, or the square of the distance.
fn weakening(offset: vec3<f32>) -> f32 {
    if numbers.falls_off == 0u {
        return 1.0;
    }
    let distances = max(length(offset / numbers.falloff_distance), 1e-6);
    return distances * distances;
}
