//! Colours that samples show to weights whose channels sum to one.

use super::drawn::Drawn;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::Texture;

/// The texel that holds (u, v): no blending, so that a mask stays a mask.
pub fn texel(texture: &Texture, [u, v]: [f64; 2]) -> [f64; 3] {
    let place = |x: f64, steps: usize| ((x * steps as f64) as usize).min(steps - 1);
    let at = place(v, texture.height) * texture.width + place(u, texture.width);
    texture.texels[at].map(f64::from)
}

/// Mean of colours; there is at least one.
pub fn mean(colors: &[[f32; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|c| colors.iter().map(|color| f64::from(color[c])).sum::<f64>() / colors.len() as f64)
}

/// `weight = emission / sum of emissions` for each channel, and the mean emission. A channel in which nothing shines has equal
/// weights, as its colour is black anyway.
///
/// # Errors
/// Nothing shines in any channel.
pub fn weights(drawn: &[Drawn]) -> Result<(Vec<[f32; 3]>, [f64; 3]), Problem> {
    let count = drawn.len();
    let equal = 1.0 / count as f32;
    let mut weights = vec![[equal; 3]; count];
    let mut mean = [0.0; 3];
    for (channel, mean) in mean.iter_mut().enumerate() {
        let first = drawn[0].emission[channel];
        if drawn.iter().all(|drawn| drawn.emission[channel] == first) {
            *mean = first;
            continue;
        }
        let total: f64 = drawn.iter().map(|drawn| drawn.emission[channel]).sum();
        *mean = total / count as f64;
        for (weight, drawn) in weights.iter_mut().zip(drawn) {
            weight[channel] = (drawn.emission[channel] / total) as f32;
        }
    }
    if mean == [0.0; 3] {
        return Err(Problem::new(
            Kind::BadValue,
            "the light emits nothing: its colours are black at every light sample",
        )
        .remedy("use a texture or colours that are not black, or more light samples"));
    }
    Ok((weights, mean))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(emission: [f64; 3]) -> Drawn {
        Drawn { position: [0.0; 3], emission }
    }

    #[test]
    fn shares_counted_by_hand() {
        let (weights, mean) = weights(&[drawn([3.0, 1.0, 0.0]), drawn([1.0, 1.0, 0.0])]).unwrap();
        assert_eq!(weights, [[0.75, 0.5, 0.5], [0.25, 0.5, 0.5]]);
        assert_eq!(mean, [2.0, 1.0, 0.0]);
        assert_eq!(super::weights(&[drawn([0.0; 3])]).unwrap_err().kind, Kind::BadValue);
    }

    #[test]
    fn texels_are_found_from_the_top_left() {
        let texels = (0..6).map(|index| [index as f32; 3]).collect();
        let texture = Texture { width: 3, height: 2, texels };
        let at = |u, v| texel(&texture, [u, v])[0];
        assert_eq!([at(0.0, 0.0), at(0.34, 0.4), at(1.0, 0.0), at(0.0, 0.5), at(1.0, 1.0)], [0.0, 1.0, 2.0, 3.0, 5.0]);
    }
}
