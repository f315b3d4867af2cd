//! Detection of coplanar faces of different surfaces: a shape that touches both is pushed twice.
//!
//! Faces of one surface (triangles that share vertices, pieces that share an internal face) share a contact's
//! load; faces of two surfaces do not (docs/theory.md, 2.2). Where two such faces overlap, both push a shape
//! that lies on them. Where they only meet in a seam, both push it while it crosses the seam. The search is
//! meant for tools, because its time grows with the number of faces.

use crate::model::MovableGroup;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Vec3};
use std::collections::BTreeMap;

/// Distance up to which faces count as coplanar, and length of an overlap up to which it counts as none,
/// relative to the size of the larger face.
const IN_PLANE: f64 = 1e-6;
/// Maximum number of pairs of faces compared: enough for parts of a scene, not for terrains on top of each
/// other.
const COMPARISONS_MAX: usize = 20_000_000;

/// Movable group with its pose.
#[derive(Clone, Copy)]
pub struct PlacedGroup<'m> {
    /// Group.
    pub group: &'m MovableGroup,
    /// Pose in a frame common to all groups.
    pub pose: Pose,
}

/// Two primitives with coplanar faces of the same orientation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FlushPair {
    /// For each of the two, the group (index into the slice) and the primitive (index into its primitives).
    pub primitives: [(usize, usize); 2],
    /// True if the faces overlap, false if they meet in a seam.
    pub overlap: bool,
}

/// All pairs of primitives of different surfaces that are flush somewhere, in order.
///
/// A single group is compared with itself; several groups are compared only with each other.
pub fn flush_pairs(placed: &[PlacedGroup<'_>]) -> Vec<FlushPair> {
    let mut faces: Vec<Face> =
        placed.iter().enumerate().flat_map(|(index, placed)| faces_of(index, placed)).collect();
    let mut found = BTreeMap::new();
    if faces.windows(2).all(|pair| pair[0].surface == pair[1].surface) {
        return Vec::new();
    }
    faces.sort_by(|a, b| a.least.x.total_cmp(&b.least.x));
    let mut open: Vec<usize> = Vec::new();
    let mut comparisons = 0;
    for (index, face) in faces.iter().enumerate() {
        open.retain(|other| faces[*other].most.x >= face.least.x - face.slack(&faces[*other]));
        for other in open.iter().map(|other| &faces[*other]) {
            comparisons += 1;
            if may_be_told(placed, face, other)
                && let Some(overlap) = face.flush_with(other)
            {
                let mut primitives = [face.primitive, other.primitive];
                primitives.sort_unstable();
                *found.entry(primitives).or_insert(false) |= overlap;
            }
        }
        if comparisons > COMPARISONS_MAX {
            break;
        }
        open.push(index);
    }
    found.into_iter().map(|(primitives, overlap)| FlushPair { primitives, overlap }).collect()
}

fn may_be_told(placed: &[PlacedGroup<'_>], one: &Face, other: &Face) -> bool {
    one.surface != other.surface && (placed.len() == 1 || one.primitive.0 != other.primitive.0)
}

/// Convex polygon, or a whole plane.
struct Face {
    /// Group and shell.
    surface: (usize, u32),
    /// Group and primitive.
    primitive: (usize, usize),
    normal: Vec3,
    /// Corners, counter-clockwise seen from the front; a single point for a plane.
    outline: Vec<Vec3>,
    least: Vec3,
    most: Vec3,
}

impl Face {
    fn new(surface: (usize, u32), primitive: (usize, usize), normal: Vec3, outline: Vec<Vec3>) -> Self {
        let unbounded = Vec3::repeat(f64::INFINITY);
        let (least, most) = match outline.len() {
            1 => (-unbounded, unbounded),
            _ => outline.iter().fold((unbounded, -unbounded), |(least, most), p| (least.inf(p), most.sup(p))),
        };
        Self { surface, primitive, normal, outline, least, most }
    }

    fn is_plane(&self) -> bool {
        self.outline.len() == 1
    }

    /// Distance within which two faces count as touching, m, from the larger face that has a size.
    fn slack(&self, other: &Self) -> f64 {
        let size = |face: &Self| if face.is_plane() { 0.0 } else { (face.most - face.least).norm() };
        IN_PLANE * size(self).max(size(other))
    }

    /// Returns `Some(true)` if two coplanar faces of the same orientation overlap, `Some(false)` if they meet
    /// in a seam, `None` if they do not meet.
    fn flush_with(&self, other: &Self) -> Option<bool> {
        let slack = self.slack(other);
        let apart = |axis: usize| {
            self.least[axis] > other.most[axis] + slack || other.least[axis] > self.most[axis] + slack
        };
        if self.normal.dot(&other.normal) < 0.5 || (0..3).any(apart) {
            return None;
        }
        let in_plane = |plane: &Self, face: &Self| {
            face.outline.iter().all(|p| (p - plane.outline[0]).dot(&plane.normal).abs() <= slack)
        };
        // The point that defines a plane may be far from a face in it, so a face's own points decide.
        let (flush, back) = (in_plane(self, other), in_plane(other, self));
        if !(flush || other.is_plane()) || !(back || self.is_plane()) || !(flush || back) {
            return None;
        }
        let gap = self.gap_to(other).max(other.gap_to(self));
        (gap <= slack).then_some(gap < -slack)
    }

    /// Largest gap between an edge of this outline and another face, in the plane, m; negative if they
    /// overlap.
    fn gap_to(&self, other: &Self) -> f64 {
        if self.is_plane() || other.is_plane() {
            return f64::NEG_INFINITY;
        }
        let ends = self.outline.iter().zip(self.outline.iter().cycle().skip(1));
        let gaps = ends.map(|(start, end)| {
            let outward = (end - start).cross(&self.normal).normalize();
            other.outline.iter().map(|p| (p - start).dot(&outward)).fold(f64::INFINITY, f64::min)
        });
        gaps.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Faces of a group that can push.
fn faces_of(index: usize, placed: &PlacedGroup<'_>) -> Vec<Face> {
    let (group, x_wg) = (placed.group, placed.pose.transform());
    let mut faces = Vec::new();
    for (number, info) in group.primitives.iter().enumerate() {
        let elements = info.elements.start as usize..info.elements.end as usize;
        let mut add = |shell, normal: &Vec3, outline: &[Vec3]| {
            let outline = outline.iter().map(|p| x_wg.point(p)).collect();
            faces.push(Face::new((index, shell), (index, number), x_wg.vector(normal), outline));
        };
        match info.kind {
            PrimitiveKind::Plane => elements.for_each(|element| {
                let plane = &group.planes[element];
                add(info.shell, &plane.normal, &[plane.normal * plane.offset]);
            }),
            PrimitiveKind::Triangle => elements.for_each(|element| {
                let (triangles, element) = (&group.triangles, element as u32);
                let shell = triangles.triangles[element as usize].shell;
                add(shell, &triangles.normal(element), &triangles.corners(element));
            }),
            PrimitiveKind::Polyhedron => elements.for_each(|element| {
                let solid = &group.polyhedra[element];
                for (face, plane) in solid.faces.iter().enumerate().filter(|(_, face)| face.active) {
                    let place = |start: u32| solid.vertices[start as usize].position;
                    let outline: Vec<Vec3> = solid.rim(face).iter().map(|rim| place(rim.start)).collect();
                    add(info.shell, &plane.normal, &outline);
                }
            }),
            _ => {}
        }
    }
    faces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extensions::Extensions;

    fn group(primitives: &str) -> MovableGroup {
        let text = format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e5) }},
             root: (name: \"m\", surface: \"s\", primitives: [{primitives}]))"
        );
        let model = crate::parse(&text, "m.ron", None, &Extensions::new());
        model.unwrap_or_else(|errors| panic!("{errors}")).bodies.swap_remove(0)
    }

    fn block(name: &str, x: [f64; 2], inactive: &str) -> String {
        let vertices: Vec<String> = (0..8)
            .map(|v| format!("({:?}, {:?}, {:?})", x[v & 1], (v >> 1 & 1) as f64, -((v >> 2) as f64)))
            .collect();
        format!(
            "Polyhedron(name: \"{name}\", vertices: [{}], faces: [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [1, 5, 7, 3], \
             [3, 7, 6, 2], [2, 6, 4, 0]], inactive_faces: [{inactive}]),",
            vertices.join(", ")
        )
    }

    /// Pairs of primitives found in one group.
    fn in_one(primitives: &str) -> Vec<([usize; 2], bool)> {
        let group = group(primitives);
        let placed = [PlacedGroup {
            group: &group,
            pose: Pose::new(Vec3::new(3.0, 1e3, -7.0), [0.9, 0.1, -0.3, 0.2]),
        }];
        flush_pairs(&placed)
            .iter()
            .map(|pair| (pair.primitives.map(|(_, primitive)| primitive), pair.overlap))
            .collect()
    }

    const PATCH: &str =
        "TriangleMesh(name: \"patch\", vertices: [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)],
        triangles: [(0, 1, 2), (0, 2, 3)]),";
    const FLOOR: &str = "Plane(name: \"floor\", normal: (0, 0, 1), offset: 0),";

    #[test]
    fn a_patch_on_a_plane_overlaps_it_once() {
        assert_eq!(in_one(&format!("{FLOOR}{PATCH}")), [([0, 1], true)]);
        assert_eq!(
            in_one(&format!("{PATCH}{FLOOR}{}", FLOOR.replace("floor", "again"))),
            [([0, 1], true), ([0, 2], true), ([1, 2], true)]
        );
        // Within a millionth of its size the face coincides; beyond, it is a step.
        let lifted = |height: &str| PATCH.replace(", 0)", &format!(", {height})"));
        let near = |height: &str| in_one(&format!("{FLOOR}{}", lifted(height)));
        assert_eq!((near("1e-7").len(), near("1e-4").len()), (1, 0));
        assert_eq!(
            in_one(&format!(
                "{FLOOR}{}",
                FLOOR.replace("floor", "below").replace("offset: 0", "offset: -0.01")
            )),
            []
        );
    }

    #[test]
    fn blocks_side_by_side_meet_in_a_seam_unless_an_inner_wall_joins_them() {
        let blocks = |inner: [&str; 2], gap: f64| {
            in_one(&(block("a", [0.0, 1.0], inner[0]) + &block("b", [1.0 + gap, 3.0], inner[1])))
        };
        assert_eq!(blocks(["", ""], 0.0), [([0, 1], false)]);
        assert_eq!(blocks(["3", "5"], 0.0), []);
        assert_eq!(blocks(["", ""], 1e-3), []);
        assert_eq!(blocks(["", ""], -0.25), [([0, 1], true)]);
    }

    #[test]
    fn several_groups_are_compared_with_each_other_alone() {
        let (twice, plane) = (group(&format!("{PATCH}{FLOOR}")), group(FLOOR));
        let turned = Pose::new(Vec3::zeros(), [0.0, 1.0, 0.0, 0.0]);
        let pairs = |pose| {
            flush_pairs(&[
                PlacedGroup { group: &twice, pose: Pose::identity() },
                PlacedGroup { group: &plane, pose },
            ])
        };
        let told: Vec<_> = pairs(Pose::identity()).iter().map(|pair| pair.primitives).collect();
        assert_eq!(told, [[(0, 0), (1, 0)], [(0, 1), (1, 0)]]);
        // Faces of opposite orientation push from two sides.
        assert_eq!(pairs(turned), []);
    }
}
