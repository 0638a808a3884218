//! Views files: recommended cameras and lights for scenes, in JSON.
//!
//! ```json
//! { "scenes": { "SCENE": { "views": [ {
//!     "name": "overview", "eye": [0, 1, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 40,
//!     "light": { "position": [2, 8, 3], "radius": 0.5, "rect_corners": [[..], [..], [..], [..]] } } ] } } }
//! ```
//! World space, scene units; `fov_y_deg` is the full vertical angle. SCENE is the scene file's name without its ending, or
//! a built-in scene's name. `up`, `light`, `radius` and `rect_corners` may be absent. Other keys are passed over.
//!
//! A light is a ball of its radius around its position unless it says otherwise:
//!
//! | Key of `light` | Meaning |
//! |---|---|
//! | `"shape"` | `"point"`, `"sphere"`, `"disc"`, `"rectangle"` or `"ellipsoid"` |
//! | `"half_axes"` | from the centre to the edge: two for a disc or rectangle, three for an ellipsoid |
//! | `"rect_corners"` | a rectangle in place of `half_axes`; also the one that `--light-shape rectangle` takes |
//! | `"color"` | linear RGB |

use crate::nearest::nearest;
use glam::Vec3;
use serde::Deserialize;
use shadowgraph_core::problem::{Kind, Place, Problem};
use shadowgraph_core::scene::{Camera, Light, LightShape};
use std::collections::BTreeMap;
use std::path::Path;

/// A views file, checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Views {
    file: String,
    scenes: BTreeMap<String, Vec<View>>,
}

/// One view of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Its camera, which bears the view's name.
    pub camera: Camera,
    /// Its light, if it names one.
    pub light: Option<Light>,
    /// Corners of a rectangular light in order around it, where the file has them.
    pub rect_corners: Option<[[f32; 3]; 4]>,
}

#[derive(Deserialize)]
struct FileText {
    scenes: BTreeMap<String, SceneText>,
}

#[derive(Deserialize)]
struct SceneText {
    views: Vec<ViewText>,
}

#[derive(Deserialize)]
struct ViewText {
    name: String,
    eye: [f32; 3],
    target: [f32; 3],
    #[serde(default = "up")]
    up: [f32; 3],
    fov_y_deg: f32,
    light: Option<LightText>,
}

#[derive(Deserialize)]
struct LightText {
    position: [f32; 3],
    #[serde(default)]
    radius: f32,
    rect_corners: Option<[[f32; 3]; 4]>,
    shape: Option<String>,
    half_axes: Option<Vec<[f32; 3]>>,
    color: Option<[f32; 3]>,
}

fn up() -> [f32; 3] {
    [0.0, 1.0, 0.0]
}

impl Views {
    /// Reads and checks a file.
    pub fn read(path: &Path) -> Result<Self, Problem> {
        let file = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| {
            Problem::new(Kind::File, format!("cannot read the views file: {error}"))
                .at(Place { file: file.clone(), line: 0, column: 0, path: String::new() })
                .remedy("give the path of a views file, or leave it out: camera and light then come from the scene")
        })?;
        Self::parse(&file, &text)
    }

    /// Checks the text of a file.
    pub fn parse(file: &str, text: &str) -> Result<Self, Problem> {
        let parsed: FileText = serde_json::from_str(text).map_err(|error| {
            let place = Place { file: file.into(), line: error.line(), column: error.column(), path: String::new() };
            let message = error.to_string();
            let message = message.split(" at line ").next().unwrap_or_default();
            Problem::new(Kind::Syntax, format!("not a views file: {message}")).at(place)
        })?;
        let mut scenes = BTreeMap::new();
        for (scene, SceneText { views }) in parsed.scenes {
            let checked = views.into_iter().enumerate().map(|(index, view)| {
                let path = format!("scenes.{scene}.views[{index}]");
                check(view).map_err(|(field, problem)| {
                    problem.at(Place { file: file.into(), line: 0, column: 0, path: format!("{path}.{field}") })
                })
            });
            let checked = checked.collect::<Result<Vec<View>, Problem>>()?;
            scenes.insert(scene, checked);
        }
        Ok(Self { file: file.into(), scenes })
    }

    /// Views of a scene, in the file's order.
    pub fn of_scene(&self, scene: &str) -> Result<&[View], Problem> {
        let found = self.scenes.get(scene).filter(|views| !views.is_empty());
        found.map(Vec::as_slice).ok_or_else(|| {
            let names = || self.scenes.keys().map(String::as_str);
            Problem::new(Kind::UnknownName, "the views file has no view of this scene")
                .at(Place { file: self.file.clone(), line: 0, column: 0, path: "scenes".into() })
                .expected(names().collect::<Vec<_>>().join(", "))
                .found(scene)
                .remedy(nearest(scene, names()))
        })
    }

    /// The view of that name; the first where no name is given.
    pub fn view(&self, scene: &str, name: Option<&str>) -> Result<&View, Problem> {
        let views = self.of_scene(scene)?;
        let Some(name) = name else { return Ok(&views[0]) };
        views.iter().find(|view| view.camera.name == name).ok_or_else(|| {
            let names = || views.iter().map(|view| view.camera.name.as_str());
            Problem::new(Kind::UnknownName, "no such view")
                .at(Place { file: self.file.clone(), line: 0, column: 0, path: format!("scenes.{scene}.views") })
                .expected(names().collect::<Vec<_>>().join(", "))
                .found(name)
                .remedy(nearest(name, names()))
        })
    }
}

/// The field that is wrong, and why.
type Wrong = (&'static str, Problem);

fn wrong(field: &'static str, message: &str, expected: &str, found: String) -> Wrong {
    (field, Problem::new(Kind::BadValue, message).expected(expected).found(found))
}

fn finite(field: &'static str, point: [f32; 3]) -> Result<(), Wrong> {
    match point.iter().all(|x| x.abs() <= 1e12) {
        true => Ok(()),
        false => Err(wrong(field, "a number too large", "at most 1e12", format!("{point:?}"))),
    }
}

fn check(text: ViewText) -> Result<View, Wrong> {
    finite("eye", text.eye)?;
    finite("target", text.target)?;
    finite("up", text.up)?;
    let forward = Vec3::from(text.target) - Vec3::from(text.eye);
    if forward == Vec3::ZERO {
        let expected = "a target apart from the eye";
        return Err(wrong("target", "the camera looks at itself", expected, format!("{:?}", text.eye)));
    }
    let sideways = forward.as_dvec3().normalize().cross(Vec3::from(text.up).as_dvec3().normalize_or_zero());
    if sideways.length() < 1e-6 {
        let expected = "a direction across the line from eye to target";
        return Err(wrong("up", "up lies along the view", expected, format!("{:?}", text.up)));
    }
    if !(text.fov_y_deg > 0.0 && text.fov_y_deg < 180.0) {
        return Err(wrong("fov_y_deg", "no such angle", "degrees between 0 and 180", text.fov_y_deg.to_string()));
    }
    let rect_corners = text.light.as_ref().and_then(|light| light.rect_corners);
    let light = text.light.map(|light| check_light(&text.name, light)).transpose()?;
    let camera =
        Camera { name: text.name, eye: text.eye, target: text.target, up: text.up, fov_y: text.fov_y_deg.to_radians() };
    Ok(View { camera, light, rect_corners })
}

fn check_light(name: &str, text: LightText) -> Result<Light, Wrong> {
    finite("light.position", text.position)?;
    for corner in text.rect_corners.iter().flatten() {
        finite("light.rect_corners", *corner)?;
    }
    for axis in text.half_axes.iter().flatten() {
        finite("light.half_axes", *axis)?;
    }
    if !(0.0..=1e12).contains(&text.radius) {
        return Err(wrong("light.radius", "no such radius", "0 or more", text.radius.to_string()));
    }
    let color = text.color.unwrap_or([1.0; 3]);
    if !color.iter().all(|part| (0.0..=1e12).contains(part)) {
        return Err(wrong("light.color", "no such colour", "three numbers of 0 or more", format!("{color:?}")));
    }
    let shaped = |shape| Light::shaped(name, text.position, shape);
    let axes = text.half_axes.as_deref().unwrap_or_default();
    let wants = |count: usize| {
        let found = format!("{} half axes", axes.len());
        wrong("light.half_axes", "the light's axes do not fit its shape", &format!("{count} half axes"), found)
    };
    let light = match (text.shape.as_deref(), axes, text.rect_corners) {
        (Some("point"), _, _) => Light::point(name, text.position),
        (Some("sphere") | None, _, _) => Light::sphere(name, text.position, text.radius),
        (Some("disc"), [u, v], _) => shaped(LightShape::Disc { half_axes: [*u, *v] }),
        (Some("rectangle"), [u, v], _) => shaped(LightShape::Rectangle { half_axes: [*u, *v] }),
        (Some("rectangle"), [], Some(corners)) => Light::rectangle(name, corners),
        (Some("ellipsoid"), [u, v, w], _) => shaped(LightShape::Ellipsoid { half_axes: [*u, *v, *w] }),
        (Some("disc" | "rectangle"), _, _) => return Err(wants(2)),
        (Some("ellipsoid"), _, _) => return Err(wants(3)),
        (Some(other), _, _) => {
            let names = ["point", "sphere", "disc", "rectangle", "ellipsoid"];
            let (field, problem) = wrong("light.shape", "no such shape", &names.join(", "), other.into());
            return Err((field, problem.remedy(nearest(other, names.into_iter()))));
        }
    };
    Ok(light.colored(color))
}
