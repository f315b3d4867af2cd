//! Energy accounts: what bodies gave to contacts, what they got back, and where the rest went.
//!
//! ```text
//! work_in + inserted + hold_error = work_out + stored + damping_loss + friction_loss
//! ```
//!
//! holds to rounding for each contact, for each pair of movable groups and for all of them together.

use crate::ids::{InterfaceId, PairId};
use std::fmt::Write as _;

/// What the host does with a wrench. The engine cannot see it, and the work that a wrench does depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WrenchCoupling {
    /// Evaluated again within every step, as Runge-Kutta methods do. Work by the trapezoid rule, which is of second
    /// order; what it may be off by is in [`EnergyAccount::resolution`].
    #[default]
    Stages,
    /// Gives the velocity with which the bodies then move, once a step: semi-implicit Euler. The trapezoid rule is exact
    /// then, for each force acts over half of the displacement before it and half of the one after.
    SemiImplicit,
    /// Held from one commit to the next, as by a host that steps the world once a frame: the work is that of the held
    /// wrench over the displacement, which the next commit tells.
    ZeroOrderHold {
        /// How many whole frames the wrench comes late; at most [`DELAY_FRAMES_MAX`](Self::DELAY_FRAMES_MAX).
        delay_frames: u32,
    },
}

impl WrenchCoupling {
    /// The latest that a wrench may come, frames.
    pub const DELAY_FRAMES_MAX: u32 = 16;

    /// What the hash of a world says of it: the words of the first version, so that blocks saved since then fit.
    pub(crate) fn hashed(self) -> String {
        match self {
            Self::Stages => "Stages".to_owned(),
            Self::SemiImplicit => "SemiImplicit".to_owned(),
            Self::ZeroOrderHold { delay_frames } => format!("Held {{ late: {delay_frames} }}"),
        }
    }

    /// How old the force is on average while it acts, in steps: holding it makes it half a step old.
    pub fn lag(self) -> f64 {
        match self {
            Self::Stages | Self::SemiImplicit => 0.0,
            Self::ZeroOrderHold { delay_frames } => 0.5 + f64::from(delay_frames),
        }
    }

    /// How many frames late.
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

/// Whether a contact gave back more energy than it got.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It gave back less.
    Dissipated,
    /// As much, as far as the accounts can tell: see [`EnergyAccount::resolution`].
    Unresolved,
    /// It gave back more: it makes energy.
    Gained,
}

/// Energies of a contact, of a pair of movable groups, or of all, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyAccount {
    /// What the bodies gave: work of the wrench on them, where it was negative.
    pub work_in: f64,
    /// What the bodies got back: work of the wrench on them, where it was positive.
    pub work_out: f64,
    /// Stored without work: where the host put bodies into each other (first frame, after the contact history was
    /// cleared), less what it let be forgotten. Of a contact that began while the pair touched already: what it may have taken over from another.
    pub inserted: f64,
    /// Made by holding the wrench: its work on the bodies less that of the force as it would have followed their motion.
    pub hold_error: f64,
    /// Stored in normal springs and bristles now.
    pub stored: f64,
    /// Lost in normal damping.
    pub damping_loss: f64,
    /// Lost in friction.
    pub friction_loss: f64,
    /// What `work_out − work_in` may be off by, rounding apart: the work in intervals in which contact began or ended, if
    /// the work is that of the trapezoid rule for [`WrenchCoupling::Stages`]; else 0.
    pub resolution: f64,
}

/// Rounding of sums of works, relative to all that went in and out.
const ROUNDING: f64 = 1e-9;

impl EnergyAccount {
    /// Numbers that are remembered.
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

    /// All but `stored`, which is found anew.
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

    /// Takes in work on the bodies.
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

    /// Work done on the bodies so far, J: over a closed path, whose ends store the same, what it gained them.
    pub fn net_work(&self) -> f64 {
        self.work_out - self.work_in
    }

    /// What was returned beyond what was taken and put in, J.
    pub fn excess(&self) -> f64 {
        self.work_out - self.work_in - self.inserted
    }

    /// Whether more was returned than taken.
    pub fn verdict(&self) -> Verdict {
        let doubt = self.resolution + ROUNDING * (self.work_in + self.work_out + self.inserted.abs());
        match self.excess() {
            excess if excess > doubt => Verdict::Gained,
            excess if excess > -doubt => Verdict::Unresolved,
            _ => Verdict::Dissipated,
        }
    }

    /// What the accounts fail to close by, J: rounding, if they are right.
    pub fn imbalance(&self) -> f64 {
        let went_in = self.work_in + self.inserted + self.hold_error;
        went_in - (self.work_out + self.stored + self.damping_loss + self.friction_loss)
    }
}

/// Accounts of a pair of movable groups at the last commit.
///
/// An *episode* lasts from the first contact of the pair until nothing of it touches any more, and no delayed wrench of it is on
/// its way. Verdicts are those of episodes: energy may go from one contact of a pair to another, a ball from facet to facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairEnergyAccount {
    /// The pair of Objects.
    pub pair: PairId,
    /// The two movable groups.
    pub interfaces: [InterfaceId; 2],
    /// Since the world began.
    pub total: EnergyAccount,
    /// Of the episode that lasts; all zero if nothing touches.
    pub episode: EnergyAccount,
    /// Whether an episode lasts.
    pub in_contact: bool,
    /// Episodes that have ended.
    pub episodes: u64,
    /// Of those, the ones that gained energy.
    pub episodes_gained: u64,
    /// Of those, the ones of which the accounts cannot tell.
    pub episodes_unresolved: u64,
    /// What episodes gained, all together, J.
    pub excess: f64,
    /// What one episode gained at most, J.
    pub worst_excess: f64,
    /// Stiffness of the stiffest contact of the pair, N/m, and its damping, N·s/m, if it does not depend on the depth.
    pub stiffest: Option<(f64, f64)>,
    /// What the host does with wrenches.
    pub coupling: WrenchCoupling,
}

impl PairEnergyAccount {
    /// Whether an episode, over or not, has gained energy.
    pub fn gains_energy(&self) -> bool {
        self.episodes_gained > 0 || self.episode.verdict() == Verdict::Gained
    }

    /// What to do about a pair that makes energy.
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
