//! Warnings and notes of the step check before the first frame.

use crate::asking::of_spring;
use crate::limits::{GroupLimits, PairLimits, SpringLimit};
use crate::mass::StepPlan;
use crate::spring::Spring;
use pong_engine::WrenchCoupling;

/// A failure at a step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StepWarning {
    /// A contact gains energy.
    TooLong {
        /// The movable groups, the contact and the longest stable step.
        told: String,
    },
    /// A bounce is less accurate than asked for.
    TooCoarse {
        /// The movable groups, the error and the longest step without it.
        told: String,
    },
    /// A pair or group could not be judged.
    NotJudged {
        /// Its name and the reason.
        told: String,
    },
}

impl std::fmt::Display for StepWarning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::TooLong { told } | Self::TooCoarse { told } => f.write_str(told),
            Self::NotJudged { told } => write!(f, "step not judged: {told}"),
        }
    }
}

/// Possible failure at a step: if all contacts that can act on one movable group act at once, it may gain
/// energy; one contact alone does not ([`StepWarning::TooLong`]).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StepNote {
    /// The movable group, the number of contacts, and the longest step that is surely stable.
    pub told: String,
}

impl std::fmt::Display for StepNote {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.told)
    }
}

/// Zero-order hold adds energy to an undamped spring at any step; below this ω·dt no warning is given.
const HELD_UNDAMPED: f64 = 0.1;

/// All warnings of a report, those of instability first.
pub(crate) fn warnings(pairs: &[PairLimits], not_judged: &[String], plan: &StepPlan) -> Vec<StepWarning> {
    let mut told = Vec::new();
    for pair in pairs {
        told.extend(unstable(pair, plan).map(|told| StepWarning::TooLong { told }));
    }
    for pair in pairs.iter().filter(|pair| unstable(pair, plan).is_none()) {
        told.extend(coarse(pair, plan).map(|told| StepWarning::TooCoarse { told }));
    }
    told.extend(not_judged.iter().map(|cause| StepWarning::NotJudged { told: cause.clone() }));
    told
}

/// Note of the unproven limits, for the worst group only: they are bounds, and the cure is the same. `asks`
/// returns the limiting term of a group's contacts.
pub(crate) fn notes(
    pairs: &[PairLimits],
    groups: &[GroupLimits],
    plan: &StepPlan,
    asks: impl Fn(&str) -> Option<String>,
) -> Option<StepNote> {
    let warned = |group: &GroupLimits| {
        pairs.iter().any(|pair| pair.groups.contains(&group.group) && unstable(pair, plan).is_some())
    };
    let together = groups.iter().filter(|group| !warned(group) && may_grow(group, plan));
    let together: Vec<&GroupLimits> = together.collect();
    let worst = together.iter().min_by(|x, y| x.stable_step.total_cmp(&y.stable_step))?;
    let asks = asks(&worst.group).map_or_else(String::new, |term| format!("; {term}"));
    Some(StepNote { told: may(worst, together.len() - 1, plan) + &asks })
}

/// Note of the solids that would gain energy at the speed that a fall can reach, for the worst pair only. `pairs` are
/// their limits at that speed.
pub(crate) fn fall_note(pairs: &[PairLimits], speed: f64, plan: &StepPlan) -> Option<StepNote> {
    let unstable_pairs = pairs.iter().filter_map(|pair| Some((pair, unstable(pair, plan)?)));
    let unstable_pairs: Vec<_> = unstable_pairs.collect();
    let (_, text) = unstable_pairs.iter().min_by(|(x, _), (y, _)| x.stable_step.total_cmp(&y.stable_step))?;
    let others = match unstable_pairs.len() - 1 {
        0 => String::new(),
        1 => "; so it is with 1 more pair".to_owned(),
        more => format!("; so it is with {more} more pairs"),
    };
    Some(StepNote {
        told: format!("at {speed:.3e} m/s, which a fall in the scene can reach, {text}{others}"),
    })
}

/// Returns true if a contact of the pair gains energy at the step.
pub(crate) fn is_unstable(pair: &PairLimits, plan: &StepPlan) -> bool {
    unstable(pair, plan).is_some()
}

fn unstable(pair: &PairLimits, plan: &StepPlan) -> Option<String> {
    if grows(&pair.normal, plan) {
        let cure = cure(pair.normal.stable_step, "give the surfaces some");
        return Some(gains(pair, 0, &pair.normal, plan) + &cure);
    }
    let friction = pair.friction.filter(|friction| grows(friction, plan))?;
    let cure = cure(friction.stable_step, "give the friction some");
    Some(gains(pair, 1, &friction, plan) + &cure)
}

/// Text of the contact that gains energy, and its limiting term: of the normal spring (0) or the friction spring (1).
fn gains(pair: &PairLimits, term: usize, limit: &SpringLimit, plan: &StepPlan) -> String {
    let what = ["a contact", "friction"][term];
    let [a, b] = &pair.groups;
    let [one, other] = &pair.surfaces[term];
    let flat = pair.areas[term].map_or_else(String::new, |area| format!(", flat on {area:.3e} m²"));
    let (k, c, mass) = (limit.spring.stiffness, limit.spring.damping, limit.mass);
    let lever = if mass < 0.999 * pair.mass { " (where its lever is longest)" } else { "" };
    format!(
        "`{a}` and `{b}`: {what} of {k:.3e} N/m and {c:.3e} N·s/m (surfaces `{one}` and `{other}`{flat}) on {mass:.3e} kg{lever}, by its \
         {}, gains energy at a step of {:.3e} s; ",
        of_spring(&limit.spring, plan.coupling, mass),
        plan.step,
    )
}

fn may_grow(group: &GroupLimits, plan: &StepPlan) -> bool {
    // Undamped springs are treated as for a single one: below `HELD_UNDAMPED` the gain is left to the host.
    let damping = if group.least_damped > 0.0 { group.spring.damping } else { 0.0 };
    let spring = Spring { damping, ..group.spring };
    grows(&SpringLimit { spring, mass: group.mass, stable_step: group.stable_step }, plan)
}

fn may(worst: &GroupLimits, others: usize, plan: &StepPlan) -> String {
    let GroupLimits { group, contacts, spring, stable_step, .. } = worst;
    let who = match contacts {
        0 => "its springs are".to_owned(),
        1 => "a contact with its lever and friction can be".to_owned(),
        _ => format!("up to {contacts} contacts can act on it at once, together"),
    };
    let surely = match stable_step {
        0.0 => "no step is surely stable without damping of every contact".to_owned(),
        _ => format!("up to {stable_step:.3e} s is surely stable"),
    };
    let others = match others {
        0 => String::new(),
        1 => "; so it is with 1 more movable group".to_owned(),
        _ => format!("; so it is with {others} more movable groups"),
    };
    format!(
        "`{group}`: {who} as stiff as {:.3e} N/m at its mass centre; a step of {:.3e} s may gain energy then, {surely}{others}",
        spring.stiffness, plan.step,
    )
}

fn grows(limit: &SpringLimit, plan: &StepPlan) -> bool {
    if plan.step < limit.stable_step {
        return false;
    }
    let frequency = (limit.spring.stiffness / limit.mass).sqrt();
    let held_undamped =
        matches!(plan.coupling, WrenchCoupling::ZeroOrderHold { .. }) && limit.spring.damping == 0.0;
    !(held_undamped && plan.step * frequency < HELD_UNDAMPED)
}

fn cure(longest: f64, undamped: &str) -> String {
    if longest > 0.0 {
        format!("the longest stable step is {longest:.3e} s, less where several touch at once")
    } else {
        format!("no step is stable without damping; {undamped}")
    }
}

fn coarse(pair: &PairLimits, plan: &StepPlan) -> Option<String> {
    let (bounce, wanted) = (pair.bounce?, plan.accuracy?);
    let error = &bounce.error;
    if error.is_within(&wanted) {
        return None;
    }
    let [a, b] = &pair.groups;
    let longest = bounce.accurate_step(plan.coupling, &wanted);
    Some(format!(
        "`{a}` and `{b}`: a bounce on one contact is off by {} of its depth and {} of its rebound at a step of {:.3e} s; \
         for {} and {} give at most {longest:.3e} s, and less where several contacts stop the bodies together",
        percent(error.depth),
        percent(error.rebound),
        plan.step,
        percent(wanted.depth),
        percent(wanted.rebound),
    ))
}

fn percent(share: f64) -> String {
    if share > 10.0 { "more than 1000 %".to_owned() } else { format!("{:.2} %", 100.0 * share) }
}
