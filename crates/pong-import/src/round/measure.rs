//! Distance of a mesh from a round primitive, and completeness of the mesh.

use super::frame::Frame;
use super::shape::{Kind, Round};
use crate::mesh::{Adjacency, Mesh, area_vector, volume_m3};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::{PI, TAU};

/// Each edge of a triangle is divided into this many parts for measuring.
const PARTS: usize = 8;

impl Round {
    fn along(&self) -> Vector3<f64> {
        self.ends[1] - self.ends[0]
    }

    /// A point in the half plane through the axis: height over end 0 and distance from the axis.
    fn flattened(&self, place: &Vector3<f64>) -> Vector2<f64> {
        let (arm, along) = (place - self.ends[0], self.along());
        let length = along.norm();
        let height = arm.dot(&along) / length;
        Vector2::new(height, (arm - along * (height / length)).norm())
    }

    /// Distance of a point from the surface, m.
    fn distance_m(&self, place: &Vector3<f64>) -> f64 {
        let (place, length) = (self.flattened(place), self.along().norm());
        let corner = |z: f64, r: f64| Vector2::new(z, r);
        let [r0, r1] = self.radii;
        if self.kind == Kind::Capsule {
            return (from_segment(&place, corner(0.0, 0.0), corner(length, 0.0)) - r0).abs();
        }
        let wall = from_segment(&place, corner(0.0, r0), corner(length, r1));
        if self.kind == Kind::Bore {
            return wall;
        }
        let low = from_segment(&place, corner(0.0, 0.0), corner(0.0, r0));
        let high = from_segment(&place, corner(length, 0.0), corner(length, r1));
        wall.min(low).min(high)
    }

    fn volume_m3(&self) -> f64 {
        let (length, [r0, r1]) = (self.along().norm(), self.radii);
        let ball = if self.kind == Kind::Capsule { 4.0 / 3.0 * PI * r0.powi(3) } else { 0.0 };
        ball + PI / 3.0 * length * (r0 * r0 + r0 * r1 + r1 * r1)
    }
}

fn from_segment(place: &Vector2<f64>, start: Vector2<f64>, end: Vector2<f64>) -> f64 {
    let along = end - start;
    let square = along.norm_squared();
    let share = if square > 0.0 { ((place - start).dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (place - start - along * share).norm()
}

/// Largest distance of the mesh from the primitive: at its vertices and at 45 points of each triangle, m.
pub(super) fn farthest_m(part: &Mesh, round: &Round) -> f64 {
    let at_vertices = part.vertices.iter().map(|place| round.distance_m(place));
    let in_triangles = (0..part.triangles.len()).flat_map(|index| {
        let [a, b, c] = part.corners(index);
        let shares = (0..=PARTS).flat_map(|i| (0..=PARTS - i).map(move |j| (i as f64, j as f64)));
        let at = move |(i, j): (f64, f64)| a + ((b - a) * i + (c - a) * j) / PARTS as f64;
        shares.map(move |share| round.distance_m(&at(share)))
    });
    at_vertices.chain(in_triangles).fold(0.0, |most, x| if x <= most { most } else { x })
}

/// Tests whether vertices surround the axis, at least `sides` of them.
pub(super) fn goes_around(part: &Mesh, frame: &Frame, sides: usize) -> bool {
    let size_m = part.size_m();
    let locals = part.vertices.iter().map(|place| frame.local(place).xy());
    let mut turns: Vec<f64> =
        locals.filter(|arm| arm.norm() > 1e-3 * size_m).map(|arm| arm.y.atan2(arm.x)).collect();
    turns.sort_by(f64::total_cmp);
    let (Some(first), Some(last)) = (turns.first(), turns.last()) else { return false };
    let over_the_end = first + TAU - last;
    let widest = turns.windows(2).map(|two| two[1] - two[0]).fold(over_the_end, f64::max);
    // Noise turns a vertex a little.
    widest <= TAU / (sides as f64 - 0.5)
}

/// Tests by its volume whether a closed mesh near the primitive encloses all of it, without folds.
pub(super) fn has_volume(part: &Mesh, round: &Round, tolerance_m: f64) -> bool {
    let area: f64 =
        0.5 * (0..part.triangles.len()).map(|t| area_vector(&part.corners(t)).norm()).sum::<f64>();
    (volume_m3(part) - round.volume_m3()).abs() <= 1.5 * tolerance_m * area
}

/// Tests whether an open mesh near the wall faces the axis and ends in two loops, one around each end.
pub(super) fn is_wall_of_hole(
    part: &Mesh,
    edges: &Adjacency,
    round: &Round,
    frame: &Frame,
    tolerance_m: f64,
) -> bool {
    let faces_axis = (0..part.triangles.len()).all(|index| {
        let corners = part.corners(index);
        let middle = frame.local(&((corners[0] + corners[1] + corners[2]) / 3.0));
        let normal = frame.local(&(frame.origin + area_vector(&corners)));
        normal.xy().dot(&middle.xy()) <= 0.0
    });
    let length = round.along().norm();
    let mut turned = [0.0; 2];
    let mut at_ends = true;
    for &(triangle, corner) in &edges.free {
        let corners = part.corners(triangle as usize);
        let (from, to) = (corners[corner as usize], corners[(corner as usize + 1) % 3]);
        let height = round.flattened(&from).x;
        let end = usize::from(height > 0.5 * length);
        at_ends &= (height - if end == 1 { length } else { 0.0 }).abs() <= tolerance_m;
        let (a, b) = (frame.local(&from).xy(), frame.local(&to).xy());
        turned[end] += a.perp(&b).atan2(a.dot(&b));
    }
    let once_around = turned.iter().all(|turn| (turn.abs() - TAU).abs() < 1.0);
    faces_axis && at_ends && once_around
}
