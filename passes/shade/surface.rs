//! What is seen at a view-sample, and the picture of all of them; the CPU side of `surface.wgsl`.

use super::params::Settings;
use super::reflection::Reflection;
use crate::ports;
use crate::shared::shading::{Corners, face_normal, unit, weights};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::shared::BACKGROUND;

/// A view-sample as lighting needs it.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// World space.
    pub position: Vec3,
    /// Its triangle.
    pub triangle: usize,
    /// Weights of the triangle's corners.
    pub weights: Vec3,
    /// The viewer sees the side from which the corners turn clockwise.
    pub is_flipped: bool,
    /// Unit, on the viewer's side.
    pub geometric_normal: Vec3,
    /// Unit, interpolated, turned with the geometric normal.
    pub shading_normal: Vec3,
    /// Unit.
    pub toward_light: Vec3,
    /// Reflectance.
    pub albedo: Vec3,
    /// Colour of the light times its falloff.
    pub light: Vec3,
    /// Visible share of the light in each channel; 1 where the pass does not read it.
    pub visible: Vec3,
}

/// Light from the centre that a surface reflects, but for visibility and ambient.
pub fn reflected(surface: &Surface, eye: Vec3, reflection: Reflection) -> Vec3 {
    let toward_eye = unit(eye - surface.position);
    let [cosine, highlight] = reflection.terms(surface.shading_normal, surface.toward_light, toward_eye);
    surface.light * (surface.albedo * cosine + Vec3::splat(highlight))
}

/// Shades every view-sample with `radiance`, which gets its row and adds to ambient light, and puts the picture: `[H, W, 4]`,
/// background where there is none.
pub fn picture(cx: &mut CpuCx, radiance: impl Fn(usize, &Surface) -> Vec3 + Sync) {
    let settings = Settings::new(cx.params());
    let [width, height] = cx.image();
    let position = cx.input(ports::POSITION.name).as_vec3();
    let normal = cx.input(ports::NORMAL.name).as_vec3();
    let triangle = cx.input(ports::TRIANGLE.name).as_u32();
    let pixel = cx.input(ports::PIXEL.name).as_u32();
    let visible = cx.optional(ports::VISIBLE.name).map(Array::as_f32);
    let visible_color = cx.optional(ports::VISIBLE_COLOR.name).map(Array::as_vec3).filter(|rows| !rows.is_empty());
    let triangles: &[Corners] = bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32());
    let corner_normals: &[Corners] = bytemuck::cast_slice(cx.input(input::TRIANGLE_NORMALS.name).as_f32());
    let albedo = cx.input(input::TRIANGLE_ALBEDO.name).as_vec3();
    let light = cx.input(input::LIGHT.name).as_f32();
    let (centre, color) = (Vec3::from_slice(&light[..3]), Vec3::from_slice(&light[4..7]));

    let surface_at = |row: usize| {
        let (position, triangle) = (Vec3::from(position[row]), triangle[row] as usize);
        let corners = &triangles[triangle];
        let weights = weights(corners, position);
        let geometric_normal = Vec3::from(normal[row]);
        let is_flipped = face_normal(corners).dot(geometric_normal) < 0.0;
        let [a, b, c] = corner_normals[triangle].map(Vec3::from);
        let smooth_normal = unit(weights.x * a + weights.y * b + weights.z * c);
        let shading_normal = match smooth_normal == Vec3::ZERO {
            true => geometric_normal,
            false if is_flipped => -smooth_normal,
            false => smooth_normal,
        };
        let offset = centre - position;
        let light = color / settings.weakening(offset);
        Surface {
            position,
            triangle,
            weights,
            is_flipped,
            geometric_normal,
            shading_normal,
            toward_light: unit(offset),
            albedo: Vec3::from(albedo[triangle]),
            light,
            visible: match (visible_color, visible) {
                (Some(rows), _) => Vec3::from(rows[row]),
                (None, Some(rows)) => Vec3::splat(rows[row]),
                (None, None) => Vec3::ONE,
            },
        }
    };
    let shaded: Vec<Option<Vec3>> = cx
        .input(ports::SAMPLE_STATE.name)
        .as_u32()
        .par_iter()
        .enumerate()
        .map(|(row, state)| {
            let is_surface = *state != BACKGROUND && (triangle[row] as usize) < triangles.len();
            is_surface.then(|| {
                let surface = surface_at(row);
                settings.ambient * surface.albedo + radiance(row, &surface)
            })
        })
        .collect();
    let mut image = settings.background.extend(0.0).to_array().repeat(width * height);
    let mut outside = 0;
    for (at, color) in pixel.iter().zip(&shaded) {
        let Some(color) = color else { continue };
        match image.get_mut(4 * *at as usize..4 * *at as usize + 4) {
            Some(place) => place.copy_from_slice(&color.extend(1.0).to_array()),
            None => outside += 1,
        }
    }
    cx.put(ports::IMAGE.name, Array::f32([height, width, 4], image));
    cx.count(super::OUTSIDE.name, outside);
}
