//! Where one vertex of a node's mesh lies: morph targets at their stored weights, then the skin or the node.

use super::accessor::{Elements, Reader};
use super::limits;
use super::nodes::Nodes;
use glam::{DAffine3, DMat3, DMat4, DVec3};
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;
use shadowgraph_core::problem::{Kind, Problem};

/// Types that positions, normals and their deltas may have: f32, or with KHR_mesh_quantization small integers.
pub const COORDINATES: &[ComponentType] =
    &[ComponentType::F32, ComponentType::I8, ComponentType::U8, ComponentType::I16, ComponentType::U16];
const JOINTS: &[ComponentType] = &[ComponentType::U8, ComponentType::U16];
const WEIGHTS: &[ComponentType] = &[ComponentType::F32, ComponentType::U8, ComponentType::U16];

/// Deltas of one morph target with a weight that is not zero.
pub struct Morph<'a> {
    weight: f64,
    positions: Option<Elements<'a>>,
    normals: Option<Elements<'a>>,
}

/// The joints of a skin, and which of them move each vertex.
pub struct Bones<'a> {
    /// World from the mesh's bind pose, by joint.
    world_from_bind: &'a [DAffine3],
    /// Joint numbers and weights, four at a time.
    influences: Vec<[Elements<'a>; 2]>,
}

/// Opens the morph targets of a primitive. `weights` are the node's, else the mesh's, else none.
pub fn morphs<'a>(
    reader: &Reader<'a>,
    path: &str,
    primitive: &Primitive,
    weights: &[f32],
    vertex_count: usize,
) -> Result<Vec<Morph<'a>>, Problem> {
    let mut morphs = Vec::new();
    for (place, target) in primitive.targets.iter().flatten().enumerate() {
        let weight = weights.get(place).copied().unwrap_or(0.0);
        if weight == 0.0 {
            continue;
        }
        let path = format!("{path}.targets[{place}]");
        let open = |name: &str, index: Option<gltf::json::Index<gltf::json::Accessor>>| {
            index
                .map(|index| {
                    let elements = reader.open(format!("{path}.{name}"), index.value(), Type::Vec3, COORDINATES)?;
                    same_count(reader, elements, vertex_count)
                })
                .transpose()
        };
        morphs.push(Morph {
            weight: f64::from(weight),
            positions: open("POSITION", target.positions)?,
            normals: open("NORMAL", target.normals)?,
        });
    }
    Ok(morphs)
}

/// World-from-bind transforms of the joints of `skin`.
pub fn joints(reader: &Reader, nodes: &Nodes, path: &str, skin: usize) -> Result<Vec<DAffine3>, Problem> {
    let source = reader.source;
    let found = source.item(path, &reader.root.skins, "skins", skin)?;
    reader.spend(path, found.joints.len() as u64)?;
    let inverse_binds = match found.inverse_bind_matrices {
        Some(index) => {
            let path = format!("skins[{skin}].inverseBindMatrices");
            let elements = reader.open(path, index.value(), Type::Mat4, &[ComponentType::F32])?;
            if elements.count < found.joints.len() {
                return Err(source
                    .problem(Kind::BadValue, elements.path, "fewer matrices than joints")
                    .expected(found.joints.len().to_string())
                    .found(elements.count.to_string()));
            }
            Some(elements)
        }
        None => None,
    };
    let joint = |(place, node): (usize, &gltf::json::Index<gltf::json::Node>)| {
        let path = format!("skins[{skin}].joints[{place}]");
        let world_from_joint = source.item(&path, &nodes.world_from_node, "nodes", node.value())?;
        Ok(match &inverse_binds {
            Some(matrices) => *world_from_joint * DAffine3::from_mat4(DMat4::from_cols_array(&matrices.numbers(place))),
            None => *world_from_joint,
        })
    };
    found.joints.iter().enumerate().map(joint).collect()
}

impl<'a> Bones<'a> {
    /// Opens the influences of a primitive.
    pub fn open(
        reader: &Reader<'a>,
        path: &str,
        primitive: &Primitive,
        world_from_bind: &'a [DAffine3],
        vertex_count: usize,
    ) -> Result<Self, Problem> {
        let mut influences = Vec::new();
        for set in 0.. {
            let find = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
            let (joints, weights) = (find(Semantic::Joints(set)), find(Semantic::Weights(set)));
            let (Some(joints), Some(weights)) = (joints, weights) else { break };
            if set >= limits::INFLUENCE_SETS {
                return Err(reader
                    .source
                    .problem(Kind::Unsupported, format!("{path}.attributes.JOINTS_{set}"), "too many joints a vertex")
                    .expected(format!("at most {} sets of four", limits::INFLUENCE_SETS))
                    .remedy("limit the joints of a vertex when exporting"));
            }
            let open = |name: &str, index: usize, components| {
                let elements = reader.open(format!("{path}.attributes.{name}_{set}"), index, Type::Vec4, components)?;
                same_count(reader, elements, vertex_count)
            };
            influences.push([open("JOINTS", joints.value(), JOINTS)?, open("WEIGHTS", weights.value(), WEIGHTS)?]);
        }
        if influences.is_empty() {
            return Err(reader
                .source
                .problem(Kind::Missing, format!("{path}.attributes"), "a node with a skin shows a mesh without joints")
                .expected("JOINTS_0 and WEIGHTS_0")
                .remedy("take the skin off the node, or export the mesh with its weights"));
        }
        Ok(Self { world_from_bind, influences })
    }

    /// Reads a vertex costs.
    pub fn reads_per_vertex(&self) -> u64 {
        4 * self.influences.len() as u64
    }

    /// The blended transform of a vertex.
    pub fn transform(&self, reader: &Reader, vertex: usize) -> Result<DAffine3, Problem> {
        let mut sum = DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO };
        let mut total = 0.0;
        for [joints, weights] in &self.influences {
            let numbers: [u32; 4] = joints.unsigned_lanes(vertex);
            // Integer weights are always fractions, whether or not the file says so: the total below makes them so.
            let weights: [f64; 4] = weights.numbers(vertex);
            for (joint, weight) in numbers.into_iter().zip(weights).filter(|(_, weight)| *weight != 0.0) {
                let path = || format!("{}[{vertex}]", joints.path);
                let transform = reader.source.item(&path(), self.world_from_bind, "joints", joint as usize)?;
                sum.matrix3 += transform.matrix3 * weight;
                sum.translation += transform.translation * weight;
                total += weight;
            }
        }
        if !(total > 1e-6 && total.is_finite()) {
            return Err(reader
                .source
                .problem(
                    Kind::BadGeometry,
                    format!("{}[{vertex}]", self.influences[0][1].path),
                    "the weights of a vertex add up to nothing",
                )
                .expected("weights with a sum of 1")
                .found(total.to_string())
                .remedy("normalise the weights in the editor and export again"));
        }
        Ok(DAffine3 { matrix3: sum.matrix3 * (1.0 / total), translation: sum.translation / total })
    }
}

impl Morph<'_> {
    /// Adds the weighted deltas of a vertex.
    pub fn apply(&self, vertex: usize, position: &mut DVec3, normal: Option<&mut DVec3>) {
        if let Some(deltas) = &self.positions {
            *position += self.weight * DVec3::from_array(deltas.numbers(vertex));
        }
        if let (Some(deltas), Some(normal)) = (&self.normals, normal) {
            *normal += self.weight * DVec3::from_array(deltas.numbers(vertex));
        }
    }
}

/// The elements again, if there is one for every vertex.
pub fn same_count<'a>(reader: &Reader, elements: Elements<'a>, vertex_count: usize) -> Result<Elements<'a>, Problem> {
    if elements.count >= vertex_count {
        return Ok(elements);
    }
    Err(reader
        .source
        .problem(Kind::BadValue, elements.path, "fewer elements than positions")
        .expected(vertex_count.to_string())
        .found(elements.count.to_string()))
}
