//! Difference between two engines' answers to the same queries of W1.

use crate::pairs::Answer;
use crate::table::Table;
use pong_geometry::Vec3;

/// Largest differences of a peer's answers from ours, over all hulls of a pair.
pub struct Difference {
    pair: String,
    peer: &'static str,
    /// Depth difference, m.
    depth: f64,
    /// Angle between the normals, rad.
    normal: f64,
    /// Number of normals off by more than a milliradian.
    off: usize,
    hits: usize,
}

impl Difference {
    /// Differences of one peer on one pair, at our hits.
    pub fn between(pair: &str, peer: &'static str, ours: &[Answer], theirs: &[Answer]) -> Self {
        let mut worst = Self { pair: pair.to_owned(), peer, depth: 0.0, normal: 0.0, off: 0, hits: 0 };
        for (ours, theirs) in ours.iter().zip(theirs).filter(|(ours, _)| ours.hit()) {
            let [a, b] = [ours, theirs].map(|answer| Vec3::from(answer.normal));
            let angle = a.cross(&b).norm().atan2(a.dot(&b));
            worst.depth = worst.depth.max((ours.depth - theirs.depth).abs());
            worst.normal = worst.normal.max(angle);
            worst.off += usize::from(angle > 1e-3);
            worst.hits += 1;
        }
        worst
    }

    /// Merges it with those of the same pair and peer.
    pub fn join(self, all: &mut Vec<Self>) {
        match all.iter_mut().find(|known| (&known.pair, known.peer) == (&self.pair, self.peer)) {
            Some(known) => {
                known.depth = known.depth.max(self.depth);
                known.normal = known.normal.max(self.normal);
                known.off += self.off;
                known.hits += self.hits;
            }
            None => all.push(self),
        }
    }

    /// Table of all differences.
    pub fn table(all: &[Self]) -> Table {
        let mut table = Table::new(&["pair", "peer", "depth, m", "normal, rad", "normals off by > 1 mrad"]);
        for Self { pair, peer, depth, normal, off, hits } in all {
            let numbers = [format!("{depth:.1e}"), format!("{normal:.1e}"), format!("{off} of {hits}")];
            table.row([pair.clone(), (*peer).to_owned()].into_iter().chain(numbers));
        }
        table
    }
}
