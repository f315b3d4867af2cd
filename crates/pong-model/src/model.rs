//! The flat, immutable form of a model that the engine reads.

use crate::box_tree::{BoxNode, BoxTree};
use crate::surface::{PairOverride, Surface};
use pong_geometry::bounding::Volume;
use pong_geometry::lanes::Lanes;
use pong_geometry::primitive::{
    Bore, Capsule, CustomPrimitive, Ellipsoid, Frustum, LineSegment, Plane, Point, Polyhedron, PrimitiveKind,
    Ray, Sphere, TriangleSet,
};
use pong_geometry::simd::LANES;
use pong_geometry::{Pose, Vec3};
use std::ops::Range;
use std::sync::Arc;

/// A validated model.
#[derive(Clone, Debug)]
pub struct Model {
    /// Name as given in the file.
    pub name: String,
    /// Hash of everything that decides the numbers (FNV-1a over a canonical byte form); equal files give equal
    /// hashes on every machine.
    pub hash: u64,
    /// Whether points remember the side of entry (docs/theory.md, 2.4).
    pub entry_memory: bool,
    /// All surfaces.
    pub surfaces: Vec<Surface>,
    /// Table of values for pairs of surfaces.
    pub pair_overrides: Vec<PairOverride>,
    /// Paths of all groups as authored, the root's first.
    pub groups: Vec<String>,
    /// Pairs of groups of one Object that never touch each other, by their full paths.
    pub filters: Vec<[String; 2]>,
    /// The movable groups; 0 is the root.
    pub bodies: Vec<MovableGroup>,
    /// What the author should know though the model is valid.
    pub warnings: Vec<String>,
}

/// A movable group with everything that hangs below it down to the next movable groups: one rigid body.
#[derive(Clone, Debug, Default)]
pub struct MovableGroup {
    /// Name of the movable group.
    pub name: String,
    /// Path in the tree, `root/arm/latch`.
    pub path: String,
    /// The next movable group above (index into [`Model::bodies`]); `None` for the root.
    pub parent: Option<u32>,
    /// Pose in the frame of the root group, as authored: where a host may start it.
    pub initial_pose: Option<Pose>,
    /// Every primitive in file order; a mesh is one primitive.
    pub primitives: Vec<PrimitiveInfo>,
    /// The surface of every primitive once more, closely packed: a frame asks for little else of most.
    pub surfaces: Vec<u32>,
    /// All points.
    pub points: Vec<Point>,
    /// All line segments.
    pub segments: Vec<LineSegment>,
    /// All rays.
    pub rays: Vec<Ray>,
    /// All spheres.
    pub spheres: Vec<Sphere>,
    /// All ellipsoids.
    pub ellipsoids: Vec<Ellipsoid>,
    /// All triangles.
    pub triangles: TriangleSet,
    /// All polyhedra.
    pub polyhedra: Vec<Polyhedron>,
    /// All planes.
    pub planes: Vec<Plane>,
    /// All capsules.
    pub capsules: Vec<Capsule>,
    /// All cylinders and cones.
    pub frusta: Vec<Frustum>,
    /// All bores.
    pub bores: Vec<Bore>,
    /// All custom primitives.
    pub customs: Vec<Arc<dyn CustomPrimitive>>,
    /// Number of shells: connected surfaces of triangles or of polyhedra joined by inner walls (section 2.1);
    /// every other primitive is a shell of its own.
    pub shell_count: u32,
    /// The tree of bounding volumes.
    pub tree: Tree,
}

/// What is known of a primitive besides its shape.
#[derive(Clone, Debug, PartialEq)]
pub struct PrimitiveInfo {
    /// Name as authored.
    pub name: String,
    /// Path in the tree, `root/arm/tip`.
    pub path: String,
    /// Kind.
    pub kind: PrimitiveKind,
    /// Index into [`Model::surfaces`].
    pub surface: u32,
    /// Its elements in the array of its kind: one, or the triangles of a mesh (mirror images included).
    pub elements: Range<u32>,
    /// Its shell; for triangles see [`pong_geometry::primitive::TriangleRecord::shell`] instead.
    pub shell: u32,
    /// Triangles: how far behind the front a centre is still pushed, m; `None` takes the smallest semi-axis of
    /// the body that touches.
    pub thickness: Option<f64>,
    /// Triangles: the elements from this one on are mirror images that make the mesh two-sided; equals
    /// `elements.end` if it is one-sided.
    pub first_mirror: u32,
}

/// A tree of bounding volumes of any arity in one array: the authored groups.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// Node 0 is the root; the children of a node are contiguous.
    pub nodes: Vec<Node>,
    /// Contents of the leaves, leaf after leaf, batch after batch.
    pub items: Vec<Item>,
    /// The elements of each leaf by kind.
    pub batches: Vec<Batch>,
}

/// A node: either children or items, never both.
#[derive(Clone, Debug)]
pub struct Node {
    /// Bounds everything below, in the movable group's frame.
    pub volume: Volume,
    /// Children (indices into [`Tree::nodes`]).
    pub children: Range<u32>,
    /// Contents of a leaf (indices into [`Tree::items`]).
    pub items: Range<u32>,
    /// The same contents by kind (indices into [`Tree::batches`]).
    pub batches: Range<u32>,
    /// Path of the authored group.
    pub group: Arc<str>,
}

/// The elements of one kind in one leaf, as they are tested: eight at a time, found through a tree of boxes.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Their kind.
    pub kind: PrimitiveKind,
    /// Which they are, in the order of the tree of boxes (indices into [`Tree::items`]).
    pub items: Range<u32>,
    /// Boxes around them. Its element *i* is item `items.start + i`.
    pub boxes: BoxTree,
    /// Boxes around eight elements each, eight boxes at a time; empty if the elements are unbounded, or of a kind
    /// that is B in all of the engine's own tests.
    pub chunks: Vec<ChunkBoxes>,
    /// For points and spheres, by lane; those of the elements 8·i … 8·i + 7 at place *i*. Empty for other kinds.
    pub balls: Vec<Balls>,
    /// The same for line segments and capsules.
    pub rods: Vec<Rods>,
}

/// Boxes around eight times eight elements of a batch: around its elements 64·i … 64·i + 7 in lane 0 at place *i*.
/// Unused lanes repeat the last box.
#[derive(Clone, Debug)]
pub struct ChunkBoxes {
    /// Centres in the movable group's frame, m.
    pub center: Lanes,
    /// Half extents along its axes, m.
    pub half: Lanes,
}

impl ChunkBoxes {
    /// The boxes around the elements of every bottom node of a tree.
    pub(crate) fn of(boxes: &BoxTree) -> Vec<Self> {
        let around = |node: &BoxNode| boxes.widened(&node.boxes.around());
        let mut bottoms: Vec<_> = boxes.nodes.iter().filter(|node| node.is_bottom()).collect();
        bottoms.sort_unstable_by_key(|node| node.elements.start);
        let is_bounded = |(low, high): &(Vec3, Vec3)| low.iter().chain(high.iter()).all(|x| x.is_finite());
        if !bottoms.iter().all(|node| is_bounded(&around(node))) {
            return Vec::new();
        }
        let eight = |nodes: &[&BoxNode]| {
            let mut made = Self { center: Lanes::ORIGIN, half: Lanes::ORIGIN };
            for lane in 0..LANES {
                let (low, high) = around(nodes[lane.min(nodes.len() - 1)]);
                made.center.set(lane, &(0.5 * (low + high)));
                made.half.set(lane, &(0.5 * (high - low)));
            }
            made
        };
        bottoms.chunks(LANES).map(eight).collect()
    }
}

/// Up to eight points or spheres. Unused lanes repeat the last element.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Balls {
    /// Centres in the movable group's frame, m.
    pub centers: Lanes,
    /// Radii, m; zero for points.
    pub radii: [f64; LANES],
}

impl Balls {
    /// Some elements, eight by eight; none of kinds that are no balls.
    pub(crate) fn of(body: &MovableGroup, kind: PrimitiveKind, items: &[Item]) -> Vec<Self> {
        let ball = |item: &Item| match kind {
            PrimitiveKind::Point => Some((body.points[item.element as usize].position, 0.0)),
            PrimitiveKind::Sphere => {
                let sphere = &body.spheres[item.element as usize];
                Some((sphere.center, sphere.radius))
            }
            _ => None,
        };
        let none = Self { centers: Lanes::ORIGIN, radii: [0.0; LANES] };
        by_lane(items, none, ball, |balls, lane, (center, radius)| {
            balls.centers.set(lane, &center);
            balls.radii[lane] = radius;
        })
    }
}

/// Up to eight line segments or capsules. Unused lanes repeat the last element.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Rods {
    /// First and second ends of their axes in the movable group's frame, m.
    pub ends: [Lanes; 2],
    /// Radii, m; zero for line segments.
    pub radii: [f64; LANES],
}

impl Rods {
    /// Some elements, eight by eight; none of kinds that are no rods.
    pub(crate) fn of(body: &MovableGroup, kind: PrimitiveKind, items: &[Item]) -> Vec<Self> {
        let rod = |item: &Item| match kind {
            PrimitiveKind::LineSegment => Some((&body.segments[item.element as usize].ends, 0.0)),
            PrimitiveKind::Capsule => {
                let capsule = &body.capsules[item.element as usize];
                Some((&capsule.ends, capsule.radius))
            }
            _ => None,
        };
        let none = Self { ends: [Lanes::ORIGIN; 2], radii: [0.0; LANES] };
        by_lane(items, none, rod, |rods, lane, (ends, radius)| {
            rods.ends.iter_mut().zip(ends).for_each(|(lanes, end)| lanes.set(lane, end));
            rods.radii[lane] = radius;
        })
    }
}

/// Elements, eight by eight: what `element` reads of each stands where `set` puts it, unused lanes repeat the last one. None
/// of what `element` does not know.
fn by_lane<L: Copy, E>(
    items: &[Item],
    none: L,
    element: impl Fn(&Item) -> Option<E>,
    set: impl Fn(&mut L, usize, E),
) -> Vec<L> {
    let eight = |chunk: &[Item]| {
        let mut lanes = none;
        for lane in 0..LANES {
            set(&mut lanes, lane, element(&chunk[lane.min(chunk.len() - 1)])?);
        }
        Some(lanes)
    };
    items.chunks(LANES).map_while(eight).collect()
}

/// One element of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Item {
    /// Index into [`MovableGroup::primitives`].
    pub primitive: u32,
    /// Index into the array of the primitive's kind.
    pub element: u32,
}
