//! Wrench of one pair alone, summed from the contacts of the last frame on request.

use super::FrameResults;
use super::reduce::Sums;
use crate::frame::forces::contact_ref::ContactRef;
use pong_geometry::{Pose, Wrench};

impl FrameResults<'_> {
    /// Wrench on `on`, one of the two movable groups of a pair, from the contacts of this pair: about the
    /// origin and along the axes of `on`. Summed as in [`reduce`](super::reduce).
    pub fn wrench_of_groups(&self, group_pair: usize, on: usize) -> Wrench {
        let of = |reference: &ContactRef| reference.direction().group_pair as usize;
        let start = self.contacts.order.partition_point(|reference| of(reference) < group_pair);
        let len = self.contacts.order[start..].partition_point(|reference| of(reference) == group_pair);
        self.wrench_of_refs(&self.contacts.order[start..start + len], on)
    }

    /// As [`wrench_of_groups`](Self::wrench_of_groups), from all contact references of the pair.
    fn wrench_of_refs(&self, refs: &[ContactRef], on: usize) -> Wrench {
        let mut wrench = Wrench::zero();
        for refs in refs.chunk_by(|a, b| a.direction() == b.direction()) {
            let (body_a, body_b) = self.sealed.bodies_of(refs[0].direction());
            let x_ba = Pose::relative(&self.poses[body_a], &self.poses[body_b]).transform();
            let sums = Sums::of_direction(&self.contacts.found, refs, &x_ba.translation);
            wrench += if body_a == on { sums.on_a(&x_ba) } else { sums.on_b() };
        }
        wrench
    }

    /// Wrench of a pair of Objects on the one that was named first, about the origin and along the axes of
    /// the movable group `about`.
    pub fn wrench_of_objects(&self, pair: usize, about: usize) -> Wrench {
        let mut wrench = Wrench::zero();
        for refs in self.contacts.order.chunk_by(|a, b| a.direction().group_pair == b.direction().group_pair)
        {
            let groups = &self.sealed.group_pairs[refs[0].direction().group_pair as usize];
            if groups.pair == pair {
                let [on, _] = groups.sides();
                wrench += self.seen_from(self.wrench_of_refs(refs, on), on, about);
            }
        }
        wrench
    }

    /// Calls `visit` for every pair of movable groups with a contact that pushes, with the index of the pair,
    /// the sum of the normal forces of its contacts, N, and the wrench on its first
    /// [side](crate::seal::GroupPair::sides): about the origin of that side, along common axes.
    pub fn for_each_touching(&self, mut visit: impl FnMut(u32, f64, Wrench)) {
        for refs in self.contacts.order.chunk_by(|a, b| a.direction().group_pair == b.direction().group_pair)
        {
            let pushing = refs.iter().filter(|reference| reference.pushes());
            if pushing.clone().next().is_none() {
                continue;
            }
            let group_pair = refs[0].direction().group_pair;
            let normal_force =
                pushing.map(|reference| self.contacts.found.contact(reference).normal_force).sum();
            let [on, _] = self.sealed.group_pairs[group_pair as usize].sides();
            let wrench = self.wrench_of_refs(refs, on);
            visit(group_pair, normal_force, self.along_common_axes(&wrench, on));
        }
    }

    /// Wrench on `group`, moved to the origin and axes of the movable group `about`.
    fn seen_from(&self, wrench: Wrench, group: usize, about: usize) -> Wrench {
        // For the same group the wrench stays as it is, without further rounding.
        if group == about {
            return wrench;
        }
        let pose = Pose::relative(&self.poses[group], &self.poses[about]);
        let force = pose.orientation * wrench.force;
        Wrench { force, moment: pose.orientation * wrench.moment + pose.position.cross(&force) }
    }
}
