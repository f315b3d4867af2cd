//! Warnings about contacts that returned more energy than they received.

use crate::simulation::Simulation;
use pong_engine::{PairEnergyAccount, Verdict, WrenchCoupling};

impl Simulation {
    /// Warnings about pairs of bodies whose contact returned more energy than it received, each with the
    /// remedy. Empty if there is none, or if the world keeps no accounts
    /// ([`Integrator::wrench_coupling`](crate::Integrator::wrench_coupling)).
    pub fn energy_warnings(&self) -> Vec<String> {
        let pairs = self.world().pair_accounts().filter(PairEnergyAccount::gains_energy);
        pairs.map(|pair| self.energy_warning(&pair)).collect()
    }

    fn energy_warning(&self, pair: &PairEnergyAccount) -> String {
        let name = |interface| {
            let mut bodies = self.bodies().map(|(_, body)| body);
            bodies.find(|body| body.interface == Some(interface)).map_or("", |body| body.name.as_str())
        };
        let [first, second] = pair.interfaces.map(name);
        let mut text = format!("`{first}` and `{second}`: ");
        if pair.episodes_gained > 0 {
            text += &format!(
                "{} of {} contact episodes gained energy, {:.3e} J in all and {:.3e} J at most; ",
                pair.episodes_gained, pair.episodes, pair.excess, pair.worst_excess
            );
        }
        if pair.episode.verdict() == Verdict::Gained {
            text += &format!("the contact that lasts has gained {:.3e} J; ", pair.episode.excess());
        }
        text += &pair.remedy();
        if let (WrenchCoupling::ZeroOrderHold { .. }, Some((k, _))) = (pair.coupling, pair.stiffest) {
            let needed = k * self.step_length() * pair.coupling.lag();
            text += &format!("; at this step c must exceed {needed:.3e} N·s/m");
        }
        text
    }
}
