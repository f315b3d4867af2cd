//! Energy accounts: what bodies gave to contacts, what they got back, and where the rest went.
//!
//! ```text
//! taken + put_in + made = returned + stored + damping_loss + friction_loss
//! ```
//!
//! holds to rounding for each contact, for each pair of movable groups and for all of them together.

use crate::ids::{InterfaceId, PairId};
use std::fmt::Write as _;

/// What the host does with a wrench. The engine cannot see it, and the work that a wrench does depends on it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WrenchUse {
    /// Evaluated again within every step, as Runge-Kutta methods do. Work by the trapezoid rule, which is of second
    /// order; what it may be off by is in [`Account::resolution`].
    #[default]
    Stages,
    /// Gives the velocity with which the bodies then move, once a step: semi-implicit Euler. The trapezoid rule is exact
    /// then, for each force acts over half of the displacement before it and half of the one after.
    SemiImplicit,
    /// Held from one commit to the next, as by a host that steps the world once a frame: the work is that of the held
    /// wrench over the displacement, which the next commit tells.
    Held {
        /// How many whole frames the wrench comes late; at most [`LATE_MAX`](Self::LATE_MAX).
        late: u32,
    },
}

impl WrenchUse {
    /// The latest that a wrench may come, frames.
    pub const LATE_MAX: u32 = 16;

    /// How many frames late.
    pub(crate) fn late(self) -> usize {
        match self {
            Self::Held { late } => late as usize,
            Self::Stages | Self::SemiImplicit => 0,
        }
    }
}

/// Whether a contact gave back more energy than it got.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It gave back less.
    Lost,
    /// As much, as far as the accounts can tell: see [`Account::resolution`].
    Unresolved,
    /// It gave back more: it makes energy.
    ReturnedMore,
}

/// Energies of a contact, of a pair of movable groups, or of all, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Account {
    /// What the bodies gave: work of the wrench on them, where it was negative.
    pub taken: f64,
    /// What the bodies got back: work of the wrench on them, where it was positive.
    pub returned: f64,
    /// Stored without work: where the host put bodies into each other (first frame, after a forget), less what it let
    /// be forgotten. Of a contact that began while the pair touched already: what it may have taken over from another.
    pub put_in: f64,
    /// Made by holding the wrench: its work on the bodies less that of the force as it would have followed their motion.
    pub made: f64,
    /// Stored in normal springs and bristles now.
    pub stored: f64,
    /// Lost in normal damping.
    pub damping_loss: f64,
    /// Lost in friction.
    pub friction_loss: f64,
    /// What `returned − taken` may be off by, rounding apart: the work in intervals in which contact began or ended, if
    /// the work is that of the trapezoid rule for [`WrenchUse::Stages`]; else 0.
    pub resolution: f64,
}

/// Rounding of sums of works, relative to all that went in and out.
const ROUNDING: f64 = 1e-9;

impl Account {
    /// Numbers that are remembered.
    pub(crate) const NUMBERS: usize = 7;

    pub(crate) fn from_numbers(numbers: &[f64]) -> Self {
        Self {
            taken: numbers[0],
            returned: numbers[1],
            put_in: numbers[2],
            made: numbers[3],
            damping_loss: numbers[4],
            friction_loss: numbers[5],
            resolution: numbers[6],
            stored: 0.0,
        }
    }

    /// All but `stored`, which is found anew.
    pub(crate) fn numbers(&self) -> [f64; Self::NUMBERS] {
        [
            self.taken,
            self.returned,
            self.put_in,
            self.made,
            self.damping_loss,
            self.friction_loss,
            self.resolution,
        ]
    }

    /// Takes in work on the bodies.
    pub(crate) fn work(&mut self, done: f64) {
        *(if done > 0.0 { &mut self.returned } else { &mut self.taken }) += done.abs();
    }

    /// Adds another account.
    pub(crate) fn add(&mut self, other: &Self) {
        self.taken += other.taken;
        self.returned += other.returned;
        self.put_in += other.put_in;
        self.made += other.made;
        self.stored += other.stored;
        self.damping_loss += other.damping_loss;
        self.friction_loss += other.friction_loss;
        self.resolution += other.resolution;
    }

    /// Work done on the bodies so far, J: over a closed path, whose ends store the same, what it gained them.
    pub fn net_work(&self) -> f64 {
        self.returned - self.taken
    }

    /// What was returned beyond what was taken and put in, J.
    pub fn excess(&self) -> f64 {
        self.returned - self.taken - self.put_in
    }

    /// Whether more was returned than taken.
    pub fn verdict(&self) -> Verdict {
        let doubt = self.resolution + ROUNDING * (self.taken + self.returned + self.put_in.abs());
        match self.excess() {
            excess if excess > doubt => Verdict::ReturnedMore,
            excess if excess > -doubt => Verdict::Unresolved,
            _ => Verdict::Lost,
        }
    }

    /// What the accounts fail to close by, J: rounding, if they are right.
    pub fn imbalance(&self) -> f64 {
        let went_in = self.taken + self.put_in + self.made;
        went_in - (self.returned + self.stored + self.damping_loss + self.friction_loss)
    }
}

/// Accounts of a pair of movable groups at the last commit.
///
/// A *touch* lasts from the first contact of the pair until nothing of it touches any more, and no late wrench of it is on
/// its way. Verdicts are those of touches: energy may go from one contact of a pair to another, a ball from facet to facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairAccount {
    /// The pair of Objects.
    pub pair: PairId,
    /// The two movable groups.
    pub interfaces: [InterfaceId; 2],
    /// Since the world began.
    pub total: Account,
    /// Of the touch that lasts; all zero if nothing touches.
    pub touch: Account,
    /// Whether a touch lasts.
    pub touching: bool,
    /// Touches that have ended.
    pub touches: u64,
    /// Of those, the ones that returned more than they took.
    pub returned_more: u64,
    /// Of those, the ones of which the accounts cannot tell.
    pub unresolved: u64,
    /// What touches returned too much, all together, J.
    pub excess: f64,
    /// What one touch returned too much at most, J.
    pub worst_excess: f64,
    /// Stiffness of the stiffest contact of the pair, N/m, and its damping, N·s/m, if it does not depend on the depth.
    pub stiffest: Option<(f64, f64)>,
    /// What the host does with wrenches.
    pub wrench_use: WrenchUse,
}

impl PairAccount {
    /// Whether a touch, over or not, has returned more than it took.
    pub fn makes_energy(&self) -> bool {
        self.returned_more > 0 || self.touch.verdict() == Verdict::ReturnedMore
    }

    /// What to do about a pair that makes energy.
    pub fn remedy(&self) -> String {
        let mut text = String::from("shorten the step, or give the surfaces more damping");
        match (self.wrench_use, self.stiffest) {
            (WrenchUse::Held { late }, Some((k, c))) => {
                let share = 0.5 + f64::from(late);
                let _ = write!(
                    text,
                    ": a wrench held over a step dt loses energy only while c > k·dt·{share}, here k = {k:.3e} N/m and c = {c:.3e} N·s/m"
                );
                if c > 0.0 {
                    let _ = write!(text, ", at steps below {:.3e} s", c / (k * share));
                }
            }
            (WrenchUse::Held { late }, None) => {
                let share = 0.5 + f64::from(late);
                let _ = write!(
                    text,
                    ": a wrench held over a step dt loses energy only while the damping exceeds {share}·dt times the stiffness at hand"
                );
            }
            (WrenchUse::Stages | WrenchUse::SemiImplicit, Some((k, c))) => {
                let _ = write!(text, "; here k = {k:.3e} N/m and c = {c:.3e} N·s/m");
            }
            (WrenchUse::Stages | WrenchUse::SemiImplicit, None) => {}
        }
        text
    }
}
