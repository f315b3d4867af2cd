//! Tests of the motion of contacts of bars: the derivatives beside central differences of the tester.

use super::two_capsules::MovesAtEnd;
use pong_geometry::interference::two_capsules::EndContact;
use pong_geometry::primitive::Capsule;
use pong_geometry::{Quat, Transform, Vec3};

const STEP: f64 = 1e-5;

/// A contact two steps and one step before a pose, and one step and two after it, along one of the six directions.
pub(super) struct Sides([EndContact; 4]);

impl Sides {
    /// `None` if one of them is missing. `found` returns the contact after a bar has been moved by so much.
    pub fn new(found: impl Fn(f64) -> Option<EndContact>) -> Option<Self> {
        let [low, less, more, high] = [-2.0, -1.0, 1.0, 2.0].map(|side| found(side * STEP));
        Some(Self([low?, less?, more?, high?]))
    }

    pub fn all(&self) -> &[EndContact; 4] {
        &self.0
    }

    fn slope(&self, of: impl Fn(&EndContact) -> f64) -> f64 {
        let [low, less, more, high] = &self.0;
        (8.0 * (of(more) - of(less)) - (of(high) - of(low))) / (12.0 * STEP)
    }

    /// True if a number changes by another amount on one side of `here` than on the other.
    pub fn bends(&self, change: impl Fn(&EndContact) -> f64) -> bool {
        let [low, _, _, high] = &self.0;
        let [up, down] = [high, low].map(change);
        (up - down).abs() > 0.1 * (up + down)
    }

    /// Panics unless depth, weight, normal and place have the known derivatives in direction `k`.
    pub fn agree(&self, known: &MovesAtEnd, k: usize, told: &str) {
        let vector = |of: &dyn Fn(&EndContact) -> Vec3| {
            Vec3::from([0, 1, 2].map(|axis: usize| self.slope(|contact| of(contact)[axis])))
        };
        let normal = vector(&|contact| contact.interference.normal_b);
        let place = vector(&|contact| contact.interference.deepest_b);
        let off = [
            known.moves.depth[k] - self.slope(|contact| contact.interference.depth),
            known.weight[k] - self.slope(|contact| contact.share),
            (known.moves.normal.column(k) - normal).norm(),
            (known.moves.deepest.column(k) - place).norm(),
        ];
        let limit = 1e-4 * (1.0 + known.weight.amax() + known.moves.deepest.amax());
        assert!(off.iter().all(|off| off.abs() < limit), "{told}, {k}: {off:?}");
    }
}

/// Bar moved along axis `k`, m, or for `k` from 3 on turned about axis `k` − 3, rad.
pub(super) fn moved(a: &Capsule, k: usize, by: f64) -> Capsule {
    let t = Vec3::ith(k % 3, by);
    let (shift, turn) =
        if k < 3 { (t, Quat::identity()) } else { (Vec3::zeros(), Quat::from_scaled_axis(t)) };
    a.carried(&Transform { rotation: turn.to_rotation_matrix().into_inner(), translation: shift })
}
