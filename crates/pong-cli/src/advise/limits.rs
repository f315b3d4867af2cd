//! What a step can hold: a table of contacts, and what goes wrong first.

use crate::text::{number, table};
use pong_engine::advice::{PairLimits, StepPlan, StepReport};

/// The table and the verdict.
pub(super) fn told(report: &StepReport, plan: &StepPlan) -> String {
    let mut text = String::new();
    if !report.pairs.is_empty() {
        text += "Single contacts, each on the effective mass of its two groups:\n";
        let heading = [
            "between",
            "kg",
            "k N/m",
            "c N·s/m",
            "stable to s",
            "friction to s",
            "accurate to s",
            "depth off",
            "rebound off",
        ];
        let rows: Vec<Vec<String>> = report.pairs.iter().map(|pair| row(pair, plan)).collect();
        text += &table(&heading, &rows);
        text += &first_to_fail(report, plan);
    }
    for cause in &report.not_judged {
        text += &format!("not judged: {cause}\n");
    }
    text
}

fn row(pair: &PairLimits, plan: &StepPlan) -> Vec<String> {
    let dash = || "-".to_owned();
    let share = |share: f64| format!("{:.2} %", 100.0 * share);
    vec![
        format!("{} · {}", pair.groups[0], pair.groups[1]),
        number(pair.mass),
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

/// Of everything that limits the step, what limits it most.
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
    format!("First to go wrong: {what} {when}\n")
}
