//! Energy accounts: energy that bodies gave to contacts and got back from them, and the losses. For each
//! contact, for each pair of movable groups and for all of them together, to rounding:
//!
//! ```text
//! work_in + inserted + hold_error = work_out + stored + damping_loss + friction_loss
//! ```

use crate::ids::{InterfaceId, PairId};
use std::fmt::Write as _;

/// Use of a wrench by the host. The engine cannot see it, and the work of a wrench depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WrenchCoupling {
    /// Evaluated again within every step, as in Runge-Kutta methods. The work is computed by the trapezoidal
    /// rule, which is of second order; [`EnergyAccount::resolution`] is its uncertainty where contact begins
    /// or ends.
    #[default]
    Stages,
    /// Applied once a step to get the new velocities: semi-implicit Euler. The trapezoidal rule is then
    /// exact, because each force acts over half of the displacement before it and half of the one after.
    SemiImplicit,
    /// Held from one commit to the next, by a host that steps the world once a frame. The work is that of the
    /// held wrench over the displacement, so it is known at the next commit.
    ZeroOrderHold {
        /// Number of whole frames by which the wrench is delayed; at most
        /// [`DELAY_FRAMES_MAX`](Self::DELAY_FRAMES_MAX).
        delay_frames: u32,
    },
}

impl WrenchCoupling {
    /// Maximum delay, frames.
    pub const DELAY_FRAMES_MAX: u32 = 16;

    /// Text for the hash of a world: unchanged since the first version, so that saved blocks stay valid.
    pub(crate) fn hashed(self) -> String {
        match self {
            Self::Stages => "Stages".to_owned(),
            Self::SemiImplicit => "SemiImplicit".to_owned(),
            Self::ZeroOrderHold { delay_frames } => format!("Held {{ late: {delay_frames} }}"),
        }
    }

    /// Mean age of the force while it acts, in steps; holding it adds half a step.
    pub fn lag(self) -> f64 {
        match self {
            Self::Stages | Self::SemiImplicit => 0.0,
            Self::ZeroOrderHold { delay_frames } => 0.5 + f64::from(delay_frames),
        }
    }

    /// Delay in frames.
    pub(crate) fn delay(self) -> usize {
        match self {
            Self::ZeroOrderHold { delay_frames } => delay_frames as usize,
            Self::Stages | Self::SemiImplicit => 0,
        }
    }
}

impl std::fmt::Display for WrenchCoupling {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Stages => write!(f, "evaluated at every stage"),
            Self::SemiImplicit => write!(f, "evaluated once a step"),
            Self::ZeroOrderHold { delay_frames: 0 } => write!(f, "held over a frame"),
            Self::ZeroOrderHold { delay_frames } => write!(f, "held over a frame, {delay_frames} late"),
        }
    }
}

/// Outcome of an energy account.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The contacts returned less energy than they received and the host inserted.
    Dissipated,
    /// The difference is below the accuracy of the accounts; see [`EnergyAccount::resolution`].
    Unresolved,
    /// The contacts returned more energy than they received and the host inserted.
    Gained,
}

/// Energies of a contact, of a pair of movable groups, or of all, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyAccount {
    /// Energy received from the bodies: work of the wrench on them, where negative.
    pub work_in: f64,
    /// Energy returned to the bodies: work of the wrench on them, where positive.
    pub work_out: f64,
    /// Energy stored without work, where the host placed bodies in contact (first frame, cleared contact
    /// history), minus stored energy that was dropped. Of one contact that began while its pair was already
    /// in contact: the energy that it may have taken over from another contact.
    pub inserted: f64,
    /// Energy created by holding the wrench: its work on the bodies minus that of a force that follows their
    /// motion.
    pub hold_error: f64,
    /// Energy currently stored in normal springs and bristles.
    pub stored: f64,
    /// Energy lost in normal damping.
    pub damping_loss: f64,
    /// Energy lost in friction.
    pub friction_loss: f64,
    /// Uncertainty of `work_out − work_in` besides rounding: the work in intervals in which contact began or
    /// ended, for [`WrenchCoupling::Stages`] (trapezoidal rule); otherwise 0.
    pub resolution: f64,
}

/// Rounding error of sums of work, relative to the total in and out.
const ROUNDING: f64 = 1e-9;

impl EnergyAccount {
    /// Number of values stored in the contact state.
    pub(crate) const NUMBERS: usize = 7;

    pub(crate) fn from_numbers(numbers: &[f64]) -> Self {
        Self {
            work_in: numbers[0],
            work_out: numbers[1],
            inserted: numbers[2],
            hold_error: numbers[3],
            damping_loss: numbers[4],
            friction_loss: numbers[5],
            resolution: numbers[6],
            stored: 0.0,
        }
    }

    /// All values except `stored`, which each frame recomputes.
    pub(crate) fn numbers(&self) -> [f64; Self::NUMBERS] {
        [
            self.work_in,
            self.work_out,
            self.inserted,
            self.hold_error,
            self.damping_loss,
            self.friction_loss,
            self.resolution,
        ]
    }

    /// Books work on the bodies.
    pub(crate) fn work(&mut self, done: f64) {
        *(if done > 0.0 { &mut self.work_out } else { &mut self.work_in }) += done.abs();
    }

    /// Adds another account.
    pub(crate) fn add(&mut self, other: &Self) {
        self.work_in += other.work_in;
        self.work_out += other.work_out;
        self.inserted += other.inserted;
        self.hold_error += other.hold_error;
        self.stored += other.stored;
        self.damping_loss += other.damping_loss;
        self.friction_loss += other.friction_loss;
        self.resolution += other.resolution;
    }

    /// Net work on the bodies so far, J. Over a closed path with equal stored energy at its ends, this is
    /// their energy gain.
    pub fn net_work(&self) -> f64 {
        self.work_out - self.work_in
    }

    /// Energy returned beyond the energy received and inserted, J.
    pub fn excess(&self) -> f64 {
        self.work_out - self.work_in - self.inserted
    }

    /// Compares the energy returned with the energy received and inserted.
    pub fn verdict(&self) -> Verdict {
        let doubt = self.resolution + ROUNDING * (self.work_in + self.work_out + self.inserted.abs());
        match self.excess() {
            excess if excess > doubt => Verdict::Gained,
            excess if excess > -doubt => Verdict::Unresolved,
            _ => Verdict::Dissipated,
        }
    }

    /// Residual of the energy balance, J; only rounding if the accounts are right.
    pub fn imbalance(&self) -> f64 {
        let went_in = self.work_in + self.inserted + self.hold_error;
        went_in - (self.work_out + self.stored + self.damping_loss + self.friction_loss)
    }
}

/// Energy accounts of a pair of movable groups at the last commit.
///
/// An *episode* lasts from the first contact of the pair until it has neither a contact nor a delayed wrench.
/// Verdicts apply to episodes and not to contacts, because energy may pass from one contact of a pair to
/// another, as for a sphere that rolls over triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairEnergyAccount {
    /// The pair of Objects.
    pub pair: PairId,
    /// The two movable groups.
    pub interfaces: [InterfaceId; 2],
    /// Account since the world began.
    pub total: EnergyAccount,
    /// Account of the current episode; all zero without contact.
    pub episode: EnergyAccount,
    /// True during an episode.
    pub in_contact: bool,
    /// Number of completed episodes.
    pub episodes: u64,
    /// Completed episodes that gained energy.
    pub episodes_gained: u64,
    /// Completed episodes with an undecided verdict.
    pub episodes_unresolved: u64,
    /// Total energy gained in episodes, J.
    pub excess: f64,
    /// Largest energy gained in one episode, J.
    pub worst_excess: f64,
    /// Stiffness, N/m, and damping, N·s/m, of the stiffest two surfaces of the pair that can meet and whose
    /// normal force is linear in the depth; `None` if there are none.
    pub stiffest: Option<(f64, f64)>,
    /// Use of wrenches by the host.
    pub coupling: WrenchCoupling,
}

impl PairEnergyAccount {
    /// Returns true if any episode, completed or not, has gained energy.
    pub fn gains_energy(&self) -> bool {
        self.episodes_gained > 0 || self.episode.verdict() == Verdict::Gained
    }

    /// Advice for a pair that gains energy.
    pub fn remedy(&self) -> String {
        let mut text = String::from("shorten the step, or give the surfaces more damping");
        match (self.coupling, self.stiffest) {
            (WrenchCoupling::ZeroOrderHold { .. }, Some((k, c))) => {
                let share = self.coupling.lag();
                let _ = write!(
                    text,
                    ": a wrench held over a step dt loses energy only while c > k·dt·{share}, here k = {k:.3e} N/m and c = {c:.3e} N·s/m"
                );
                if c > 0.0 {
                    let _ = write!(text, ", at steps below {:.3e} s", c / (k * share));
                }
            }
            (WrenchCoupling::ZeroOrderHold { .. }, None) => {
                let share = self.coupling.lag();
                let _ = write!(
                    text,
                    ": a wrench held over a step dt loses energy only while the damping exceeds {share}·dt times the stiffness at hand"
                );
            }
            (WrenchCoupling::Stages | WrenchCoupling::SemiImplicit, Some((k, c))) => {
                let _ = write!(text, "; here k = {k:.3e} N/m and c = {c:.3e} N·s/m");
            }
            (WrenchCoupling::Stages | WrenchCoupling::SemiImplicit, None) => {}
        }
        text
    }
}
