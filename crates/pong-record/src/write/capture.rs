//! A frame of the world as bytes.

use crate::read::Frame;
use crate::table::{ContactRow, EnergyRow, FrameRow, Row, StateRow, WrenchRow};
use pong_engine::{Contact, ContactSide, EngineError, InterfaceId, State, World};

/// Buffer for the bytes of one frame, with the list of bodies to write.
#[derive(Debug)]
pub(crate) struct Capture {
    bodies: Vec<InterfaceId>,
    /// Index of the first primitive of each body in the list of all.
    first_primitive: Vec<u32>,
    energies: bool,
    bytes: Vec<u8>,
}

impl Capture {
    pub fn new(world: &World, energies: bool) -> Result<Self, EngineError> {
        let mut bodies = Vec::new();
        let mut first_primitive = Vec::new();
        let mut primitives = 0;
        for object in world.scene().objects() {
            bodies.extend(world.scene().interfaces(object)?);
            for body in &world.scene().model_of(object)?.bodies {
                first_primitive.push(primitives);
                primitives += body.primitives.len() as u32;
            }
        }
        Ok(Self { bodies, first_primitive, energies, bytes: Vec::new() })
    }

    /// Reserves and touches memory for a frame of `largest` bytes, to avoid page faults in the first large
    /// frame.
    pub fn take_room(&mut self, largest: usize) {
        self.bytes.resize(largest, 1);
        self.bytes.clear();
    }

    /// The movable groups, as a run lists them.
    pub fn bodies(&self) -> &[InterfaceId] {
        &self.bodies
    }

    /// Bytes of a frame with this number of contacts.
    pub fn size(&self, contacts: usize) -> usize {
        let energies = if self.energies { EnergyRow::SIZE } else { 0 };
        FrameRow::SIZE
            + self.bodies.len() * (StateRow::SIZE + WrenchRow::SIZE)
            + energies
            + contacts * ContactRow::SIZE
    }

    /// Bytes of the last frame of the world. Allocates nothing if there is room for the largest number of
    /// contacts.
    pub fn frame(
        &mut self,
        world: &World,
        row: &FrameRow,
        energies: Option<&EnergyRow>,
    ) -> Result<&[u8], EngineError> {
        self.bytes.clear();
        row.put(&mut self.bytes);
        for body in &self.bodies {
            state_row(world.state_as_set(*body)?).put(&mut self.bytes);
        }
        for body in &self.bodies {
            wrench_row(world, *body)?.put(&mut self.bytes);
        }
        if self.energies {
            energies.copied().unwrap_or(NO_ENERGIES).put(&mut self.bytes);
        }
        for contact in world.contacts_iter() {
            self.contact_row(row.frame, &contact).put(&mut self.bytes);
        }
        Ok(&self.bytes)
    }

    /// As [`frame`](Self::frame), but as rows, into memory that is reused.
    pub fn rows(&self, world: &World, time: f64, out: &mut Frame) -> Result<(), EngineError> {
        let report = world.report();
        out.row = FrameRow { time, contacts: report.contacts, flags: report.status.bits(), ..out.row };
        out.states.clear();
        out.wrenches.clear();
        out.contacts.clear();
        for body in &self.bodies {
            out.states.push(state_row(world.state_as_set(*body)?));
            out.wrenches.push(wrench_row(world, *body)?);
        }
        out.contacts.extend(world.contacts_iter().map(|contact| self.contact_row(out.row.frame, &contact)));
        Ok(())
    }

    /// Row of a contact in the log: the values of the contact, with indices in the log instead of ids.
    pub fn contact_row(&self, frame: u64, contact: &Contact) -> ContactRow {
        let primitive = |side: &ContactSide| self.first_primitive[side.interface.index()] + side.primitive;
        ContactRow {
            frame,
            pair: contact.pair.index() as u32,
            primitive_a: primitive(&contact.a),
            primitive_b: primitive(&contact.b),
            element_a: contact.a.element,
            element_b: contact.b.element,
            feature_kind: contact.feature.kind() as u32,
            feature_index: contact.feature.index() as u32,
            end: contact.end,
            sticks: u32::from(contact.sticks),
            point: contact.point.into(),
            normal: contact.normal.into(),
            depth: contact.depth,
            depth_rate: contact.depth_rate,
            weight: contact.weight,
            normal_force: contact.normal_force,
            friction_force: contact.friction_force.into(),
            slip_velocity: contact.slip_velocity.into(),
            stored: contact.stored,
        }
    }
}

/// Placeholder for energies that were not given.
const NO_ENERGIES: EnergyRow = EnergyRow {
    kinetic: f64::NAN,
    potential: f64::NAN,
    springs: f64::NAN,
    contacts: f64::NAN,
    contact_loss: f64::NAN,
    spring_loss: f64::NAN,
    work_in: f64::NAN,
    balance: f64::NAN,
};

pub(crate) fn wrench_row(world: &World, body: InterfaceId) -> Result<WrenchRow, EngineError> {
    let wrench = world.wrench_common(body)?;
    Ok(WrenchRow { force: wrench.force.into(), moment: wrench.moment.into() })
}

fn state_row(state: Option<&State>) -> StateRow {
    let unset = State {
        position: [f64::NAN; 3],
        orientation: [f64::NAN; 4],
        linear_velocity: [f64::NAN; 3],
        angular_velocity: [f64::NAN; 3],
    };
    let State { position, orientation, linear_velocity, angular_velocity } = *state.unwrap_or(&unset);
    StateRow { position, orientation, linear_velocity, angular_velocity }
}
