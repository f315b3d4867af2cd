//! Answers of the engine in a frame, as hashes: two answers are equal only if every bit is.

use pong_engine::{Contact, ContactSide, EngineError, InterfaceId, World};
use pong_model::Fnv;

/// The answer of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Answer {
    /// Hash of the wrenches on all movable groups, and of the limits that the frame hit.
    wrenches: u64,
    /// Hash of all contacts, in their order, with all their fields.
    pub contacts: u64,
    /// Hash of the contact state after the frame, if requested.
    state: Option<u64>,
}

impl Answer {
    /// Name of the first difference between parts that both have; `None` if they agree.
    pub fn difference(&self, other: &Self) -> Option<&'static str> {
        let parts = [
            (self.wrenches == other.wrenches, "the wrenches"),
            (self.contacts == other.contacts, "the contacts"),
            (self.state.is_none() || other.state.is_none() || self.state == other.state, "the contact state"),
        ];
        parts.into_iter().find(|(same, _)| !same).map(|(_, what)| what)
    }
}

/// Reads answers; its buffer is reused.
#[derive(Default)]
pub(crate) struct Reader {
    block: Vec<u8>,
}

impl Reader {
    /// The answer of the world's last frame, after its commit if there was one. Errors in the contact state
    /// persist, so it need not be read in every frame.
    pub fn read(
        &mut self,
        world: &World,
        bodies: &[InterfaceId],
        with_state: bool,
    ) -> Result<Answer, EngineError> {
        let (mut wrenches, mut contacts) = (Fnv::default(), Fnv::default());
        for body in bodies {
            let wrench = world.wrench_common(*body)?;
            wrenches.numbers(wrench.force.iter().chain(wrench.moment.iter()).copied());
        }
        wrenches.word(world.report().status.bits().into());
        world.contacts_iter().for_each(|contact| add(&mut contacts, &contact));
        let state = if with_state { Some(hash_of_block(self.block(world))) } else { None };
        Ok(Answer { wrenches: wrenches.value(), contacts: contacts.value(), state })
    }

    /// The world's contact state as a block.
    pub fn block(&mut self, world: &World) -> &[u8] {
        world.save_state_packed(&mut self.block);
        &self.block
    }
}

/// The checksum at the end of a block, which is a hash of all bytes before it.
fn hash_of_block(block: &[u8]) -> u64 {
    let mut last = [0; 8];
    last.copy_from_slice(&block[block.len() - 8..]);
    u64::from_le_bytes(last)
}

fn add(hash: &mut Fnv, contact: &Contact) {
    // Destructured without `..`, so that a field added to contacts must be added here.
    let Contact {
        pair,
        a,
        b,
        feature,
        end,
        point,
        normal,
        depth,
        depth_rate,
        weight,
        normal_force,
        friction_force,
        force,
        slip_velocity,
        sticks,
        stored,
        work,
        dissipated,
    } = contact;
    hash.word(pair.index() as u64);
    for ContactSide { object, interface, primitive, element, arm } in [a, b] {
        hash.word(object.index() as u64);
        hash.word(interface.index() as u64);
        hash.word(u64::from(*primitive) << 32 | u64::from(*element));
        hash.numbers(arm.iter().copied());
    }
    hash.word(u64::from(feature.0) << 32 | u64::from(*end) << 1 | u64::from(*sticks));
    for vector in [point, normal, friction_force, force, slip_velocity] {
        hash.numbers(vector.iter().copied());
    }
    hash.numbers([*depth, *depth_rate, *weight, *normal_force, *stored, *work, *dissipated]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_engine::{ObjectId, PairId};
    use pong_geometry::Vec3;
    use pong_geometry::interference::Feature;

    fn contact() -> Contact {
        let side = |bits| ContactSide {
            object: ObjectId::from_bits(bits),
            interface: InterfaceId::from_bits(bits),
            primitive: 1,
            element: 2,
            arm: Vec3::x(),
        };
        Contact {
            pair: PairId::from_bits(1),
            a: side(1),
            b: side(2),
            feature: Feature(3),
            end: 0,
            point: Vec3::x(),
            normal: Vec3::z(),
            depth: 1.0,
            depth_rate: 2.0,
            weight: 0.5,
            normal_force: 3.0,
            friction_force: Vec3::y(),
            force: Vec3::zeros(),
            slip_velocity: Vec3::zeros(),
            sticks: false,
            stored: 4.0,
            work: 5.0,
            dissipated: 6.0,
        }
    }

    fn hash(contact: &Contact) -> u64 {
        let mut hash = Fnv::default();
        add(&mut hash, contact);
        hash.value()
    }

    /// Every change of a contact changes its hash; ids of worlds are not part of it.
    #[test]
    fn nothing_of_a_contact_is_left_out() {
        let changes: [fn(&mut Contact); 22] = [
            |c| c.pair = PairId::from_bits(2),
            |c| c.a.object = ObjectId::from_bits(7),
            |c| c.a.interface = InterfaceId::from_bits(7),
            |c| c.a.primitive = 7,
            |c| c.a.element = 7,
            |c| c.a.arm.y = 1e-300,
            |c| c.b.interface = InterfaceId::from_bits(7),
            |c| c.b.primitive = 7,
            |c| c.feature = Feature(1 << 31),
            |c| c.end = 1,
            |c| c.sticks = true,
            |c| c.point.x = 1.0_f64.next_up(),
            |c| c.normal.x = -0.0,
            |c| c.depth = 1.0_f64.next_up(),
            |c| c.depth_rate = 2.0_f64.next_down(),
            |c| c.weight = 0.25,
            |c| c.normal_force = 3.5,
            |c| c.friction_force.z = 1.0,
            |c| c.force.z = -0.0,
            |c| c.slip_velocity.z = 1.0,
            |c| c.stored = 0.0,
            |c| (c.work, c.dissipated) = (c.dissipated, c.work),
        ];
        let same = hash(&contact());
        for (index, change) in changes.iter().enumerate() {
            let mut other = contact();
            change(&mut other);
            // 0 and -0 too: they compare equal but have different bits.
            assert_ne!(hash(&other), same, "change {index}");
        }
        let mut elsewhere = contact();
        elsewhere.pair = PairId::from_bits(5 << 32 | 1);
        assert_eq!(hash(&elsewhere), same);
    }

    #[test]
    fn what_differs_is_named() {
        let answer = Answer { wrenches: 1, contacts: 2, state: Some(3) };
        assert_eq!(answer.difference(&answer), None);
        assert_eq!(answer.difference(&Answer { state: None, ..answer }), None);
        assert_eq!(answer.difference(&Answer { state: Some(4), ..answer }), Some("the contact state"));
        assert_eq!(answer.difference(&Answer { contacts: 4, ..answer }), Some("the contacts"));
        assert_eq!(answer.difference(&Answer { wrenches: 4, contacts: 4, ..answer }), Some("the wrenches"));
    }
}
