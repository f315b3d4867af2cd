//! Comparison of one frame of the engine with one frame of the log.

use crate::error::LogError;
use crate::read::Frame;
use crate::run::Run;
use crate::table::Row;
use crate::write::{Capture, wrench_row};
use pong_engine::{InterfaceId, World};

/// Two values that should be equal.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Number of the frame.
    pub frame: u64,
    /// Its time, s.
    pub time: f64,
    /// The item that has the quantity: a body, a contact, the frame.
    pub of: String,
    /// Name of the quantity in the tables.
    pub quantity: &'static str,
    /// The value in the log.
    pub logged: String,
    /// The value that the engine computed.
    pub replayed: String,
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { frame, time, of, quantity, logged, replayed } = self;
        write!(f, "frame {frame}, t = {time:?} s, {of}: {quantity} is {logged} in the log and {replayed} now")
    }
}

/// A quantity, its value in the log and its value now.
type Values = (&'static str, String, String);

/// Settings of the comparison of frames.
pub(super) struct Comparison {
    capture: Capture,
    bodies: Vec<InterfaceId>,
    tolerance: Option<f64>,
}

impl Comparison {
    pub fn new(capture: Capture, bodies: Vec<InterfaceId>, tolerance: Option<f64>) -> Self {
        Self { capture, bodies, tolerance }
    }

    /// Returns the first difference in wrenches and the first in contacts.
    ///
    /// # Errors
    /// A frame that the world does not have.
    pub fn differences(&self, run: &Run, world: &World, frame: &Frame) -> Result<Vec<Difference>, LogError> {
        let report = world.report();
        let tell = |of: String, (quantity, logged, replayed): Values| Difference {
            frame: frame.row.frame,
            time: frame.row.time,
            of,
            quantity,
            logged,
            replayed,
        };
        let mut found = Vec::new();
        if frame.row.flags != report.status.bits() {
            let flags = ("flags", frame.row.flags.to_string(), report.status.bits().to_string());
            found.push(tell("limits".to_owned(), flags));
        }
        found.extend(
            self.wrench(world, frame)?
                .map(|(body, what)| tell(format!("wrench on `{}`", run.bodies[body].name), what)),
        );
        found.extend(self.contact(run, world, frame).map(|(of, what)| tell(of, what)));
        Ok(found)
    }

    fn wrench(&self, world: &World, frame: &Frame) -> Result<Option<(usize, Values)>, LogError> {
        let scales = Scales::of(&frame.wrenches);
        for (body, (id, logged)) in self.bodies.iter().zip(&frame.wrenches).enumerate() {
            let now = wrench_row(world, *id)?;
            if let Some(what) = logged.difference(&now, 0, &|field, a, b| self.same(&scales, field, a, b)) {
                return Ok(Some((body, what)));
            }
        }
        Ok(None)
    }

    fn contact(&self, run: &Run, world: &World, frame: &Frame) -> Option<(String, Values)> {
        let scales = Scales::of(&frame.contacts);
        let mut now = world.contacts_iter();
        for (index, logged) in frame.contacts.iter().enumerate() {
            let Some(contact) = now.next() else { break };
            let row = self.capture.contact_row(frame.row.frame, &contact);
            if let Some(what) = logged.difference(&row, 0, &|field, a, b| self.same(&scales, field, a, b)) {
                let name = |primitive: u32| run.primitive_name(primitive as usize).unwrap_or_default();
                let (a, b) = (name(logged.primitive_a), name(logged.primitive_b));
                return Some((format!("contact {index} (`{a}` on `{b}`)"), what));
            }
        }
        let (logged, now) = (frame.contacts.len(), world.contact_count());
        (logged != now).then(|| ("frame".to_owned(), ("contacts", logged.to_string(), now.to_string())))
    }

    fn same(&self, scales: &Scales, field: &str, a: f64, b: f64) -> bool {
        match self.tolerance {
            None => a.to_bits() == b.to_bits(),
            Some(tolerance) => a == b || (a - b).abs() <= tolerance * scales.get(field).max(b.abs()),
        }
    }
}

/// The largest magnitude of each quantity in a frame.
struct Scales(Vec<(&'static str, f64)>);

impl Scales {
    fn of<R: Row>(rows: &[R]) -> Self {
        let mut scales: Vec<_> = R::FIELDS.iter().map(|field| (field.name, 0.0_f64)).collect();
        for row in rows {
            let mut index = 0;
            row.magnitudes(&mut |_, magnitude| {
                scales[index].1 = scales[index].1.max(magnitude);
                index += 1;
            });
        }
        Self(scales)
    }

    fn get(&self, field: &str) -> f64 {
        self.0.iter().find(|(name, _)| *name == field).map_or(0.0, |(_, scale)| *scale)
    }
}
