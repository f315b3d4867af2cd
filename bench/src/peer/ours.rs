//! Pong beside the other engines, on one pair of primitives.

use super::PairPeer;
use crate::ours::{Elements, Ours};
use crate::pairs::{Answer, Queries};

impl PairPeer for Ours {
    fn pass(&mut self, queries: &Queries, answers: &mut [Answer]) {
        self.test_all(queries, answers);
    }

    fn pass_over_elements(&mut self, elements: &Elements, answers: &mut [Answer]) -> bool {
        self.test_all(elements, answers);
        true
    }
}
