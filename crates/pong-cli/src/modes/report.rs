//! Modes as a table, CSV, JSON and notes.

use crate::text::{count, number};
use pong_advise::{BodyShape, Mode, ModeKind, Modes};
use pong_executive::scene::BuiltScene;
use pong_executive::{Linearised, Vec3};
use pong_model::printable;
use pong_report::table;
use serde_json::{Value, json};

/// Number of contacts and springs that are named for each mode.
const NAMED: usize = 4;
/// Least share of the energy of a mode for which a contact or spring is named.
const LEAST_SHARE: f64 = 0.02;
/// Component of a unit vector from which it counts as along an axis.
const ALONG: f64 = 0.98;

pub(super) fn text(built: &BuiltScene, state: &str, linear: &Linearised, modes: &Modes) -> String {
    let mut text = format!(
        "{}, {state}: {}, {} ({} slipping)\n",
        printable(&built.name),
        count(linear.bodies.len(), "free body", "free bodies"),
        count(linear.contacts, "contact", "contacts"),
        linear.slipping,
    );
    if modes.modes.is_empty() {
        return text + "No body is free, so there are no modes.\n";
    }
    let heading = ["mode", "Hz", "damping", "shape", "carried by"];
    let rows = modes.modes.iter().enumerate().map(|(index, mode)| {
        let frequency = match mode.kind {
            ModeKind::Rigid => "rigid".to_owned(),
            ModeKind::Oscillation => number(mode.frequency),
            ModeKind::Unstable => "unstable".to_owned(),
        };
        let damping = mode.damping_ratio.map_or_else(|| "-".to_owned(), number);
        vec![(index + 1).to_string(), frequency, damping, shape(linear, mode), carried(linear, mode)]
    });
    text += &table::aligned_left(&heading, &rows.collect::<Vec<_>>());
    for growth in &modes.growths {
        text += &match growth.frequency {
            0.0 => format!("Unstable: a motion grows by e in {} s\n", number(1.0 / growth.rate)),
            frequency => format!(
                "Flutter: an oscillation of {} Hz grows by e in {} s\n",
                number(frequency),
                number(1.0 / growth.rate)
            ),
        };
    }
    text
}

/// Statements about the validity of the modes.
pub(super) fn notes(built: &BuiltScene, linear: &Linearised) -> Vec<String> {
    let mut notes = Vec::new();
    if let Some(why) = &linear.by_differences {
        notes.push(format!("the tangents of the contacts come from differences, to about 6 digits: {why}"));
    }
    if linear.slipping > 0 {
        let slipping = count(linear.slipping, "contact slips", "contacts slip");
        notes.push(format!("{slipping}: frequencies are those of the symmetric part of the stiffness"));
    }
    let gravity = built.simulation.gravity().norm();
    if let Some((body, acceleration)) = linear.unbalanced
        && acceleration > 1e-3 * if gravity > 0.0 { gravity } else { 1.0 }
    {
        let name = built.simulation.bodies().find(|(known, _)| *known == body).map(|(_, body)| &body.name);
        notes.push(format!(
            "`{}` is not in equilibrium: its acceleration is {} m/s²; --settle runs the scene until it rests",
            name.map_or("", String::as_str),
            number(acceleration)
        ));
    }
    notes
}

/// The body and axis with the largest share of the kinetic energy, in words.
fn shape(linear: &Linearised, mode: &Mode) -> String {
    let parts = mode.shape.iter().enumerate().flat_map(|(body, shape)| {
        let BodyShape { translation, rotation, translation_share, rotation_share } = shape;
        [
            (*translation_share, body, "moves along", *translation),
            (*rotation_share, body, "turns about", *rotation),
        ]
    });
    let largest = parts.max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((share, body, how, vector)) = largest else { return String::new() };
    format!("`{}` {how} {} ({:.0} %)", linear.system.bodies()[body].name, axis(&vector), 100.0 * share)
}

fn axis(vector: &Vec3) -> String {
    let unit = vector / vector.norm().max(f64::MIN_POSITIVE);
    match ["x", "y", "z"].iter().zip(unit.iter()).find(|(_, part)| part.abs() > ALONG) {
        Some((name, _)) => (*name).to_owned(),
        None => format!("({:.2}, {:.2}, {:.2})", unit.x, unit.y, unit.z),
    }
}

/// The contacts and springs with the largest shares of the energy of a mode.
fn carried(linear: &Linearised, mode: &Mode) -> String {
    let mut shares: Vec<(f64, &str)> = mode
        .shares
        .iter()
        .zip(linear.system.carriers())
        .map(|(share, carrier)| (*share, carrier.name.as_str()))
        .filter(|(share, _)| share.abs() >= LEAST_SHARE)
        .collect();
    shares.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    let mut named: Vec<String> =
        shares.iter().take(NAMED).map(|(share, name)| format!("{name} {:.0} %", 100.0 * share)).collect();
    if shares.len() > NAMED {
        named.push(format!("{} more", shares.len() - NAMED));
    }
    named.join(", ")
}

fn kind_name(kind: ModeKind) -> &'static str {
    match kind {
        ModeKind::Rigid => "rigid",
        ModeKind::Oscillation => "oscillation",
        ModeKind::Unstable => "unstable",
    }
}

/// One row for each mode and body.
pub(super) fn csv(linear: &Linearised, modes: &Modes) -> String {
    let mut text =
        "mode,kind,rate_1_s2,frequency_hz,damping_ratio,body,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad\n".to_owned();
    for (index, mode) in modes.modes.iter().enumerate() {
        for (body, shape) in linear.system.bodies().iter().zip(&mode.shape) {
            let numbers = shape.translation.iter().chain(shape.rotation.iter());
            let numbers: Vec<String> = numbers.map(|value| format!("{value:e}")).collect();
            text += &format!(
                "{},{},{:e},{:e},{},\"{}\",{}\n",
                index + 1,
                kind_name(mode.kind),
                mode.rate,
                mode.frequency,
                mode.damping_ratio.map_or_else(String::new, |ratio| format!("{ratio:e}")),
                body.name.replace('"', "\"\""),
                numbers.join(",")
            );
        }
    }
    text
}

pub(super) fn json(linear: &Linearised, modes: &Modes) -> Result<String, serde_json::Error> {
    let vector = |vector: &Vec3| Value::from(vector.as_slice().to_vec());
    let shapes = |mode: &Mode| -> Vec<Value> {
        let bodies = linear.system.bodies().iter().zip(&mode.shape);
        let one = bodies.map(|(body, shape)| {
            json!({ "body": body.name, "translation_m": vector(&shape.translation),
                "rotation_rad": vector(&shape.rotation), "translation_share": shape.translation_share,
                "rotation_share": shape.rotation_share })
        });
        one.collect()
    };
    let shares = |mode: &Mode| -> Vec<Value> {
        let carriers = linear.system.carriers().iter().zip(&mode.shares);
        carriers
            .map(|(carrier, share)| json!({ "name": carrier.name, "contacts": carrier.contacts, "share": share }))
            .collect()
    };
    let all = modes.modes.iter().enumerate().map(|(index, mode)| {
        json!({ "mode": index + 1, "kind": kind_name(mode.kind), "rate_1_s2": mode.rate,
            "frequency_hz": mode.frequency, "damping_ratio": mode.damping_ratio, "shape": shapes(mode),
            "carried_by": shares(mode) })
    });
    let growths = modes
        .growths
        .iter()
        .map(|growth| json!({ "rate_1_s": growth.rate, "frequency_hz": growth.frequency }));
    let whole = json!({ "modes": all.collect::<Vec<_>>(), "growing": growths.collect::<Vec<_>>(),
        "by_differences": linear.by_differences, "contacts": linear.contacts, "slipping": linear.slipping });
    Ok(serde_json::to_string_pretty(&whole)? + "\n")
}
