//! Line segments against planes and polyhedra, compared with the text of the physics contract (2.3) worked out
//! by dense sampling, with the condition of docs/decisions/0001: a face takes part only if its crossings lie on the
//! solid.
//!
//! Degenerate cases: a segment along a face's normal, along an edge, through a vertex, within an inner wall,
//! touching from outside.

mod common;
mod oracle_support;

use common::{Random, cuboid, cuboid_corners, hull, hull_with_walls, moved, stretched_hull};
use oracle_support::{Worst, polygon};
use pong_geometry::Vec3;
use pong_geometry::interference::line_segment_plane::line_segment_plane;
use pong_geometry::interference::line_segment_polyhedron::{EndContacts, line_segment_polyhedron};
use pong_geometry::primitive::{LineSegment, Plane, Polyhedron};

/// What one end carries: depth, normal, point.
type End = Option<(f64, Vec3, Vec3)>;

/// What one face measures at one end.
#[derive(Clone, Copy)]
struct Measured {
    end: End,
    /// Whether an inner wall cuts it off.
    walled: bool,
    /// How far the place is behind all faces that do not meet there (a tip: without limit).
    behind_others: f64,
}

/// Winding of a polygon about a point, both seen along a normal.
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

    /// The stretch over a face: sampled, its ends sharpened by halving.
    fn stretch(&self, face: usize) -> Option<[f64; 2]> {
        const SAMPLES: usize = 160;
        let corners = polygon(self.shape, face);
        let over = |t: f64| encloses(&corners, &self.shape.faces[face].normal, &self.place(t));
        let inside: Vec<usize> = (0..=SAMPLES).filter(|&i| over(i as f64 / SAMPLES as f64)).collect();
        let (&first, &last) = (inside.first()?, inside.last()?);
        let sharpen = |mut within: f64, mut beyond: f64| {
            for _ in 0..60 {
                let middle = 0.5 * (within + beyond);
                if over(middle) {
                    within = middle;
                } else {
                    beyond = middle;
                }
            }
            within
        };
        let step = 1.0 / SAMPLES as f64;
        let low = if first == 0 { 0.0 } else { sharpen(first as f64 * step, (first - 1) as f64 * step) };
        let high = if last == SAMPLES { 1.0 } else { sharpen(last as f64 * step, (last + 1) as f64 * step) };
        Some([low, high])
    }

    fn end(&self, face: usize, t: f64) -> Measured {
        let normal = self.shape.faces[face].normal;
        let p = self.place(t);
        if t == 0.0 || t == 1.0 {
            let depth = normal.dot(&(polygon(self.shape, face)[0] - p));
            let end = (depth > 0.0).then_some((depth, normal, p));
            return Measured { end, walled: false, behind_others: f64::INFINITY };
        }
        // The edge of the polygon that is nearest to that place, seen along the normal.
        let flat = |x: &Vec3| x - normal * normal.dot(x);
        let corners = polygon(self.shape, face);
        let gap = |k: usize| {
            let (a, b) = (flat(&corners[k]), flat(&corners[(k + 1) % corners.len()]));
            (oracle_support::nearest_on_segment(&flat(&p), &a, &b) - flat(&p)).norm()
        };
        let k = (0..corners.len()).min_by(|&a, &b| gap(a).total_cmp(&gap(b))).expect("edges");
        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
        let across = |f: usize| {
            f != face && polygon(self.shape, f).contains(&a) && polygon(self.shape, f).contains(&b)
        };
        let neighbor = (0..self.shape.faces.len()).find(|&f| across(f)).expect("closed");
        let walled = !self.shape.faces[neighbor].active;
        let behind_others = (0..self.shape.faces.len())
            .filter(|&f| f != face && f != neighbor)
            .map(|f| self.shape.faces[f].offset - self.shape.faces[f].normal.dot(&p))
            .fold(f64::INFINITY, f64::min);
        // Nearest points of the two lines by least squares.
        let (s, e) = (self.segment.ends[1] - self.segment.ends[0], b - a);
        let w = a - self.segment.ends[0];
        let (ss, se, ee) = (s.dot(&s), s.dot(&e), e.dot(&e));
        let (ws, we) = (w.dot(&s), w.dot(&e));
        let determinant = ss * ee - se * se;
        let (on_s, on_e) = ((ws * ee - we * se) / determinant, (ws * se - we * ss) / determinant);
        let gap = (a + e * on_e) - (self.segment.ends[0] + s * on_s);
        let unit = e.cross(&s).normalize();
        let unit = if unit.dot(&normal) > 0.0 { unit } else { -unit };
        let depth = gap.dot(&unit);
        let end = (depth > 0.0).then_some((depth, unit, self.segment.ends[0] + s * on_s));
        Measured { end, walled, behind_others }
    }

    /// Whether some point of the segment is inside: the greatest of the least depths, by sections.
    fn deepest_point(&self) -> f64 {
        let depth = |t: f64| {
            let p = self.place(t);
            self.shape.faces.iter().map(|f| f.offset - f.normal.dot(&p)).fold(f64::INFINITY, f64::min)
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..90 {
            let (a, b) = (low + (high - low) * 0.4, low + (high - low) * 0.6);
            if depth(a) < depth(b) { low = a } else { high = b }
        }
        depth(0.5 * (low + high)).max(depth(0.0)).max(depth(1.0))
    }

    /// What the face of least energy carries, with all that tie, and how clear the choice is.
    fn answer(&self) -> (Vec<[End; 2]>, f64) {
        let reach = self.deepest_point();
        if reach <= 0.0 {
            return (vec![[None, None]], -reach);
        }
        let mut found: Vec<(f64, [End; 2], bool)> = Vec::new();
        let mut margin = reach;
        for face in (0..self.shape.faces.len()).filter(|&f| self.shape.faces[f].active) {
            let Some(stretch) = self.stretch(face) else { continue };
            let ends = stretch.map(|t| self.end(face, t));
            let energy: f64 = ends.iter().filter_map(|e| e.end).map(|e| e.0 * e.0).sum();
            if energy > 0.0 {
                let touching = || ends.iter().filter(|e| e.end.is_some());
                let on_solid = touching().all(|e| e.behind_others >= 0.0);
                let carried = ends.map(|e| if e.walled { None } else { e.end });
                found.push((energy, carried, on_solid));
                margin = touching().map(|e| e.behind_others.abs()).fold(margin, f64::min);
            }
        }
        let least = |some: &dyn Fn(bool) -> bool| {
            found.iter().filter(|f| some(f.2)).map(|f| f.0).fold(f64::INFINITY, f64::min)
        };
        let (on_solid, any) = (least(&|on_solid| on_solid), least(&|_| true));
        margin = margin.min((on_solid - 4.0 * any).abs());
        if on_solid <= 4.0 * any {
            found.retain(|f| f.2);
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(least) = found.first().map(|f| f.0) else { return (vec![[None, None]], margin) };
        let (ties, others): (Vec<_>, Vec<_>) = found.into_iter().partition(|f| f.0 - least < 1e-13);
        margin = others.iter().map(|f| f.0 - least).fold(margin, f64::min);
        (ties.into_iter().map(|f| f.1).collect(), margin)
    }
}

fn error(found: &EndContacts, expected: &[End; 2]) -> f64 {
    let mut worst = 0.0_f64;
    for (found, expected) in found.iter().zip(expected) {
        match (found, expected) {
            (None, None) => {}
            (Some(f), Some((depth, normal, point))) => {
                worst = worst.max((f.depth - depth).abs()).max((f.normal - normal).norm() * depth);
                worst = worst.max((f.point_a - point).norm() * depth);
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
                    assert_eq!((contact.point_a, contact.normal), (*end, plane.normal));
                }
                None => assert!(depth <= 1e-15),
            }
        }
    }
}

#[test]
fn polyhedra_as_the_text_says() {
    let mut random = Random(502);
    let mut worst = Worst::new("segment–polyhedron: depth, normal and point × depth");
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
    .map(|shape| moved(&shape, &random.motion(0.2)));
    let (mut touching, mut skipped) = (0, 0);
    while touching < 10_000 {
        let shape = &shapes[touching % 4];
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
        if error > 1e-9 && (margin < 1e-7 || wavers(&segment, shape, &expected[0], &mut random)) {
            skipped += 1;
            continue;
        }
        worst.note(error, 2e-11);
    }
    println!("{touching} touching, {skipped} on a border");
    assert!(skipped < 150);
}

/// Whether the sampled answer itself changes nearby (a stretch shorter than the sampling, a vertex).
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
                    assert!((contact.normal.norm() - 1.0).abs() < 1e-15);
                    assert!(contact.point_a.iter().all(|c| c.is_finite()));
                }
                // Turned round it is the same contact with the ends exchanged.
                let back = line_segment_polyhedron(&LineSegment { ends: [*b, *a] }, shape);
                for (one, other) in contacts.iter().zip(back.iter().rev()) {
                    let depths = [one, other].map(|c| c.map_or(0.0, |c| c.depth));
                    assert!((depths[0] - depths[1]).abs() < 1e-14, "{a:?} {b:?}: {depths:?}");
                }
                // Along the surface: touching is no contact.
                let touches = (0..3).any(|i| a[i].abs() >= 1.0 && a[i] == b[i]);
                assert!(!touches || contacts == [None, None], "{a:?} {b:?}: {contacts:?}");
            }
        }
    }
}
