//! Statistics of a run: peaks, impulses, energies, contacts left out.

use crate::energy::Energy;
use crate::left_out::LeftOut;
use crate::missed::{deep_in_mesh_in_words, tunnelling_in_words};
use crate::simulation::Simulation;
use pong_engine::{Contact, InterfaceId, StatusBits};
use pong_geometry::{Vec3, Wrench};
use std::collections::BTreeMap;

/// Statistics of one body over the whole run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyStatistics {
    /// Largest contact force, N.
    pub peak_force: f64,
    /// Largest contact moment about the origin of the group, N·m.
    pub peak_moment: f64,
    /// Largest depth of a contact of the body, m.
    pub peak_depth: f64,
    /// Most contacts of the body at once.
    pub most_contacts: usize,
    /// ∫ contact force dt by the trapezoid rule, N·s, along the common axes.
    pub impulse: Vec3,
    last_force: Vec3,
}

/// Statistics of all bodies and of the run itself.
#[derive(Clone, Debug, Default)]
pub struct RunStatistics {
    /// The bodies in their order in the simulation.
    pub bodies: Vec<BodyStatistics>,
    by_interface: BTreeMap<InterfaceId, usize>,
    /// Most contacts at once.
    pub most_contacts: usize,
    /// Energies at the first instant, J.
    pub first_energy: Energy,
    /// Energies at the last instant, J.
    pub last_energy: Energy,
    /// Largest deviation of the energy balance from its first value, J.
    pub worst_balance: f64,
    /// The frame that left contacts out with the largest advised capacity.
    pub left_out: Option<LeftOut>,
    /// Number of steps in which something tunnelled.
    pub tunnelled: u64,
    /// The first tunnelling in words; empty if there is none.
    pub first_tunnelled: String,
    /// Number of steps in which a solid was deeper in a mesh than the regions below its facets.
    pub deep_in_mesh: u64,
    /// The first such step in words; empty if there is none.
    pub first_deep_in_mesh: String,
}

impl RunStatistics {
    /// Statistics of the first instant of a simulation whose [initial
    /// states](Simulation::commit_initial_states) are committed.
    pub fn new(simulation: &Simulation) -> Self {
        let bodies = simulation.bodies();
        let mut statistics = Self {
            bodies: vec![BodyStatistics::default(); bodies.len()],
            by_interface: bodies.filter_map(|(id, body)| Some((body.interface?, id.index()))).collect(),
            ..Self::default()
        };
        statistics.observe(simulation);
        statistics.bodies.iter_mut().for_each(|body| body.impulse = Vec3::zeros());
        statistics.first_energy = statistics.last_energy;
        statistics.worst_balance = 0.0;
        statistics
    }

    /// Adds the instant after a step.
    pub fn observe(&mut self, simulation: &Simulation) {
        for (id, _) in simulation.bodies() {
            self.bodies[id.index()].feel(&simulation.contact_wrench(id), simulation.step_length());
        }
        let world = simulation.world();
        if world.contact_count() > 0 {
            self.count(&world.contacts());
        }
        let report = world.report();
        if report.status.contains(StatusBits::TUNNELLED) {
            self.tunnelled += 1;
            if self.tunnelled == 1 {
                self.first_tunnelled = at_time(tunnelling_in_words(world), simulation);
            }
        }
        if report.status.contains(StatusBits::DEEP_IN_MESH) {
            self.deep_in_mesh += 1;
            if self.deep_in_mesh == 1 {
                self.first_deep_in_mesh = at_time(deep_in_mesh_in_words(world), simulation);
            }
        }
        self.left_out = self.left_out.max(LeftOut::of(world));
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

    /// Advice on all that went wrong in frames of the run.
    pub fn advice(&self) -> impl Iterator<Item = String> {
        [self.incomplete_advice(), self.tunnelling_advice(), self.depth_advice()].into_iter().flatten()
    }

    /// Advice if a solid was deeper in a mesh than the regions below its facets.
    fn depth_advice(&self) -> Option<String> {
        (self.deep_in_mesh > 0).then(|| {
            format!(
                "in {} steps a solid was deeper in a mesh than its facets push (`pong check` prints that depth), and the \
                 force did not grow as it should; first {}; make the surfaces stiffer, the mesh thicker or its edges \
                 longer, or divide it by `pong decompose`",
                self.deep_in_mesh, self.first_deep_in_mesh
            )
        })
    }

    /// Advice if something tunnelled between two steps.
    fn tunnelling_advice(&self) -> Option<String> {
        (self.tunnelled > 0).then(|| {
            format!(
                "in {} steps something went right through something else, and contacts were missed; first {}; \
                 make the step shorter, the wall thicker or the surfaces stiffer",
                self.tunnelled, self.first_tunnelled
            )
        })
    }

    /// Advice if frames had to leave contacts out.
    fn incomplete_advice(&self) -> Option<String> {
        let left_out = self.left_out?;
        Some(format!(
            "{left_out}; set contact_capacity: {} in the scene{}",
            left_out.advised,
            left_out.again()
        ))
    }
}

/// A warning in words, with the time of the simulation.
fn at_time(words: Option<String>, simulation: &Simulation) -> String {
    words.map(|words| format!("{words} at {} s", simulation.time())).unwrap_or_default()
}

impl BodyStatistics {
    fn feel(&mut self, wrench: &Wrench, step: f64) {
        self.peak_force = self.peak_force.max(wrench.force.norm());
        self.peak_moment = self.peak_moment.max(wrench.moment.norm());
        self.impulse += (self.last_force + wrench.force) * (0.5 * step);
        self.last_force = wrench.force;
    }
}
