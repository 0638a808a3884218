//! The light as the command line names it.

use crate::args::{GeneratorChoice, LightChoice, ShapeChoice};
use crate::job::point;
use crate::{npy, texture, usage_problem};
use clap::ValueEnum;
use glam::{DVec3, Vec3};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::scene::{Light, LightShape};
use shadowgraph_scenes::lights::{
    Generator, MOST_SAMPLES, Sampling, points_light, surface_light, takes_texture, volume_light,
};
use std::path::Path;

/// The view's light with the command line's differences. Rectangles come from `--light-axis`, the view's `rect_corners`, or are
/// squares that face `target`, in this order; discs likewise. What a light mesh's file drops is added to `notes`.
///
/// # Errors
/// Flags that do not go together or are not understood; files that cannot be used.
pub fn light(
    view_light: Light,
    rect_corners: Option<[[f32; 3]; 4]>,
    target: [f32; 3],
    choice: &LightChoice,
    notes: &mut Vec<String>,
) -> Result<Light, Problem> {
    if let Some(radius) = choice.light_radius.filter(|radius| !(0.0..=1e12).contains(radius)) {
        let problem = usage_problem("--light-radius is out of range").expected("0..=1e12 scene units");
        return Err(problem.found(radius.to_string()));
    }
    let place = choice.light.as_ref().map(|text| point("--light", text)).transpose()?;
    // A disc faces the target from where it is.
    let view_light = match place {
        Some(place) => view_light.moved_to(place),
        None => view_light,
    };
    let color = view_light.color;
    let mut light = match (&choice.light_points, &choice.light_mesh) {
        (Some(path), _) => of_points(path, choice)?.colored(color),
        (_, Some(mesh)) => of_mesh(mesh, choice, notes)?.colored(color),
        _ => of_shape(view_light, rect_corners, target, choice)?,
    };
    if let Some(place) = place {
        light = light.moved_to(place);
    }
    if let Some(radius) = choice.light_radius {
        light = resized(light, radius);
    }
    if let Some(text) = &choice.light_color {
        light.color = point("--light-color", text)?;
        if light.color.iter().any(|part| *part < 0.0) {
            let problem = usage_problem("--light-color is no colour");
            return Err(problem.expected("three numbers R,G,B of 0 or more, linear").found(text));
        }
    }
    if let Some(path) = &choice.light_texture {
        if !takes_texture(&light.shape) {
            return Err(usage_problem(format!("a {} light takes no --light-texture", light.shape.name()))
                .expected("a sphere, disc, rectangle or ellipsoid")
                .remedy("choose one with --light-shape"));
        }
        light = light.textured(texture::read(path)?);
    }
    Ok(light)
}

/// How many samples, of which kind: the command line's number, all of `--light-points`, the graph's number, one.
///
/// # Errors
/// More points than samples there can be.
pub fn sampling(light: &Light, choice: &LightChoice) -> Result<Sampling, Problem> {
    let generator = match choice.generator {
        GeneratorChoice::Hammersley => Generator::Hammersley,
        GeneratorChoice::Jittered => Generator::Jittered,
        GeneratorChoice::Lattice => Generator::Lattice,
        GeneratorChoice::Random => Generator::Random,
    };
    let count = match (&light.shape, choice.light_samples) {
        (_, Some(count)) => count as usize,
        (LightShape::Points { positions, .. }, None) if positions.len() > MOST_SAMPLES => {
            return Err(usage_problem("--light-points has more points than there can be light samples")
                .expected(format!("at most {MOST_SAMPLES} points"))
                .found(positions.len().to_string())
                .remedy(format!("--light-samples {MOST_SAMPLES} chooses so many of them at random")));
        }
        (LightShape::Points { positions, .. }, None) => positions.len(),
        (_, None) => choice.light_samples_of_graph.unwrap_or(1) as usize,
    };
    Ok(Sampling { generator, count, seed: choice.light_seed })
}

fn of_points(path: &Path, choice: &LightChoice) -> Result<Light, Problem> {
    fits(choice, "--light-points", &[ShapeChoice::Points])?;
    let positions = npy::read_f32(path, 3)?.as_vec3().to_vec();
    let colors = match &choice.light_point_colors {
        Some(path) => npy::read_f32(path, 3)?.as_vec3().to_vec(),
        None => Vec::new(),
    };
    points_light("points", positions, colors).map_err(|problem| problem.at(crate::whole_file(path)))
}

fn of_mesh(spec: &str, choice: &LightChoice, notes: &mut Vec<String>) -> Result<Light, Problem> {
    fits(choice, "--light-mesh", &[ShapeChoice::Surface, ShapeChoice::Volume])?;
    let scene = shadowgraph_scenes::load(spec)?;
    notes.extend(scene.notes.iter().map(|note| format!("light mesh: {note}")));
    let light = match choice.light_shape {
        Some(ShapeChoice::Volume) => volume_light(spec, &scene),
        _ => surface_light(spec, &scene),
    };
    light.map_err(|problem| {
        match problem.remedy {
            Some(_) => problem.remedy("close the mesh, or leave out --light-shape volume: its surface shines then"),
            None => problem,
        }
        .at(crate::whole_file(Path::new(spec)))
    })
}

/// `--light-shape`, `--light-axis` and `--light-direction` beside a file that is the shape.
fn fits(choice: &LightChoice, flag: &str, shapes: &[ShapeChoice]) -> Result<(), Problem> {
    let other = choice.light_shape.filter(|shape| !shapes.contains(shape)).map(|_| "--light-shape");
    let other = other.or((!choice.light_axis.is_empty()).then_some("--light-axis"));
    match other.or(choice.light_direction.as_ref().map(|_| "--light-direction")) {
        Some(other) => Err(usage_problem(format!("{other} does not go with {flag}"))
            .expected("one of them")
            .remedy(format!("leave out {other}: the file is the shape"))),
        None => Ok(()),
    }
}

fn of_shape(
    light: Light,
    rect_corners: Option<[[f32; 3]; 4]>,
    target: [f32; 3],
    choice: &LightChoice,
) -> Result<Light, Problem> {
    let axes = choice.light_axis.iter().map(|text| point("--light-axis", text)).collect::<Result<Vec<_>, Problem>>()?;
    let direction = choice.light_direction.as_ref().map(|text| point("--light-direction", text)).transpose()?;
    let wants_axes = |count: usize| {
        let problem = usage_problem("--light-axis does not fit --light-shape");
        problem.expected(format!("{count} times, each X,Y,Z")).found(format!("{} times", axes.len()))
    };
    let shaped = |shape| Light {
        color: light.color,
        texture: light.texture.clone(),
        ..Light::shaped(&*light.name, light.position, shape)
    };
    let radius = choice.light_radius.unwrap_or(light.radius);
    let facing = |flag: &str| {
        if radius == 0.0 {
            let problem = usage_problem(format!("--light-shape {flag} needs an extent, and the view's light has none"));
            return Err(problem.remedy("give --light-radius, or --light-axis twice"));
        }
        let towards = match direction {
            Some(direction) => Vec3::from(direction).as_dvec3(),
            None => Vec3::from(target).as_dvec3() - Vec3::from(light.position).as_dvec3(),
        };
        Ok(across(towards).map(|axis| (f64::from(radius) * axis).as_vec3().to_array()))
    };
    let is_asked =
        |shape: ShapeChoice| shape.to_possible_value().is_some_and(|value| value.matches(light.shape.name(), true));
    if axes.is_empty() && direction.is_none() && choice.light_shape.is_none_or(is_asked) {
        return Ok(light);
    }
    if direction.is_some() && !matches!(choice.light_shape, Some(ShapeChoice::Disc | ShapeChoice::Rectangle)) {
        return Err(usage_problem("--light-direction needs a shape that faces somewhere")
            .remedy("add --light-shape disc or rectangle"));
    }
    Ok(match (choice.light_shape, axes.as_slice()) {
        (None, _) => {
            return Err(
                usage_problem("--light-axis needs a shape").remedy("add --light-shape disc, rectangle or ellipsoid")
            );
        }
        (Some(ShapeChoice::Point), []) => Light { radius: 0.0, ..shaped(LightShape::Point) },
        (Some(ShapeChoice::Sphere), []) if radius > 0.0 => Light { radius, ..shaped(LightShape::Sphere) },
        (Some(ShapeChoice::Sphere), []) => {
            return Err(usage_problem("--light-shape sphere needs an extent, and the view's light has none")
                .remedy("give --light-radius"));
        }
        (Some(ShapeChoice::Disc), [u, v]) => shaped(LightShape::Disc { half_axes: [*u, *v] }),
        (Some(ShapeChoice::Rectangle), [u, v]) => shaped(LightShape::Rectangle { half_axes: [*u, *v] }),
        (Some(ShapeChoice::Ellipsoid), [u, v, w]) => shaped(LightShape::Ellipsoid { half_axes: [*u, *v, *w] }),
        (Some(ShapeChoice::Disc), []) => shaped(LightShape::Disc { half_axes: facing("disc")? }),
        (Some(ShapeChoice::Rectangle), []) => match rect_corners.filter(|_| direction.is_none()) {
            Some(corners) => {
                let rectangle = Light::rectangle(&*light.name, corners);
                Light { color: light.color, texture: light.texture.clone(), ..rectangle }
            }
            None => resized(shaped(LightShape::Rectangle { half_axes: facing("rectangle")? }), radius),
        },
        (Some(ShapeChoice::Disc | ShapeChoice::Rectangle), _) => return Err(wants_axes(2)),
        (Some(ShapeChoice::Ellipsoid), _) => return Err(wants_axes(3)),
        (Some(ShapeChoice::Point | ShapeChoice::Sphere), _) => return Err(wants_axes(0)),
        (Some(ShapeChoice::Points), _) => {
            return Err(usage_problem("--light-shape points needs points").remedy("give --light-points FILE"));
        }
        (Some(ShapeChoice::Surface | ShapeChoice::Volume), _) => {
            return Err(usage_problem("this --light-shape needs a mesh").remedy("give --light-mesh FILE"));
        }
    })
}

/// A light of that radius; a rectangle as large as the disc of that radius.
fn resized(light: Light, radius: f32) -> Light {
    let LightShape::Rectangle { half_axes: [u, v] } = &light.shape else { return light.with_radius(radius) };
    let area = 4.0 * Vec3::from(*u).as_dvec3().cross(Vec3::from(*v).as_dvec3()).length();
    if area == 0.0 {
        return light.with_radius(radius);
    }
    let factor = (std::f64::consts::PI * f64::from(radius).powi(2) / area).sqrt();
    let radius = f64::from(light.radius) * factor;
    light.with_radius(radius as f32)
}

/// Two unit vectors whose cross product is `direction`'s; the second is as far up as can be.
fn across(direction: DVec3) -> [DVec3; 2] {
    let forward = direction.try_normalize().unwrap_or(-DVec3::Y);
    let up = if forward.y.abs() < 0.999 { DVec3::Y } else { DVec3::Z };
    let right = up.cross(forward).normalize();
    [right, forward.cross(right)]
}

#[cfg(test)]
mod tests;
