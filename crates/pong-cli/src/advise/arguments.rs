//! Arguments of `pong advise`.

use crate::folders::AllowedFolders;
use crate::text::number;
use pong_advise::{Accuracy, WrenchCoupling};
use std::path::PathBuf;

/// Tells which stiffness, damping and friction give a desired depth and rebound, how long a step may be, and
/// what goes wrong first (docs/advise.md). For a scene, masses, step and integrator are taken from it.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A scene, or a model whose surfaces are judged against a rigid partner; none for a desired contact
    /// alone.
    #[arg(value_name = "SCENE.ron|MODEL.ron", required_unless_present_all = ["depth", "mass"])]
    pub(super) file: Option<PathBuf>,
    /// Mass, kg; give it twice for two bodies. One alone meets a partner that does not yield.
    #[arg(long, value_name = "KG", action = clap::ArgAction::Append)]
    pub(super) mass: Vec<f64>,
    /// Rate at which the host calls the engine, Hz.
    #[arg(long, value_name = "HZ", conflicts_with = "step")]
    pub(super) rate: Option<f64>,
    /// The step or frame, s, in place of --rate.
    #[arg(long, value_name = "S")]
    pub(super) step: Option<f64>,
    /// Use of the wrench by the integrator.
    #[arg(long, value_enum)]
    pub(super) coupling: Option<CouplingName>,
    /// Whole frames by which a held wrench is delayed. Without it 0, or for a scene that holds its wrench the
    /// delay of the scene.
    #[arg(long, value_name = "FRAMES")]
    pub(super) late: Option<u32>,
    /// Closing speed, m/s. Needed for a desired contact and for contacts whose stiffness follows the depth;
    /// for a scene by default the largest at its start.
    #[arg(long, value_name = "M/S")]
    pub(super) speed: Option<f64>,
    /// The greatest depth desired at that speed, m.
    #[arg(long, value_name = "M", requires = "restitution")]
    pub(super) depth: Option<f64>,
    /// The desired rebound speed, over the closing speed.
    #[arg(long, value_name = "E", requires = "depth")]
    pub(super) restitution: Option<f64>,
    /// Number of contacts that carry the body together; each gets its share.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(super) contacts: u32,
    /// Mass that friction feels along the surface, kg, if it differs from the effective mass: for a rolling
    /// body 1/(1/m + r²/I), for a ball 2/7 of its mass. For a model only.
    #[arg(long, value_name = "KG", conflicts_with = "depth")]
    pub(super) friction_mass: Option<f64>,
    /// Largest error of the depth, %.
    #[arg(long, value_name = "%", default_value_t = 5.0)]
    pub(super) depth_within: f64,
    /// Largest error of the rebound, %.
    #[arg(long, value_name = "%", default_value_t = 2.0)]
    pub(super) rebound_within: f64,
    #[command(flatten)]
    pub(super) allowed: AllowedFolders,
}

#[derive(Clone, Copy, clap::ValueEnum)]
pub(super) enum CouplingName {
    /// Evaluated at every stage of a Runge-Kutta method.
    Stages,
    /// Evaluated once a step (semi-implicit Euler).
    Step,
    /// Held over a frame.
    Held,
}

impl Arguments {
    pub(super) fn coupling(&self, otherwise: WrenchCoupling) -> Result<WrenchCoupling, String> {
        let coupling = match self.coupling {
            None => otherwise,
            Some(CouplingName::Stages) => WrenchCoupling::Stages,
            Some(CouplingName::Step) => WrenchCoupling::SemiImplicit,
            Some(CouplingName::Held) => WrenchCoupling::ZeroOrderHold { delay_frames: 0 },
        };
        let Some(delay_frames) = self.late else { return Ok(coupling) };
        if !matches!(coupling, WrenchCoupling::ZeroOrderHold { .. }) {
            return Err(format!(
                "--late: the wrench is {coupling}, and only a held one comes late; leave it out or give --coupling held"
            ));
        }
        Ok(WrenchCoupling::ZeroOrderHold { delay_frames })
    }

    pub(super) fn step(&self) -> Option<f64> {
        self.rate.map(|rate| 1.0 / rate).or(self.step)
    }

    pub(super) fn accuracy(&self) -> Accuracy {
        Accuracy { depth: 0.01 * self.depth_within, rebound: 0.01 * self.rebound_within }
    }

    /// Effective mass 1/(1/m₁ + 1/m₂), kg.
    pub(super) fn effective_mass(&self) -> Result<f64, String> {
        if self.mass.is_empty() || self.mass.len() > 2 {
            return Err(format!("--mass: {} are given; give that of one body, or of both", self.mass.len()));
        }
        if let Some(wrong) = self.mass.iter().find(|mass| mass.is_nan() || **mass <= 0.0) {
            return Err(format!("--mass: it is {wrong} kg; give a mass above zero"));
        }
        Ok(1.0 / self.mass.iter().map(|mass| 1.0 / mass).sum::<f64>())
    }

    /// Mass that one contact feels along the surface, over the effective mass.
    pub(super) fn friction_share(&self, mass: f64) -> Result<f64, String> {
        match self.friction_mass {
            Some(wrong) if wrong.is_nan() || wrong <= 0.0 => {
                Err(format!("--friction-mass: it is {wrong} kg; give a mass above zero"))
            }
            Some(along) => Ok(along / mass / f64::from(self.contacts)),
            None => Ok(1.0 / f64::from(self.contacts)),
        }
    }

    /// Statement of step and coupling above every answer.
    pub(super) fn stated(&self, step: Option<f64>, coupling: WrenchCoupling) -> String {
        let step = step.map_or("step of the adviser's choice".to_owned(), |step| {
            format!("step {} s ({} Hz)", number(step), number(1.0 / step))
        });
        format!("{step}, wrench {coupling}")
    }
}
