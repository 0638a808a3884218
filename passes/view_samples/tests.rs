//! The two camera passes against each other.

use super::cast::cast;
use super::raster::raster;
use super::surface::{Corners, Seen};
use crate::shared::camera::Camera;
use crate::shared::hard_scenes::Random;
use shadowgraph_core::shared::NO_TRIANGLE;
use shadowgraph_core::{input, scene};

fn both(corners: &[Corners], image: [usize; 2]) -> [Seen; 2] {
    let camera = scene::Camera {
        name: "test".into(),
        eye: [0.3, -0.2, 1.5],
        target: [0.1, 0.4, -1.0],
        up: [0.1, 1.0, 0.0],
        fov_y: 1.4,
    };
    let camera = Camera::from_words(&input::camera_words(&camera, image));
    [cast(corners, &camera, image, &|_, _| ()), raster(corners, &camera, image, &|_, _| ())]
}

#[test]
fn rays_and_the_z_buffer_see_the_same() {
    let mut random = Random(5);
    for (count, size) in [(1, 1.0), (40, 2.0), (3000, 0.1)] {
        // Many on a coarse grid: equal depths, shared edges, corners at pixel centres.
        let corners: Vec<Corners> = (0..count)
            .map(|index| {
                let middle = random.point().map(|x| 2.0 * x);
                [0; 3].map(|_| {
                    let offset = random.point();
                    let point = [0, 1, 2].map(|axis| middle[axis] + size * offset[axis]);
                    if index % 3 == 0 { point.map(|x| (4.0 * x).round() / 4.0) } else { point }
                })
            })
            .collect();
        let [cast, raster] = both(&corners, [83, 61]);
        assert!(cast.triangles.iter().any(|id| *id != NO_TRIANGLE));
        assert_eq!(cast, raster);
    }
}

#[test]
fn an_empty_scene_is_background() {
    let [cast, raster] = both(&[], [7, 3]);
    assert_eq!(cast, raster);
    assert_eq!(cast, Seen::background(21));
}
