//! What a run is summed up from, gathered at every step.

use super::acting::Acting;
use pong_engine::{Contact, InterfaceId, StatusBits};
use pong_executive::scene::BuiltScene;
use pong_executive::{Energy, Simulation, Vec3, Wrench};
use std::collections::BTreeMap;
use std::time::Duration;

/// Most step times that are kept; of longer runs every second, third … is.
const TIMES_KEPT: u64 = 1_000_000;

/// One body over the whole run.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyStatistics {
    /// Greatest contact force, N.
    pub peak_force: f64,
    /// Greatest contact moment about the group's origin, N·m.
    pub peak_moment: f64,
    /// Greatest depth, m.
    pub peak_depth: f64,
    pub most_contacts: usize,
    /// ∫ contact force dt in the common axes, N·s, by the trapezoid rule.
    pub impulse: Vec3,
    last_force: Vec3,
}

/// All bodies and the run itself.
pub(super) struct Statistics {
    pub bodies: Vec<BodyStatistics>,
    by_interface: BTreeMap<InterfaceId, usize>,
    pub most_contacts: usize,
    pub first_energy: Energy,
    pub last_energy: Energy,
    /// Largest distance of the energy balance from its first value, J.
    pub worst_balance: f64,
    times_ns: Vec<u64>,
    every: u64,
    steps: u64,
    contacts_wanted: Option<u32>,
    /// Steps in which something went through something else, and the first of them in words.
    tunnelled: u64,
    first_tunnelled: String,
    /// If it is asked for.
    pub acting: Option<Acting>,
}

impl Statistics {
    /// `acting`: whether what acts together is held against the step.
    pub fn new(built: &BuiltScene, acting: bool) -> Self {
        let bodies = built.simulation.bodies();
        let none = BodyStatistics {
            peak_force: 0.0,
            peak_moment: 0.0,
            peak_depth: 0.0,
            most_contacts: 0,
            impulse: Vec3::zeros(),
            last_force: Vec3::zeros(),
        };
        Self {
            bodies: vec![none; bodies.len()],
            by_interface: bodies.filter_map(|(id, body)| Some((body.interface?, id.index()))).collect(),
            most_contacts: 0,
            first_energy: Energy::default(),
            last_energy: Energy::default(),
            worst_balance: 0.0,
            times_ns: Vec::new(),
            every: built.steps.div_ceil(TIMES_KEPT).max(1),
            steps: 0,
            contacts_wanted: None,
            tunnelled: 0,
            first_tunnelled: String::new(),
            acting: acting.then(|| Acting::new(built.simulation.step_plan())),
        }
    }

    /// Takes in the first instant.
    pub fn start(&mut self, simulation: &Simulation) {
        self.observe(simulation);
        self.bodies.iter_mut().for_each(|body| body.impulse = Vec3::zeros());
        self.first_energy = self.last_energy;
        self.worst_balance = 0.0;
    }

    /// Takes in the time of a step.
    pub fn took(&mut self, time: Duration) {
        if self.steps.is_multiple_of(self.every) {
            self.times_ns.push(time.as_nanos() as u64);
        }
        self.steps += 1;
    }

    /// Takes in an instant.
    pub fn observe(&mut self, simulation: &Simulation) {
        for (id, _) in simulation.bodies() {
            self.bodies[id.index()].feel(&simulation.contact_wrench(id), simulation.step_length());
        }
        if simulation.world().contact_count() > 0 {
            self.count(&simulation.world().contacts());
        }
        self.acting.iter_mut().for_each(|acting| acting.observe(simulation));
        let report = simulation.world().report();
        if report.status.contains(StatusBits::TUNNELLED) {
            self.tunnelled += 1;
            if self.tunnelled == 1 {
                self.first_tunnelled = tunnelling_in_words(simulation).unwrap_or_default();
            }
        }
        if report.status.leaves_contacts_out() {
            self.contacts_wanted = self.contacts_wanted.max(Some(report.contacts_wanted));
        }
        self.last_energy = simulation.energy();
        let change = self.last_energy.balance() - self.first_energy.balance();
        self.worst_balance = self.worst_balance.max(change.abs());
    }

    fn count(&mut self, contacts: &[Contact]) {
        let mut counts = vec![0; self.bodies.len()];
        for contact in contacts {
            for interface in [contact.a.interface, contact.b.interface] {
                if let Some(&body) = self.by_interface.get(&interface) {
                    counts[body] += 1;
                    let peak = &mut self.bodies[body].peak_depth;
                    *peak = peak.max(contact.depth);
                }
            }
        }
        for (body, count) in self.bodies.iter_mut().zip(counts) {
            body.most_contacts = body.most_contacts.max(count);
        }
        self.most_contacts = self.most_contacts.max(contacts.len());
    }

    /// Median, 99th percentile and longest step, in microseconds; `None` before the first.
    pub fn step_times_us(&self) -> Option<[f64; 3]> {
        let mut sorted = self.times_ns.clone();
        sorted.sort_unstable();
        let last = sorted.len().checked_sub(1)?;
        let at = |share: f64| sorted[(share * last as f64).round() as usize] as f64 * 1e-3;
        Some([at(0.5), at(0.99), at(1.0)])
    }

    /// What to do if something went through something else between two steps.
    pub fn tunnelling_advice(&self) -> Option<String> {
        (self.tunnelled > 0).then(|| {
            format!(
                "in {} steps something went right through something else, and contacts were missed; first {}; \
                 make the step shorter, the wall thicker or the surfaces stiffer",
                self.tunnelled, self.first_tunnelled
            )
        })
    }

    /// What to do if frames had to leave contacts out.
    pub fn incomplete_advice(&self) -> Option<String> {
        let wanted = self.contacts_wanted?;
        Some(format!(
            "some frames had more contacts than the world keeps, and the shallowest were left out; \
             set contact_capacity: {wanted} in the scene"
        ))
    }
}

/// Which element went through which body, and when.
fn tunnelling_in_words(simulation: &Simulation) -> Option<String> {
    let world = simulation.world();
    let passage = world.tunnelling()?;
    let element = world.scene().primitive_path(passage.interface, passage.primitive).ok()?;
    let through = world.scene().interface_path(passage.through).ok()?;
    Some(format!("`{element}` through `{through}` at {} s", simulation.time()))
}

impl BodyStatistics {
    fn feel(&mut self, wrench: &Wrench, step: f64) {
        self.peak_force = self.peak_force.max(wrench.force.norm());
        self.peak_moment = self.peak_moment.max(wrench.moment.norm());
        self.impulse += (self.last_force + wrench.force) * (0.5 * step);
        self.last_force = wrench.force;
    }
}
