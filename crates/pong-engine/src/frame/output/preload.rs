//! Friction present before the first frame: bristles are set to the state that a steady motion or a constant
//! load would have produced (theory manual, section 4).
//!
//! ```text
//! sliding:   p = (μ_k·F_n/K)·v_t/|v_t|, slipping
//! holding F: p = −F_t/ΣK, limited to μ_s·F_n/K, sticking; F on A, F_t its part in the contact plane
//! ```
//!
//! A load that displaces two bodies against each other deflects all bristles between them equally, so each
//! carries the load in proportion to its stiffness.

use crate::frame::buffers::EvaluationBuffers;
use crate::frame::forces::bristle_share;
use crate::frame::forces::contact::FrameContact;
use crate::frame::input::{PairContext, Round};
use crate::law::FrictionProps;
use crate::law::friction::shortened;
use crate::scene::Scene;
use crate::seal::{Sealed, values_of};
use crate::state::{ContactMemory, ContactRole, SolidContactPart};
use pong_geometry::Vec3;

/// State to which the bristles of a pair of Objects are preloaded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionPreload {
    /// Steady sliding: each sliding contact has kinetic friction against its current motion. Contacts without
    /// slip velocity keep their bristle.
    Sliding,
    /// Friction holds this force on the first Object of the pair, N, in common axes: the part in the contact
    /// planes, up to the sticking limit.
    Holding(Vec3),
}

/// New state of one bristle.
#[derive(Clone, Copy)]
pub(crate) struct Preloaded {
    /// Index of the contact in the frame's order, and of its record after the commit.
    index: usize,
    bristle_b: Vec3,
    sticks: bool,
    friction_force_b: Vec3,
    /// Increase of its stored energy, J.
    stored_more: f64,
}

/// A contact with normal force and a bristle.
struct Held<'f> {
    index: usize,
    contact: &'f FrameContact,
    /// Tangential stiffness K, N/m.
    stiffness: f64,
    kinetic_limit: f64,
    static_limit: f64,
    /// For solids: index of the second of the two contacts that carry the friction, and the effective area, m².
    second: Option<(usize, f64)>,
}

impl EvaluationBuffers {
    /// New states of the bristles between two paired Objects, to be written after the commit of this frame.
    pub fn preloaded(
        &self,
        scene: &Scene,
        sealed: &Sealed,
        memory: &ContactMemory,
        pair: usize,
        preload: &FrictionPreload,
    ) -> Vec<Preloaded> {
        let held = self.held(scene, sealed, memory, pair);
        let whole: f64 = held.iter().map(|held| held.stiffness).sum();
        let preloaded = |held: &Held<'_>| {
            let (bristle, sticks) = match preload {
                FrictionPreload::Sliding => held.sliding()?,
                FrictionPreload::Holding(force) => {
                    (held.holding(self.on_a(scene, sealed, pair, held.contact, force), whole), true)
                }
            };
            Some(held.preloaded(bristle, sticks))
        };
        held.iter().filter_map(preloaded).flatten().collect()
    }

    fn held(&self, scene: &Scene, sealed: &Sealed, memory: &ContactMemory, pair: usize) -> Vec<Held<'_>> {
        let motions = self.motions(sealed, &memory.poses);
        let round = Round { scene, sealed, memory, input: &self.input };
        let contact_at = |index: usize| self.found().contact(&self.order[index]);
        let indices: Vec<usize> = (0..self.order.len()).collect();
        let mut all = Vec::new();
        for group in indices.chunk_by(|a, b| contact_at(*a).found.key == contact_at(*b).found.key) {
            let key = contact_at(group[0]).found.key;
            if sealed.group_pairs[key.group_pair as usize].pair != pair {
                continue;
            }
            if key.is_of_solids() {
                let of_one =
                    |a: &usize, b: &usize| contact_at(*a).found.element_b == contact_at(*b).found.element_b;
                all.extend(group.chunk_by(of_one).filter_map(|two| self.held_by_solids(scene, sealed, two)));
                continue;
            }
            if !key.is_tested() {
                continue;
            }
            let motion = motions.known(&self.input, key.direction());
            let context = PairContext::new(&round, key.direction(), &motion);
            for index in group {
                let contact = contact_at(*index);
                let props = context.props(&contact.found);
                let FrictionProps::Bristle { stiffness, mu_kinetic, mu_static, .. } = props.friction else {
                    continue;
                };
                if contact.found.role != ContactRole::Active || contact.normal_force <= 0.0 {
                    continue;
                }
                let share =
                    bristle_share(&contact.found, group.iter().map(|index| &contact_at(*index).found));
                all.push(Held {
                    index: *index,
                    contact,
                    stiffness: share * stiffness,
                    kinetic_limit: mu_kinetic * contact.normal_force,
                    static_limit: mu_static * contact.normal_force,
                    second: None,
                });
            }
        }
        all.retain(|held| held.stiffness > 0.0);
        all
    }

    /// Bristle of a pair of solids, if `group` is the two contacts that carry its friction. Normal force and
    /// effective area follow from the cells beside them: (Σaδ)²/Σaδ² for the areas a and the depths δ.
    fn held_by_solids(&self, scene: &Scene, sealed: &Sealed, group: &[usize]) -> Option<Held<'_>> {
        let contact_at = |index: usize| self.found().contact(&self.order[index]);
        let [index, second] = *group else { return None };
        let contact = contact_at(index);
        let found = &contact.found;
        let key_of = |part| found.key.with_part(part);
        if found.key != key_of(SolidContactPart::Friction) {
            return None;
        }
        let FrictionProps::Bristle { stiffness, mu_kinetic, mu_static, .. } =
            values_of(scene, sealed, &self.input.tables, found).friction
        else {
            return None;
        };
        let fields = [SolidContactPart::CellOfB, SolidContactPart::CellOfA].map(key_of);
        let cells =
            self.contacts().with_head(found.key.head()).map(|reference| self.found().contact(reference));
        let cells =
            cells.filter(|cell| fields.contains(&cell.found.key) && cell.found.element_b == found.element_b);
        let (mut force, mut volume, mut squares) = (Vec3::zeros(), 0.0, 0.0);
        for cell in cells {
            force += cell.found.normal_b * cell.normal_force;
            volume += cell.found.weight * cell.found.depth;
            squares += cell.found.weight * cell.found.depth * cell.found.depth;
        }
        let area = volume * volume / squares.max(f64::MIN_POSITIVE);
        Some(Held {
            index,
            contact,
            stiffness: stiffness * area,
            kinetic_limit: mu_kinetic * force.norm(),
            static_limit: mu_static * force.norm(),
            second: Some((second, area)),
        })
    }

    /// Force on A of a contact, in B's frame, from a force on the first Object of a pair.
    fn on_a(
        &self,
        scene: &Scene,
        sealed: &Sealed,
        pair: usize,
        contact: &FrameContact,
        force: &Vec3,
    ) -> Vec3 {
        let objects = &scene.pairs[pair];
        let (body_a, body_b) = sealed.bodies_of(contact.found.key.direction());
        // Between two groups of one Object, the first is the group with the lower index.
        let a_is_first =
            if objects.a == objects.b { body_a < body_b } else { scene.bodies[body_a].object == objects.a };
        let on_a = if a_is_first { *force } else { -*force };
        self.poses[body_b].orientation.inverse() * on_a
    }
}

impl Held<'_> {
    /// New state with this deflection, m. Solids have two contacts, each with half of the force.
    fn preloaded(&self, bristle: Vec3, sticks: bool) -> Vec<Preloaded> {
        let squared = bristle.norm_squared() - self.contact.bristle_b.norm_squared();
        let part = if self.second.is_some() { 0.5 } else { 1.0 };
        let first = Preloaded {
            index: self.index,
            bristle_b: bristle,
            sticks,
            friction_force_b: bristle * (-part * self.stiffness),
            stored_more: 0.5 * self.stiffness * squared,
        };
        let second = self.second.map(|(index, area)| Preloaded {
            index,
            bristle_b: bristle * area,
            stored_more: 0.0,
            ..first
        });
        std::iter::once(first).chain(second).collect()
    }

    /// Bristle of steady sliding; `None` without slip velocity.
    fn sliding(&self) -> Option<(Vec3, bool)> {
        let velocity = &self.contact.slip_velocity_b;
        let speed = velocity.norm();
        (speed > 0.0)
            .then(|| (velocity * (self.kinetic_limit / self.stiffness / speed.max(f64::MIN_POSITIVE)), false))
    }

    fn holding(&self, on_a: Vec3, whole: f64) -> Vec3 {
        let normal = &self.contact.found.normal_b;
        let bristle = -(on_a - normal * normal.dot(&on_a)) / whole;
        let pull = self.stiffness * bristle.norm();
        shortened(bristle, pull, self.static_limit)
    }
}

impl ContactMemory {
    /// Writes preloaded bristles into the records after the commit of their frame. No work was done on the
    /// bodies, so the added energy counts as negative dissipation in the ledger and as inserted in the
    /// accounts.
    pub(crate) fn preload(&mut self, preloaded: &[Preloaded], keeps_ledger: bool) {
        for one in preloaded {
            let record = &mut self.records[one.index];
            record.force_b = record.normal_b * record.normal_b.dot(&record.force_b) + one.friction_force_b;
            (record.bristle_b, record.sticks) = (one.bristle_b, one.sticks);
            record.stored += one.stored_more;
            if keeps_ledger {
                record.dissipated -= one.stored_more;
                self.dissipated -= one.stored_more;
            }
            let pair = record.key.group_pair as usize;
            self.energies.insert_into_bristle(one.index, one.stored_more);
            self.pair_energies.insert(pair, one.stored_more);
        }
    }
}
