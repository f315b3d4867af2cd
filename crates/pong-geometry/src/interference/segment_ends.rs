//! Line segment that lies partly inside a polyhedron: the depth of each end of the part inside, below a given
//! face (see [`line_segment_polyhedron`](super::line_segment_polyhedron)).

use super::{Feature, Interference};
use crate::primitive::{LineSegment, Polyhedron, PolyhedronFace, RimEdge};
use crate::{Vec3, divisor};

/// One end of the part of a segment inside a solid.
#[derive(Clone, Copy)]
pub(super) struct InsideEnd {
    /// Parameter along the segment, 0…1.
    pub at: f64,
    /// Face through which the segment leaves; `None` if its tip is inside.
    pub leaves_by: Option<usize>,
}

/// One end of the part of a segment inside a solid, evaluated for one face.
pub(super) struct AtEnd<'a> {
    pub segment: &'a LineSegment,
    pub polyhedron: &'a Polyhedron,
    pub face: usize,
    pub inside: &'a InsideEnd,
    pub tip_b: &'a Vec3,
}

/// Depth of one end of the part of the segment that is inside the solid, measured from the plane of one face.
#[derive(Clone, Copy)]
pub(super) enum Measured {
    /// No depth: the segment leaves through the face itself.
    Leaves,
    /// Depth of the tip, m. The tip is inside the solid, or straight below the face (negative if above it).
    Tip(f64),
    /// Depth of a crossing: the segment leaves through another face.
    Crossing(Crossing),
}

/// Place where the segment's line passes the line in which two face planes intersect. One is the plane of the
/// face that pushes, the other that of the face through which the segment leaves.
///
/// Let f be the face that pushes and h the face of the exit, n_f and n_h their normals, s the direction of
/// the segment, and q its exit point, which lies in the plane of h. The common normal of the two lines is u =
/// s × (n_f × n_h) = (n_h·s) n_f − (n_f·s) n_h. A vector from q to the intersection line has no component
/// along n_h, so the distance of the lines is the depth of q below f times |n_h·s|/|u|.
#[derive(Clone, Copy)]
pub(super) struct Crossing {
    leaves_by: usize,
    /// Distance of the segment's line below the intersection line, m.
    depth: f64,
    /// Common normal u of the two lines, not normalised, towards the outside; `length` is |u|.
    across: Vec3,
    length: f64,
}

/// Planes of two faces of a body that meet in an edge that a segment may cross.
#[derive(Clone, Copy)]
pub(super) struct Wedge {
    /// Outward unit normals and offsets, m: of the face that pushes, then of the other face.
    pub planes: [(Vec3, f64); 2],
}

impl Wedge {
    /// Difference up to which positions along a segment (fractions of its length) count as equal, so that
    /// rounding does not choose between tips that extend equally far.
    const TIE: f64 = 1e-9;

    /// Returns the wedge of two faces of a piece.
    pub fn of_faces(polyhedron: &Polyhedron, face: usize, other: usize) -> Self {
        Self { planes: [face, other].map(|f| (polyhedron.faces[f].normal, polyhedron.faces[f].offset)) }
    }

    /// Returns the wedge of `face` and the face of the next piece at `edge`, for an edge in which the
    /// internal face between the two pieces ends. `None` if the two faces do not meet convexly.
    pub fn of_edge(polyhedron: &Polyhedron, face: usize, edge: usize) -> Option<Self> {
        let edge = &polyhedron.edges[edge];
        let push = edge.convex.as_ref()?;
        let own = &polyhedron.faces[face];
        let place = polyhedron.vertices[edge.vertices[0] as usize].position;
        let is_first = push.normals[0].dot(&own.normal) >= push.normals[1].dot(&own.normal);
        let other = push.normals[usize::from(is_first)];
        Some(Self { planes: [(own.normal, own.offset), (other, other.dot(&place))] })
    }

    /// Returns the height of a point above one of the planes, m.
    #[inline]
    pub fn height(&self, plane: usize, p: &Vec3) -> f64 {
        let (normal, offset) = &self.planes[plane];
        normal.dot(p) - offset
    }

    /// Returns the end of the segment to which the crossing of the edge is assigned. If the segment enters
    /// through one plane and leaves through the other, that is the end whose tip extends farther out, or the
    /// first end if both extend equally far. Otherwise it is `end`.
    ///
    /// While one tip is inside, the crossing belongs to the other end, whose tip is out. When the first tip
    /// comes out, the other one is still farther out, so the crossing does not change its end.
    pub fn farther_out(&self, segment: &LineSegment, end: usize) -> usize {
        let heights = |plane| (self.height(plane, &segment.ends[0]), self.height(plane, &segment.ends[1]));
        let ((first, second), (other_first, other_second)) = (heights(0), heights(1));
        if !(second < first && other_first < other_second || first < second && other_second < other_first) {
            return end;
        }
        let at = first / divisor(first - second) + other_first / divisor(other_first - other_second);
        // `at` is the sum of the positions of the entry and the exit, as fractions of the length. It is 1 if
        // the parts outside are equally long.
        usize::from(at < 1.0 - Self::TIE)
    }
}

impl Measured {
    /// Returns the depth, m; 0 if the end does not touch.
    #[inline(always)]
    pub fn depth(&self) -> f64 {
        let depth = match self {
            Self::Leaves => 0.0,
            Self::Tip(depth) => *depth,
            Self::Crossing(crossing) => crossing.depth,
        };
        if depth > 0.0 { depth } else { 0.0 }
    }
}

impl AtEnd<'_> {
    #[inline(always)]
    fn face(&self) -> &PolyhedronFace {
        &self.polyhedron.faces[self.face]
    }

    /// Returns the depth of the end below the face; `None` if the face takes no part.
    #[inline(always)]
    pub fn measured(&self) -> Option<Measured> {
        match self.inside.leaves_by {
            Some(leaves_by) if leaves_by == self.face => Some(Measured::Leaves),
            Some(leaves_by) if !is_over_face(self.tip_b, self.polyhedron, self.face) => {
                self.crossing(leaves_by).map(Measured::Crossing)
            }
            _ => Some(Measured::Tip(-self.face().height(self.tip_b))),
        }
    }

    /// Returns the contact of the end, given its depth; `None` if it does not touch.
    #[inline(always)]
    pub fn contact(&self, measured: &Measured) -> Option<Interference> {
        match measured {
            _ if measured.depth() <= 0.0 => None,
            Measured::Leaves => None,
            Measured::Tip(depth) => Some(Interference {
                depth: *depth,
                normal_b: self.face().normal,
                deepest_b: *self.tip_b,
                feature: Feature::face(self.face),
            }),
            Measured::Crossing(crossing) => Some(self.contact_at(crossing)),
        }
    }

    #[inline(always)]
    fn along(&self) -> Vec3 {
        self.segment.ends[1] - self.segment.ends[0]
    }

    #[inline(always)]
    fn leaving(&self) -> Vec3 {
        self.segment.ends[0] + self.along() * self.inside.at
    }

    /// Returns the edge between this face and the internal face through which the segment leaves. The edge is
    /// found by the exit point, because `leaves_by` may be any of several coplanar internal faces.
    #[cold]
    fn rim_at_wall(&self) -> Option<&RimEdge> {
        let (place, slack) = (self.leaving(), self.polyhedron.planes().wall_slack);
        let is_there = |rim: &&RimEdge| {
            let neighbor = &self.polyhedron.faces[rim.neighbor as usize];
            !neighbor.active && neighbor.height(&place).abs() <= slack
        };
        self.polyhedron.rim(self.face).iter().find(is_there)
    }

    /// Returns the crossing for an exit through the face `leaves_by`; `None` if the planes of that face and
    /// of this face are parallel.
    #[inline(always)]
    fn crossing(&self, leaves_by: usize) -> Option<Crossing> {
        let (face, exit, along) = (self.face(), &self.polyhedron.faces[leaves_by], self.along());
        let (slope, exit_slope) = (face.normal.dot(&along), exit.normal.dot(&along));
        let across = (face.normal * exit_slope - exit.normal * slope) * exit_slope.signum();
        let length = across.norm();
        let they_meet = length > 0.0;
        let depth = -face.height(&self.leaving()) * exit_slope.abs() / if they_meet { length } else { 1.0 };
        (they_meet && depth.is_finite()).then_some(Crossing { leaves_by, depth, across, length })
    }

    #[inline(always)]
    fn contact_at(&self, crossing: &Crossing) -> Interference {
        let (exit, along) = (&self.polyhedron.faces[crossing.leaves_by], self.along());
        let normal = (crossing.across / crossing.length).normalize();
        // Point of the segment's line nearest to the intersection line: moved by the depth along `normal`, it
        // lies in the plane of the exit face.
        let back = crossing.depth * exit.normal.dot(&normal) / exit.normal.dot(&along);
        let nearest = self.leaving() - along * back;
        let rims = self.polyhedron.rim(self.face);
        let leaves_by_rim = rims.iter().find(|rim| rim.neighbor as usize == crossing.leaves_by);
        let shared = leaves_by_rim.or_else(|| if exit.active { None } else { self.rim_at_wall() });
        let feature = shared.map_or(Feature::face(self.face), |rim| Feature::edge(rim.edge as usize));
        Interference { depth: crossing.depth, normal_b: normal, deepest_b: nearest, feature }
    }
}

/// Returns `true` if a point projects onto a face's polygon along the face's normal.
#[inline(always)]
fn is_over_face(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> bool {
    // Branch-free in groups of four, because most points outside are outside of an edge in the first group.
    polyhedron
        .rim(face)
        .chunks(4)
        .all(|rims| rims.iter().fold(true, |over, rim| over & (rim.outward.dot(&(p - rim.anchor)) <= 0.0)))
}
