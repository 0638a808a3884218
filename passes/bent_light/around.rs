//! The smallest light term of the faces around each corner, whatever the light is: what the passes that bend have in common.

use crate::ports;
use crate::shared::shading::{Corners, face_normal};
use glam::Vec3;
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target, Target::Port};
use shadowgraph_core::shared::GROUP;

/// The same in WGSL, joined after shading and before the pass's kernel, which has `light_cosine` and binding 3.
pub const WGSL: &str = include_str!("around.wgsl");

/// Above every cosine: nothing counted yet.
const NONE: f32 = 2.0;

/// Triangles and which of them meet at smooth vertices.
#[derive(Clone, Copy)]
pub struct Mesh<'a> {
    /// World space.
    pub triangles: &'a [Corners],
    /// Smooth vertex of each corner.
    pub corner_vertex: &'a [[u32; 3]],
    /// Start of each vertex's faces.
    pub face_offset: &'a [u32],
    /// Faces around vertices.
    pub faces: &'a [u32],
}

impl Mesh<'_> {
    /// `[T, 3]` smallest values of `cosine(normal, corner)` over the faces around each corner, its own among them; 0 where all
    /// are degenerate.
    pub fn smallest(&self, cosine: impl Fn(Vec3, Vec3) -> f32 + Sync) -> Vec<[f32; 3]> {
        let at = |corners: &Corners, corner: usize| {
            let normal = face_normal(corners);
            if normal == Vec3::ZERO { NONE } else { cosine(normal, Vec3::from(corners[corner])) }
        };
        let around = |vertex: usize| {
            let row = self.face_offset[vertex] as usize..self.face_offset[vertex + 1] as usize;
            let listed = self.faces.get(row).unwrap_or(&[]).iter().filter_map(|&face| {
                let corner = self.corner_vertex.get(face as usize)?.iter().position(|&v| v as usize == vertex)?;
                Some(at(&self.triangles[face as usize], corner))
            });
            listed.fold(NONE, f32::min)
        };
        let vertices: Vec<f32> = (0..self.face_offset.len().saturating_sub(1)).into_par_iter().map(around).collect();
        let at_corner = |(corners, of): (&Corners, &[u32; 3])| {
            [0, 1, 2].map(|k| {
                let least = vertices.get(of[k] as usize).copied().unwrap_or(NONE).min(at(corners, k));
                if least == NONE { 0.0 } else { least }
            })
        };
        self.triangles.par_iter().zip(self.corner_vertex).map(at_corner).collect()
    }
}

/// Puts `corner_light`.
pub fn run(cx: &mut CpuCx, cosine: impl Fn(Vec3, Vec3) -> f32 + Sync) {
    let mesh = Mesh {
        triangles: bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32()),
        corner_vertex: bytemuck::cast_slice(cx.input(input::CORNER_VERTEX.name).as_u32()),
        face_offset: cx.input(input::FACE_OFFSET.name).as_u32(),
        faces: cx.input(input::FACES.name).as_u32(),
    };
    let smallest = mesh.smallest(cosine);
    cx.put(ports::CORNER_LIGHT.name, Array::f32([smallest.len(), 3], bytemuck::cast_vec(smallest)));
}

/// Names of the two dispatches: label, then entry point.
pub type Steps = [(&'static str, &'static str); 2];

/// Records both dispatches: entries of `faces`, then corners. `light` is what binding 3 reads.
pub fn record(cx: &mut GpuCx, pieces: &'static [&'static str], [entries_step, corners_step]: Steps, light: Target) {
    let corners = cx.words(ports::CORNER_LIGHT.name);
    let vertices = cx.words(input::FACE_OFFSET.name).saturating_sub(1);
    let entries = cx.words(input::FACES.name);
    let smallest = cx.scratch("smallest cosine of each vertex", vertices);
    cx.zero(smallest);
    let bind = vec![
        Uniform(vec![corners as u32, vertices as u32, entries as u32]),
        Read(Port(input::TRIANGLES.name)),
        Read(Port(input::CORNER_VERTEX.name)),
        Read(light),
        ReadWrite(smallest),
        Read(Port(input::FACE_OFFSET.name)),
        Read(Port(input::FACES.name)),
        ReadWrite(Port(ports::CORNER_LIGHT.name)),
    ];
    cx.dispatch(entries_step.0, pieces, entries_step.1, bind.clone(), entries, GROUP);
    cx.dispatch(corners_step.0, pieces, corners_step.1, bind, corners, GROUP);
}
