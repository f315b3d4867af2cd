//! The parts of a contact that can limit a step.

use crate::spring::{ContactSprings, Spring};

/// A part of a contact that can limit a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// k.
    NormalStiffness,
    /// c, or the damping slope of laws that follow the depth.
    NormalDamping,
    /// k_t of sticking friction.
    FrictionStiffness,
    /// c_t, or the slope of regularised friction.
    FrictionDamping,
}

impl std::fmt::Display for Term {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::NormalStiffness => "normal stiffness",
            Self::NormalDamping => "normal damping",
            Self::FrictionStiffness => "friction stiffness",
            Self::FrictionDamping => "friction damping",
        })
    }
}

/// Factor of a removed term: so small that no step feels it, while the equations stay regular.
pub(crate) const FAINT: f64 = 1e-9;

impl ContactSprings {
    /// The contact without some of its terms.
    pub fn without(&self, terms: &[Term]) -> Self {
        let faint = |term: Term| if terms.contains(&term) { FAINT } else { 1.0 };
        let weaken = |spring: Spring, stiffness: Term, damping: Term| Spring {
            stiffness: spring.stiffness * faint(stiffness),
            damping: spring.damping * faint(damping),
        };
        Self {
            normal: weaken(self.normal, Term::NormalStiffness, Term::NormalDamping),
            friction: self
                .friction
                .map(|friction| weaken(friction, Term::FrictionStiffness, Term::FrictionDamping)),
            bounces_by_formula: self.bounces_by_formula,
        }
    }

    /// The spring that a term belongs to.
    pub fn spring_of(&self, term: Term) -> Option<Spring> {
        match term {
            Term::NormalStiffness | Term::NormalDamping => Some(self.normal),
            Term::FrictionStiffness | Term::FrictionDamping => self.friction,
        }
    }
}
