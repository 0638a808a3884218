//! What is no light.

use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Light, LightShape, Texture};

/// Largest coordinate, as of every scene.
const MOST: f32 = 1e12;
/// Most points, triangles, or texels of a light: far above any use.
const MOST_ROWS: usize = 1 << 24;
/// Most parts of a light, and how deep parts may hold parts.
const MOST_PARTS: usize = 1024;
const MOST_DEPTH: usize = 8;

/// Everything that [`super::sample`] relies on.
pub fn light(light: &Light) -> Result<(), Problem> {
    at_depth(light, 0)
}

fn at_depth(light: &Light, depth: usize) -> Result<(), Problem> {
    point("position", &light.position)?;
    color("color", &light.color)?;
    if !(0.0..=MOST).contains(&light.radius) {
        return Err(wrong("the light's radius is out of range", "0..=1e12 scene units", light.radius.to_string()));
    }
    if let Some(texture) = &light.texture {
        let shape = light.shape.name();
        if !takes_texture(&light.shape) {
            return Err(wrong(
                "a light of this shape takes no texture",
                "a sphere, disc, rectangle or ellipsoid",
                shape.to_string(),
            ));
        }
        self::texture(texture)?;
    }
    match &light.shape {
        LightShape::Point | LightShape::Sphere => Ok(()),
        LightShape::Disc { half_axes } | LightShape::Rectangle { half_axes } => points("half axis", half_axes),
        LightShape::Ellipsoid { half_axes } => points("half axis", half_axes),
        LightShape::Points { positions, colors } => points_with_colors(positions, colors),
        LightShape::Surface(triangles) => {
            self::triangles(triangles)?;
            positive("area", super::surface::Surface::new(triangles).area())
        }
        LightShape::Volume(triangles) => {
            self::triangles(triangles)?;
            positive("volume", super::volume::Volume::new(triangles).volume())
        }
        LightShape::Parts(parts) => {
            if !(1..=MOST_PARTS).contains(&parts.len()) {
                return Err(wrong("no such number of parts", "1 to 1024", parts.len().to_string()));
            }
            if depth == MOST_DEPTH {
                return Err(wrong("parts of a light hold parts too deep", "at most 8 levels", "more".into()));
            }
            parts.iter().try_for_each(|part| at_depth(part, depth + 1))
        }
    }
}

/// Whether a shape has (u, v).
pub fn takes_texture(shape: &LightShape) -> bool {
    use LightShape::{Disc, Ellipsoid, Point, Rectangle, Sphere};
    matches!(shape, Point | Sphere | Disc { .. } | Rectangle { .. } | Ellipsoid { .. })
}

/// Positions with a colour each, or none.
pub fn points_with_colors(positions: &[[f32; 3]], colors: &[[f32; 3]]) -> Result<(), Problem> {
    rows("points", positions.len())?;
    points("point", positions)?;
    if !colors.is_empty() && colors.len() != positions.len() {
        let expected = format!("a colour for each of {} points", positions.len());
        return Err(wrong("colours and points differ in number", &expected, colors.len().to_string()));
    }
    colors.iter().enumerate().try_for_each(|(row, rgb)| color(&format!("colour {row}"), rgb))
}

/// Triangles that are numbers.
pub fn triangles(triangles: &[[[f32; 3]; 3]]) -> Result<(), Problem> {
    rows("triangles", triangles.len())?;
    triangles.iter().enumerate().try_for_each(|(row, corners)| points(&format!("triangle {row}, corner"), corners))
}

fn texture(texture: &Texture) -> Result<(), Problem> {
    let Texture { width, height, texels } = texture;
    rows("texels", texels.len())?;
    if width.checked_mul(*height) != Some(texels.len()) {
        let found = format!("{} texels for {width} x {height}", texels.len());
        return Err(wrong("a texture of another size than it says", "width times height texels", found));
    }
    texels.iter().enumerate().try_for_each(|(row, rgb)| color(&format!("texel {row}"), rgb))
}

/// Something to spread samples over.
pub fn positive(what: &str, size: f64) -> Result<(), Problem> {
    if size > 0.0 && size.is_finite() {
        return Ok(());
    }
    Err(Problem::new(Kind::BadGeometry, format!("the light's mesh has no {what}"))
        .expected("more than 0")
        .found(size.to_string()))
}

fn rows(what: &str, count: usize) -> Result<(), Problem> {
    if (1..=MOST_ROWS).contains(&count) {
        return Ok(());
    }
    Err(wrong(&format!("no such number of {what} of a light"), "1 to 16777216", count.to_string()))
}

fn points(what: &str, points: &[[f32; 3]]) -> Result<(), Problem> {
    points.iter().enumerate().try_for_each(|(row, xyz)| point(&format!("{what} {row}"), xyz))
}

fn point(what: &str, point: &[f32; 3]) -> Result<(), Problem> {
    if point.iter().all(|x| x.abs() <= MOST) {
        return Ok(());
    }
    Err(wrong(&format!("the light's {what} is no point"), "finite numbers of at most 1e12", format!("{point:?}")))
}

fn color(what: &str, color: &[f32; 3]) -> Result<(), Problem> {
    if color.iter().all(|x| (0.0..=MOST).contains(x)) {
        return Ok(());
    }
    Err(wrong(&format!("the light's {what} is no colour"), "three numbers in 0..=1e12", format!("{color:?}")))
}

fn wrong(message: &str, expected: &str, found: String) -> Problem {
    Problem::new(Kind::BadValue, message).expected(expected).found(found)
}
