//! Casters that are no closed two-manifolds.

use super::Builtin;
use super::shapes::{COOL, LEAF, LIGHT, WARM, board, ground, light_at, look_from, quad};
use crate::random::Random;
use crate::soup::{Look, Soup};
use glam::{Vec3, vec3};
use shadowgraph_core::param::Params;
use shadowgraph_core::scene::flag;
use std::f32::consts::TAU;

/// `builtin:open`.
pub const OPEN: Builtin = Builtin {
    name: "open",
    doc: "leaf cards, a Moebius strip and a tube without ends: casting from one side only loses shadows",
    params: &[],
    build: open,
};

/// `builtin:nonmanifold`.
pub const NONMANIFOLD: Builtin = Builtin {
    name: "nonmanifold",
    doc: "three triangles on one edge, a grid with T-junctions, coplanar faces twice",
    params: &[],
    build: nonmanifold,
};

/// `builtin:degenerate`.
pub const DEGENERATE: Builtin = Builtin {
    name: "degenerate",
    doc: "needles, triangles without area, equal corners, a triangle through the light's height",
    params: &[],
    build: degenerate,
};

/// `builtin:transparent`.
pub const TRANSPARENT: Builtin = Builtin {
    name: "transparent",
    doc: "three stacked coloured panes with alphaMode BLEND, which cast as opaque until transparency is built",
    params: &[],
    build: transparent,
};

fn leaf() -> Look {
    LEAF.with(flag::TWO_SIDED)
}

fn open(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    soup.start_shape();
    let mut random = Random::new(1);
    for _ in 0..300 {
        let middle = vec3(random.range(-1.8, -0.4), random.range(0.3, 1.5), random.range(-0.9, 0.9));
        let normal = random.direction();
        let right = normal.any_orthonormal_vector() * 0.05;
        let ahead = normal.cross(right) * 1.6;
        quad(
            &mut soup,
            [middle - right - ahead, middle + right - ahead, middle + right + ahead, middle - right + ahead],
            leaf(),
        );
    }
    soup.start_shape();
    let edge = |step: u32, side: f32| {
        // After a whole turn the half turn has swapped the sides: the last pair is the first, crossed.
        let (step, side) = if step == 64 { (0, -side) } else { (step, side) };
        let turn = step as f32 / 64.0 * TAU;
        let outward = vec3(turn.cos(), 0.0, turn.sin());
        vec3(0.9, 0.9, -0.4)
            + outward * 0.45
            + side * 0.15 * (outward * (turn / 2.0).cos() + Vec3::Y * (turn / 2.0).sin())
    };
    for step in 0..64 {
        let corners = [edge(step, -1.0), edge(step + 1, -1.0), edge(step + 1, 1.0), edge(step, 1.0)];
        quad(&mut soup, corners, WARM.with(flag::TWO_SIDED));
    }
    soup.start_shape();
    let rim = |side: u32, height: f32| {
        let turn = (side % 32) as f32 / 32.0 * TAU;
        vec3(0.9 + 0.3 * turn.sin(), height, 0.8 + 0.3 * turn.cos())
    };
    for side in 0..32 {
        quad(
            &mut soup,
            [rim(side, 0.0), rim(side + 1, 0.0), rim(side + 1, 0.8), rim(side, 0.8)],
            COOL.with(flag::TWO_SIDED),
        );
    }
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(1.8, 2.8, 4.4), vec3(0.0, 0.5, 0.0));
    soup
}

fn nonmanifold(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    soup.start_shape();
    let spine = [vec3(-1.2, 0.2, -0.5), vec3(-1.2, 1.4, -0.5)];
    for wing in 0..3 {
        let turn = wing as f32 / 3.0 * TAU + 0.3;
        soup.flat(
            [spine[0], spine[1], vec3(-1.2 + 0.7 * turn.cos(), 0.8, -0.5 + 0.7 * turn.sin())],
            WARM.with(flag::TWO_SIDED),
        );
    }
    // Quads whose lower neighbours are twice as wide: every second vertex lies inside an edge.
    soup.start_shape();
    for row in 0..4 {
        let cells = 1 << (4 - row);
        let (low, high) = (0.3 + 0.25 * row as f32, 0.55 + 0.25 * row as f32);
        for cell in 0..cells {
            let x = |place: i32| -0.3 + 1.6 * place as f32 / cells as f32;
            let (left, right) = (x(cell), x(cell + 1));
            let corners =
                [vec3(left, low, -0.3), vec3(right, low, -0.3), vec3(right, high, -0.3), vec3(left, high, -0.3)];
            quad(&mut soup, corners, COOL.with(flag::TWO_SIDED));
        }
    }
    board(&mut soup, vec3(0.4, 0.5, 0.9), 0.4, LEAF);
    board(&mut soup, vec3(0.4, 0.5, 0.9), 0.4, LEAF);
    board(&mut soup, vec3(0.6, 0.5, 1.0), 0.3, WARM);
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(1.4, 2.8, 4.4), vec3(0.0, 0.4, 0.0));
    soup
}

fn degenerate(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    soup.start_shape();
    let mut random = Random::new(1);
    let mut point = |high: f32| vec3(random.range(-1.5, 1.5), random.range(0.2, high), random.range(-1.5, 1.5));
    let look = COOL.with(flag::TWO_SIDED);
    for _ in 0..40 {
        // Length over width of 1e5.
        let (from, along) = (point(1.6), (point(1.6) - point(1.6)).normalize());
        soup.flat([from, from + along, from + along * 0.5 + along.any_orthonormal_vector() * 1e-5], look);
    }
    for _ in 0..20 {
        let (from, to) = (point(1.6), point(1.6));
        soup.flat([from, to, (from + to) / 2.0], look);
        soup.flat([from, to, to], look);
        soup.flat([from, from, from], look);
    }
    for _ in 0..20 {
        let corners = [point(1.2), point(1.2), point(1.2)];
        let corners = corners.map(|corner| corners[0] + (corner - corners[0]) * 0.25);
        soup.flat(corners, look);
        soup.flat([corners[0], corners[2], corners[1]], look);
    }
    // From under the light's height of 4.5 to above it, and wholly above it.
    soup.flat([vec3(-2.5, 3.0, -1.0), vec3(-1.5, 6.0, -0.5), vec3(-2.0, 4.5, 1.0)], WARM.with(flag::TWO_SIDED));
    soup.flat([vec3(1.6, 1.0, 0.0), vec3(2.0, 5.5, 0.4), vec3(1.8, 1.2, -0.6)], WARM.with(flag::TWO_SIDED));
    soup.flat([vec3(0.5, 5.0, -1.0), vec3(1.5, 5.0, -1.0), vec3(1.0, 6.0, 0.0)], WARM.with(flag::TWO_SIDED));
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(1.4, 3.4, 5.4), vec3(0.0, 0.7, 0.0));
    soup
}

fn transparent(_: &Params) -> Soup {
    let mut soup = Soup::default();
    ground(&mut soup, 2.5, 0.0);
    let panes = [
        (0.5, -0.3, Look::new(0.9, 0.2, 0.2)),
        (1.0, 0.0, Look::new(0.2, 0.9, 0.2)),
        (1.5, 0.3, Look::new(0.2, 0.3, 0.9)),
    ];
    for (height, x, look) in panes {
        board(&mut soup, vec3(x, height, 0.0), 0.5, look.with(flag::ALPHA_BLEND));
    }
    soup.notes.push("6 triangles have alphaMode BLEND: they cast as opaque, so their shadows are too dark".into());
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(2.2, 2.4, 4.0), vec3(0.0, 0.6, 0.0));
    soup
}
