//! A light to points with the colours that they show.

use super::generator::Sequence;
use super::surface::Surface;
use super::volume::Volume;
use super::{emission, has_extent, shapes};
use glam::{DVec3, Vec3};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Light, LightShape};

/// One light sample before weights are made.
#[derive(Clone, Copy, Debug)]
pub struct Drawn {
    /// World space.
    pub position: [f32; 3],
    /// Linear RGB that shines there, over the light's colour.
    pub emission: [f64; 3],
}

/// A light as its one sample: its position, in its mean colour.
pub fn centre(light: &Light) -> Drawn {
    Drawn { position: light.position, emission: mean_emission(light) }
}

/// `count` samples of a checked light.
pub fn draw(light: &Light, sequence: Sequence, count: usize) -> Result<Vec<Drawn>, Problem> {
    if !has_extent(light) {
        return Ok(vec![centre(light); count]);
    }
    let centre = wide(light.position);
    let show = |uv: [f64; 2]| light.texture.as_ref().map_or([1.0; 3], |texture| emission::texel(texture, uv));
    let at = |offset: DVec3, emission| Drawn { position: (centre + offset).as_vec3().to_array(), emission };
    let square = || sequence.square(count).into_iter();
    let cube = || sequence.cube(count).into_iter();
    let white = |point: DVec3| Drawn { position: point.as_vec3().to_array(), emission: [1.0; 3] };
    Ok(match &light.shape {
        LightShape::Point => unreachable!("a point has no extent"),
        LightShape::Sphere => {
            let radius = f64::from(light.radius);
            cube().map(shapes::in_ball).map(|p| at(radius * p, show(shapes::longitude_latitude(p)))).collect()
        }
        LightShape::Ellipsoid { half_axes } => {
            let axes = half_axes.map(wide);
            let offset = |p: DVec3| p.x * axes[0] + p.y * axes[1] + p.z * axes[2];
            cube().map(shapes::in_ball).map(|p| at(offset(p), show(shapes::longitude_latitude(p)))).collect()
        }
        LightShape::Disc { half_axes: [u, v] } => {
            let (u, v) = (wide(*u), wide(*v));
            square().map(shapes::in_disc).map(|p| at(p.x * u + p.y * v, show(flat_uv(p)))).collect()
        }
        LightShape::Rectangle { half_axes: [u, v] } => {
            let (u, v) = (wide(*u), wide(*v));
            square().map(shapes::in_square).map(|p| at(p.x * u + p.y * v, show(flat_uv(p)))).collect()
        }
        LightShape::Points { positions, colors } => {
            let row = |row: usize| Drawn {
                position: positions[row],
                emission: colors.get(row).map_or([1.0; 3], |color| color.map(f64::from)),
            };
            chosen(positions.len(), sequence, count)?.into_iter().map(row).collect()
        }
        LightShape::Surface(triangles) => {
            let surface = Surface::new(triangles);
            square().map(|point| white(surface.point(point))).collect()
        }
        LightShape::Volume(triangles) => {
            Volume::new(triangles).points(sequence, count)?.into_iter().map(white).collect()
        }
        LightShape::Parts(parts) => from_parts(parts, sequence, count)?,
    })
}

/// (u, v) of a point of the square from -1 to 1, v downwards as in a picture.
fn flat_uv(p: glam::DVec2) -> [f64; 2] {
    [0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y]
}

/// Rows of separate points: all in their order, or fewer of them at random.
fn chosen(points: usize, sequence: Sequence, count: usize) -> Result<Vec<usize>, Problem> {
    if count > points {
        return Err(Problem::new(Kind::BadValue, "the light has fewer points than light samples are asked for")
            .expected(format!("at most {points} light samples"))
            .found(count.to_string()));
    }
    let mut rows: Vec<usize> = (0..points).collect();
    if count < points {
        let mut random = sequence.random();
        for index in 0..count {
            rows.swap(index, index + (random.unit() * (points - index) as f64) as usize);
        }
        rows.truncate(count);
    }
    Ok(rows)
}

/// Samples of every part in proportion to its size; what rounding to whole samples takes from a part its colour gets back.
fn from_parts(parts: &[Light], sequence: Sequence, count: usize) -> Result<Vec<Drawn>, Problem> {
    let sizes = sizes(parts);
    let total: f64 = sizes.iter().sum();
    let mut all = Vec::with_capacity(count);
    for (index, (part, part_count)) in parts.iter().zip(shares(&sizes, count)).enumerate() {
        if part_count == 0 {
            continue;
        }
        let stream = sequence.stream.wrapping_mul(parts.len() as u32).wrapping_add(1 + index as u32);
        let drawn = match part_count {
            1 => vec![centre(part)],
            _ => draw(part, Sequence { stream, ..sequence }, part_count)?,
        };
        let share = sizes[index] * count as f64 / (total * part_count as f64);
        all.extend(drawn.into_iter().map(|drawn| {
            let emission = [0, 1, 2].map(|c| share * f64::from(part.color[c]) * drawn.emission[c]);
            Drawn { emission, ..drawn }
        }));
    }
    Ok(all)
}

/// Areas or volumes where all parts have one; else all parts count alike.
fn sizes(parts: &[Light]) -> Vec<f64> {
    let sizes: Vec<(u32, f64)> = parts.iter().map(size).collect();
    let are_alike = sizes.iter().all(|(dimension, size)| *dimension == sizes[0].0 && *dimension > 0 && *size > 0.0);
    sizes.iter().map(|(_, size)| if are_alike { *size } else { 1.0 }).collect()
}

/// Dimensions of a light, and its area or volume.
fn size(light: &Light) -> (u32, f64) {
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    match &light.shape {
        LightShape::Point | LightShape::Points { .. } => (0, 0.0),
        LightShape::Sphere => (3, ball * f64::from(light.radius).powi(3)),
        LightShape::Disc { half_axes: [u, v] } => (2, std::f64::consts::PI * wide(*u).cross(wide(*v)).length()),
        LightShape::Rectangle { half_axes: [u, v] } => (2, 4.0 * wide(*u).cross(wide(*v)).length()),
        LightShape::Ellipsoid { half_axes: [a, b, c] } => (3, ball * wide(*a).dot(wide(*b).cross(wide(*c))).abs()),
        LightShape::Surface(triangles) => (2, Surface::new(triangles).area()),
        LightShape::Volume(triangles) => (3, Volume::new(triangles).volume()),
        LightShape::Parts(parts) => {
            let all: Vec<(u32, f64)> = parts.iter().map(size).collect();
            let dimension = all[0].0;
            if all.iter().all(|(other, _)| *other == dimension) {
                (dimension, all.iter().map(|(_, size)| size).sum())
            } else {
                (0, 0.0)
            }
        }
    }
}

/// `count` whole samples in proportion to `sizes`, by largest remainder; none goes empty where there are enough.
fn shares(sizes: &[f64], count: usize) -> Vec<usize> {
    let total: f64 = sizes.iter().sum();
    let exact: Vec<f64> = sizes.iter().map(|size| size / total * count as f64).collect();
    let mut shares: Vec<usize> = exact.iter().map(|share| (*share as usize).min(count)).collect();
    let mut by_remainder: Vec<usize> = (0..sizes.len()).collect();
    by_remainder.sort_by(|a, b| exact[*b].fract().total_cmp(&exact[*a].fract()));
    let given: usize = shares.iter().sum();
    for index in by_remainder.iter().cycle().take(count.saturating_sub(given)) {
        shares[*index] += 1;
    }
    let most = |shares: &[usize]| (0..shares.len()).max_by_key(|index| shares[*index]).unwrap_or(0);
    while let (Some(empty), true) = (shares.iter().position(|share| *share == 0), count >= sizes.len()) {
        let from = most(&shares);
        shares[from] -= 1;
        shares[empty] = 1;
    }
    shares
}

/// What a light shows in the mean, over its colour.
fn mean_emission(light: &Light) -> [f64; 3] {
    match &light.shape {
        LightShape::Points { colors, .. } if !colors.is_empty() => emission::mean(colors),
        LightShape::Parts(parts) => {
            let sizes = sizes(parts);
            let total: f64 = sizes.iter().sum();
            let shown = |c: usize| {
                let part =
                    |(part, size): (&Light, &f64)| size / total * f64::from(part.color[c]) * mean_emission(part)[c];
                parts.iter().zip(&sizes).map(part).sum()
            };
            [0, 1, 2].map(shown)
        }
        _ => light.texture.as_ref().map_or([1.0; 3], |texture| emission::mean(&texture.texels)),
    }
}

fn wide(point: [f32; 3]) -> DVec3 {
    Vec3::from(point).as_dvec3()
}

#[cfg(test)]
mod tests {
    use super::shares;

    #[test]
    fn samples_are_shared_by_size() {
        assert_eq!(shares(&[1.0, 1.0], 7), [4, 3]);
        assert_eq!(shares(&[1.0, 3.0], 8), [2, 6]);
        assert_eq!(shares(&[1e-9, 1.0, 1.0], 4), [1, 2, 1]);
        assert_eq!(shares(&[1.0, 5.0, 2.0], 1), [0, 1, 0]);
        assert_eq!(shares(&[1.0; 3], 3), [1, 1, 1]);
    }
}
