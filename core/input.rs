//! The graph inputs that the program supplies, as ports. A host may supply others under names of its own.

use crate::array::Array;
use crate::array::Element::{F32, U32};
use crate::facts::Facts;
use crate::light_plane::LightPlane;
use crate::port::{Direction::Out, Port, Space};
use crate::scene::{Camera, Light, Scene, flag};

/// Corners of every triangle.
pub const TRIANGLES: Port = Port::new(Out, "triangles", F32, "corner", "T 3 3")
    .space(Space::World)
    .unit("scene units")
    .doc("corners of every triangle, counter-clockwise seen from outside");
/// Shading normals.
pub const TRIANGLE_NORMALS: Port = Port::new(Out, "triangle_normals", F32, "corner_normal", "T 3 3")
    .space(Space::World)
    .doc("unit shading normal at every corner");
/// Flags.
pub const TRIANGLE_FLAGS: Port = Port::new(Out, "triangle_flags", U32, "triangle_flags", "T")
    .doc("bit 0 part of a closed two-manifold, 1 alpha-masked, 2 alpha-blended, 3 two-sided");
/// Reflectance.
pub const TRIANGLE_ALBEDO: Port =
    Port::new(Out, "triangle_albedo", F32, "albedo", "T 3").doc("linear RGB reflectance, 0..1");
/// Smooth vertex of each corner.
pub const CORNER_VERTEX: Port =
    Port::new(Out, "corner_vertex", U32, "vertex", "T 3").doc("smooth vertex at every corner");
/// Faces around smooth vertices, compressed rows.
pub const FACE_OFFSET: Port =
    Port::new(Out, "face_offset", U32, "face_offset", "V+1").doc("start of every smooth vertex's faces");
/// Faces around smooth vertices.
pub const FACES: Port = Port::new(Out, "faces", U32, "triangle", "K").doc("triangles around every smooth vertex");
/// Camera words, see [`camera_words`].
pub const CAMERA: Port = Port::new(Out, "camera", F32, "camera", "20")
    .space(Space::World)
    .doc("eye, right, up, forward, tangents of the half angles, width, height");
/// Light samples.
pub const LIGHT_SAMPLES: Port = Port::new(Out, "light_samples", F32, "light_sample", "L 3")
    .space(Space::World)
    .unit("scene units")
    .doc("points on the light; one for a hard shadow");
/// Weights of light samples.
pub const LIGHT_WEIGHTS: Port = Port::new(Out, "light_weights", F32, "light_weight", "L 3")
    .unit("share of the light")
    .doc("linear RGB share of the light that each sample carries; 1/L in every channel for a uniform white light");
/// Light words.
pub const LIGHT: Port =
    Port::new(Out, "light", F32, "light", "8").space(Space::World).doc("centre xyz, radius, linear RGB, zero");
/// Bounds of the scene.
pub const SCENE_BOUNDS: Port = Port::new(Out, "scene_bounds", F32, "bounds", "2 3")
    .space(Space::World)
    .unit("scene units")
    .doc("smallest and largest corner coordinates; zeros for an empty scene");
/// Imported view-sample positions.
pub const IMPORTED_POSITION: Port = Port::new(Out, "imported_position", F32, "position", "P 3")
    .space(Space::World)
    .unit("scene units")
    .doc("view-samples from a file");
/// Imported view-sample normals.
pub const IMPORTED_NORMAL: Port = Port::new(Out, "imported_normal", F32, "normal", "P 3")
    .space(Space::World)
    .doc("their unit geometric normals, towards the viewer");
/// Imported view-sample triangles.
pub const IMPORTED_TRIANGLE: Port = Port::new(Out, "imported_triangle", U32, "triangle_of_sample", "P")
    .doc("the triangle each lies on; all bits set: none, which is background");
/// Imported view-sample pixels.
pub const IMPORTED_PIXEL: Port =
    Port::new(Out, "imported_pixel", U32, "pixel", "P").space(Space::Image).doc("row-major pixel index of each");

/// All of them.
pub const ALL: &[Port] = &[
    TRIANGLES,
    TRIANGLE_NORMALS,
    TRIANGLE_FLAGS,
    TRIANGLE_ALBEDO,
    CORNER_VERTEX,
    FACE_OFFSET,
    FACES,
    CAMERA,
    LIGHT_SAMPLES,
    LIGHT_WEIGHTS,
    LIGHT,
    SCENE_BOUNDS,
    IMPORTED_POSITION,
    IMPORTED_NORMAL,
    IMPORTED_TRIANGLE,
    IMPORTED_PIXEL,
];

/// Arrays of the scene ports, in the order of [`ALL`] up to the imports.
pub fn scene_arrays(
    scene: &Scene,
    camera: &Camera,
    image: [usize; 2],
    light: &Light,
    samples: &[[f32; 3]],
    weights: &[[f32; 3]],
) -> Vec<(&'static str, Array)> {
    let count = scene.triangle_count();
    let rows9 = |rows: &[[[f32; 3]; 3]]| Array::f32([count, 3, 3], bytemuck::cast_slice(rows).to_vec());
    let bounds = scene.bounds().unwrap_or_default();
    let [r, g, b] = light.color;
    let [x, y, z] = light.position;
    vec![
        (TRIANGLES.name, rows9(&scene.positions)),
        (TRIANGLE_NORMALS.name, rows9(&scene.normals)),
        (TRIANGLE_FLAGS.name, Array::u32([count], scene.flags.clone())),
        (TRIANGLE_ALBEDO.name, Array::f32([count, 3], bytemuck::cast_slice(&scene.albedo).to_vec())),
        (CORNER_VERTEX.name, Array::u32([count, 3], bytemuck::cast_slice(&scene.corner_vertex).to_vec())),
        (FACE_OFFSET.name, Array::u32([scene.face_offset.len()], scene.face_offset.clone())),
        (FACES.name, Array::u32([scene.faces.len()], scene.faces.clone())),
        (CAMERA.name, Array::f32([20], camera_words(camera, image).to_vec())),
        (LIGHT_SAMPLES.name, Array::f32([samples.len(), 3], bytemuck::cast_slice(samples).to_vec())),
        (LIGHT_WEIGHTS.name, Array::f32([weights.len(), 3], bytemuck::cast_slice(weights).to_vec())),
        (LIGHT.name, Array::f32([8], vec![x, y, z, light.radius, r, g, b, 0.0])),
        (SCENE_BOUNDS.name, Array::f32([2, 3], bytemuck::cast_slice(&bounds).to_vec())),
    ]
}

/// Twenty words of a camera: eye xyz, 0, right xyz, tan of half the horizontal angle, up xyz, tan of half the vertical angle,
/// forward xyz, 0, width, height in pixels, 0, 0. Right, up and forward are orthonormal, computed in f64 and rounded once.
///
/// The ray through the centre of pixel (column, row) leaves `eye` along
/// `forward + ((2 column + 1) / width - 1) tan_x right + (1 - (2 row + 1) / height) tan_y up`.
pub fn camera_words(camera: &Camera, image: [usize; 2]) -> [f32; 20] {
    let wide = |v: [f32; 3]| v.map(f64::from);
    let cross =
        |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let unit = |v: [f64; 3]| {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.map(|x| x / length)
    };
    let (eye, target) = (wide(camera.eye), wide(camera.target));
    let forward = unit([0, 1, 2].map(|k| target[k] - eye[k]));
    let right = unit(cross(forward, wide(camera.up)));
    let up = cross(right, forward);
    let tan_y = (f64::from(camera.fov_y) / 2.0).tan();
    let tan_x = tan_y * image[0] as f64 / image[1] as f64;
    let mut words = [0.0; 20];
    for (start, vector) in [(0, eye), (4, right), (8, up), (12, forward)] {
        for axis in 0..3 {
            words[start + axis] = vector[axis] as f32;
        }
    }
    words[7] = tan_x as f32;
    words[11] = tan_y as f32;
    words[16] = image[0] as f32;
    words[17] = image[1] as f32;
    words
}

/// What a graph file may ask of the scene and the light. The samples are taken for equal shares of the light; see
/// [`Facts::with_weights`].
pub fn facts(scene: &Scene, samples: &[[f32; 3]], view_samples_imported: bool) -> Facts {
    let inside = |point: &[f32; 3]| {
        scene.bounds().is_some_and(|[low, high]| (0..3).all(|k| low[k] <= point[k] && point[k] <= high[k]))
    };
    Facts {
        light_is_point: samples.len() <= 1,
        light_is_planar: is_planar(samples),
        light_is_textured: false,
        light_inside_scene: samples.iter().any(inside),
        all_casters_closed: scene.flags.iter().all(|flags| flags & flag::CLOSED != 0),
        transparency_present: scene.flags.iter().any(|flags| flags & (flag::ALPHA_MASK | flag::ALPHA_BLEND) != 0),
        scene_is_empty: scene.positions.is_empty(),
        view_samples_imported,
    }
}

/// Whether all points lie in one plane, as [`LightPlane`] tells.
fn is_planar(samples: &[[f32; 3]]) -> bool {
    let plane = LightPlane::of(samples);
    samples.iter().all(|sample| plane.has(*sample))
}
