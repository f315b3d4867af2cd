//! The term of the contacts that limits the step: stiffness or damping, of the normal force or of friction,
//! and its surfaces.
//!
//! The limiting term is the one whose removal would lengthen the step most. Where no removal alone does,
//! because another term as large remains, both are named.
//! left, both are named.

use crate::coupling::{longest_stable_step, surely_stable_with};
use crate::mass::{SpringRates, StepPlan};
use crate::setting::Setting;
use crate::spring::{ContactSprings, Spring};
use crate::term::{FAINT, Term};
use crate::together::{Load, pair_load};
use pong_engine::WrenchCoupling;

/// Text where springs of the host limit the step more than any term of the contacts.
pub(crate) const BY_SPRINGS: &str = "its springs ask for that";

/// Candidates: one term, or two that may be equally large.
const SUSPECTS: [&[Term]; 6] = [
    &[Term::NormalStiffness],
    &[Term::NormalDamping],
    &[Term::FrictionStiffness],
    &[Term::FrictionDamping],
    &[Term::NormalStiffness, Term::FrictionStiffness],
    &[Term::NormalDamping, Term::FrictionDamping],
];

/// Factor by which the step must grow without a term for that term alone to be named.
const ALONE: f64 = 1.1;

/// Returns whether stiffness or damping limits the longest stable step of one spring on one mass.
pub(crate) fn of_spring(spring: &Spring, coupling: WrenchCoupling, mass: f64) -> &'static str {
    let step = |k: f64, c: f64| longest_stable_step(coupling, k, c, mass);
    let (k, c) = (spring.stiffness, spring.damping);
    if step(FAINT * k, c) >= step(k, FAINT * c) { "stiffness" } else { "damping" }
}

/// The term that limits the surely stable step of a movable group, in words.
pub(crate) fn of_group(setting: &Setting<'_>, body: usize, plan: &StepPlan) -> Option<String> {
    let springs = setting.springs_on(body);
    let pairs = setting.scene.pairs().iter().filter(|pair| [pair.first, pair.second].contains(&body));
    let mut met = Vec::new();
    for pair in pairs {
        let Some(mass) = setting.effective_mass(pair) else { continue };
        if [pair.first, pair.second].iter().all(|body| setting.masses[*body].is_some()) {
            met.push((pair, mass, setting.known(pair, mass, plan).0));
        }
    }
    let step_with = |terms: &[Term], springs: SpringRates| {
        let (mut load, mut ratio) = (Load::default(), f64::INFINITY);
        for (pair, mass, known) in &met {
            load = load.plus(pair_load(setting, pair, *mass, plan, terms));
            ratio = known.iter().map(|known| least_damped(&known.springs, terms)).fold(ratio, f64::min);
        }
        let contacts = SpringRates { stiffness: load.stiffness_rate, damping: load.damping_rate };
        surely_stable_with(plan.coupling, contacts, ratio, springs)
    };
    let step_without = |terms: &[Term]| step_with(terms, springs);
    let whole = step_without(&[]);
    let longer = SUSPECTS.map(|terms| (terms, step_without(terms)));
    let longest = |suspects: &[(&'static [Term], f64)]| {
        // Of equal ones the first.
        suspects.iter().rev().copied().max_by(|x, y| x.1.total_cmp(&y.1))
    };
    if !springs.is_zero() {
        let by_contacts = longer.iter().map(|(_, step)| *step).fold(whole, f64::max);
        if met.is_empty() || step_with(&[], SpringRates::default()) > by_contacts {
            return Some(BY_SPRINGS.to_owned());
        }
    }
    let (terms, step) =
        longest(&longer[..4]).filter(|(_, step)| *step > ALONE * whole).or(longest(&longer))?;
    if step <= whole {
        return None;
    }
    let all = met.iter().flat_map(|(_, _, known)| known);
    let worst = all.max_by(|x, y| {
        size(&x.springs, terms[0], plan.coupling).total_cmp(&size(&y.springs, terms[0], plan.coupling))
    })?;
    let Spring { stiffness, damping } = worst.springs.spring_of(terms[0])?;
    let named: Vec<String> = terms.iter().map(ToString::to_string).collect();
    let [a, b] = &worst.surfaces;
    Some(format!(
        "its {} asks for that, most of all between `{a}` and `{b}` ({stiffness:.3e} N/m, {damping:.3e} N·s/m)",
        named.join(" and its ")
    ))
}

/// The least damping over stiffness of the springs whose stiffness remains, s.
fn least_damped(springs: &ContactSprings, without: &[Term]) -> f64 {
    let left = |term: Term| if without.contains(&term) { None } else { springs.spring_of(term) };
    let weak = springs.without(without);
    let ratio = |term: Term| {
        let spring = left(term).and(weak.spring_of(term)).filter(|spring| spring.stiffness > 0.0);
        spring.map_or(f64::INFINITY, |spring| spring.damping / spring.stiffness.max(f64::MIN_POSITIVE))
    };
    ratio(Term::NormalStiffness).min(ratio(Term::FrictionStiffness))
}

/// Size of a term; for a stiffness under a held wrench, its ratio to the damping.
fn size(springs: &ContactSprings, term: Term, coupling: WrenchCoupling) -> f64 {
    let Some(spring) = springs.spring_of(term) else { return -1.0 };
    match (term, coupling) {
        (Term::NormalStiffness | Term::FrictionStiffness, WrenchCoupling::ZeroOrderHold { .. }) => {
            spring.stiffness / spring.damping
        }
        (Term::NormalStiffness | Term::FrictionStiffness, _) => spring.stiffness,
        _ => spring.damping,
    }
}
