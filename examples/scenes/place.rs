//! From what stands on a command line to a scene and a view of it.

use crate::nearest::nearest;
use crate::soup::Soup;
use crate::views::Views;
use crate::{builtin, gltf};
use glam::{Vec3, vec3};
use shadowgraph_core::problem::{Kind, Place, Problem};
use shadowgraph_core::scene::{Camera, Light, Scene};
use std::path::Path;

/// Full vertical angle of a camera that frames a scene, radians.
const FRAMING_ANGLE: f32 = 40.0 * std::f32::consts::PI / 180.0;

/// A camera and a light, and how they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// What the image is seen through.
    pub camera: Camera,
    /// What casts the shadows.
    pub light: Light,
    /// Corners of a rectangular light in its place, in order around it, where the views file has them.
    pub rect_corners: Option<[[f32; 3]; 4]>,
    /// Sentences for the record: what was assumed where nothing was given.
    pub note: Vec<String>,
}

/// Loads a path to a .glb or .gltf file, or `builtin:NAME?param=value&..`.
pub fn load(spec: &str) -> Result<Scene, Problem> {
    match spec.strip_prefix(builtin::PREFIX) {
        Some(rest) => builtin::build(rest),
        None => gltf::load(Path::new(spec)),
    }
}

/// The same before it is finished, for [`crate::Variation`].
pub fn load_soup(spec: &str) -> Result<Soup, Problem> {
    match spec.strip_prefix(builtin::PREFIX) {
        Some(rest) => builtin::soup(rest),
        None => gltf::load_soup(Path::new(spec)),
    }
}

/// Finds camera and light of a scene that was loaded from `spec`: from the views file where one is given, else from the
/// scene's own file, else so that they frame its bounding box. `view` is a view of the views file, or without one a camera
/// of the scene; without a name the first is used.
pub fn choose_view(scene: &Scene, spec: &str, views: Option<&Path>, view: Option<&str>) -> Result<View, Problem> {
    match views {
        Some(path) => choose_from(scene, spec, &Views::read(path)?, view),
        None => {
            let mut note = Vec::new();
            let camera = own_camera(scene, spec, view, &mut note)?;
            let light = own_light(scene, &mut note);
            Ok(View { camera, light, rect_corners: None, note })
        }
    }
}

/// [`choose_view`] with a views file that is read already. A view without a light gets the scene's.
pub fn choose_from(scene: &Scene, spec: &str, views: &Views, view: Option<&str>) -> Result<View, Problem> {
    let found = views.view(short_name(spec), view)?;
    let mut note = Vec::new();
    let light = found.light.clone().unwrap_or_else(|| own_light(scene, &mut note));
    Ok(View { camera: found.camera.clone(), light, rect_corners: found.rect_corners, note })
}

/// Names that [`choose_view`] takes: those of the views file, else of the scene's cameras; empty where the scene has none.
pub fn view_names(scene: &Scene, spec: &str, views: Option<&Path>) -> Result<Vec<String>, Problem> {
    match views {
        Some(path) => Views::read(path)?
            .of_scene(short_name(spec))
            .map(|views| views.iter().map(|view| view.camera.name.clone()).collect()),
        None => Ok(scene.cameras.iter().map(|camera| camera.name.clone()).collect()),
    }
}

/// The name under which a views file keeps a scene: a file's without its ending, a built-in scene's without parameters.
pub fn short_name(spec: &str) -> &str {
    match spec.strip_prefix(builtin::PREFIX) {
        Some(name) => name.split('?').next().unwrap_or(name),
        None => Path::new(spec).file_stem().and_then(|stem| stem.to_str()).unwrap_or(spec),
    }
}

fn own_camera(scene: &Scene, spec: &str, name: Option<&str>, notes: &mut Vec<String>) -> Result<Camera, Problem> {
    if let Some(name) = name {
        let names = || scene.cameras.iter().map(|camera| camera.name.as_str());
        return scene.cameras.iter().find(|camera| camera.name == name).cloned().ok_or_else(|| {
            Problem::new(Kind::UnknownName, "the scene has no such camera")
                .at(Place { file: spec.into(), line: 0, column: 0, path: "cameras".into() })
                .expected(names().collect::<Vec<_>>().join(", "))
                .found(name)
                .remedy(format!("{}; or give a views file", nearest(name, names())))
        });
    }
    match scene.cameras.as_slice() {
        [] => {
            notes.push("no camera given: one that frames the scene's bounding box is used".into());
            let (middle, diagonal) = frame(scene);
            // Far enough for the sphere around the box to fit.
            let distance = 0.5 * diagonal / (FRAMING_ANGLE / 2.0).sin();
            let eye = middle + vec3(0.6, 0.5, 0.8).normalize() * distance;
            Ok(Camera {
                name: "frame".into(),
                eye: eye.to_array(),
                target: middle.to_array(),
                up: [0.0, 1.0, 0.0],
                fov_y: FRAMING_ANGLE,
            })
        }
        [only] => Ok(only.clone()),
        [first, ..] => {
            notes.push(format!("{} cameras in the scene: {} is used", scene.cameras.len(), first.name));
            Ok(first.clone())
        }
    }
}

fn own_light(scene: &Scene, notes: &mut Vec<String>) -> Light {
    match scene.lights.as_slice() {
        [] => {
            notes.push("no light given: a small ball above and beside the scene's bounding box is used".into());
            let (middle, diagonal) = frame(scene);
            // Up by 0.87 diagonals from the middle, which is above the top: half the height is half a diagonal at most.
            let position = middle + vec3(0.45, 1.0, 0.3).normalize() * diagonal;
            Light::sphere("frame", position.to_array(), 0.02 * diagonal)
        }
        [only] => only.clone(),
        [first, ..] => {
            notes.push(format!("{} lights in the scene: {} alone is used", scene.lights.len(), first.name));
            first.clone()
        }
    }
}

/// Middle and diagonal of the bounding box; a diagonal that stays distinct in f32 at the middle.
fn frame(scene: &Scene) -> (Vec3, f32) {
    let [low, high] = scene.bounds().unwrap_or([[-1.0; 3], [1.0; 3]]).map(Vec3::from);
    let middle = low + (high - low) / 2.0;
    let diagonal = (high - low).length();
    (middle, if diagonal > 0.0 { diagonal.max(1e-4 * middle.abs().max_element()) } else { 1.0f32.max(middle.length()) })
}
