//! Nodes: the forest they must form, and where each puts its mesh, camera or light. No recursion: depth costs nothing.

use super::source::Source;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::json::{Node, Root};
use shadowgraph_core::problem::{Kind, Problem};

/// Nodes of a file.
pub struct Nodes {
    /// World from node, by node.
    pub world_from_node: Vec<DAffine3>,
    /// Nodes of the shown scene, parents before children.
    pub shown: Vec<usize>,
}

/// Checks the forest and accumulates the transforms in f64.
pub fn resolve(source: &Source, root: &Root) -> Result<Nodes, Problem> {
    let parents = parents(source, root)?;
    let order = parents_first(source, root, &parents)?;
    let mut world_from_node = vec![DAffine3::IDENTITY; root.nodes.len()];
    for &node in &order {
        let parent_from_node = local(source, node, &root.nodes[node])?;
        world_from_node[node] = match parents[node] {
            Some(parent) => world_from_node[parent] * parent_from_node,
            None => parent_from_node,
        };
    }
    let is_shown = shown(source, root, &parents, &order)?;
    Ok(Nodes { world_from_node, shown: order.into_iter().filter(|node| is_shown[*node]).collect() })
}

fn children(node: &Node) -> impl Iterator<Item = usize> {
    node.children.iter().flatten().map(|child| child.value())
}

fn parents(source: &Source, root: &Root) -> Result<Vec<Option<usize>>, Problem> {
    let mut parents: Vec<Option<usize>> = vec![None; root.nodes.len()];
    for (index, node) in root.nodes.iter().enumerate() {
        for (place, child) in children(node).enumerate() {
            let path = format!("nodes[{index}].children[{place}]");
            source.item(&path, &root.nodes, "nodes", child)?;
            if let Some(other) = parents[child].replace(index) {
                return Err(source
                    .problem(Kind::BadValue, path, format!("nodes[{child}] has two parents"))
                    .expected("one parent at most")
                    .found(format!("nodes[{other}] and nodes[{index}]"))
                    .remedy("give each parent a node of its own; nodes may share a mesh"));
            }
        }
    }
    Ok(parents)
}

fn parents_first(source: &Source, root: &Root, parents: &[Option<usize>]) -> Result<Vec<usize>, Problem> {
    let mut order: Vec<usize> = (0..parents.len()).filter(|node| parents[*node].is_none()).collect();
    let mut next = 0;
    while let Some(&node) = order.get(next) {
        order.extend(children(&root.nodes[node]));
        next += 1;
    }
    if order.len() == parents.len() {
        return Ok(order);
    }
    // With one parent at most, what no root reaches is circles and what hangs on them.
    let mut reached = vec![false; parents.len()];
    order.iter().for_each(|node| reached[*node] = true);
    let mut node = reached.iter().position(|reached| !reached).unwrap_or(0);
    while !std::mem::replace(&mut reached[node], true) {
        node = parents[node].unwrap_or(node);
    }
    let parent = parents[node].unwrap_or(node);
    Err(source
        .problem(Kind::Cycle, format!("nodes[{node}]"), "the node is its own ancestor")
        .expected("a tree")
        .found(format!("nodes[{parent}] is its parent and hangs below it"))
        .remedy("take one of the children lists apart"))
}

/// Nodes below the roots of the file's scene; of its first scene where it names none; all where it has no scenes.
fn shown(source: &Source, root: &Root, parents: &[Option<usize>], order: &[usize]) -> Result<Vec<bool>, Problem> {
    let scene = match root.scene {
        Some(scene) => source.item("scene", &root.scenes, "scenes", scene.value())?,
        None if root.scenes.is_empty() => return Ok(vec![true; parents.len()]),
        None => &root.scenes[0],
    };
    let scene_index = root.scene.map_or(0, |scene| scene.value());
    let mut shown = vec![false; parents.len()];
    for (place, node) in scene.nodes.iter().enumerate() {
        let path = format!("scenes[{scene_index}].nodes[{place}]");
        source.item(&path, &root.nodes, "nodes", node.value())?;
        if shown[node.value()] || parents[node.value()].is_some() {
            return Err(source
                .problem(Kind::BadValue, path, format!("nodes[{}] is no root, or named twice", node.value()))
                .expected("each root node once"));
        }
        shown[node.value()] = true;
    }
    for &node in order {
        shown[node] |= parents[node].is_some_and(|parent| shown[parent]);
    }
    Ok(shown)
}

fn local(source: &Source, index: usize, node: &Node) -> Result<DAffine3, Problem> {
    let finite = |field: &str, numbers: &[f32]| match numbers.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(place) => Err(source
            .problem(Kind::BadValue, format!("nodes[{index}].{field}[{place}]"), "not a finite number")
            .expected("a number that fits f32")
            .found(numbers[place].to_string())),
    };
    if let Some(matrix) = &node.matrix {
        finite("matrix", matrix)?;
        let m = matrix.map(f64::from);
        let bottom = [m[3], m[7], m[11], m[15]];
        if bottom != [0.0, 0.0, 0.0, 1.0] {
            return Err(source
                .problem(Kind::BadValue, format!("nodes[{index}].matrix"), "not an affine transform")
                .expected("a bottom row of 0, 0, 0, 1")
                .found(format!("{bottom:?}")));
        }
        let column = |start: usize| DVec3::new(m[start], m[start + 1], m[start + 2]);
        return Ok(DAffine3::from_mat3_translation(DMat3::from_cols(column(0), column(4), column(8)), column(12)));
    }
    let translation = node.translation.unwrap_or_default();
    let scale = node.scale.unwrap_or([1.0; 3]);
    let rotation = node.rotation.unwrap_or_default().0;
    finite("translation", &translation)?;
    finite("scale", &scale)?;
    finite("rotation", &rotation)?;
    let quaternion = DQuat::from_array(rotation.map(f64::from));
    if quaternion.length_squared() < 1e-12 {
        return Err(source
            .problem(Kind::BadValue, format!("nodes[{index}].rotation"), "a rotation of no length")
            .expected("a unit quaternion")
            .found(format!("{rotation:?}")));
    }
    Ok(DAffine3::from_scale_rotation_translation(
        DVec3::from_array(scale.map(f64::from)),
        quaternion.normalize(),
        DVec3::from_array(translation.map(f64::from)),
    ))
}
