use super::PASS;
use super::cpu::{fit, table};
use crate::shared::area_light_scenes::disc;
use crate::shared::hard_scenes::{Random, run};
use crate::shared::light_box::LightBox;
use crate::shared::lu::{Layout, bin, line_bin};
use shadowgraph_core::array::Array;

/// Points of a tilted square.
fn square(count: usize) -> Vec<[f32; 3]> {
    let r = &mut Random(3);
    (0..count)
        .map(|_| {
            let (u, v) = (r.signed(), r.signed());
            [1.0 + u, 5.0 + 0.6 * v, 2.0 + 0.8 * v]
        })
        .collect()
}

fn layout_of(samples: &[[f32; 3]]) -> Layout {
    let mut layout = Layout::new(&LightBox::new(samples));
    assert_eq!(fit(&mut layout, samples), 0);
    layout
}

#[test]
fn wrong_bits_a_look_up_fall_with_the_size() {
    let samples = square(128);
    let layout = layout_of(&samples);
    let shares = [64, 256, 1024].map(|size| {
        let words = table(&samples, &layout, size);
        let r = &mut Random(4);
        let mut wrong = 0;
        for _ in 0..10_000 {
            let turn = std::f32::consts::PI * r.signed();
            let (normal, distance) = ([turn.cos(), turn.sin()], r.signed());
            let at = (line_bin(normal, size) * size + bin(0.5 + 0.5 * distance, size)) * 4;
            for (place, sample) in samples.iter().enumerate() {
                let offset = layout.offset(*sample);
                let along = |axis: [f32; 3]| (0..3).map(|k| axis[k] * offset[k]).sum::<f32>();
                let value = normal[0] * along(layout.axes[0]) + normal[1] * along(layout.axes[1]) + distance;
                wrong += usize::from((words[at + place / 32] >> (place % 32) & 1 == 1) != (value >= 0.0));
            }
        }
        f64::from(wrong as u32) / 1_280_000.0
    });
    println!("{shares:?}");
    assert!(shares[0] < 0.01 && shares[1] < 0.3 * shares[0] && shares[2] < 0.3 * shares[1], "{shares:?}");
}

#[test]
fn a_light_that_is_not_planar_is_refused() {
    let mut samples = square(40);
    samples[7][1] += 0.01;
    let light = Array::f32([40, 3], bytemuck::cast_slice(&samples).to_vec());
    let problem = run(&PASS, &vec![("light_samples", light)]).unwrap_err();
    assert_eq!(problem.port.as_deref(), Some("light_samples"));
    assert!(problem.to_string().contains("all light samples in one plane"), "{problem}");
}

#[test]
fn a_segment_and_a_point_are_planar() {
    layout_of(&(0..9).map(|k| [k as f32, 2.0 * k as f32, 1.0]).collect::<Vec<_>>());
    layout_of(&[[1.0, 2.0, 3.0]]);
}

#[test]
fn a_disc_tilted_about_two_axes_is_planar_though_not_through_the_middle_of_its_box() {
    for (seed, count) in (0..).zip([3, 16, 64, 256]) {
        for centre in [[3.0, 10.0, 2.0], [3000.0, 1e4, -2000.0]] {
            let samples = disc(&mut Random(seed), centre, centre, 0.5, count);
            let layout = layout_of(&samples);
            assert!(layout.height.abs() > 1e-4, "{layout:?}");
            // All of them at the layout's height, but for the rounding of coordinates.
            for sample in &samples {
                let offset = layout.offset(*sample).map(|x| x * layout.radius);
                let height = (0..3).map(|k| layout.axes[2][k] * offset[k]).sum::<f32>();
                assert!(
                    (height - layout.height).abs() < 1e-6 + 4.0 * f32::EPSILON * centre[1],
                    "{height} in {layout:?}"
                );
            }
        }
    }
}
