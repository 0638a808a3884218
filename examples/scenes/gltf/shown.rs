//! Cameras and lights that the shown nodes carry.

use super::limits;
use super::nodes::Nodes;
use super::notes::Counts;
use super::source::Source;
use crate::soup::Soup;
use glam::{DVec3, Vec3};
use gltf::json::Root;
use gltf::json::extensions::scene::khr_lights_punctual::{Light as FileLight, Type};
use gltf::json::validation::Checked;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Camera, Light};

/// How far a directional light is placed from the middle of the scene, in scene diagonals.
const DIRECTIONAL_DIAGONALS: f64 = 10.0;

/// Adds cameras and lights to `soup`, whose triangles are complete.
pub fn append(
    source: &Source,
    root: &Root,
    nodes: &Nodes,
    soup: &mut Soup,
    counts: &mut Counts,
) -> Result<(), Problem> {
    let no_lights = Vec::new();
    let lights = root.extensions.as_ref().and_then(|all| all.khr_lights_punctual.as_ref());
    let lights = lights.map_or(&no_lights, |extension| &extension.lights);
    let bounds = bounds(soup);
    for &node in &nodes.shown {
        let (file_node, placed) = (&root.nodes[node], nodes.world_from_node[node]);
        let eye = placed.translation;
        let forward = -placed.matrix3.z_axis.normalize_or_zero();
        let up = placed.matrix3.y_axis.normalize_or_zero();
        let is_placed = limits::allow(eye) && forward.is_finite();
        let name = |own: &Option<String>, kind: &str| {
            own.clone().or_else(|| file_node.name.clone()).unwrap_or_else(|| format!("{kind}{node}"))
        };

        if let Some(index) = file_node.camera {
            let path = format!("nodes[{node}].camera");
            let camera = source.item(&path, &root.cameras, "cameras", index.value())?;
            let angle = camera.perspective.as_ref().map(|lens| lens.yfov).filter(|angle| {
                // A camera as wide as that, or as narrow, has no f32 tangent worth the name.
                (1e-4..179.9_f32.to_radians()).contains(angle)
            });
            match angle {
                None => counts.skipped_cameras += 1,
                Some(_) if !is_placed || forward.cross(up).length() < 1e-6 => counts.lost_nodes += 1,
                Some(fov_y) => {
                    // The looked-at point must differ from the eye after rounding to f32.
                    let distance = 1.0_f64.max(eye.abs().max_element());
                    soup.cameras.push(Camera {
                        name: name(&camera.name, "camera"),
                        eye: eye.as_vec3().to_array(),
                        target: (eye + forward * distance).as_vec3().to_array(),
                        up: up.as_vec3().to_array(),
                        fov_y,
                    });
                }
            }
        }

        let light = file_node.extensions.as_ref().and_then(|all| all.khr_lights_punctual.as_ref());
        if let Some(index) = light.map(|extension| extension.light) {
            let path = format!("nodes[{node}].extensions.KHR_lights_punctual.light");
            let light = source.item(&path, lights, "lights", index.value())?;
            let position = match kind(source, index.value(), light)? {
                Type::Directional => {
                    counts.directional_lights += 1;
                    let [low, high] = bounds;
                    (low + high) / 2.0 - forward * DIRECTIONAL_DIAGONALS * (high - low).length().max(1.0)
                }
                Type::Spot => {
                    counts.spot_lights += 1;
                    eye
                }
                Type::Point => eye,
            };
            if !(is_placed && limits::allow(position)) {
                counts.lost_nodes += 1;
                continue;
            }
            let color = light.color.map(|part| if part.is_finite() { part.max(0.0) } else { 1.0 });
            soup.lights.push(Light::point(name(&light.name, "light"), position.as_vec3().to_array()).colored(color));
        }
    }
    Ok(())
}

fn kind(source: &Source, index: usize, light: &FileLight) -> Result<Type, Problem> {
    match light.type_ {
        Checked::Valid(kind) => Ok(kind),
        Checked::Invalid => Err(source
            .problem(Kind::BadValue, format!("extensions.KHR_lights_punctual.lights[{index}].type"), "no such light")
            .expected("directional, point or spot")),
    }
}

fn bounds(soup: &Soup) -> [DVec3; 2] {
    let mut corners = soup.positions.iter().flatten().map(|corner| Vec3::from(*corner).as_dvec3());
    let first = corners.next().unwrap_or_default();
    corners.fold([first, first], |[low, high], corner| [low.min(corner), high.max(corner)])
}
