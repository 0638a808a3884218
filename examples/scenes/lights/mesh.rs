//! Lights of points and of meshes: checked, with their centres.

use super::check;
use super::surface::Surface;
use super::volume::Volume;
use glam::{DVec3, Vec3};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Light, LightShape, Scene, flag};
use std::sync::Arc;

/// A light of separate points with a colour each, or all white where `colors` is empty. Its position is their mean.
///
/// # Errors
/// No points, too many, or colours for another number of points; numbers that are no points or colours.
pub fn points_light(name: &str, positions: Vec<[f32; 3]>, colors: Vec<[f32; 3]>) -> Result<Light, Problem> {
    check::points_with_colors(&positions, &colors)?;
    let sum: DVec3 = positions.iter().map(|point| Vec3::from(*point).as_dvec3()).sum();
    let centre = (sum / positions.len() as f64).as_vec3().to_array();
    let shape = LightShape::Points { positions: Arc::new(positions), colors: Arc::new(colors) };
    Ok(Light::shaped(name, centre, shape))
}

/// The surface of a scene's triangles as a light. Its position is the mean of the surface.
///
/// # Errors
/// No triangles, or none with an area.
pub fn surface_light(name: &str, scene: &Scene) -> Result<Light, Problem> {
    check::triangles(&scene.positions)?;
    let surface = Surface::new(&scene.positions);
    check::positive("area", surface.area())?;
    let centre = surface.centroid().as_vec3().to_array();
    let light = Light::shaped(name, centre, LightShape::Surface(Arc::new(scene.positions.clone())));
    check::light(&light).map(|()| light)
}

/// The inside of a scene's closed parts as a light. Its position is the mean of the volume.
///
/// # Errors
/// No triangles, or some that are not part of a closed mesh: they have no inside.
pub fn volume_light(name: &str, scene: &Scene) -> Result<Light, Problem> {
    check::triangles(&scene.positions)?;
    let open = scene.flags.iter().filter(|flags| **flags & flag::CLOSED == 0).count();
    if open > 0 {
        return Err(Problem::new(Kind::BadGeometry, "the light's mesh is not closed, so it has no inside")
            .expected("every edge between two triangles that run along it in opposite directions, facing outwards")
            .found(format!("{open} of {} triangles in open parts", scene.triangle_count()))
            .remedy("close the mesh, or use its surface"));
    }
    let volume = Volume::new(&scene.positions);
    check::positive("volume", volume.volume())?;
    let centre = volume.centroid().as_vec3().to_array();
    let light = Light::shaped(name, centre, LightShape::Volume(Arc::new(scene.positions.clone())));
    check::light(&light).map(|()| light)
}
