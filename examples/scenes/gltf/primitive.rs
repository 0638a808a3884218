//! One primitive shown by one node, as world-space triangles.

use super::accessor::{Elements, Reader};
use super::limits;
use super::notes::Counts;
use super::pose::{self, Bones, COORDINATES, Morph};
use crate::soup::{Look, Soup, geometric_normal};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::{self, Mode, Semantic};
use gltf::json::validation::Checked;
use shadowgraph_core::problem::{Kind, Problem};

const INDICES: &[ComponentType] = &[ComponentType::U8, ComponentType::U16, ComponentType::U32];

/// A primitive with its accessors open.
pub struct Primitive<'a> {
    path: String,
    mode: Mode,
    indices: Option<Elements<'a>>,
    positions: Elements<'a>,
    normals: Option<Elements<'a>>,
    morphs: Vec<Morph<'a>>,
    bones: Option<Bones<'a>>,
    world_from_node: DAffine3,
    look: Look,
}

/// What places a primitive.
pub struct Placement<'a> {
    /// The node's transform.
    pub world_from_node: DAffine3,
    /// World from bind pose by joint, where the node has a skin; it replaces the node's transform.
    pub joints: Option<&'a [DAffine3]>,
    /// Weights of the morph targets.
    pub weights: &'a [f32],
    /// What its triangles look like.
    pub look: Look,
}

/// Triangles that a primitive makes of `corners` indices or vertices; none for points and lines.
pub fn triangle_count(mode: Mode, corners: u64) -> u64 {
    match mode {
        Mode::Triangles => corners / 3,
        Mode::TriangleStrip | Mode::TriangleFan => corners.saturating_sub(2),
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => 0,
    }
}

/// The valid mode of a primitive.
pub fn mode(reader: &Reader, path: &str, primitive: &mesh::Primitive) -> Result<Mode, Problem> {
    match primitive.mode {
        Checked::Valid(mode) => Ok(mode),
        Checked::Invalid => {
            Err(reader.source.problem(Kind::BadValue, format!("{path}.mode"), "no such mode").expected("0..=6"))
        }
    }
}

/// Opens `primitive`; none where it has no positions, which the format allows and which shows nothing.
pub fn open<'a>(
    reader: &Reader<'a>,
    path: String,
    primitive: &mesh::Primitive,
    placement: &Placement<'a>,
) -> Result<Option<Primitive<'a>>, Problem> {
    let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).map(|index| index.value());
    let Some(positions) = attribute(Semantic::Positions) else { return Ok(None) };
    let positions = reader.open(format!("{path}.attributes.POSITION"), positions, Type::Vec3, COORDINATES)?;
    let vertex_count = positions.count;
    let normals = match attribute(Semantic::Normals) {
        Some(index) => {
            let elements = reader.open(format!("{path}.attributes.NORMAL"), index, Type::Vec3, COORDINATES)?;
            Some(pose::same_count(reader, elements, vertex_count)?)
        }
        None => None,
    };
    let indices = match primitive.indices {
        Some(index) => Some(reader.open(format!("{path}.indices"), index.value(), Type::Scalar, INDICES)?),
        None => None,
    };
    let morphs = pose::morphs(reader, &path, primitive, placement.weights, vertex_count)?;
    let bones = match placement.joints {
        Some(joints) => Some(Bones::open(reader, &path, primitive, joints, vertex_count)?),
        None => None,
    };
    let mode = mode(reader, &path, primitive)?;
    Ok(Some(Primitive {
        mode,
        indices,
        positions,
        normals,
        morphs,
        bones,
        world_from_node: placement.world_from_node,
        look: placement.look,
        path,
    }))
}

impl Primitive<'_> {
    /// Appends its triangles to `soup`.
    pub fn append(&self, reader: &Reader, soup: &mut Soup, counts: &mut Counts) -> Result<(), Problem> {
        let corner_count = self.indices.as_ref().map_or(self.positions.count, |indices| indices.count);
        let triangles = triangle_count(self.mode, corner_count as u64) as usize;
        if self.mode == Mode::Triangles {
            counts.left_over_corners += corner_count % 3;
        }
        let reads = 2 + 2 * self.morphs.len() as u64 + self.bones.as_ref().map_or(0, Bones::reads_per_vertex);
        reader.spend(&self.path, 3 * triangles as u64 * reads)?;
        for triangle in 0..triangles {
            let corners = self.corners(triangle);
            let vertices =
                [self.vertex(reader, corners[0])?, self.vertex(reader, corners[1])?, self.vertex(reader, corners[2])?];
            let mut posed =
                [self.posed(reader, vertices[0])?, self.posed(reader, vertices[1])?, self.posed(reader, vertices[2])?];
            // A mirroring transform turns outside in; the other order of corners turns it out again.
            if posed.iter().filter(|vertex| vertex.mirrored).count() >= 2 {
                posed.swap(1, 2);
            }
            let positions = posed.each_ref().map(|vertex| vertex.position);
            let flat = Vec3::from(geometric_normal(positions.map(|position| position.to_array())));
            let normals = posed.map(|vertex| match vertex.normal {
                Some(normal) if normal != Vec3::ZERO => normal,
                Some(_) => {
                    counts.replaced_normals += 1;
                    flat
                }
                None => flat,
            });
            soup.smooth(positions, normals, self.look);
        }
        counts.flat_triangles += if self.normals.is_none() { triangles } else { 0 };
        Ok(())
    }

    /// Places in the index list, or vertex numbers where there is none.
    fn corners(&self, triangle: usize) -> [usize; 3] {
        match self.mode {
            Mode::TriangleStrip => [triangle, triangle + 1 + triangle % 2, triangle + 2 - triangle % 2],
            Mode::TriangleFan => [triangle + 1, triangle + 2, 0],
            _ => [3 * triangle, 3 * triangle + 1, 3 * triangle + 2],
        }
    }

    fn vertex(&self, reader: &Reader, corner: usize) -> Result<usize, Problem> {
        let Some(indices) = &self.indices else { return Ok(corner) };
        let vertex = indices.unsigned(corner) as usize;
        if vertex < self.positions.count {
            return Ok(vertex);
        }
        Err(reader
            .source
            .problem(Kind::BadValue, format!("{}[{corner}]", indices.path), "no such vertex")
            .expected(format!("an index below {}", self.positions.count))
            .found(vertex.to_string())
            .remedy("export the mesh again"))
    }

    fn posed(&self, reader: &Reader, vertex: usize) -> Result<Posed, Problem> {
        let stored = DVec3::from_array(self.positions.numbers(vertex));
        let mut position = stored;
        let mut normal = self.normals.as_ref().map(|normals| DVec3::from_array(normals.numbers(vertex)));
        for morph in &self.morphs {
            morph.apply(vertex, &mut position, normal.as_mut());
        }
        let world_from_vertex = match &self.bones {
            Some(bones) => bones.transform(reader, vertex)?,
            None => self.world_from_node,
        };
        let position = world_from_vertex.transform_point3(position);
        if !limits::allow(position) {
            let found = if stored == position { format!("{stored}") } else { format!("{position} from {stored}") };
            return Err(reader
                .source
                .problem(
                    Kind::BadGeometry,
                    format!("{}[{vertex}]", self.positions.path),
                    "a position that cannot be computed with",
                )
                .expected(format!("world coordinates of at most {:e}", limits::COORDINATE))
                .found(found)
                .remedy("remove the vertex, or scale the scene down"));
        }
        let matrix = world_from_vertex.matrix3;
        let normal = normal.map(|normal| transformed_normal(matrix, normal));
        Ok(Posed { position: position.as_vec3(), normal, mirrored: matrix.determinant() < 0.0 })
    }
}

struct Posed {
    position: Vec3,
    /// Zero where the file's is of no use.
    normal: Option<Vec3>,
    mirrored: bool,
}

/// A unit normal after a transform: times the cofactors, which are the inverse transpose times the determinant and exist
/// for flattening transforms too. Zero where nothing is left.
fn transformed_normal(matrix: DMat3, normal: DVec3) -> Vec3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    let turned = (cofactors * normal) * matrix.determinant().signum();
    turned.normalize_or_zero().as_vec3()
}
