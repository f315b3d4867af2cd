//! Check of the step against the contacts that act together in the run.

use crate::text::{count, number};
use pong_advise::{ActingReport, StepPlan};
use pong_executive::Simulation;

/// The worst instant of a run so far.
pub(super) struct Acting {
    plan: StepPlan,
    /// Time, s, and report of the worst instant.
    worst: Option<(f64, ActingReport)>,
    most: usize,
    not_judged: usize,
}

impl Acting {
    pub fn new(plan: StepPlan) -> Self {
        Self { plan, worst: None, most: 0, not_judged: 0 }
    }

    /// Checks an instant.
    pub fn observe(&mut self, simulation: &Simulation) {
        // Fails only without a frame, and then there is nothing to check.
        let Ok(report) = simulation.acting_report(&self.plan) else { return };
        self.most = self.most.max(report.contacts);
        self.not_judged = self.not_judged.max(report.not_judged);
        let before = self.worst.as_ref().map_or(f64::INFINITY, |(_, worst)| worst.stable_step);
        if report.contacts > 0 && report.stable_step < before {
            self.worst = Some((simulation.time(), report));
        }
    }

    /// The result in words.
    pub fn told(&self) -> String {
        let mut text = "Contacts that acted together: ".to_owned();
        text += &match &self.worst {
            None => "none\n".to_owned(),
            Some((time, worst)) => format!(
                "at most {}; the stiffest, {} at t = {} s, {}; {}\n",
                self.most,
                worst.contacts,
                number(*time),
                match worst.stable_step {
                    0.0 => "are surely stable at no step".to_owned(),
                    step => format!("are surely stable to {} s", number(step)),
                },
                match self.plan.step < worst.stable_step {
                    true => "the step is shorter".to_owned(),
                    false =>
                        format!("the step is {} s, and they may have gained energy", number(self.plan.step)),
                }
            ),
        };
        if self.not_judged > 0 {
            let contacts = count(self.not_judged, "contact", "contacts");
            text += &format!("  not judged: up to {contacts} at once, of the host's laws\n");
        }
        text
    }
}
