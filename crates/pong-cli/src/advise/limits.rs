//! Limits of a step: a table of contacts, and the first failure.

use crate::text::{count, number};
use pong_advise::{
    GroupLimits, PairLimits, SpringLimit, StepPlan, StepReport, critical_damping, critical_delay,
    longest_stable_step,
};
use pong_model::printable;
use pong_report::table;

/// The tables and the verdict. Along the surface a contact feels `friction_share` of its mass.
pub(super) fn told(report: &StepReport, plan: &StepPlan, friction_share: f64) -> String {
    let mut text = String::new();
    if !report.pairs.is_empty() {
        text += "Single contacts, each on the effective mass of its two groups (a bounce), and on the least one (stability):\n";
        let heading = [
            "between",
            "kg",
            "least kg",
            "k N/m",
            "c N·s/m",
            "stable to s",
            "friction to s",
            "accurate to s",
            "depth off",
            "rebound off",
        ];
        let rows: Vec<Vec<String>> = report.pairs.iter().map(|pair| row(pair, plan)).collect();
        text += &table::aligned(&heading, &rows);
        if report.pairs.iter().any(|pair| pair.bounce.is_some()) {
            text += "Depth and rebound are those of one contact that carries the whole mass. Where n contacts share it, they are \
                     farther off: ask without a file, with `--contacts n`.\n";
        }
        text += &friction(report, plan, friction_share);
        text += &delays(report, plan);
    }
    text += &together(report);
    text += &first_to_fail(report, plan);
    for cause in &report.not_judged {
        text += &format!("not judged: {}\n", printable(cause));
    }
    text
}

/// Sticking friction as a spring with its damper: its frequency, and the damping that would stop the ringing.
fn friction(report: &StepReport, plan: &StepPlan, share: f64) -> String {
    let springs: Vec<(&PairLimits, SpringLimit)> = report
        .pairs
        .iter()
        .filter_map(|pair| Some((pair, pair.friction.filter(|friction| friction.spring.stiffness > 0.0)?)))
        .collect();
    if springs.is_empty() {
        return String::new();
    }
    let heading = [
        "friction between",
        "kg",
        "k_t N/m",
        "c_t N·s/m",
        "rings at Hz",
        "critical c_t N·s/m",
        "stable with it to s",
    ];
    let row = |(pair, limit): &(&PairLimits, SpringLimit)| {
        let (mass, k, c) = (share * pair.mass, limit.spring.stiffness, limit.spring.damping);
        let critical = critical_damping(k, mass, plan.coupling, plan.step);
        // Frequency of a damped oscillation; with enough damping there is none.
        let ringing = k / mass - 0.25 * (c / mass) * (c / mass);
        vec![
            format!("{} · {}", pair.surfaces[1][0], pair.surfaces[1][1]),
            number(mass),
            number(k),
            number(c),
            if ringing > 0.0 { number(ringing.sqrt() / std::f64::consts::TAU) } else { "-".to_owned() },
            number(critical),
            number(longest_stable_step(plan.coupling, k, critical, mass)),
        ]
    };
    let rows: Vec<Vec<String>> = springs.iter().map(row).collect();
    "What sticks, as a spring on the mass that it feels along the surface (docs/advise.md, Damping of friction):\n".to_owned()
        + &table::aligned(&heading, &rows)
}

/// Delays beyond which contacts gain energy, where the host holds the wrench.
fn delays(report: &StepReport, plan: &StepPlan) -> String {
    let lag = plan.coupling.lag() * plan.step;
    if lag == 0.0 {
        return String::new();
    }
    let row = |pair: &PairLimits| {
        let spring = pair.normal.spring;
        let delay = critical_delay(spring.stiffness, spring.damping, pair.normal.mass);
        let verdict = if lag < delay { "loses energy" } else { "gains energy" };
        vec![
            format!("{} · {}", pair.groups[0], pair.groups[1]),
            number(delay),
            number(lag),
            verdict.to_owned(),
        ]
    };
    let springs = report.pairs.iter().filter(|pair| pair.normal.spring.stiffness > 0.0);
    let rows: Vec<Vec<String>> = springs.map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    "How late a wrench may act (docs/advise.md, Late wrenches):\n".to_owned()
        + &table::aligned(
            &["late wrench between", "critical delay s", "mean delay s", "a contact that lasts"],
            &rows,
        )
}

/// Contacts that can act on one movable group at once.
fn together(report: &StepReport) -> String {
    if report.groups.is_empty() {
        return String::new();
    }
    let heading =
        ["all that can act at once on", "kg", "primitives", "k N/m", "c N·s/m", "surely stable to s"];
    let row = |group: &GroupLimits| {
        vec![
            group.group.clone(),
            number(group.mass),
            group.contacts.to_string(),
            number(group.spring.stiffness),
            number(group.spring.damping),
            number(group.stable_step),
        ]
    };
    let rows: Vec<Vec<String>> = report.groups.iter().map(row).collect();
    let scene = report.surely_stable_step();
    "A bound of their sums (levers and inertia counted; docs/advise.md):\n".to_owned()
        + &table::aligned(&heading, &rows)
        + &format!("  the scene is surely stable to {} s\n", number(scene))
}

fn row(pair: &PairLimits, plan: &StepPlan) -> Vec<String> {
    let dash = || "-".to_owned();
    let share = |share: f64| format!("{:.2} %", 100.0 * share);
    vec![
        format!("{} · {}", pair.groups[0], pair.groups[1]),
        number(pair.mass),
        number(pair.normal.mass),
        number(pair.normal.spring.stiffness),
        number(pair.normal.spring.damping),
        number(pair.normal.stable_step),
        pair.friction.map_or_else(dash, |friction| number(friction.stable_step)),
        accurate_step(pair, plan).map_or_else(dash, number),
        pair.bounce.map_or_else(dash, |bounce| share(bounce.error.depth)),
        pair.bounce.map_or_else(dash, |bounce| share(bounce.error.rebound)),
    ]
}

fn accurate_step(pair: &PairLimits, plan: &StepPlan) -> Option<f64> {
    let (bounce, accuracy) = (pair.bounce?, plan.accuracy?);
    Some(bounce.accurate_step(plan.coupling, &accuracy))
}

/// The lowest of all limits of the step.
fn first_to_fail(report: &StepReport, plan: &StepPlan) -> String {
    let mut limits: Vec<(f64, String)> = Vec::new();
    for pair in &report.pairs {
        let between = format!("`{}` and `{}`", pair.groups[0], pair.groups[1]);
        limits.extend(
            accurate_step(pair, plan)
                .map(|step| (step, format!("the rebound between {between} leaves its closed form"))),
        );
        limits.push((pair.normal.stable_step, format!("contact between {between} gains energy")));
        limits.extend(pair.friction.map(|limit| {
            (limit.stable_step, format!("friction that sticks between {between} gains energy"))
        }));
    }
    let first = limits.into_iter().min_by(|x, y| x.0.total_cmp(&y.0));
    let Some((step, what)) = first else { return String::new() };
    let when = match (step, step < plan.step) {
        (0.0, _) => "at any step".to_owned(),
        (_, true) => format!("beyond {} s, and the step is {} s", number(step), number(plan.step)),
        (_, false) => format!("beyond {} s; the step is shorter", number(step)),
    };
    format!("First to go wrong: {} {when}\n", printable(&what)) + &may_go_wrong(report, step)
}

/// A limit below that one from a bound of all contacts together, which may but need not fail.
fn may_go_wrong(report: &StepReport, first: f64) -> String {
    let worst = report.groups.iter().min_by(|x, y| x.stable_step.total_cmp(&y.stable_step));
    match worst {
        Some(group) if group.stable_step < first => format!(
            "Before that, {} on `{}` may gain energy beyond {} s\n",
            match group.contacts {
                0 => "the springs".to_owned(),
                contacts => count(contacts, "contact", "contacts together"),
            },
            printable(&group.group),
            number(group.stable_step)
        ),
        _ => String::new(),
    }
}
