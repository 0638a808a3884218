//! Coarse facets, and view-samples exactly on shared edges and vertices.

use super::Builtin;
use super::shapes::{COOL, GROUND, LIGHT, WARM, ground, light_at, look_from, quad, sphere};
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};
use shadowgraph_core::scene::{Camera, flag};

/// `builtin:self`.
pub const SELF: Builtin = Builtin {
    name: "self",
    doc: "spheres of 32 x 16 and 12 x 6 facets: acne and light leaks along the terminator",
    params: &[],
    build: spheres,
};

/// `builtin:coplanar-p`.
pub const COPLANAR: Builtin = Builtin {
    name: "coplanar-p",
    doc: "a grid whose vertices lie at the pixel centres, under a sheet whose vertices lie on the rays to the light: \
          a single lit pixel on the left, or dark one on the right, is a leak",
    params: &[ParamSpec {
        name: "pixels",
        range: Range::U32 { min: 2, max: 512, default: 128 },
        unit: "pixels",
        doc: "side of the square image for which vertices and pixel centres agree",
    }],
    build: coplanar,
};

fn spheres(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    sphere(&mut soup, vec3(-0.6, 0.8, 0.0), 0.6, 32, 16, COOL);
    sphere(&mut soup, vec3(0.8, 0.5, 0.3), 0.4, 12, 6, WARM);
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(2.0, 2.2, 4.0), vec3(0.0, 0.5, 0.0));
    soup
}

fn coplanar(params: &Params) -> Soup {
    let pixels = params.u32("pixels");
    // At height 1 and 90 degrees the centre of pixel c is at (2 c + 1) / pixels - 1, exact in f32 for powers of two.
    let centre = |pixel: u32| (2 * pixel + 1) as f32 / pixels as f32 - 1.0;
    let mut soup = Soup::default();
    for (height, scale, last_column, look) in
        [(0.0, 1.0, pixels - 1, GROUND), (2.0, 0.5, pixels / 2, WARM.with(flag::TWO_SIDED))]
    {
        soup.start_shape();
        let corner = |column: u32, row: u32| vec3(centre(column) * scale, height, centre(row) * scale);
        for row in 0..pixels - 1 {
            for column in 0..last_column {
                let corners = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(x, z)| corner(column + x, row + z));
                quad(&mut soup, corners, look);
            }
        }
    }
    // Twice as high as the sheet: the ray from a grid vertex passes through the sheet's at half its x and z.
    light_at(&mut soup, vec3(0.0, 4.0, 0.0), 0.25);
    soup.cameras.push(Camera {
        name: "default".into(),
        eye: [0.0, 1.0, 0.0],
        target: Vec3::ZERO.to_array(),
        up: [0.0, 0.0, -1.0],
        fov_y: std::f32::consts::FRAC_PI_2,
    });
    soup
}
