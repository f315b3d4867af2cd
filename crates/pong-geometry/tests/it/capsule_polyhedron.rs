//! Capsule against the edges of a piece: no edge that pushes is left out, with the same bits at every
//! instruction-set level.
//!
//! The reference tests all edges one by one by theory.md, 2.8. Poses: at a distance, along edges and faces up
//! to rounding, through edges and vertices, sunk in so that an edge gives the minimum translation, beside the
//! apex of a fan, on internal faces; rotated and moved, with coordinates of half precision, small and large.

use crate::common::{
    Random, cuboid, cuboid_corners, hull, hull_with_walls, levels, moved, random_motion, scaled,
    stretched_hull,
};
use pong_geometry::Vec3;
use pong_geometry::interference::capsule_edge::{ConvexEdge, capsule_edge};
use pong_geometry::interference::capsule_polyhedron::CapsuleAtPiece;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::{Capsule, Polyhedron, PolyhedronEdge};
use pong_geometry::simd::{self, Level};

/// Contacts of all edges that the axis crosses, in edge order.
fn crossings(capsule: &Capsule, piece: &Polyhedron) -> Vec<Interference> {
    let mut found = Vec::new();
    for (index, edge) in piece.edges.iter().enumerate() {
        let Some(push) = edge.push else { continue };
        let edge = ConvexEdge {
            ends_b: edge.vertices.map(|vertex| piece.vertices[vertex as usize].position),
            normals_b: push.normals,
            outwards_b: Some(push.outwards),
            free_outward_b: None,
            feature: Feature::edge(index),
        };
        found.extend(capsule_edge(capsule, &edge));
    }
    found
}

/// Contacts that push: less deep than the radius, or the minimum translation out of the piece; `None` in
/// front of a face.
fn pushing(capsule: &Capsule, piece: &Polyhedron) -> Option<Vec<Interference>> {
    let rounding = 16.0 * f64::EPSILON * capsule.ends[0].amax().max(capsule.ends[1].amax());
    let lower_end = |normal: &Vec3, offset: f64| {
        let [one, other] = capsule.ends.map(|end| normal.dot(&end) - offset);
        one.min(other)
    };
    let ways_out: Vec<f64> =
        piece.faces.iter().map(|face| capsule.radius - lower_end(&face.normal, face.offset)).collect();
    if ways_out.iter().any(|way| *way <= 0.0) {
        return None;
    }
    let all = crossings(capsule, piece);
    let sunk = all.iter().map(|crossing| crossing.depth).filter(|depth| *depth >= capsule.radius);
    let shortest = sunk.chain(ways_out).fold(f64::INFINITY, f64::min);
    let is_in =
        |place: Vec3| piece.faces.iter().all(|face| face.normal.dot(&place) - face.offset <= rounding);
    let pushes = |crossing: &Interference| {
        let on_axis = crossing.deepest_b + crossing.normal_b * capsule.radius;
        crossing.depth < capsule.radius || (crossing.depth <= shortest + rounding && is_in(on_axis))
    };
    Some(all.into_iter().filter(pushes).collect())
}

#[derive(Default)]
struct Tally {
    poses: usize,
    apart: usize,
    /// Numbers of edges that the axis passes above, and that it has sunk below.
    over: usize,
    sunk: usize,
    /// Edges of which the axis passes an end: the normal is then not perpendicular to both.
    beside: usize,
}

impl Tally {
    fn check(&mut self, capsule: &Capsule, piece: &Polyhedron, name: &str) {
        self.poses += 1;
        let expected = pushing(capsule, piece);
        let turn = levels::Turn::wait();
        for level in Level::available() {
            simd::set_level(level);
            let found = CapsuleAtPiece::new(capsule, piece).map(|at| {
                let mut found = Vec::new();
                at.each_crossing(|crossing| found.push(*crossing));
                found
            });
            assert_eq!(found, expected, "{name}, {}: {capsule:?}", level.name());
        }
        drop(turn);
        let Some(expected) = expected else {
            self.apart += 1;
            return;
        };
        for crossing in expected {
            let edge = &piece.edges[crossing.feature.index()];
            let is_across = crossing.normal_b.dot(&edge.direction).abs() < 1e-9;
            self.over += usize::from(crossing.depth < capsule.radius);
            self.sunk += usize::from(crossing.depth >= capsule.radius);
            self.beside += usize::from(!is_across);
        }
    }
}

fn half(v: Vec3) -> Vec3 {
    v.map(|x| f64::from(x as f32))
}

/// Pyramid of `sides` sides on the ground, its apex above the origin: all edges to the apex are near it.
fn fan(sides: usize) -> Polyhedron {
    let rim = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / sides as f64;
        Vec3::new(angle.cos(), angle.sin(), 0.0)
    };
    hull(&(0..sides).map(rim).chain([Vec3::new(0.0, 0.0, 0.8)]).collect::<Vec<_>>())
}

/// Two thirds of a box, with an internal face where the rest is cut off.
fn walled() -> Polyhedron {
    hull_with_walls(&cuboid_corners(Vec3::new(-0.9, -0.7, -0.5), Vec3::new(0.6, 0.7, 0.5)), &|normal, _| {
        normal.x > 0.9
    })
}

/// Piece with its edges at the end of a long list of edges that do not push.
fn with_many_edges(piece: Polyhedron) -> Polyhedron {
    let mut parts = piece.into_parts();
    let others = 1000;
    let silent = PolyhedronEdge { push: None, convex: None, ..parts.edges[0] };
    parts.edges.splice(0..0, std::iter::repeat_n(silent, others));
    parts.rims.iter_mut().for_each(|rim| rim.edge += others as u32);
    Polyhedron::new(parts)
}

fn pieces() -> Vec<(&'static str, Polyhedron)> {
    let wedge = [(-0.8, -0.5, 0.0), (0.8, -0.5, 0.0), (-0.8, 0.5, 0.0), (0.8, 0.5, 0.0)]
        .into_iter()
        .chain([(-0.8, 0.0, 0.4), (0.8, 0.1, 0.5)])
        .map(|(x, y, z)| Vec3::new(x, y, z));
    vec![
        ("box", cuboid(Vec3::new(-0.9, -0.7, -0.5), Vec3::new(0.9, 0.7, 0.5))),
        ("walled", walled()),
        ("thin", cuboid(Vec3::new(-0.9, -0.7, -0.01), Vec3::new(0.9, 0.7, 0.01))),
        ("wedge", hull(&wedge.collect::<Vec<_>>())),
        ("tetrahedron", stretched_hull(4, Vec3::new(1.0, 0.8, 0.7))),
        ("hull 8", stretched_hull(8, Vec3::new(1.0, 0.8, 0.6))),
        ("hull 66", stretched_hull(66, Vec3::new(1.0, 0.8, 0.6))),
        ("fan", fan(40)),
        ("many edges", with_many_edges(stretched_hull(30, Vec3::new(1.0, 0.8, 0.6)))),
    ]
}

/// Random capsule near an edge of a piece.
fn capsule_at(piece: &Polyhedron, random: &mut Random) -> Capsule {
    let pushing: Vec<_> = piece.edges.iter().filter(|edge| edge.push.is_some()).collect();
    let edge = random.pick(&pushing);
    let ends = edge.vertices.map(|vertex| piece.vertices[vertex as usize].position);
    let along = ends[1] - ends[0];
    let normals = edge.faces.map(|face| piece.faces[face as usize].normal);
    // Most points are on the edge, some exactly at its ends.
    let share = [0.0, 1.0, 0.5, random.between(0.0, 1.0), random.between(0.0, 1.0)][random.below(5)];
    let place = ends[0] + along * share;
    let out = normals[0] * random.unit() + normals[1] * random.unit();
    let radius = [0.3, 0.05, 1e-3, 0.1][random.below(4)];
    let height = [radius * random.between(-1.5, 1.2), -random.unit(), 0.0, radius][random.below(4)];
    let across = out.cross(&along);
    let direction = match random.below(6) {
        // Along the edge, exactly or nearly.
        0 => along,
        1 => along + random.vector(1e-12 * along.norm()),
        2 => along + random.vector(1e-6 * along.norm()),
        // In a face.
        3 => normals[0].cross(&along) + along * random.between(-1.0, 1.0),
        4 => across,
        _ => random.direction(),
    };
    let middle = place + out.normalize() * height;
    let (before, after) = (random.between(0.0, 1.5), random.between(0.0, 1.5));
    let direction = direction.normalize();
    Capsule { ends: [middle - direction * before, middle + direction * after], radius }
}

#[test]
fn no_edge_that_pushes_is_left_out() {
    let mut random = Random(2017);
    for (name, piece) in pieces() {
        let mut tally = Tally::default();
        for case in 0..4000 {
            let capsule = capsule_at(&piece, &mut random);
            match case % 4 {
                0 => tally.check(&capsule, &piece, name),
                1 => {
                    let x = random_motion(&mut random, 3.0);
                    tally.check(&capsule.carried(&x), &moved(&piece, &x), name);
                }
                2 => tally.check(&Capsule { ends: capsule.ends.map(half), ..capsule }, &piece, name),
                _ => {
                    let size = [1e-5, 1e4, 1e61, 1e80][random.below(4)];
                    let x = random_motion(&mut random, 3.0);
                    let Capsule { ends, radius } = capsule.carried(&x);
                    let large = Capsule { ends: ends.map(|end| end * size), radius: radius * size };
                    tally.check(&large, &scaled(&moved(&piece, &x), size), name);
                }
            }
        }
        let Tally { poses, apart, over, sunk, beside } = tally;
        assert!(poses == 4000 && apart > 10 && over > 500 && beside > 100, "{name}: {apart} {over} {beside}");
        assert!(sunk > 10 || name == "thin", "{name}: {sunk}");
    }
}
