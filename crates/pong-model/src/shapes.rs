//! Faults of single shapes, by face and vertex, for tools in which shapes are made.

use crate::hull;
use crate::model::{MovableGroup, PrimitiveInfo};
use crate::read::{SLIVER, smallest_height_share};
use crate::triangle_topology::{self, MeshWarning};
use crate::weld::Welder;
use pong_geometry::Vec3;
use pong_geometry::primitive::{Lean, MayPush, NO_NEIGHBOR, PrimitiveKind, TriangleRecord};

/// Fault of a polyhedron.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyhedronFault {
    /// Name of the broken rule; stable from version to version.
    pub rule: &'static str,
    /// Cause of the fault.
    pub cause: String,
    /// Cure.
    pub cure: &'static str,
    /// Index of the face, if the fault concerns one.
    pub face: Option<usize>,
    /// Vertices that the fault concerns.
    pub places: Vec<Vec3>,
    /// Distance by which a vertex misses a plane or a line, m; 0 if not applicable.
    pub off: f64,
}

/// Faults of a polyhedron with these vertices and faces: all that the first failing stage of the loader
/// finds. Faces have their fronts outside; `inactive` are indices of faces.
pub fn check_polyhedron(vertices: &[Vec3], faces: &[&[u32]], inactive: &[usize]) -> Vec<PolyhedronFault> {
    let active: Vec<bool> = (0..faces.len()).map(|face| !inactive.contains(&face)).collect();
    let problems = hull::check(vertices, faces, &active).err().unwrap_or_default();
    let told = |hull::Problem { face, rule, cause, cure, places, off }| PolyhedronFault {
        rule,
        cause,
        cure,
        face,
        places,
        off,
    };
    problems.into_iter().map(told).collect()
}

/// Fault or warning about triangles of one movable group.
#[derive(Clone, Debug, PartialEq)]
pub struct TriangleFault {
    /// True if the loader refuses them, false if it warns.
    pub is_error: bool,
    /// Name of the rule.
    pub rule: &'static str,
    /// Cause, for each of the triangles.
    pub cause: &'static str,
    /// Cure.
    pub cure: &'static str,
    /// Indices of the triangles, in increasing order.
    pub triangles: Vec<u32>,
}

/// Faults and warnings of the triangles of a movable group, one entry per rule. Bit-equal corners are one
/// vertex. If there are slivers, only these are reported, because the topology is checked only without
/// slivers.
pub fn check_triangles(corners: &[[Vec3; 3]]) -> Vec<TriangleFault> {
    let thin = |corners: &[Vec3; 3]| {
        let share = smallest_height_share(corners);
        share.is_nan() || share < SLIVER
    };
    let slivers: Vec<u32> =
        corners.iter().zip(0..).filter(|(corners, _)| thin(corners)).map(|(_, index)| index).collect();
    if !slivers.is_empty() {
        return fault(SLIVERS, slivers).into_iter().collect();
    }
    let findings = triangle_topology::build_adjacency(&mut body_of(corners), &[]);
    let repeated = findings.duplicates.iter().map(|&(repeated, _)| repeated).collect();
    let (mut crowded, mut wound, mut cracks) = (Vec::new(), Vec::new(), Vec::new());
    for warning in findings.mesh_warnings {
        match warning {
            MeshWarning::CrowdedEdge { triangles } => crowded.extend(triangles),
            MeshWarning::Winding { triangle, other } => wound.extend([triangle, other]),
            MeshWarning::TJunction { triangle, .. } => cracks.push(triangle),
        }
    }
    let told = [(REPEATED, repeated), (CROWDED, crowded), (WOUND, wound), (CRACKS, cracks)];
    told.into_iter().filter_map(|(rule, triangles)| fault(rule, triangles)).collect()
}

/// Severity (true for an error), name, cause and cure of a rule.
type Rule = (bool, &'static str, &'static str, &'static str);

const SLIVERS: Rule = (
    true,
    "sliver-triangle",
    "a sliver: a triangle lower than 1e-9 of its longest edge",
    "remove it or move a vertex",
);
const REPEATED: Rule =
    (true, "duplicate-triangle", "the triangle is there twice in its body", "remove one of the two");
const CROWDED: Rule = (
    false,
    "crowded-edge",
    "it meets two or more others at one edge, which counts as free",
    "separate the sheets",
);
const WOUND: Rule = (
    false,
    "winding",
    "it is wound against its neighbour, and their common edge counts as free",
    "turn all fronts one way",
);
const CRACKS: Rule = (
    false,
    "t-junction",
    "a vertex of another triangle lies within its edge: a crack could open there",
    "cut it at that vertex",
);

fn fault((is_error, rule, cause, cure): Rule, mut triangles: Vec<u32>) -> Option<TriangleFault> {
    triangles.sort_unstable();
    triangles.dedup();
    (!triangles.is_empty()).then_some(TriangleFault { is_error, rule, cause, cure, triangles })
}

/// Movable group that consists of these triangles only.
fn body_of(corners: &[[Vec3; 3]]) -> MovableGroup {
    let mut body = MovableGroup::default();
    let (mut welder, set) = (Welder::default(), &mut body.triangles);
    for corners in corners {
        let vertices = corners.map(|corner| welder.weld(corner, &mut set.vertices));
        set.triangles.push(TriangleRecord {
            vertices,
            neighbors: [NO_NEIGHBOR; 3],
            shell: 0,
            may_push: MayPush::ALL,
            edge_lean: Lean::ANY,
            vertex_lean: Lean::ANY,
        });
    }
    let count = corners.len() as u32;
    body.surfaces.push(0);
    body.primitives.push(PrimitiveInfo {
        name: String::new(),
        path: String::new(),
        kind: PrimitiveKind::Triangle,
        surface: 0,
        elements: 0..count,
        shell: 0,
        thickness: None,
        first_mirror: count,
    });
    body
}
