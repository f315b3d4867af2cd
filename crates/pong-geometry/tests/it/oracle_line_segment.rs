//! Line segments against planes and polyhedra, compared with the rule as worded in docs/decisions/0001,
//! evaluated by sampling, winding numbers and least squares.
//!
//! Degenerate cases: a segment along a face's normal, along an edge, through a vertex, within an inner wall,
//! touching from outside.

use crate::common::{
    Random, cuboid, cuboid_corners, hull, hull_with_walls, moved, random_motion, stretched_hull,
};
use crate::oracle_support::{Worst, polygon};
use pong_geometry::Vec3;
use pong_geometry::interference::line_segment_plane::line_segment_plane;
use pong_geometry::interference::line_segment_polyhedron::{EndContacts, line_segment_polyhedron};
use pong_geometry::primitive::{LineSegment, Plane, Polyhedron};

/// Contact of one end: depth, normal, point.
type End = Option<(f64, Vec3, Vec3)>;

/// Measurement of one face at one end.
#[derive(Clone, Copy)]
struct Measured {
    end: End,
    /// True if an internal face cuts it off.
    walled: bool,
}

/// Winding number of a polygon about a point, seen along a normal.
fn encloses(corners: &[Vec3], normal: &Vec3, p: &Vec3) -> bool {
    let u = (corners[1] - corners[0]).normalize();
    let v = normal.cross(&u);
    let angles: Vec<f64> = corners.iter().map(|c| v.dot(&(c - p)).atan2(u.dot(&(c - p)))).collect();
    let turn: f64 = (0..angles.len())
        .map(|i| {
            let step = angles[(i + 1) % angles.len()] - angles[i];
            step - std::f64::consts::TAU * (step / std::f64::consts::TAU).round()
        })
        .sum();
    turn.abs() > std::f64::consts::PI
}

struct Text<'a> {
    segment: LineSegment,
    shape: &'a Polyhedron,
}

impl Text<'_> {
    fn place(&self, t: f64) -> Vec3 {
        self.segment.ends[0] + (self.segment.ends[1] - self.segment.ends[0]) * t
    }

    fn depth(&self, t: f64) -> f64 {
        let p = self.place(t);
        self.shape.faces.iter().map(|f| f.offset - f.normal.dot(&p)).fold(f64::INFINITY, f64::min)
    }

    /// Interval inside the solid: from its deepest point outwards by bisection.
    fn stretch(&self, deepest: f64) -> [f64; 2] {
        [0.0, 1.0].map(|tip| {
            if self.depth(tip) > 0.0 {
                return tip;
            }
            let (mut within, mut beyond) = (deepest, tip);
            for _ in 0..80 {
                let middle = 0.5 * (within + beyond);
                if self.depth(middle) > 0.0 {
                    within = middle;
                } else {
                    beyond = middle;
                }
            }
            within
        })
    }

    /// Measurement of a face at the end `t` of the interval, on the side of the tip `tip`; `None` if it takes
    /// no part.
    fn end(&self, face: usize, t: f64, tip: f64) -> Option<Measured> {
        let faces = &self.shape.faces;
        let normal = faces[face].normal;
        let below = |p: Vec3| {
            let depth = normal.dot(&(polygon(self.shape, face)[0] - p));
            Some(Measured { end: (depth > 0.0).then_some((depth, normal, p)), walled: false })
        };
        if t == tip {
            return below(self.place(tip));
        }
        let p = self.place(t);
        let gap = |f: usize| (faces[f].offset - faces[f].normal.dot(&p)).abs();
        let exit = (0..faces.len()).min_by(|&a, &b| gap(a).total_cmp(&gap(b))).expect("faces");
        let walled = !faces[exit].active;
        if exit == face {
            return Some(Measured { end: None, walled });
        }
        if encloses(&polygon(self.shape, face), &normal, &self.place(tip)) {
            return below(self.place(tip)).map(|measured| Measured { walled, ..measured });
        }
        // Intersection line of the two planes, and the nearest points of the two lines by least squares.
        let e = normal.cross(&faces[exit].normal);
        if e.norm() < 1e-9 {
            return None;
        }
        let rows = nalgebra::Matrix3::from_rows(&[
            normal.transpose(),
            faces[exit].normal.transpose(),
            e.transpose(),
        ]);
        let a = rows.lu().solve(&Vec3::new(faces[face].offset, faces[exit].offset, 0.0)).expect("a line");
        let s = self.segment.ends[1] - self.segment.ends[0];
        let w = a - self.segment.ends[0];
        let (ss, se, ee) = (s.dot(&s), s.dot(&e), e.dot(&e));
        let (ws, we) = (w.dot(&s), w.dot(&e));
        let determinant = ss * ee - se * se;
        let (on_s, on_e) = ((ws * ee - we * se) / determinant, (ws * se - we * ss) / determinant);
        let gap = (a + e * on_e) - self.place(on_s);
        let end = (gap.norm() > 0.0).then(|| (gap.norm(), gap.normalize(), self.place(on_s)));
        Some(Measured { end, walled })
    }

    /// Deepest point, by sectioning, and its depth.
    fn deepest(&self) -> (f64, f64) {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..90 {
            let (a, b) = (low + (high - low) * 0.4, low + (high - low) * 0.6);
            if self.depth(a) < self.depth(b) { low = a } else { high = b }
        }
        let places = [0.5 * (low + high), 0.0, 1.0].map(|t| (t, self.depth(t)));
        places.into_iter().max_by(|a, b| a.1.total_cmp(&b.1)).expect("places")
    }

    /// Contacts of the face of least energy, with all ties, and the margin of the choice.
    fn answer(&self) -> (Vec<[End; 2]>, f64) {
        let (deepest, reach) = self.deepest();
        if reach <= 0.0 {
            return (vec![[None, None]], -reach);
        }
        let stretch = self.stretch(deepest);
        let mut found: Vec<(f64, [End; 2])> = Vec::new();
        for face in (0..self.shape.faces.len()).filter(|&f| self.shape.faces[f].active) {
            let ends = [0, 1].map(|i| self.end(face, stretch[i], i as f64));
            let [Some(first), Some(second)] = ends else { continue };
            let energy: f64 = [first, second].iter().filter_map(|e| e.end).map(|e| e.0 * e.0).sum();
            if energy > 0.0 {
                found.push((energy, [first, second].map(|e| if e.walled { None } else { e.end })));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(least) = found.first().map(|f| f.0) else { return (vec![[None, None]], reach) };
        let (ties, others): (Vec<_>, Vec<_>) = found.into_iter().partition(|f| f.0 - least < 1e-13);
        let margin = others.iter().map(|f| f.0 - least).fold(reach, f64::min);
        (ties.into_iter().map(|f| f.1).collect(), margin)
    }
}

fn error(found: &EndContacts, expected: &[End; 2]) -> f64 {
    let mut worst = 0.0_f64;
    for (found, expected) in found.iter().zip(expected) {
        match (found, expected) {
            (None, None) => {}
            (Some(f), Some((depth, normal, point))) => {
                worst = worst.max((f.depth - depth).abs()).max((f.normal_b - normal).norm() * depth);
                worst = worst.max((f.deepest_b - point).norm() * depth);
            }
            (Some(f), None) => worst = worst.max(f.depth),
            (None, Some((depth, ..))) => worst = worst.max(*depth),
        }
    }
    worst
}

#[test]
fn planes_take_half_at_each_end() {
    let mut random = Random(501);
    let mut worst = Worst::new("segment–plane");
    for _ in 0..10_000 {
        let ends = [0; 2].map(|_| random.direction() * random.between(0.0, 2.0));
        let plane = Plane { normal: random.direction(), offset: random.between(-1.0, 1.0) };
        let on_plane = plane.normal * plane.offset;
        let contacts = line_segment_plane(&LineSegment { ends }, &plane);
        for (end, contact) in ends.iter().zip(&contacts) {
            let depth = plane.normal.dot(&(on_plane - end));
            match contact {
                Some(contact) => {
                    worst.note((contact.depth - depth).abs(), 2e-15);
                    assert_eq!((contact.deepest_b, contact.normal_b), (*end, plane.normal));
                }
                None => assert!(depth <= 1e-15),
            }
        }
    }
}

#[test]
fn polyhedra_as_the_rule_says() {
    let mut random = Random(502);
    let tetrahedron =
        hull(&[Vec3::zeros(), Vec3::x(), Vec3::y(), Vec3::z()].map(|v| v * 1.6 - Vec3::repeat(0.3)));
    let walled =
        hull_with_walls(&cuboid_corners(Vec3::new(-0.6, -0.5, -0.4), Vec3::new(0.7, 0.6, 0.3)), &|n, _| {
            n.x > 0.9
        });
    let shapes = [
        cuboid(Vec3::new(-0.8, -0.6, -0.4), Vec3::new(0.7, 0.6, 0.3)),
        tetrahedron,
        walled,
        stretched_hull(10, Vec3::new(1.0, 0.8, 0.5)),
    ]
    .map(|shape| moved(&shape, &random_motion(&mut random, 0.2)));
    compare_with_the_rule(&shapes, 10_000, &mut random);
}

/// The number of faces selects the algorithm (registers, bounds, one by one, beyond the bits of a word); the
/// result is the same.
#[test]
fn however_many_faces_as_the_rule_says() {
    let mut random = Random(503);
    for (vertices, touching) in [(18, 600), (30, 600), (80, 300), (280, 100)] {
        let shape = stretched_hull(vertices, Vec3::new(1.0, 0.8, 0.5));
        compare_with_the_rule(&[moved(&shape, &random_motion(&mut random, 0.2))], touching, &mut random);
    }
}

fn compare_with_the_rule(shapes: &[Polyhedron], wanted: usize, random: &mut Random) {
    let mut worst = Worst::new("segment–polyhedron: depth, normal and point × depth");
    let (mut touching, mut skipped) = (0, 0);
    while touching < wanted {
        let shape = &shapes[touching % shapes.len()];
        let length = random.between(0.05, 3.0);
        let middle = random.direction() * random.between(0.0, 1.0);
        let half = random.direction() * length * 0.5;
        let segment = LineSegment { ends: [middle - half, middle + half] };
        let found = line_segment_polyhedron(&segment, shape);
        let (expected, margin) = Text { segment, shape }.answer();
        if expected == [[None, None]] && found == [None, None] {
            continue;
        }
        touching += 1;
        let error = expected.iter().map(|e| error(&found, e)).fold(f64::INFINITY, f64::min);
        if error > 1e-9 && (margin < 1e-7 || wavers(&segment, shape, &expected[0], random)) {
            skipped += 1;
            continue;
        }
        worst.note(error, 2e-11);
    }
    println!("{touching} touching, {skipped} on a border");
    assert!(skipped * 60 < wanted);
}

/// A segment that enters by one face and leaves by another has one crossing, claimed by both. The end that is
/// farther out carries it, and the first if both are equal, in spite of rounding: the contact is remembered
/// by that end.
#[test]
fn a_crossing_that_two_faces_claim_is_at_the_end_farther_out() {
    let mut random = Random(504);
    for _ in 0..300 {
        let shape = moved(
            &cuboid(Vec3::new(-0.8, -0.6, -0.4), Vec3::new(0.7, 0.6, 0.3)),
            &random_motion(&mut random, 0.5),
        );
        for edge in &shape.edges {
            let [from, to] = edge.vertices.map(|v| shape.vertices[v as usize].position);
            let middle = from + (to - from) * random.between(0.4, 0.6);
            let on = |f: &usize| shape.faces[*f].height(&middle).abs() < 1e-9;
            let faces: Vec<usize> = (0..shape.faces.len()).filter(on).collect();
            let [lower, higher] = [faces[0], faces[1]].map(|face| shape.faces[face].normal);
            let inside = middle - (lower + higher) * random.between(1e-3, 0.05);
            let along = (lower - higher + (to - from) * random.between(-0.1, 0.1)) * 0.3;
            // The first end is beyond the higher face, the second beyond the lower one.
            for (reach, is_first) in [(1.0, [true, true]), (0.99, [true, false]), (1.01, [false, true])] {
                let ends = [inside - along, inside + along * reach];
                let contacts = line_segment_polyhedron(&LineSegment { ends }, &shape);
                let turned = line_segment_polyhedron(&LineSegment { ends: [ends[1], ends[0]] }, &shape);
                for (contacts, is_first) in [contacts, turned].iter().zip(is_first) {
                    assert_eq!(contacts.map(|c| c.is_some()), [is_first, !is_first], "{reach}: {contacts:?}");
                }
            }
        }
    }
}

/// Returns `true` if the sampled answer itself changes nearby (an interval shorter than the sampling, a
/// vertex).
fn wavers(segment: &LineSegment, shape: &Polyhedron, expected: &[End; 2], random: &mut Random) -> bool {
    (0..6).any(|_| {
        let ends = segment.ends.map(|end| end + random.direction() * 3e-3);
        let (other, _) = Text { segment: LineSegment { ends }, shape }.answer();
        (0..2).any(|i| match (&other[0][i], &expected[i]) {
            (Some(a), Some(b)) => (a.1 - b.1).norm() > 0.1 || (a.0 - b.0).abs() > 0.03,
            (None, None) => false,
            _ => true,
        })
    })
}

#[test]
fn degenerate_segments_are_finite_and_the_same_every_time() {
    let shape = cuboid(Vec3::repeat(-1.0), Vec3::repeat(1.0));
    let walled = hull_with_walls(&cuboid_corners(Vec3::repeat(-1.0), Vec3::repeat(1.0)), &|n, _| n.x > 0.9);
    let places: Vec<Vec3> = [-2.0, -1.0, 0.0, 1.0, 2.0]
        .iter()
        .flat_map(|&x| [-1.0, 0.0, 1.0].map(move |y| (x, y)))
        .flat_map(|(x, y)| [-2.0, -1.0, 0.0, 0.5, 1.0].map(move |z| Vec3::new(x, y, z)))
        .collect();
    for a in &places {
        for b in &places {
            if a == b {
                continue;
            }
            for shape in [&shape, &walled] {
                let segment = LineSegment { ends: [*a, *b] };
                let contacts = line_segment_polyhedron(&segment, shape);
                assert_eq!(contacts, line_segment_polyhedron(&segment, shape));
                for contact in contacts.iter().flatten() {
                    assert!(contact.depth > 0.0 && contact.depth.is_finite());
                    assert!((contact.normal_b.norm() - 1.0).abs() < 1e-15);
                    assert!(contact.deepest_b.iter().all(|c| c.is_finite()));
                }
                // The reversed segment has the same contact with the ends exchanged; if both tips are equally
                // far out, a single contact is at the first end both times.
                let back = line_segment_polyhedron(&LineSegment { ends: [*b, *a] }, shape);
                let depths = |contacts: EndContacts| contacts.map(|c| c.map_or(0.0, |c| c.depth));
                let (one, other) = (depths(contacts), depths(back));
                let is_single = contacts.iter().flatten().count() == 1;
                let apart = |to: [f64; 2]| (one[0] - to[0]).abs().max((one[1] - to[1]).abs());
                let off = apart([other[1], other[0]]).min(if is_single { apart(other) } else { f64::MAX });
                assert!(off < 1e-14, "{a:?} {b:?}: {one:?} {other:?}");
                // Along the surface: touching is no contact.
                let touches = (0..3).any(|i| a[i].abs() >= 1.0 && a[i] == b[i]);
                assert!(!touches || contacts == [None, None], "{a:?} {b:?}: {contacts:?}");
            }
        }
    }
}
