//! Clusters of view-samples in parallel.

use super::MOST_VIEWS;
use super::cluster::{Counts, Scene, Worker};
use super::halving::Points;
use super::own::World;
use super::patches::Choice;
use super::rays::Leaves;
use super::tree::{Casters, unit_scale};
use crate::ports;
use crate::shared::atomic_words::{atomic_zeros, into_words};
use crate::shared::neighbours::Neighbours;
use crate::shared::predicate::Corners;
use crate::shared::segments::mask_words;
use fearless_simd::{Level, Simd, dispatch};
use rayon::prelude::*;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::{BACKGROUND, KEPT};
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// Pixels along the side of a cluster's tile.
const TILE: usize = 16;
const _: () = assert!(TILE * TILE <= MOST_VIEWS);

/// What the masks are a function of.
#[derive(Clone, Copy)]
pub struct Receivers<'a> {
    /// Corners of every triangle, world space.
    pub triangles: &'a [Corners],
    /// 1 for each triangle that casts.
    pub caster_state: &'a [u32],
    /// Light samples, world space, finite.
    pub light_samples: &'a [[f32; 3]],
    /// View-sample positions, world space.
    pub position: &'a [[f32; 3]],
    /// Triangle each lies on.
    pub triangle: &'a [u32],
    /// State of each.
    pub sample_state: &'a [u32],
    /// Picture width and height; view-samples that are not its pixels are taken as they come.
    pub image: [usize; 2],
    /// When joined casters are decided together.
    pub patches: Choice,
    /// How blocks of view-samples are decided.
    pub leaves: Leaves,
}

/// Masks `[P, mask_words]`, and what was counted.
pub fn answer(receivers: Receivers, level: Level, progress: &(dyn Fn(u64, u64) + Sync)) -> (Vec<u32>, Counts) {
    let Receivers { triangles, light_samples, position, .. } = receivers;
    let words = mask_words(light_samples.len());
    let masks = atomic_zeros(position.len() * words);
    if words == 0 {
        return (into_words(masks), Counts::default());
    }
    let scale = unit_scale(triangles.iter().flatten().chain(light_samples).chain(position));
    let world = World { triangles, lights: light_samples, scale };
    // What the tree leaves out must be no neighbour either: a patch that ends there has a border.
    let is_finite = |id: usize| triangles[id].as_flattened().iter().all(|coordinate| coordinate.is_finite());
    let casts = |id: usize| receivers.caster_state[id] == 1 && is_finite(id);
    let patches = receivers.patches;
    let (casters, neighbours) = rayon::join(
        || Casters::build(triangles, casts, scale),
        || Neighbours::new(triangles, |id| patches != Choice::Off && casts(id)),
    );
    let lights: Vec<[f32; 3]> = light_samples.iter().map(|light| world.unit(*light)).collect();
    let share = 1.0 / lights.len() as f32;
    let light = lights.iter().fold([0.0; 3], |sum: [f32; 3], p| [0, 1, 2].map(|k| sum[k] + share * p[k]));
    let mut light_points = Points::default();
    light_points.fill(lights.iter().copied());
    let light_index: Vec<u32> = (0..lights.len() as u32).collect();
    let scene = Scene {
        world,
        casters: &casters,
        neighbours: &neighbours,
        patches,
        leaves: receivers.leaves,
        position,
        triangle: receivers.triangle,
        lights: &light_points,
        light_index: &light_index,
        light,
    };
    let clusters = Clusters::new(&receivers, &world);
    let tiles = clusters.len();
    let done = AtomicU64::new(0);
    let step = (tiles as u64 / 100).max(1);
    let counts = (0..tiles)
        .into_par_iter()
        .map_init(
            || (Worker::default(), Vec::new()),
            |(worker, rows), tile_index| {
                clusters.rows(tile_index, rows);
                rows.retain(|&row| keep(&receivers, &masks, words, row as usize));
                worker.counts = Counts::default();
                if !rows.is_empty() {
                    let write = |row: u32, mask: &[u32]| {
                        for (to, from) in masks[row as usize * words..].iter().zip(mask) {
                            to.store(*from, Relaxed);
                        }
                    };
                    dispatch!(level, simd => {
                        worker.cluster(simd, &scene, rows);
                        simd.vectorize(#[inline(always)] || worker.write(simd, write));
                    });
                }
                let done = done.fetch_add(1, Relaxed) + 1;
                if done.is_multiple_of(step) {
                    progress(done, tiles as u64);
                }
                worker.counts
            },
        )
        .reduce(Counts::default, |mut a, b| {
            a.add(&b);
            a
        });
    (into_words(masks), counts)
}

/// View-samples in clusters: tiles of the picture; or, where they are not its pixels, runs along a curve through space.
enum Clusters {
    Tiles { width: usize, height: usize },
    Runs(Vec<u32>),
}

impl Clusters {
    fn new(receivers: &Receivers, world: &World) -> Self {
        let [width, height] = receivers.image;
        if width * height == receivers.position.len() {
            return Self::Tiles { width, height };
        }
        // Unit lengths are below 2 in each coordinate; what is not finite goes anywhere.
        let key = |row: &u32| {
            let spread = |x: f32| {
                let cell = (((x + 2.0) * 256.0) as u64).min(1023);
                (0..10).fold(0, |key, bit| key | (cell >> bit & 1) << (3 * bit))
            };
            let [x, y, z] = world.unit(receivers.position[*row as usize]).map(spread);
            x | y << 1 | z << 2
        };
        let mut rows: Vec<u32> = (0..receivers.position.len() as u32).collect();
        rows.par_sort_by_cached_key(key);
        Self::Runs(rows)
    }

    fn len(&self) -> usize {
        match self {
            Self::Tiles { width, height } => width.div_ceil(TILE) * height.div_ceil(TILE),
            Self::Runs(rows) => rows.len().div_ceil(MOST_VIEWS),
        }
    }

    /// Puts the view-samples of cluster `at` into `rows`.
    fn rows(&self, at: usize, rows: &mut Vec<u32>) {
        rows.clear();
        match self {
            Self::Tiles { width, height } => {
                let across = width.div_ceil(TILE);
                let [left, top] = [at % across * TILE, at / across * TILE];
                for y in top..(top + TILE).min(*height) {
                    rows.extend((left..(left + TILE).min(*width)).map(|x| (y * width + x) as u32));
                }
            }
            Self::Runs(order) => rows.extend(order.iter().skip(at * MOST_VIEWS).take(MOST_VIEWS)),
        }
    }
}

/// Whether view-sample `row` is to be tested; the mask of one that faces away is filled.
fn keep(receivers: &Receivers, masks: &[AtomicU32], words: usize, row: usize) -> bool {
    match receivers.sample_state.get(row) {
        None | Some(&BACKGROUND) => false,
        // No predicate can be decided on what is not finite: nothing blocks it.
        Some(&KEPT) => receivers.position[row].iter().all(|x| x.is_finite()),
        Some(_) => {
            masks[row * words..(row + 1) * words].iter().for_each(|word| word.store(u32::MAX, Relaxed));
            false
        }
    }
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let receivers = Receivers {
        triangles: bytemuck::cast_slice(cx.input(input::TRIANGLES.name).as_f32()),
        caster_state: cx.input(ports::CASTER_STATE.name).as_u32(),
        light_samples: cx.input(input::LIGHT_SAMPLES.name).as_vec3(),
        position: cx.input(ports::POSITION.name).as_vec3(),
        triangle: cx.input(ports::TRIANGLE.name).as_u32(),
        sample_state: cx.input(ports::SAMPLE_STATE.name).as_u32(),
        image: cx.image(),
        patches: match cx.params().word("patches") {
            "off" => Choice::Off,
            "always" => Choice::Always,
            _ => Choice::Auto,
        },
        leaves: match cx.params().word("leaves") {
            "triangles" => Leaves::Triangles,
            "rays" => Leaves::Rays,
            _ => Leaves::Auto,
        },
    };
    if let Some(at) = receivers.light_samples.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return Err(Problem::new(Kind::BadValue, "a light sample has no place")
            .port(input::LIGHT_SAMPLES.name)
            .expected("finite coordinates")
            .found(format!("{:?} for light sample {at}", receivers.light_samples[at]))
            .remedy("leave it out"));
    }
    let (masks, counts) = answer(receivers, Level::new(), cx.progress());
    let shape = [receivers.position.len(), mask_words(receivers.light_samples.len())];
    cx.put(ports::MASK.name, Array::u32(shape, masks));
    cx.count("shafts", counts.shafts);
    cx.count("lit_shafts", counts.lit);
    cx.count("covered_shafts", counts.covered);
    cx.count("patch_shafts", counts.by_patch);
    cx.count("met", counts.met);
    cx.count("tested", counts.tested);
    cx.count("ray_shafts", counts.by_rays);
    cx.count("cast", counts.cast);
    cx.count("exact", counts.exact);
    Ok(())
}
