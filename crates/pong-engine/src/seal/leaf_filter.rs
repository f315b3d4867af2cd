//! Filters between groups, in the form that frames read.

use pong_model::{Filters, MovableGroup};
use std::collections::BTreeMap;

/// Filters of the pairs of Objects that have any, keyed by the two Objects in both orders.
#[derive(Default)]
pub(crate) struct ObjectFilters(BTreeMap<(usize, usize), Filters>);

impl ObjectFilters {
    /// Filters of the pairs of Objects, without the empty ones.
    pub fn new(of_pairs: impl IntoIterator<Item = ((usize, usize), Filters)>) -> Self {
        let mut all = BTreeMap::new();
        for ((a, b), filters) in of_pairs.into_iter().filter(|(_, filters)| !filters.is_empty()) {
            all.insert((b, a), filters.turned());
            all.insert((a, b), filters);
        }
        Self(all)
    }

    /// Filters between two Objects, with the first Object's groups first; `None` if there are none.
    #[inline]
    pub fn between(&self, a: usize, b: usize) -> Option<&Filters> {
        // Usual case: no filters at all.
        if self.0.is_empty() { None } else { self.0.get(&(a, b)) }
    }
}

/// Leaves of A's tree that are not tested against leaves of B's tree. Leaves of one *class* lie in the same
/// groups that filters name, so filters treat them alike.
#[derive(Clone, Debug)]
pub(crate) struct LeafFilter {
    /// Classes of the nodes of A's and B's trees; [`MIXED`] above leaves of several classes.
    nodes: [Vec<u16>; 2],
    /// Classes of the batches.
    batches: [Vec<u16>; 2],
    /// True where two classes are kept apart; row-major by class of A, then of B.
    apart: Vec<bool>,
    /// Number of classes of B.
    columns: usize,
}

/// Class value of a node with leaves of several classes below.
const MIXED: u16 = u16::MAX;

impl LeafFilter {
    /// Filter between two movable groups. Each leaf lies entirely inside or outside of every group that a
    /// filter names.
    pub fn new(filters: &Filters, bodies: [&MovableGroup; 2]) -> Self {
        let classes = [0, 1].map(|side| Classes::new(filters, side, bodies[side]));
        let [a, b] = &classes;
        let mut apart = vec![false; a.known.len() * b.known.len()];
        for (of_a, row) in &a.known {
            for (of_b, column) in &b.known {
                let is_common = of_a.iter().any(|entry| of_b.contains(entry));
                apart[*row as usize * b.known.len() + *column as usize] = is_common;
            }
        }
        let columns = b.known.len();
        let batches = [0, 1].map(|side| {
            let nodes = bodies[side].tree.nodes.iter().zip(&classes[side].nodes);
            let mut of_batches = vec![MIXED; bodies[side].tree.batches.len()];
            nodes.for_each(|(node, class)| {
                of_batches[node.batches.start as usize..node.batches.end as usize].fill(*class);
            });
            of_batches
        });
        Self { nodes: classes.map(|classes| classes.nodes), batches, apart, columns }
    }

    /// Returns true if everything of A below one node is kept apart from everything of B below another.
    pub fn keeps_apart(&self, node_a: u32, node_b: u32) -> bool {
        self.of_classes(self.nodes[0][node_a as usize], self.nodes[1][node_b as usize])
    }

    /// Returns true if two batches are kept apart.
    pub fn keeps_batches_apart(&self, batch_a: usize, batch_b: usize) -> bool {
        self.of_classes(self.batches[0][batch_a], self.batches[1][batch_b])
    }

    /// Returns true if everything of A below a node is kept apart from all of B.
    pub fn keeps_from_all(&self, node_a: u32) -> bool {
        let row = usize::from(self.nodes[0][node_a as usize]) * self.columns;
        self.apart.get(row..row + self.columns).is_some_and(|row| !row.contains(&false))
    }

    /// Returns true if all of A is kept apart from all of B.
    pub fn keeps_all_apart(&self) -> bool {
        !self.apart.contains(&false)
    }

    fn of_classes(&self, a: u16, b: u16) -> bool {
        a != MIXED && b != MIXED && self.apart[usize::from(a) * self.columns + usize::from(b)]
    }
}

/// Classes of leaves, by the set of filter entries that contain them.
struct Classes {
    known: BTreeMap<Vec<usize>, u16>,
    nodes: Vec<u16>,
}

impl Classes {
    fn new(filters: &Filters, side: usize, body: &MovableGroup) -> Self {
        let mut classes = Self { known: BTreeMap::new(), nodes: vec![MIXED; body.tree.nodes.len()] };
        classes.visit(filters, side, body, 0);
        classes
    }

    /// Classifies a node and everything below it.
    fn visit(&mut self, filters: &Filters, side: usize, body: &MovableGroup, node: u32) -> u16 {
        let of = &body.tree.nodes[node as usize];
        let class = if of.children.is_empty() {
            let first = body.tree.items[of.items.start as usize..of.items.end as usize].first();
            let path = first.map_or("", |item| &body.primitives[item.primitive as usize].path);
            // Groups are nested or disjoint, so there is at most one class more than filter entries. Their
            // number is limited, so that a class fits into 16 bits.
            let next = self.known.len() as u16;
            *self.known.entry(filters.that_hold(side, path)).or_insert(next)
        } else {
            let mut below = of.children.clone().map(|child| self.visit(filters, side, body, child));
            let first = below.next().unwrap_or(MIXED);
            // `fold` visits all children, where a search would stop early.
            below.fold(first, |class, other| if class == other { class } else { MIXED })
        };
        self.nodes[node as usize] = class;
        class
    }
}
