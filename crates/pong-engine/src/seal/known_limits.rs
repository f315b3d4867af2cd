//! Known limits of the contact model that two paired models may meet, by the kinds of their primitives
//! (docs/theory.md, 6).
//!
//! A new limit is a row of [`LIMITS`]: the kinds on both sides, the effect with its size, and the cure.

use super::warnings::SetupNote;
use crate::frame::narrow_phase::pair_table::has_tester;
use crate::scene::Scene;
use pong_geometry::primitive::PrimitiveKind::{self, *};
use pong_model::{Item, MovableGroup, PrimitiveInfo};
use std::collections::{BTreeMap, BTreeSet};

/// Deviation of the contact of two kinds of primitives from section 2 or 6 of docs/theory.md.
#[derive(Clone, Copy, Debug)]
struct KnownLimit {
    a: &'static [PrimitiveKind],
    b: &'static [PrimitiveKind],
    /// Returns true if the limit may affect the primitives of two movable groups.
    may_show: fn(&MovableGroup, &MovableGroup) -> bool,
    /// Effect, size and cure.
    text: &'static str,
}

const LIMITS: &[KnownLimit] = &[
    KnownLimit {
        a: &[Capsule],
        b: &[Polyhedron],
        may_show: has_pieces,
        text: "on pieces of a body that is not convex an axis sunk below an edge or a corner stores up to 65 % too little energy, in steps of \
               up to 56 %; keep capsules less deep than their radius",
    },
    KnownLimit {
        a: &[Capsule],
        b: &[Polyhedron],
        may_show: has_pieces,
        text: "on pieces of a body that is not convex a capsule that lies flat over an edge has half of the stiffness, at the ball or at the \
               edge by the sign of a tilt; make what lies over edges of several capsules",
    },
    KnownLimit {
        a: &[Capsule],
        b: &[Triangle],
        may_show: always,
        text: "once its axis has reached the surface, a capsule that lies over an edge has half of the stiffness, in one step; keep \
               capsules less deep than their radius",
    },
    KnownLimit {
        a: &[Cylinder, Cone],
        b: &[Polyhedron],
        may_show: has_pieces,
        text: "on pieces of a body that is not convex a side that lies flat over an edge has half of the stiffness, at a disc or at \
               the edge by the sign of a tilt; a flat end that overhangs steps by ½kδ as its rim passes the edge; keep wheels on \
               their ground, and axes above edges",
    },
    KnownLimit {
        a: &[Cylinder, Cone],
        b: &[Triangle],
        may_show: always,
        text: "where the triangles that it touches are not convex, a flat end has half of the stiffness across a fold that is \
               no rounding (1e-4 of its radius), steps by ½kδ as its rim passes an edge, and feels no corner inside its \
               rim; a side over an edge has half of the stiffness once its axis has reached the surface, in one step; stand \
               drums on a Plane or a convex Polyhedron, keep wheels on their ground, and axes above edges",
    },
    KnownLimit {
        a: &[LineSegment],
        b: &[Polyhedron],
        may_show: has_pieces,
        text: "on pieces of a body that is not convex a segment that overhangs its support on both sides has half of the stiffness, at one edge \
               or at the other: the moment steps between them; make what lies over edges of two segments that meet on the support",
    },
    KnownLimit {
        a: &[Point, LineSegment],
        b: &[Polyhedron],
        may_show: both_are_solids_with_corners,
        text: "corners and edges that reach an edge of the other solid from outside are pushed out of its side: two boxes set edge on \
               edge, to a depth or so, are not held and fall through each other; let one overhang by more than the depth, or give \
               the lower one a Plane",
    },
    KnownLimit {
        a: &[Cone],
        b: &[Plane],
        may_show: has_tip,
        text: "the tip of a cone has half of the stiffness with the radius 0, and all of it with any other radius that is less than \
               the depth; give the tip the radius that it has",
    },
];

fn always(_: &MovableGroup, _: &MovableGroup) -> bool {
    true
}

/// True if polyhedra of B are pieces of a surface that is no convex solid.
fn has_pieces(_: &MovableGroup, b: &MovableGroup) -> bool {
    let is_piece = |(index, info): (usize, &PrimitiveInfo)| {
        let item = Item { primitive: index as u32, element: info.elements.start };
        info.kind == Polyhedron && b.convex_solid(item).is_none()
    };
    b.primitives.iter().enumerate().any(is_piece)
}

/// True if both groups have polyhedra, and points or segments at their corners or edges, such as boxes that
/// stack.
fn both_are_solids_with_corners(a: &MovableGroup, b: &MovableGroup) -> bool {
    let has_corners = |body: &MovableGroup| !(body.points.is_empty() && body.segments.is_empty());
    [a, b].iter().all(|body| has_corners(body) && !body.polyhedra.is_empty())
}

/// True if a cone of A has a tip: one of its radii is less than a hundredth of the other.
fn has_tip(a: &MovableGroup, _: &MovableGroup) -> bool {
    elements(a, Cone)
        .map(|cone| a.frusta[cone].radii)
        .any(|[one, other]| one.min(other) < 0.01 * one.max(other))
}

fn elements(body: &MovableGroup, kind: PrimitiveKind) -> impl Iterator<Item = usize> {
    let infos = body.primitives.iter().filter(move |info| info.kind == kind);
    infos.flat_map(|info| info.elements.clone()).map(|element| element as usize)
}

/// Limits that a scene may meet, once per two models, with the pairs of kinds affected.
pub(super) fn known_limits(scene: &Scene) -> Vec<SetupNote> {
    let model_of = |object: usize| scene.objects[object].model;
    let paired: BTreeSet<_> =
        scene.pairs.iter().map(|pair| (model_of(pair.a), model_of(pair.b), pair.a == pair.b)).collect();
    let mut met: BTreeMap<([String; 2], &str), BTreeSet<[&'static str; 2]>> = BTreeMap::new();
    for (first, second, itself) in paired {
        let bodies = [first, second].map(|model| &scene.models[model].bodies);
        for (index, one) in bodies[0].iter().enumerate() {
            // A movable group never meets itself.
            for other in bodies[1].iter().skip(if itself { index + 1 } else { 0 }) {
                for (a, b, models) in [(one, other, [first, second]), (other, one, [second, first])] {
                    for (kinds, text) in limits_between(a, b) {
                        let names = models.map(|model| scene.models[model].name.clone());
                        met.entry((names, text)).or_default().insert(kinds);
                    }
                }
            }
        }
    }
    let note = |((models, limit), kinds): (_, BTreeSet<_>)| SetupNote::KnownLimit {
        models,
        kinds: kinds.into_iter().collect(),
        limit,
    };
    met.into_iter().map(note).collect()
}

/// Limits of primitives of one movable group against those of another, with the names of the two kinds.
fn limits_between(a: &MovableGroup, b: &MovableGroup) -> Vec<([&'static str; 2], &'static str)> {
    let [kinds_a, kinds_b] =
        [a, b].map(|body| body.primitives.iter().map(|info| info.kind).collect::<BTreeSet<_>>());
    let mut found = Vec::new();
    for limit in LIMITS {
        let pairs = limit.a.iter().flat_map(|kind_a| limit.b.iter().map(move |kind_b| (*kind_a, *kind_b)));
        let met = |&(kind_a, kind_b): &(PrimitiveKind, PrimitiveKind)| {
            has_tester(kind_a, kind_b) && kinds_a.contains(&kind_a) && kinds_b.contains(&kind_b)
        };
        let met = pairs.filter(met).filter(|_| (limit.may_show)(a, b));
        found.extend(met.map(|(kind_a, kind_b)| ([kind_a.name(), kind_b.name()], limit.text)));
    }
    found
}
