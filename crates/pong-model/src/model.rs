//! Flat, immutable model as the engine reads it.

use crate::box_tree::{BoxNode, BoxTree};
use crate::solid::Solid;
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

/// Validated model.
#[derive(Clone, Debug)]
pub struct Model {
    /// Name as given in the file.
    pub name: String,
    /// Hash of everything that affects results (FNV-1a over a canonical byte form); equal files give equal
    /// hashes on every machine.
    pub hash: u64,
    /// True if points remember the side of entry (docs/theory.md, 2.4).
    pub entry_memory: bool,
    /// All surfaces.
    pub surfaces: Vec<Surface>,
    /// Values for pairs of surfaces.
    pub pair_overrides: Vec<PairOverride>,
    /// Paths of all groups as authored, the root's first.
    pub groups: Vec<String>,
    /// Pairs of groups of one Object that never touch each other, by full path.
    pub filters: Vec<[String; 2]>,
    /// Movable groups; 0 is the root.
    pub bodies: Vec<MovableGroup>,
    /// Warnings for the author of a valid model.
    pub warnings: Vec<String>,
}

/// Movable group with everything below it down to the next movable groups: one rigid body.
#[derive(Clone, Debug, Default)]
pub struct MovableGroup {
    /// Name of the movable group.
    pub name: String,
    /// Path in the tree, `root/arm/latch`.
    pub path: String,
    /// Next movable group above (index into [`Model::bodies`]); `None` for the root.
    pub parent: Option<u32>,
    /// Authored pose in the frame of the root group, with which a host may start the movable group.
    pub initial_pose: Option<Pose>,
    /// All primitives in file order; a mesh is one primitive.
    pub primitives: Vec<PrimitiveInfo>,
    /// Index into [`Model::surfaces`] of every primitive: a compact copy, because a frame rarely needs more.
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
    /// Number of shells: connected surfaces of triangles, or of polyhedra joined by internal faces, or what a group
    /// declares one surface; every other primitive is a shell of its own.
    pub shell_count: u32,
    /// Shells of polyhedra, triangles and planes that a group declares one surface (`one_surface: true`), in
    /// increasing order. Only these shells may have primitives of several kinds.
    pub joint_shells: Vec<u32>,
    /// Convex solids that several polyhedra of one shell form together, by shell.
    pub wholes: Vec<Whole>,
    /// Parts that touch by overlapped volume.
    pub solids: Vec<Solid>,
    /// Tree of bounding volumes.
    pub tree: Tree,
}

impl MovableGroup {
    /// Returns `true` if a primitive of this group belongs to a solid.
    pub fn is_solid(&self, info: &PrimitiveInfo) -> bool {
        let shell = match info.kind {
            PrimitiveKind::Triangle => self.triangles.triangles[info.elements.start as usize].shell,
            _ => info.shell,
        };
        self.solids.iter().any(|solid| solid.shell == shell)
    }

    /// Returns `true` if a group declares this shell one surface.
    #[inline]
    pub fn is_joint(&self, shell: u32) -> bool {
        self.joint_shells.binary_search(&shell).is_ok()
    }

    /// Returns the convex solid to which a polyhedron belongs, with the item that stands for it: the polyhedron itself
    /// if none of its faces is internal, or all pieces of its shell together with the first of them. `None` if their
    /// union is not convex, or if a group declares the shell one surface.
    #[inline]
    pub fn convex_solid(&self, item: Item) -> Option<(Item, &Polyhedron)> {
        let polyhedron = &self.polyhedra[item.element as usize];
        let shell = self.primitives[item.primitive as usize].shell;
        if polyhedron.planes().all_active {
            return (!self.is_joint(shell)).then_some((item, polyhedron));
        }
        let at = self.wholes.binary_search_by_key(&shell, |whole| whole.shell).ok()?;
        let Whole { primitive, solid, .. } = &self.wholes[at];
        let element = self.primitives[*primitive as usize].elements.start;
        Some((Item { primitive: *primitive, element }, solid))
    }

    /// Returns `true` if a place is in a polyhedron of the shell other than number `piece`, or below a plane of the
    /// shell.
    pub fn is_in_another(&self, shell: u32, piece: u32, place: &Vec3) -> bool {
        let mut others = self.primitives.iter().filter(|info| info.shell == shell);
        others.any(|info| {
            let element = info.elements.start;
            match info.kind {
                PrimitiveKind::Polyhedron => {
                    let faces = &self.polyhedra[element as usize].faces;
                    element != piece && faces.iter().all(|face| face.height(place) <= 0.0)
                }
                PrimitiveKind::Plane => self.planes[element as usize].height(place) <= 0.0,
                _ => false,
            }
        })
    }
}

/// Convex solid that the pieces of a shell form together.
#[derive(Clone, Debug)]
pub struct Whole {
    /// Shell.
    pub shell: u32,
    /// First of its pieces (index into [`MovableGroup::primitives`]).
    pub primitive: u32,
    /// The solid. Its faces, edges and vertices have numbers of their own; none of its faces is internal.
    pub solid: Polyhedron,
}

/// Properties of a primitive other than its shape.
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
    /// Elements in the array of its kind: one, or the triangles of a mesh (mirror images included).
    pub elements: Range<u32>,
    /// Shell; for triangles see [`pong_geometry::primitive::TriangleRecord::shell`] instead.
    pub shell: u32,
    /// Thickness of triangles: distance behind the front up to which a centre is still pushed, m. `None`
    /// takes the radius of the sphere or capsule, or the smallest semi-axis of the ellipsoid, that touches.
    pub thickness: Option<f64>,
    /// First mirror image of a two-sided mesh of triangles; the elements from here on are mirror images.
    /// Equals `elements.end` for a one-sided mesh.
    pub first_mirror: u32,
}

/// Tree of the authored groups with their bounding volumes, in one array. A node may have any number of
/// children.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// Nodes; node 0 is the root, and the children of a node are contiguous.
    pub nodes: Vec<Node>,
    /// Contents of the leaves, leaf after leaf, batch after batch.
    pub items: Vec<Item>,
    /// Elements of each leaf by kind.
    pub batches: Vec<Batch>,
}

/// Node with either children or items.
#[derive(Clone, Debug)]
pub struct Node {
    /// Bound of everything below, in the group frame.
    pub volume: Volume,
    /// Children (indices into [`Tree::nodes`]).
    pub children: Range<u32>,
    /// Contents of a leaf (indices into [`Tree::items`]).
    pub items: Range<u32>,
    /// Contents of a leaf by kind (indices into [`Tree::batches`]).
    pub batches: Range<u32>,
    /// Path of the authored group.
    pub group: Arc<str>,
}

/// Elements of one kind in one leaf, tested eight at a time and found through a tree of boxes.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Kind of the elements.
    pub kind: PrimitiveKind,
    /// Elements in the order of the box tree (indices into [`Tree::items`]).
    pub items: Range<u32>,
    /// Boxes around the elements. Element *i* of the tree is item `items.start + i`.
    pub boxes: BoxTree,
    /// Boxes around eight elements each, eight boxes per entry. Empty if the elements are unbounded, or if
    /// they are triangles, polyhedra or planes, which are B in all of the engine's tests.
    pub chunks: Vec<ChunkBoxes>,
    /// Centres and radii of points and spheres in lanes; entry *i* has the elements 8·i … 8·i + 7. Empty for
    /// other kinds.
    pub spheres: Vec<SphereLanes>,
    /// Axes and radii of line segments and capsules in lanes, in the same order.
    pub segments: Vec<SegmentLanes>,
}

/// Eight boxes, each around eight elements of a batch: entry *i* has the box of the elements 64·i … 64·i + 7
/// in lane 0. Unused lanes repeat the last box.
#[derive(Clone, Debug)]
pub struct ChunkBoxes {
    /// Centres in the group frame, m.
    pub center: Lanes,
    /// Half extents along the axes of the group frame, m.
    pub half: Lanes,
}

impl ChunkBoxes {
    /// Boxes around the elements of each bottom node of a tree; an empty list if a node is unbounded.
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
pub struct SphereLanes {
    /// Centres in the group frame, m.
    pub centers: Lanes,
    /// Radii, m; zero for points.
    pub radii: [f64; LANES],
}

impl SphereLanes {
    /// Packs points or spheres eight by eight; returns an empty list for other kinds.
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
        by_lane(items, none, ball, |spheres, lane, (center, radius)| {
            spheres.centers.set(lane, &center);
            spheres.radii[lane] = radius;
        })
    }
}

/// Up to eight line segments or capsules. Unused lanes repeat the last element.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct SegmentLanes {
    /// First and second ends of their axes in the group frame, m.
    pub ends: [Lanes; 2],
    /// Radii, m; zero for line segments.
    pub radii: [f64; LANES],
}

impl SegmentLanes {
    /// Packs line segments or capsules eight by eight; returns an empty list for other kinds.
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
        by_lane(items, none, rod, |segments, lane, (ends, radius)| {
            segments.ends.iter_mut().zip(ends).for_each(|(lanes, end)| lanes.set(lane, end));
            segments.radii[lane] = radius;
        })
    }
}

/// Packs elements eight by eight: `element` reads each one and `set` stores it in a lane; unused lanes repeat
/// the last one. Empty if `element` returns `None`.
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

/// Element of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Item {
    /// Index into [`MovableGroup::primitives`].
    pub primitive: u32,
    /// Index into the array of the primitive's kind.
    pub element: u32,
}
