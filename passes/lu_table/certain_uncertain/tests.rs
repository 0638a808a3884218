use super::cpu::table;
use crate::shared::area_light_scenes::ball;
use crate::shared::hard_scenes::Random;
use crate::shared::light_box::LightBox;
use crate::shared::lu::{Layout, bin, direction_bins};
use crate::shared::lu_fill::CERTAIN_SLACK;

#[test]
fn certain_is_behind_and_impossible_is_not_for_every_plane_of_a_bin() {
    let samples = ball(128);
    let layout = Layout::new(&LightBox::new(&samples));
    let mut open_shares = Vec::new();
    for size in [32, 64, 128] {
        let words = table(&samples, &layout, size);
        let r = &mut Random(9);
        let (mut open, mut bits) = (0, 0);
        for round in 0..20_000 {
            // Every fourth next to a pole, where bins are slivers; every third with a light sample in the plane.
            let [x, y, z] = r.point();
            let normal = if round % 4 == 0 { [0.02 * x, 0.02 * y, z.signum()] } else { [x, y, z] };
            let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
            let normal = normal.map(|x| x / length);
            let dot = |offset: [f32; 3]| (0..3).map(|k| f64::from(normal[k]) * f64::from(offset[k])).sum::<f64>();
            let distance = if round % 3 == 0 { -dot(layout.offset(samples[r.below(128)])) as f32 } else { r.signed() };
            let [theta, phi] = direction_bins(normal, size);
            let at = ((theta * size + phi) * size + bin(0.5 + 0.5 * distance, size)) * 8;
            for (place, sample) in samples.iter().enumerate() {
                let has = |group: usize| words[at + 4 * group + place / 32] >> (place % 32) & 1 == 1;
                let value = dot(layout.offset(*sample)) + f64::from(distance);
                assert!(!has(0) || value >= 0.0, "size {size}: certain, at {value}");
                assert!(has(1) || value < 0.0, "size {size}: impossible, at {value}");
                assert!(has(1) || !has(0));
                open += usize::from(has(1) && !has(0));
                bits += 1;
            }
        }
        open_shares.push(open as f64 / bits as f64);
    }
    println!("left open: {open_shares:?}");
    assert!(open_shares[1] < 0.12 && open_shares[2] < 0.6 * open_shares[1], "{open_shares:?}");
}

#[test]
fn the_kernel_states_the_same_slack() {
    assert!(include_str!("kernel.wgsl").contains(&format!("const SLACK: f32 = {CERTAIN_SLACK:e};")));
}
