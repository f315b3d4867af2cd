//! A convex solid cut into pieces acts on an ellipsoid like the uncut solid: for any position and number of
//! internal faces, in any pose, shallow and deep.

use crate::common::*;
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_piece;
use pong_geometry::primitive::{Ellipsoid, Polyhedron};
use pong_geometry::{Quat, Vec3};
use pong_model::Extensions;
use pong_testkit::Random;

const STIFFNESS: f64 = 1e5;
/// Both surfaces have the same stiffness, N/m.
const SERIES: f64 = 0.5 * STIFFNESS;

fn steel() -> String {
    surface(STIFFNESS, "normal: Linear(damping: 0.0)")
}

/// A convex solid by its faces, each an outline counter-clockwise from outside; the flag is false for an
/// internal face.
#[derive(Clone)]
struct Solid {
    faces: Vec<(Vec<Vec3>, bool)>,
}

impl Solid {
    fn cuboid(half: Vec3) -> Self {
        let corner =
            |i: usize| Vec3::from_fn(|axis, _| if i >> axis & 1 == 1 { half[axis] } else { -half[axis] });
        let outlines = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        Self { faces: outlines.map(|outline| (outline.map(corner).to_vec(), false)).to_vec() }
    }

    fn turned(&self, turn: &Quat, shift: &Vec3) -> Self {
        let moved = |outline: &Vec<Vec3>| outline.iter().map(|p| turn * p + shift).collect();
        Self { faces: self.faces.iter().map(|(outline, wall)| (moved(outline), *wall)).collect() }
    }

    /// The part behind a plane, if any; `wall` marks the cut as an internal face.
    fn behind(&self, normal: &Vec3, offset: f64, wall: bool) -> Option<Self> {
        let height = |p: &Vec3| normal.dot(p) - offset;
        let mut faces = Vec::new();
        let mut rim: Vec<(Vec3, Vec3)> = Vec::new();
        for (outline, is_wall) in &self.faces {
            let mut kept = Vec::new();
            let (mut leaves, mut enters) = (None, None);
            for (k, p) in outline.iter().enumerate() {
                let q = &outline[(k + 1) % outline.len()];
                if height(p) < 0.0 {
                    kept.push(*p);
                }
                if (height(p) < 0.0) != (height(q) < 0.0) {
                    let at = crossing(p, q, &height);
                    kept.push(at);
                    *(if height(p) < 0.0 { &mut leaves } else { &mut enters }) = Some(at);
                }
            }
            if kept.len() >= 3 {
                faces.push((kept, *is_wall));
            }
            rim.extend(enters.zip(leaves));
        }
        if faces.is_empty() {
            return None;
        }
        if let Some(&(first, mut at)) = rim.first() {
            let mut outline = vec![first];
            while at != first {
                outline.push(at);
                at = rim.iter().find(|(from, _)| *from == at).expect("the cut closes").1;
            }
            faces.push((outline, wall));
        }
        Some(Self { faces })
    }

    fn text(&self, name: &str) -> String {
        let mut vertices: Vec<Vec3> = Vec::new();
        let mut outlines = Vec::new();
        for (outline, _) in &self.faces {
            let index = |p: &Vec3| {
                vertices.iter().position(|v| v == p).unwrap_or_else(|| {
                    vertices.push(*p);
                    vertices.len() - 1
                })
            };
            outlines.push(outline.iter().map(index).collect::<Vec<_>>());
        }
        let walls: Vec<usize> = (0..self.faces.len()).filter(|&face| self.faces[face].1).collect();
        let points: Vec<String> =
            vertices.iter().map(|v| format!("({:?},{:?},{:?})", v.x, v.y, v.z)).collect();
        format!(
            "Polyhedron(name: \"{name}\", vertices: [{}], faces: {outlines:?}, inactive_faces: {walls:?})",
            points.join(",")
        )
    }
}

/// Intersection of the edge between two points with a plane; bit-identical from either end.
fn crossing(p: &Vec3, q: &Vec3, height: &impl Fn(&Vec3) -> f64) -> Vec3 {
    let (p, q) = if (p.x, p.y, p.z) < (q.x, q.y, q.z) { (p, q) } else { (q, p) };
    p + (q - p) * (height(p) / (height(p) - height(q)))
}

/// Cuts all pieces by one plane after another, so that the pieces meet face to face.
fn cut(solid: &Solid, planes: &[(Vec3, f64)]) -> Vec<Solid> {
    let mut pieces = vec![solid.clone()];
    for (normal, offset) in planes {
        let halves = pieces
            .iter()
            .flat_map(|piece| [piece.behind(normal, *offset, true), piece.behind(&-normal, -offset, true)]);
        pieces = halves.flatten().collect();
    }
    pieces
}

fn body(pieces: &[Solid]) -> String {
    let texts: Vec<String> =
        pieces.iter().enumerate().map(|(i, piece)| piece.text(&format!("p{i}"))).collect();
    model("body", &steel(), &texts.join(","))
}

/// A box with some of its corners cut off.
fn random_solid(random: &mut Random) -> Solid {
    let mut solid = Solid::cuboid(Vec3::from_fn(|_, _| random.between(0.3, 1.0)));
    for _ in 0..(random.between(0.0, 5.0) as usize) {
        let normal = random.vector(1.0).normalize();
        if let Some(smaller) = solid.behind(&normal, random.between(0.3, 0.6), false) {
            solid = smaller;
        }
    }
    solid.turned(&random.rotation(), &random.vector(2.0))
}

fn a_point_of(solid: &Solid, random: &mut Random) -> Vec3 {
    let (outline, _) = &solid.faces[(random.unit() * solid.faces.len() as f64) as usize];
    let shares: Vec<f64> = outline.iter().map(|_| random.unit()).collect();
    let sum: f64 = shares.iter().sum();
    outline.iter().zip(&shares).map(|(p, share)| p * (share / sum)).sum()
}

#[derive(Default, Debug)]
struct Tally {
    touched: usize,
    /// Deeper than the smallest radius of curvature.
    deep: usize,
    off: usize,
    /// The ellipsoid does not reach the piece with the uncut solid's contact point; that piece takes no part.
    out_of_reach: usize,
    out_of_reach_and_off: usize,
}

/// Compares a solid with its pieces; `reach` is the distance of the centre from the surface in smallest
/// semi-axes.
fn compare(cuts: usize, reach: f64, random: &mut Random) -> Tally {
    let mut tally = Tally::default();
    for _ in 0..30 {
        let solid = random_solid(random);
        let plane = |random: &mut Random| {
            let normal = random.vector(1.0).normalize();
            let inside = (a_point_of(&solid, random) + a_point_of(&solid, random)) * 0.5;
            (normal, normal.dot(&inside))
        };
        let planes: Vec<(Vec3, f64)> = (0..cuts).map(|_| plane(random)).collect();
        let semi_axes = Vec3::from_fn(|_, _| random.between(0.05, 0.3));
        let [x, y, z] = [semi_axes.x, semi_axes.y, semi_axes.z];
        let text = format!("Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: ({x:?},{y:?},{z:?}))");
        let ellipsoid = model("ellipsoid", &steel(), &text);
        let mut whole = Rig::new(&ellipsoid, &body(std::slice::from_ref(&solid)));
        let text = body(&cut(&solid, &planes));
        let mut pieces = Rig::new(&ellipsoid, &text);
        let solids =
            &pong_model::parse(&text, "pieces.ron", None, &Extensions::new()).unwrap().bodies[0].polyhedra;
        for _ in 0..120 {
            let smallest = semi_axes.min();
            let place = a_point_of(&solid, random) + random.vector(reach * smallest);
            let turn = random.rotation();
            // The whole scene is rotated and moved.
            let (frame, shift) = (random.rotation(), random.vector(3.0));
            let orientation = frame * turn;
            let forces = [&mut whole, &mut pieces].map(|rig| {
                rig.place([at(frame * place + shift, orientation), at(shift, frame)]);
                rig.world.evaluate().unwrap();
                rig.wrench(0).force
            });
            let depth = forces[0].norm() / SERIES;
            let off = (forces[0] - forces[1]).norm() > 1e-9 * SERIES;
            let e = Ellipsoid { center: place, axes: turn.to_rotation_matrix().into_inner(), semi_axes };
            let touched = whole.world.contacts_iter().next().map(|contact| {
                let touched = contact.point + contact.normal * (0.5 * contact.depth);
                frame.inverse() * (touched - shift)
            });
            let has_place =
                |p: &Polyhedron, place: &Vec3| p.faces.iter().all(|face| face.height(place) < 1e-9);
            let reached = |p: &&Polyhedron| ellipsoid_piece(&e, p).is_some();
            let out_of_reach = touched
                .is_some_and(|place| !solids.iter().filter(|p| has_place(p, &place)).any(|p| reached(&p)));
            tally.touched += usize::from(depth > 0.0);
            tally.deep += usize::from(depth > smallest * smallest / semi_axes.max());
            tally.off += usize::from(off && !out_of_reach);
            tally.out_of_reach += usize::from(out_of_reach);
            tally.out_of_reach_and_off += usize::from(off && out_of_reach);
        }
    }
    tally
}

#[test]
fn a_cut_solid_is_the_solid() {
    let mut random = Random(7);
    for (cuts, reach) in [1, 2, 3, 4].into_iter().flat_map(|cuts| [0.3, 1.0, 3.0].map(|reach| (cuts, reach)))
    {
        let tally = compare(cuts, reach, &mut random);
        println!("{cuts} cuts, {reach} semi-axes: {tally:?}");
        assert!(tally.touched > 1500);
        assert_eq!(tally.off, 0, "{cuts} cuts, {reach} semi-axes: {tally:?}");
    }
}

/// The centre is 1e-5 to 1e-3 beyond the internal face between two boxes of a rotated body: the internal face
/// must not take the contact from the piece that has the foot point.
#[test]
fn a_wall_beside_the_centre_takes_nothing_away() {
    let mut random = Random(8);
    for _ in 0..50 {
        let solid = Solid::cuboid(Vec3::new(1.0, 0.7, 0.5)).turned(&random.rotation(), &random.vector(1.0));
        let [corner, next] = [solid.faces[0].0[0], solid.faces[0].0[1]];
        let (normal, middle) = ((next - corner).normalize(), (corner + next) * 0.5);
        let pieces = cut(&solid, &[(normal, normal.dot(&middle))]);
        let ellipsoid = "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.1,0.08,0.06))";
        let mut rig = Rig::new(&model("ellipsoid", &steel(), ellipsoid), &body(&pieces));
        let outline = &solid.faces[0].0;
        let face = (outline[1] - outline[0]).cross(&(outline[2] - outline[0])).normalize();
        let inside = (outline[2] - outline[1]).normalize();
        let turn = random.rotation();
        let half_width = Vec3::new(0.1, 0.08, 0.06).component_mul(&(turn.inverse() * face)).norm();
        for along in [-1e-3, -1e-9, 0.0, 1e-9, 1e-5, 1e-4, 2e-4, 5e-4, 1e-3] {
            let center = middle + inside * 0.5 + normal * along - face * 0.01;
            rig.place([at(center, turn), pong_engine::State::identity()]);
            rig.world.evaluate().unwrap();
            let expected = face * (SERIES * (half_width + 0.01));
            let force = rig.wrench(0).force;
            assert!((force - expected).norm() < 1e-9 * SERIES, "{along}: {force:?} {expected:?}");
        }
    }
}

/// The lower of two slabs has a free face below, the upper one a free top: the ellipsoid at their internal
/// face is pushed out by the nearer.
#[test]
fn of_two_far_sides_the_nearer_pushes() {
    let slab = Solid::cuboid(Vec3::new(3.0, 3.0, 1.0));
    let pieces = cut(&slab, &[(Vec3::z(), 0.0)]);
    let ellipsoid = "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.4,0.4,0.3))";
    let mut rig = Rig::new(&model("ellipsoid", &steel(), ellipsoid), &body(&pieces));
    for z in [0.2, -0.2] {
        rig.place_a(Vec3::new(0.1, 0.0, z), Quat::identity());
        rig.world.evaluate().unwrap();
        let expected = Vec3::z() * (SERIES * 1.1 * z.signum());
        assert!((rig.wrench(0).force - expected).norm() < 1e-9 * SERIES, "{:?}", rig.wrench(0));
    }
}
