//! Loads, springs and preloads of a scene.

use super::document::{Document, EndEntry, FrictionEntry, LoadEntry, PreloadEntry, SpringEntry};
use super::error::{At, Faults};
use super::poses::pose;
use super::setting::Setting;
use crate::body::{BodyId, RigidBody};
use crate::load::{Load, LoadHistory, LoadRow};
use crate::simulation::Simulation;
use crate::spring::{Spring, SpringEnd};
use pong_engine::{FrictionPreload, PairId};
use pong_geometry::Wrench;

/// Finds a body by its name in the scene.
fn body_named(
    setting: &Setting<'_>,
    bodies: &[RigidBody],
    name: &str,
    at: &mut At<'_, '_>,
) -> Option<BodyId> {
    let interface = setting.interface(name, at)?;
    // A body with a fault is missing here, but its fault is noted already.
    bodies.iter().position(|body| body.interface == Some(interface)).map(BodyId)
}

pub(crate) fn loads(setting: &Setting<'_>, bodies: &[RigidBody], faults: &mut Faults<'_>) -> Vec<Load> {
    let mut loads = Vec::new();
    for (number, entry) in setting.document.loads.iter().enumerate() {
        let at = &mut faults.at(format!("loads[{number}]"));
        let body = body_named(setting, bodies, &entry.body, at);
        at.finite("point", &entry.point);
        let history = history(entry, at);
        if let Some(line) = history.fault() {
            at.note_line(&line);
        }
        let (point, axes) = (entry.point.into(), entry.axes);
        loads.extend(body.map(|body| Load { body, point, axes, history }));
    }
    loads
}

fn history(entry: &LoadEntry, at: &mut At<'_, '_>) -> LoadHistory {
    if entry.table.is_some() == (entry.force.is_some() || entry.moment.is_some()) {
        let cause = "it is neither a constant nor a table";
        at.note(cause, "give `force` and/or `moment`, or `table`, not both");
    }
    let mut wrench = |force: [f64; 3], moment: [f64; 3]| {
        at.finite("force", &force);
        at.finite("moment", &moment);
        Wrench { force: force.into(), moment: moment.into() }
    };
    match &entry.table {
        None => {
            LoadHistory::Constant(wrench(entry.force.unwrap_or_default(), entry.moment.unwrap_or_default()))
        }
        Some(rows) => LoadHistory::Table(
            rows.iter()
                .map(|row| LoadRow { time: row.time, wrench: wrench(row.force, row.moment) })
                .collect(),
        ),
    }
}

pub(crate) fn springs(setting: &Setting<'_>, bodies: &[RigidBody], faults: &mut Faults<'_>) -> Vec<Spring> {
    let mut springs = Vec::new();
    for (number, entry) in setting.document.springs.iter().enumerate() {
        let at = &mut faults.at(format!("springs[{number}]"));
        let mut end = |end: &EndEntry| match end {
            EndEntry::Ground { position, orientation } => {
                Some(SpringEnd::ground(pose(position, orientation, at)))
            }
            EndEntry::On { body, position, orientation } => {
                let frame = pose(position, orientation, at);
                let body = body_named(setting, bodies, body, at);
                body.map(|body| SpringEnd::on(body, frame))
            }
        };
        let ends = (end(&entry.first), end(&entry.second));
        if let (Some(first), Some(second)) = ends {
            springs.push(spring(entry, first, second, at));
        }
    }
    springs
}

fn spring(entry: &SpringEntry, first: SpringEnd, second: SpringEnd, at: &mut At<'_, '_>) -> Spring {
    let spring = Spring {
        first,
        second,
        stiffness: entry.stiffness,
        damping: entry.damping,
        preload: entry.preload,
        rest: pose(&entry.rest.position, &entry.rest.orientation, at),
    };
    if let Some(line) = spring.fault() {
        at.note_line(&line);
    }
    spring
}

/// Sets the initial friction and returns what was set; warns of a pair without any.
pub(super) fn preload(
    document: &Document,
    simulation: &mut Simulation,
    warnings: &mut Vec<String>,
    faults: &mut Faults<'_>,
) -> Vec<(PairId, FrictionPreload)> {
    let mut preloads = Vec::new();
    for PreloadEntry { pair: (a, b), friction } in &document.preload {
        let thing = format!("preload/({a}, {b})");
        let at = &mut faults.at(&thing);
        let Some(place) = document.pairs().iter().position(|(one, other)| one == a && other == b) else {
            let turned = document.pairs().iter().any(|(one, other)| one == b && other == a);
            let cause =
                if turned { "`pairs` has these two the other way round" } else { "`pairs` has no such pair" };
            at.note(cause, "name a pair of `pairs`, in its order");
            continue;
        };
        let (pair, _) =
            simulation.world().scene().pairs().nth(place).expect("every pair of the scene was made");
        let preload = match friction {
            FrictionEntry::Sliding => FrictionPreload::Sliding,
            FrictionEntry::Holding(force) => FrictionPreload::Holding((*force).into()),
        };
        match simulation.preload_friction(pair, &preload) {
            Err(error) => at.note_line(&error.to_string()),
            Ok(0) => warnings.push(format!(
                "{thing}: no bristle is there to be preloaded at the start; place the two so that they touch (for `Sliding`: and \
                 move), with `Bristle` friction, or leave it out"
            )),
            Ok(_) => {}
        }
        preloads.push((pair, preload));
    }
    preloads
}
