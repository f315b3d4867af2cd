//! What the engine answers in a frame, as hashes: two answers are equal only if every bit is.

use crate::fnv::Fnv;
use pong_engine::{Contact, ContactSide, EngineError, InterfaceId, World};

/// The answer of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Answer {
    /// Wrenches on all movable groups, and what the frame had to leave out.
    wrenches: u64,
    /// All contacts, in their order, with all that is told of them.
    contacts: u64,
    /// Contact state as it stands after the frame, if that was asked for.
    state: Option<u64>,
}

impl Answer {
    /// What differs, if anything does that both know.
    pub fn difference(&self, other: &Self) -> Option<&'static str> {
        let parts = [
            (self.wrenches == other.wrenches, "the wrenches"),
            (self.contacts == other.contacts, "the contacts"),
            (self.state.is_none() || other.state.is_none() || self.state == other.state, "the contact state"),
        ];
        parts.into_iter().find(|(same, _)| !same).map(|(_, what)| what)
    }
}

/// Reads answers; keeps its memory.
#[derive(Default)]
pub(crate) struct Reader {
    block: Vec<u8>,
}

impl Reader {
    /// The answer of the world's last frame, after its commit if there was one. What is wrong in contact state stays in it:
    /// it need not be asked for in every frame.
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
        let state = if with_state { Some(hash_of_block(self.block(world)?)) } else { None };
        Ok(Answer { wrenches: wrenches.value(), contacts: contacts.value(), state })
    }

    /// The world's contact state as a block.
    pub fn block(&mut self, world: &World) -> Result<&[u8], EngineError> {
        world.save_state_packed(&mut self.block)?;
        Ok(&self.block)
    }
}

/// The checksum at the end of a block, which is a hash of all before it.
fn hash_of_block(block: &[u8]) -> u64 {
    let mut last = [0; 8];
    last.copy_from_slice(&block[block.len() - 8..]);
    u64::from_le_bytes(last)
}

fn add(hash: &mut Fnv, contact: &Contact) {
    // Taken apart without `..`: a field that is added to contacts must be added here.
    let Contact {
        pair,
        a,
        b,
        feature,
        end,
        point,
        normal,
        depth,
        rate,
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
    hash.word(u64::from(*feature) << 32 | u64::from(*end) << 1 | u64::from(*sticks));
    for vector in [point, normal, friction_force, force, slip_velocity] {
        hash.numbers(vector.iter().copied());
    }
    hash.numbers([*depth, *rate, *weight, *normal_force, *stored, *work, *dissipated]);
}
