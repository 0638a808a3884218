// One view-sample against every light sample, in the order of cpu.rs.
@group(0) @binding(1) var<storage, read> normals: array<f32>;
@group(0) @binding(2) var<storage, read> position: array<f32>;
@group(0) @binding(3) var<storage, read> place: array<u32>;
@group(0) @binding(4) var<storage, read> mask: array<u32>;
@group(0) @binding(5) var<storage, read> light_samples: array<f32>;
@group(0) @binding(6) var<storage, read> light_weights: array<f32>;
@group(0) @binding(7) var<storage, read> camera: array<f32>;
// Sum of cosines, then of highlights, RGB each.
@group(0) @binding(8) var<storage, read_write> lighting: array<f32>;

@compute @workgroup_size(64)
fn full_sum(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if row >= numbers.sample_count {
        return;
    }
    if place[row] == NO_PLACE {
        return;
    }
    let at = vec3<f32>(position[3u * row], position[3u * row + 1u], position[3u * row + 2u]);
    let n = vec3<f32>(normals[6u * row], normals[6u * row + 1u], normals[6u * row + 2u]);
    let plane = vec3<f32>(normals[6u * row + 3u], normals[6u * row + 4u], normals[6u * row + 5u]);
    let toward_eye = unit(vec3<f32>(camera[0], camera[1], camera[2]) - at);
    var cosines = vec3<f32>(0.0);
    var highlights = vec3<f32>(0.0);
    for (var word = 0u; word < numbers.mask_words; word++) {
        let blocked = mask[row * numbers.mask_words + word];
        if blocked == 0xffffffffu {
            continue;
        }
        var cosines_of_word = vec3<f32>(0.0);
        var highlights_of_word = vec3<f32>(0.0);
        let end = min(32u * (word + 1u), numbers.light_samples);
        for (var sample = 32u * word; sample < end; sample++) {
            let first = 3u * sample;
            let offset = vec3<f32>(light_samples[first], light_samples[first + 1u], light_samples[first + 2u]) - at;
            // Behind the surface itself no caster is needed.
            if (blocked >> (sample % 32u) & 1u) == 0u && shading_dot(offset, plane) > 0.0 {
                let weight = vec3<f32>(light_weights[first], light_weights[first + 1u], light_weights[first + 2u])
                    / weakening(offset);
                let terms = phong_terms(n, unit(offset), toward_eye);
                cosines_of_word += weight * terms.x;
                highlights_of_word += weight * terms.y;
            }
        }
        cosines += cosines_of_word;
        highlights += highlights_of_word;
    }
    for (var k = 0u; k < 3u; k++) {
        lighting[6u * row + k] = cosines[k];
        lighting[6u * row + 3u + k] = highlights[k];
    }
}
