//! glTF 2.0 files (.glb, and .gltf with its buffers) as [`Scene`]s: the stored pose, in world space, f64 until the last step.
//!
//! Whatever the bytes, loading ends in a scene or a [`Problem`], in time and memory bounded by the file's size and
//! [`limits`]: every index and length is checked where it is used, nothing is allocated for a count that the file only
//! declares, and there is no recursion.
//!
//! Departures: materials are reduced to a base colour and flags; MASK and BLEND cast as opaque; light intensities, ranges
//! and cones are not used. What is left out of a file is counted in [`Scene::notes`].

mod accessor;
mod buffers;
mod container;
mod document;
pub mod limits;
mod look;
mod nodes;
mod notes;
mod pose;
mod primitive;
mod shown;
mod source;

use crate::soup::Soup;
use accessor::Reader;
use gltf::json::Root;
use nodes::Nodes;
use notes::Counts;
use primitive::Placement;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Scene, flag};
use source::Source;
use std::cell::Cell;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;

/// Loads a file; buffers of their own are read from its folder.
pub fn load(path: &Path) -> Result<Scene, Problem> {
    let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    Ok(load_soup(path)?.finish(&name))
}

/// The same before it is finished.
pub fn load_soup(path: &Path) -> Result<Soup, Problem> {
    let source =
        Source { name: path.display().to_string(), folder: Some(path.parent().unwrap_or(Path::new("")).to_owned()) };
    let unreadable = |error: std::io::Error| {
        source
            .problem(Kind::File, "", format!("cannot read the scene: {error}"))
            .remedy("give the path of a .glb or .gltf file, or builtin:NAME")
    };
    let found = std::fs::metadata(path).map_err(unreadable)?;
    if !found.is_file() || found.len() > limits::BYTES {
        return Err(source
            .problem(Kind::File, "", "not a scene file")
            .expected(format!("a plain file of at most {} bytes", limits::BYTES)));
    }
    let bytes = std::fs::read(path).map_err(unreadable)?;
    from_source(&source, &bytes)
}

/// Loads a file that is in memory already. Buffers in files of their own are refused.
pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Scene, Problem> {
    Ok(from_source(&Source { name: name.into(), folder: None }, bytes)?.finish(name))
}

fn from_source(source: &Source, bytes: &[u8]) -> Result<Soup, Problem> {
    let container = container::split(source, bytes)?;
    let root = document::parse(source, container.json)?;
    let buffers = buffers::load(source, &root, container.bin)?;
    let reader = Reader { source, root: &root, buffers: &buffers, reads: Cell::new(0) };
    let nodes = nodes::resolve(source, &root)?;
    check_triangle_count(&reader, &nodes)?;

    let mut counts = Counts::default();
    let mut soup = Soup::default();
    let mut joints_of_skin = HashMap::new();
    for &node in &nodes.shown {
        let Some(skin) = root.nodes[node].skin.filter(|_| root.nodes[node].mesh.is_some()) else { continue };
        if let Entry::Vacant(free) = joints_of_skin.entry(skin.value()) {
            free.insert(pose::joints(&reader, &nodes, &format!("nodes[{node}].skin"), skin.value())?);
        }
    }
    for &node in &nodes.shown {
        soup.start_shape();
        let joints = root.nodes[node].skin.and_then(|skin| joints_of_skin.get(&skin.value()));
        append_mesh(&reader, &nodes, node, joints.map(Vec::as_slice), &mut soup, &mut counts, Depth::Triangles)?;
    }
    shown::append(source, &root, &nodes, &mut soup, &mut counts)?;

    let has = |bit: u32| soup.looks.iter().filter(|look| look.flags & bit != 0).count();
    counts.masked = has(flag::ALPHA_MASK);
    counts.blended = has(flag::ALPHA_BLEND);
    counts.textured_materials =
        root.materials.iter().filter(|one| one.pbr_metallic_roughness.base_color_texture.is_some()).count();
    soup.notes = counts.sentences();
    if root.extensions_used.iter().any(|name| name == "EXT_mesh_gpu_instancing") {
        soup.notes.push("EXT_mesh_gpu_instancing is not built: its instances are left out".into());
    }
    Ok(soup)
}

/// How far to go with a mesh.
#[derive(Clone, Copy, PartialEq)]
enum Depth {
    /// Check that its accessors lie in their buffers.
    OpenOnly,
    /// Append its triangles.
    Triangles,
}

fn append_mesh<'a>(
    reader: &Reader<'a>,
    nodes: &Nodes,
    node: usize,
    joints: Option<&'a [glam::DAffine3]>,
    soup: &mut Soup,
    counts: &mut Counts,
    depth: Depth,
) -> Result<(), Problem> {
    let root = reader.root;
    let Some(index) = root.nodes[node].mesh else { return Ok(()) };
    let mesh = reader.source.item(&format!("nodes[{node}].mesh"), &root.meshes, "meshes", index.value())?;
    let weights = root.nodes[node].weights.as_ref().or(mesh.weights.as_ref());
    for (place, primitive) in mesh.primitives.iter().enumerate() {
        let path = format!("meshes[{}].primitives[{place}]", index.value());
        if primitive::triangle_count(primitive::mode(reader, &path, primitive)?, 9) == 0 {
            counts.points_or_lines += 1;
            continue;
        }
        let placement = Placement {
            world_from_node: nodes.world_from_node[node],
            joints,
            weights: weights.map_or(&[], Vec::as_slice),
            look: look::of_material(reader, &path, primitive.material.map(|material| material.value()))?,
        };
        match primitive::open(reader, path, primitive, &placement)? {
            Some(_) if depth == Depth::OpenOnly => {}
            Some(primitive) => primitive.append(reader, soup, counts)?,
            None => counts.without_positions += 1,
        }
    }
    Ok(())
}

/// Adds up what the shown nodes declare, before any of it is read.
fn check_triangle_count(reader: &Reader, nodes: &Nodes) -> Result<(), Problem> {
    let Root { meshes, accessors, .. } = reader.root;
    let declared = |index: usize| accessors.get(index).map_or(0, |accessor| accessor.count.0);
    let in_mesh: Vec<u64> = meshes
        .iter()
        .map(|mesh| {
            let counts = mesh.primitives.iter().map(|primitive| {
                let positions = gltf::json::validation::Checked::Valid(gltf::json::mesh::Semantic::Positions);
                let named = primitive.indices.or(primitive.attributes.get(&positions).copied());
                let corners = named.map_or(0, |index| declared(index.value()));
                match primitive.mode {
                    gltf::json::validation::Checked::Valid(mode) => primitive::triangle_count(mode, corners),
                    gltf::json::validation::Checked::Invalid => 0,
                }
            });
            counts.fold(0, u64::saturating_add)
        })
        .collect();
    let mut total = 0u64;
    for &node in &nodes.shown {
        let mesh = reader.root.nodes[node].mesh.map(|mesh| mesh.value());
        total = total.saturating_add(mesh.and_then(|mesh| in_mesh.get(mesh)).copied().unwrap_or(0));
        if total > limits::TRIANGLES {
            // A count that its buffer cannot hold is the better thing to tell.
            append_mesh(reader, nodes, node, None, &mut Soup::default(), &mut Counts::default(), Depth::OpenOnly)?;
            return Err(reader
                .source
                .problem(Kind::BadGeometry, format!("nodes[{node}].mesh"), "too many triangles over all instances")
                .expected(format!("at most {}", limits::TRIANGLES))
                .found(format!("{total} up to this node"))
                .remedy("export fewer instances or a coarser mesh"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
