//! Trees of bounding volumes: lays out the blocks of work, and finds the leaves of B that a leaf of A may touch.

use crate::frame::input::{Block, PairContext, WorkerInput};
use crate::report::FrameCounts;
use crate::scene::Scene;
use crate::sealed::{Direction, Plan, Sealed};
use pong_arena::List;
use pong_geometry::Transform;
use pong_geometry::bounding::Volume;
use pong_model::box_tree::{BoxNode, BoxTree, Child, NarrowBox};
use pong_model::{Batch, MovableGroup, Node};

/// Blocks of one round: when so many are laid out they are worked off before more are.
pub(crate) const ROUND: usize = 4096;

/// What a block may cost before it is cut, ns: long against claiming one, short against a frame.
const BLOCK_NS: u32 = 4000;

/// Lays out all blocks of some pairs, whose motions stand in their order, and calls `work` with them whenever a round is
/// full and at the end. Every call is told what the round may cost, ns.
pub(crate) fn lay_out(
    scene: &Scene,
    sealed: &Sealed,
    pairs: &[u32],
    input: &mut WorkerInput,
    counts: &mut FrameCounts,
    work: &mut dyn FnMut(&mut WorkerInput, u64),
) {
    let mut cost = 0;
    input.blocks.clear();
    for (slot, &group_pair) in pairs.iter().enumerate() {
        for (plan, direction) in sealed.plans_of(group_pair) {
            let (body_a, body_b) = sealed.bodies_of(direction);
            let bodies = (scene.body(body_a), scene.body(body_b));
            let slot = slot as u32;
            let mut layout =
                Layout { sealed, plan, bodies, direction, slot, input, counts, cost: &mut cost, work };
            layout.visit_leaves(0);
        }
    }
    work(input, cost);
    input.blocks.clear();
}

/// Lays out the blocks of one direction of a pair of movable groups.
struct Layout<'a, 'w> {
    sealed: &'a Sealed,
    plan: &'a Plan,
    /// A's and B's.
    bodies: (&'a MovableGroup, &'a MovableGroup),
    direction: Direction,
    slot: u32,
    input: &'a mut WorkerInput,
    counts: &'a mut FrameCounts,
    cost: &'a mut u64,
    work: &'a mut (dyn FnMut(&mut WorkerInput, u64) + 'w),
}

impl Layout<'_, '_> {
    fn x_ba(&self) -> Transform {
        self.input.motions[self.slot as usize][self.direction.flipped as usize].x_ba
    }

    /// Whether a volume of A reaches the root of B's tree.
    fn reaches_b(&mut self, volume: &Volume) -> bool {
        let root = &self.bodies.1.tree.nodes[0].volume;
        let meets = self.sealed.volume_tests.overlap(volume, root, &self.x_ba());
        self.counts.note_volumes(volume, root, meets);
        meets
    }

    fn visit_leaves(&mut self, node: u32) {
        let tree = &self.bodies.0.tree;
        let Node { volume, children, batches, .. } = &tree.nodes[node as usize];
        if !self.reaches_b(volume) {
            return;
        }
        for child in children.clone() {
            self.visit_leaves(child);
        }
        for batch in batches.clone() {
            let Some(element_ns) = self.plan.element_ns(tree.batches[batch as usize].kind) else { continue };
            let boxes = &tree.batches[batch as usize].boxes;
            let at_most = (BLOCK_NS / element_ns).next_multiple_of(8);
            let block =
                Block { direction: self.direction, slot: self.slot, leaf: node, batch, first: 0, end: 0 };
            self.cut(boxes, 0, at_most, element_ns, block);
        }
    }

    /// Cuts the elements below a node of boxes into blocks; a node too large for one is first asked whether it
    /// reaches B at all.
    fn cut(&mut self, boxes: &BoxTree, node: u32, at_most: u32, element_ns: u32, block: Block) {
        let node: &BoxNode = &boxes.nodes[node as usize];
        let elements = node.elements.clone();
        if elements.end - elements.start <= at_most || node.is_bottom() {
            let cost = u64::from(elements.end - elements.start) * u64::from(element_ns);
            return self.add(Block { first: elements.start, end: elements.end, ..block }, cost);
        }
        for (lane, child) in node.children().enumerate() {
            let Child::Node(child) = child else { continue };
            let below = &boxes.nodes[child as usize].elements;
            let small = below.end - below.start <= at_most;
            if small || self.reaches_b(&as_volume(boxes, &node.boxes.lane(lane))) {
                self.cut(boxes, child, at_most, element_ns, block);
            }
        }
    }

    fn add(&mut self, block: Block, cost: u64) {
        self.input.blocks.push(block);
        *self.cost += cost;
        if self.input.blocks.len() == ROUND {
            (self.work)(self.input, *self.cost);
            self.input.blocks.clear();
            *self.cost = 0;
        }
    }
}

fn as_volume(boxes: &BoxTree, narrow: &NarrowBox) -> Volume {
    let (low, high) = boxes.widened(narrow);
    let (center, half) = (0.5 * (low + high), 0.5 * (high - low));
    if half.iter().all(|x| x.is_finite()) { Volume::Aabb { center, half } } else { Volume::Unbounded }
}

/// The batches of B in leaves whose volumes a leaf of A overlaps and that a kind of A may touch.
pub(crate) fn batches_of_b<'a>(
    (context, plan): (&PairContext<'a>, &Plan),
    block: &Block,
    out: &mut List<'_, &'a Batch>,
    stack: &mut List<'_, u32>,
    counts: &mut FrameCounts,
) {
    let (tree_a, tree_b) = (&context.body_a.tree, &context.body_b.tree);
    let volume = &tree_a.nodes[block.leaf as usize].volume;
    let kind_a = tree_a.batches[block.batch as usize].kind;
    let room = "room for every node of B";
    // The layout has asked about the root.
    stack.push(0).expect(room);
    let mut next = 0;
    while next < stack.len() {
        let node = &tree_b.nodes[stack[next] as usize];
        next += 1;
        counts.leaf_pairs += u64::from(block.first == 0 && node.children.is_empty());
        for batch in node.batches.clone() {
            let batch = &tree_b.batches[batch as usize];
            if plan.tests(kind_a, batch.kind) {
                out.push(batch).expect(room);
            }
        }
        for child in node.children.clone() {
            let below = &tree_b.nodes[child as usize].volume;
            let meets = context.volume_tests.overlap(volume, below, &context.motion.x_ba);
            counts.note_volumes(volume, below, meets);
            if meets {
                stack.push(child).expect(room);
            }
        }
    }
}
