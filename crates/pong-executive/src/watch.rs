//! Check of the step against contacts as they occur.

use crate::simulation::Simulation;
use pong_engine::InterfaceId;
use std::collections::{BTreeMap, BTreeSet};

/// Factor in depth or normal force at which the contacts of two bodies are judged again. A run asks the
/// adviser some ten times for a tenfold growth, whatever its steps.
const GROWTH: f64 = 1.25;

/// Warns once of every two bodies whose contact gains energy at the step, at the first instant at which it
/// does. Before the run this is known only of laws that follow neither depth nor load, or for a known closing
/// speed.
#[derive(Clone, Debug, Default)]
pub struct StepWatch {
    /// Largest depth (m) and normal force (N) of two bodies that were judged.
    judged: BTreeMap<[InterfaceId; 2], [f64; 2]>,
    told: BTreeSet<String>,
}

impl StepWatch {
    /// A watch that does not repeat warnings already given.
    pub fn after(told: &[String]) -> Self {
        Self { judged: BTreeMap::new(), told: told.iter().map(|warning| names(warning)).collect() }
    }

    /// New warnings of the present instant.
    pub fn observe(&mut self, simulation: &Simulation) -> Vec<String> {
        let mut grown = false;
        for contact in simulation.world().contacts() {
            let pair = [contact.a.interface, contact.b.interface];
            let largest = self.judged.entry(pair).or_insert([0.0; 2]);
            for (largest, now) in largest.iter_mut().zip([contact.depth, contact.normal_force]) {
                if now > GROWTH * *largest {
                    (*largest, grown) = (now, true);
                }
            }
        }
        let warnings = if grown { simulation.pressed_warnings() } else { Vec::new() };
        warnings.into_iter().filter(|warning| self.told.insert(names(warning))).collect()
    }
}

/// Names in a warning: the text before its first colon.
fn names(warning: &str) -> String {
    warning.split(": ").next().unwrap_or_default().to_owned()
}
