//! Distance of two movable groups: the nearest two primitives that have a contact test with each other
//! (docs/theory.md, 2.10).
//!
//! Every element of A descends the trees of boxes of B, nearer boxes first, and leaves out boxes that are
//! farther away than the nearest pair so far. The search allocates nothing.

use crate::scene::Scene;
use crate::seal::{Plan, Sealed, solids_touch};
use pong_geometry::distance::{Distance, Solid};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Transform, Vec3};
use pong_model::box_tree::{BoxNode, BoxTree, Child, NarrowBox};
use pong_model::{Batch, Item, MovableGroup};

/// Nearest primitives of two movable groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Distance and points in the frame of the second side.
    pub found: Distance,
    /// The two movable groups: A and B of the direction in which the pair was found.
    pub bodies: [usize; 2],
    /// Elements of the two.
    pub items: [Item; 2],
}

/// First primitive of two movable groups that has a contact test with the other group, but no convex solid:
/// the index of its group, and its index in the group.
pub(crate) fn without_solid(scene: &Scene, sealed: &Sealed, group_pair: usize) -> Option<(usize, usize)> {
    for (plan, direction) in sealed.plans_of(group_pair as u32) {
        let bodies: [usize; 2] = sealed.bodies_of(direction).into();
        for batches in tested_batches(plan, bodies.map(|body| scene.body(body))) {
            for (body, batch) in bodies.into_iter().zip(batches) {
                if matches!(batch.kind, PrimitiveKind::Bore | PrimitiveKind::Custom) {
                    let first = scene.body(body).tree.items[batch.items.start as usize];
                    return Some((body, first.primitive as usize));
                }
            }
        }
    }
    None
}

/// Nearest primitives of a pair of movable groups at these poses; `None` if no primitive of one group has a
/// contact test with one of the other.
pub(crate) fn nearest(scene: &Scene, sealed: &Sealed, group_pair: usize, poses: &[Pose]) -> Option<Nearest> {
    let mut best = None;
    for (plan, direction) in sealed.plans_of(group_pair as u32) {
        let (a, b) = sealed.bodies_of(direction);
        let x_ba = Pose::relative(&poses[a], &poses[b]).transform();
        let mut search = Search { bodies: [a, b], groups: [a, b].map(|body| scene.body(body)), best };
        for [batch_a, batch_b] in tested_batches(plan, search.groups) {
            for item_a in
                &search.groups[0].tree.items[batch_a.items.start as usize..batch_a.items.end as usize]
            {
                if let Some(solid) = solid_of(search.groups[0], batch_a.kind, item_a, &x_ba) {
                    search.against(&solid, *item_a, batch_b);
                }
            }
        }
        best = search.best;
    }
    best
}

/// Batches of A and B that are tested against each other.
fn tested_batches<'m>(plan: &Plan, groups: [&'m MovableGroup; 2]) -> impl Iterator<Item = [&'m Batch; 2]> {
    let [of_a, of_b] = groups.map(|group| &group.tree.batches);
    let first = |group: &'m MovableGroup, batch: &Batch| {
        let item = &group.tree.items[batch.items.start as usize];
        (group, &group.primitives[item.primitive as usize])
    };
    of_a.iter().enumerate().flat_map(move |(a, batch_a)| {
        let tested = move |(b, batch_b): &(usize, &Batch)| {
            plan.tests_batches((a, batch_a.kind), (*b, batch_b.kind))
                || !plan.solids.is_empty()
                    && solids_touch(first(groups[0], batch_a), first(groups[1], batch_b))
        };
        of_b.iter().enumerate().filter(tested).map(move |(_, batch_b)| [batch_a, batch_b])
    })
}

/// Element as a convex solid in the frame that `x` leads to; `None` for planes, bores and a host's kinds.
fn solid_of<'m>(
    body: &'m MovableGroup,
    kind: PrimitiveKind,
    item: &Item,
    x: &Transform,
) -> Option<Solid<'m>> {
    let element = item.element as usize;
    Some(match kind {
        PrimitiveKind::Point => Solid::point(&body.points[element].carried(x)),
        PrimitiveKind::LineSegment => Solid::segment(&body.segments[element].carried(x)),
        PrimitiveKind::Ray => Solid::ray(&body.rays[element].carried(x)),
        PrimitiveKind::Sphere => Solid::sphere(&body.spheres[element].carried(x)),
        PrimitiveKind::Ellipsoid => Solid::ellipsoid(&body.ellipsoids[element].carried(x)),
        PrimitiveKind::Triangle => {
            Solid::triangle(body.triangles.corners(item.element).map(|corner| x.point(&corner)))
        }
        PrimitiveKind::Polyhedron => Solid::polyhedron(&body.polyhedra[element], x),
        PrimitiveKind::Capsule => Solid::capsule(&body.capsules[element].carried(x)),
        PrimitiveKind::Cylinder | PrimitiveKind::Cone => Solid::frustum(&body.frusta[element].carried(x)),
        PrimitiveKind::Plane | PrimitiveKind::Bore | PrimitiveKind::Custom => return None,
    })
}

/// Search for the nearest elements of A and B.
struct Search<'m> {
    bodies: [usize; 2],
    groups: [&'m MovableGroup; 2],
    best: Option<Nearest>,
}

impl Search<'_> {
    /// Smallest distance so far, m.
    fn limit(&self) -> f64 {
        self.best.map_or(f64::INFINITY, |best| best.found.distance)
    }

    /// Tests an element of A against the elements of a batch of B that may be nearer than the nearest so far.
    fn against(&mut self, solid: &Solid<'_>, item_a: Item, batch_b: &Batch) {
        /// A tree of 2³¹ elements has eleven levels, each of which leaves at most seven nodes waiting.
        const DEPTH_MAX: usize = 80;
        let tree = &batch_b.boxes;
        let ball = solid.ball();
        let mut stack = [(0.0, 0_u32); DEPTH_MAX];
        stack[0] = (least_distance(tree, &tree.around, &ball), 0);
        let mut waiting = usize::from(!tree.nodes.is_empty());
        while waiting > 0 {
            waiting -= 1;
            let (least, node) = stack[waiting];
            if least >= self.limit() {
                continue;
            }
            let node = &tree.nodes[node as usize];
            let (mut children, count) = farthest_first(tree, node, &ball);
            let children = &mut children[..count];
            // Elements are tested at once, so the nearest comes first. Of nodes the last one pushed is
            // visited first, so the nearest comes last.
            if node.is_bottom() {
                children.reverse();
            }
            for &(least, child) in children.iter() {
                match child {
                    Child::Node(node) => {
                        stack[waiting] = (least, node);
                        waiting += 1;
                    }
                    Child::Element(place) if least < self.limit() => {
                        let item_b = self.groups[1].tree.items[(batch_b.items.start + place) as usize];
                        self.test(solid, [item_a, item_b], batch_b.kind);
                    }
                    Child::Element(_) => {}
                }
            }
        }
    }

    /// Computes the distance of two elements, unless it exceeds the smallest so far.
    fn test(&mut self, solid: &Solid<'_>, items: [Item; 2], kind_b: PrimitiveKind) {
        let limit = self.limit();
        let found = if kind_b == PrimitiveKind::Plane {
            Some(solid.to_plane(&self.groups[1].planes[items[1].element as usize]))
        } else {
            let other = solid_of(self.groups[1], kind_b, &items[1], &Transform::identity());
            other.and_then(|other| solid.to_within(&other, limit))
        };
        if let Some(found) = found.filter(|found| found.distance < limit) {
            self.best = Some(Nearest { found, bodies: self.bodies, items });
        }
    }
}

/// Contents of a node's boxes, the farthest first, each with its least distance from a ball, m; and their
/// number.
fn farthest_first(tree: &BoxTree, node: &BoxNode, ball: &(Vec3, f64)) -> ([(f64, Child); 8], usize) {
    let mut children = [(0.0, Child::Node(0)); 8];
    let mut count = 0;
    for lane in 0..children.len() {
        let narrow = node.boxes.lane(lane);
        if narrow.low[0] <= narrow.high[0] {
            children[count] = (least_distance(tree, &narrow, ball), node.child(lane));
            count += 1;
        }
    }
    children[..count].sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    (children, count)
}

/// Least distance of a ball, given by centre and radius, from what is in a box, m; negative if they may
/// overlap.
fn least_distance(tree: &BoxTree, narrow: &NarrowBox, (center, radius): &(Vec3, f64)) -> f64 {
    let (low, high) = tree.widened(narrow);
    let beyond = |k: usize| (low[k] - center[k]).max(center[k] - high[k]).max(0.0);
    Vec3::new(beyond(0), beyond(1), beyond(2)).norm() - radius
}
