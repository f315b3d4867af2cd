//! Summary of a run as text.

use super::acting::Acting;
use super::statistics::Statistics;
use crate::text::{count, number, numbers};
use pong_engine::{PairEnergyAccount, Verdict};
use pong_executive::scene::BuiltScene;
use pong_executive::{BodyId, Simulation};
use pong_model::printable;
use pong_report::table;

pub(super) fn summary(built: &BuiltScene, statistics: &Statistics) -> String {
    let simulation = &built.simulation;
    let mut text = heading(built, statistics);
    text += &ends(simulation);
    text += &contacts(simulation, statistics);
    text += &energies(built, statistics);
    text += &statistics.acting.as_ref().map_or_else(String::new, Acting::told);
    if let Some([median, most, longest]) = statistics.step_times_us() {
        let [median, most, longest] = [median, most, longest].map(number);
        text += &format!("Time per step: median {median} µs, 99 % within {most} µs, longest {longest} µs\n");
    }
    text
}

fn heading(built: &BuiltScene, statistics: &Statistics) -> String {
    let simulation = &built.simulation;
    let filters = match built.seal.filters {
        0 => String::new(),
        filters => format!(", filtered: {}", count(filters, "pair of groups", "pairs of groups")),
    };
    format!(
        "{}: t = {} s, step {} s, {:?}; {}, {}{filters}, at most {}\n",
        printable(&built.name),
        number(simulation.time()),
        number(simulation.step_length()),
        simulation.integrator(),
        count(simulation.bodies().len(), "body", "bodies"),
        count(built.seal.group_pairs, "pair of movable groups", "pairs of movable groups"),
        count(statistics.run.most_contacts, "contact at once", "contacts at once"),
    )
}

fn names(simulation: &Simulation) -> impl Iterator<Item = (BodyId, String)> {
    simulation.bodies().map(|(id, body)| (id, body.name.clone()))
}

fn ends(simulation: &Simulation) -> String {
    let row = |(id, name)| {
        let (pose, twist) = (simulation.pose(id), simulation.twist(id));
        let q = &pose.orientation;
        vec![
            name,
            numbers(pose.position.as_slice()),
            numbers(&[q.w, q.i, q.j, q.k]),
            numbers(twist.linear.as_slice()),
            numbers(twist.angular.as_slice()),
        ]
    };
    let rows: Vec<Vec<String>> = names(simulation).map(row).collect();
    let heading = ["at the end", "position m", "orientation wxyz", "velocity m/s", "angular velocity rad/s"];
    table::aligned(&heading, &rows)
}

fn contacts(simulation: &Simulation, statistics: &Statistics) -> String {
    let row = |(id, name): (BodyId, String)| {
        let body = &statistics.run.bodies[id.index()];
        vec![
            name,
            number(body.peak_force),
            number(body.peak_moment),
            number(body.peak_depth),
            body.most_contacts.to_string(),
            numbers(body.impulse.as_slice()),
        ]
    };
    let rows: Vec<Vec<String>> = names(simulation).map(row).collect();
    let heading =
        ["contact", "peak force N", "peak moment N·m", "peak depth m", "most contacts", "impulse N·s"];
    table::aligned(&heading, &rows)
}

fn energies(built: &BuiltScene, statistics: &Statistics) -> String {
    let (first, last) = (&statistics.run.first_energy, &statistics.run.last_energy);
    let mut text = format!(
        "Energy: kinetic {} → {} J, potential {} → {} J, springs {} → {} J",
        number(first.kinetic),
        number(last.kinetic),
        number(first.potential),
        number(last.potential),
        number(first.springs),
        number(last.springs),
    );
    if built.ledger {
        text += &format!(
            ", contacts {} J stored, {} J lost\nEnergy drift: {} J at the end, {} J at worst",
            number(last.contacts),
            number(last.contact_loss),
            number(last.balance() - first.balance()),
            number(statistics.run.worst_balance),
        );
        if last.contact_made != first.contact_made {
            let made = number(last.contact_made - first.contact_made);
            text += &format!("; holding contact wrenches over steps made {made} J of it");
        }
        text += "\n";
        text += &accounts(&built.simulation);
    } else {
        text += "\nEnergy drift: not known; set ledger: true in the scene\n";
    }
    text
}

/// Energy that each pair of bodies gave to its contacts, and where it went; empty if none touched.
fn accounts(simulation: &Simulation) -> String {
    let touched = simulation.world().pair_accounts().filter(|pair| pair.in_contact || pair.episodes > 0);
    let names = |interface| {
        let mut bodies = simulation.bodies();
        bodies.find(|(_, body)| body.interface == Some(interface)).map(|(_, body)| body.name.clone())
    };
    let row = |pair: PairEnergyAccount| {
        let [first, second] = pair.interfaces.map(|interface| names(interface).unwrap_or_default());
        let total = &pair.total;
        let energies = [
            total.work_in,
            total.work_out,
            total.stored,
            total.damping_loss,
            total.friction_loss,
            total.hold_error,
        ];
        let mut row = vec![format!("{first}, {second}")];
        row.extend(energies.map(number));
        row.push((pair.episodes + u64::from(pair.in_contact)).to_string());
        row.extend([Verdict::Gained, Verdict::Unresolved].map(|verdict| touches_with(&pair, verdict)));
        row
    };
    let rows: Vec<Vec<String>> = touched.map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    let heading = [
        "contact energy",
        "work in J",
        "work out J",
        "stored J",
        "damping J",
        "friction J",
        "hold error J",
        "episodes",
        "gained",
        "unresolved",
    ];
    table::aligned(&heading, &rows)
}

/// Number of contact episodes of a pair with a verdict, including the one in progress.
fn touches_with(pair: &PairEnergyAccount, verdict: Verdict) -> String {
    let ended = if verdict == Verdict::Gained { pair.episodes_gained } else { pair.episodes_unresolved };
    let lasts = pair.in_contact && pair.episode.verdict() == verdict;
    (ended + u64::from(lasts)).to_string()
}
