use super::cpu::table;
use crate::shared::area_light_scenes::ball;
use crate::shared::hard_scenes::Random;
use crate::shared::light_box::LightBox;
use crate::shared::lu::{Layout, bin, direction_bins};
use crate::shared::lu_fill::opposite_direction;

fn plane(r: &mut Random) -> ([f32; 3], f32) {
    loop {
        let normal = r.point();
        let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
        if (0.1..=1.0).contains(&length) {
            return (normal.map(|x| x / length), r.signed());
        }
    }
}

/// Wrong bits of a look-up at the nearest bin, of all bits.
fn wrong_share(size: usize) -> f64 {
    let samples = ball(128);
    let layout = Layout::new(&LightBox::new(&samples));
    let words = table(&samples, &layout, size);
    let r = &mut Random(5);
    let count = 20_000;
    let mut wrong = 0;
    for _ in 0..count {
        let (normal, distance) = plane(r);
        let [theta, phi] = direction_bins(normal, size);
        let at = ((theta * size + phi) * size + bin(0.5 + 0.5 * distance, size)) * 4;
        for (place, sample) in samples.iter().enumerate() {
            let offset = layout.offset(*sample);
            let inside = (0..3).map(|k| normal[k] * offset[k]).sum::<f32>() + distance >= 0.0;
            wrong += usize::from((words[at + place / 32] >> (place % 32) & 1 == 1) != inside);
        }
    }
    wrong as f64 / (128 * count) as f64
}

#[test]
fn wrong_bits_a_look_up_halve_as_the_table_grows() {
    // Per cent, measured elsewhere on random planes over the unit ball.
    for (size, expected) in [(32, 1.24), (64, 0.62), (128, 0.31), (256, 0.16)] {
        let found = 100.0 * wrong_share(size);
        println!("{size}: {found:.3} % wrong, {expected} expected");
        assert!((0.75 * expected..1.25 * expected).contains(&found), "{size}: {found} %, {expected} % expected");
    }
}

#[test]
fn mirrored_bins_hold_complements() {
    let samples = ball(128);
    let layout = Layout::new(&LightBox::new(&samples));
    let size = 32;
    let words = table(&samples, &layout, size);
    for row in 0..size * size {
        for bin in 0..size {
            let one = &words[(row * size + bin) * 4..][..4];
            let other = &words[(opposite_direction(row, size) * size + size - 1 - bin) * 4..][..4];
            assert!(one.iter().zip(other).all(|(one, other)| *one == !other), "row {row}, bin {bin}");
        }
    }
}

#[test]
fn one_light_sample_counts_from_the_middle_on() {
    let samples = [[3.0, 1.0, 2.0]];
    let layout = Layout::new(&LightBox::new(&samples));
    assert_eq!((layout.middle, layout.radius), (samples[0], 0.0));
    let words = table(&samples, &layout, 32);
    // The first direction of the first half.
    let row: Vec<u32> = (0..32).map(|bin| words[bin * 4] & 1).collect();
    assert_eq!(row, [[0; 16], [1; 16]].concat());
}

#[test]
fn blocks_hold_their_own_light_samples() {
    let samples = ball(130);
    let layout = Layout::new(&LightBox::new(&samples));
    let words = table(&samples, &layout, 32);
    assert_eq!(words.len(), 2 * 32 * 32 * 32 * 4);
    let far = &words[words.len() / 2..];
    // Of the second block only two bits are used; in the last bin of the first direction both are set.
    assert_eq!(far[31 * 4] & 0b11, 0b11);
    assert_eq!(table(&samples[128..], &layout, 32), far);
}
