//! Trees of bounding volumes against each other: streams the pairs of leaves that may touch.

use super::Frame;
use super::buffers::FrameContact;
use super::relative::Motion;
use crate::contact::FrameReport;
use crate::scene::Scene;
use crate::sealed::Sealed;
use pong_geometry::bounding::VolumeTests;
use pong_model::{Body, Item, Tree};

/// One pair of movable groups as the testers see it.
pub(super) struct PairContext<'a> {
    pub scene: &'a Scene,
    pub group_pair: u32,
    /// First and second body.
    pub bodies: [&'a Body; 2],
    /// Motion of the first against the second, and of the second against the first.
    pub motions: &'a [Motion; 2],
    pub volume_tests: &'a VolumeTests,
    /// Whether the first body's Object was named first in the pair.
    pub first_named_first: bool,
    /// Whether each body's model remembers the side of entry.
    pub entry_memory: [bool; 2],
}

/// What a pair of leaves holds.
pub(super) type LeafItems<'a> = [&'a [Item]; 2];

/// Where testers put what they find.
pub(super) struct Found<'a> {
    pub contacts: &'a mut Vec<FrameContact>,
    pub report: &'a mut FrameReport,
}

/// Calls `test` with every pair of leaves whose volumes overlap.
pub(super) fn stream_leaf_pairs(
    scene: &Scene,
    sealed: &Sealed,
    frame: &mut Frame,
    mut test: impl FnMut(&PairContext<'_>, LeafItems<'_>, &mut Found<'_>),
) {
    let Frame { motions, stack, contacts, report, .. } = frame;
    for (index, pair) in sealed.group_pairs.iter().enumerate() {
        if !scene.pairs[pair.pair].enabled {
            continue;
        }
        let context = PairContext {
            scene,
            group_pair: index as u32,
            bodies: [scene.body(pair.first), scene.body(pair.second)],
            motions: &motions[index],
            volume_tests: &sealed.volume_tests,
            first_named_first: pair.first_named_first,
            entry_memory: [pair.first, pair.second].map(|body| scene.model_of_body(body).entry_memory),
        };
        let mut found = Found { contacts: &mut *contacts, report: &mut *report };
        walk(&context, stack, &mut found, &mut test);
    }
}

fn walk(
    context: &PairContext<'_>,
    stack: &mut Vec<(u32, u32)>,
    found: &mut Found<'_>,
    test: &mut impl FnMut(&PairContext<'_>, LeafItems<'_>, &mut Found<'_>),
) {
    let [first, second] = context.bodies.map(|body| &body.tree);
    let x_second_first = &context.motions[0].x_ba;
    stack.clear();
    if !first.nodes.is_empty() && !second.nodes.is_empty() {
        stack.push((0, 0));
    }
    while let Some((a, b)) = stack.pop() {
        let (node_a, node_b) = (&first.nodes[a as usize], &second.nodes[b as usize]);
        found.report.volumes_tested += 1;
        if !context.volume_tests.overlap(&node_a.volume, &node_b.volume, x_second_first) {
            continue;
        }
        match (node_a.children.is_empty(), node_b.children.is_empty()) {
            (true, true) => {
                found.report.leaf_pairs += 1;
                test(context, [items(first, a), items(second, b)], found);
            }
            (false, true) => stack.extend(node_a.children.clone().map(|child| (child, b))),
            (true, false) => stack.extend(node_b.children.clone().map(|child| (a, child))),
            // The tree with more below it is opened first; which one decides nothing but the cost.
            (false, false) if first.nodes.len() - a as usize >= second.nodes.len() - b as usize => {
                stack.extend(node_a.children.clone().map(|child| (child, b)));
            }
            (false, false) => stack.extend(node_b.children.clone().map(|child| (a, child))),
        }
    }
}

fn items(tree: &Tree, node: u32) -> &[Item] {
    let range = &tree.nodes[node as usize].items;
    &tree.items[range.start as usize..range.end as usize]
}
