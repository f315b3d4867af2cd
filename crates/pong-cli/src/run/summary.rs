//! What a run comes to, as text.

use super::statistics::Statistics;
use crate::text::{count, number, numbers, table};
use pong_executive::scene::BuiltScene;
use pong_executive::{BodyId, Simulation};

pub(super) fn summary(built: &BuiltScene, statistics: &Statistics) -> String {
    let simulation = &built.simulation;
    let mut text = heading(built, statistics);
    text += &ends(simulation);
    text += &contacts(simulation, statistics);
    text += &energies(built, statistics);
    if let Some([median, most, longest]) = statistics.step_times_us() {
        let [median, most, longest] = [median, most, longest].map(number);
        text += &format!("Time per step: median {median} µs, 99 % within {most} µs, longest {longest} µs\n");
    }
    text
}

fn heading(built: &BuiltScene, statistics: &Statistics) -> String {
    let simulation = &built.simulation;
    format!(
        "{}: t = {} s, step {} s, {:?}; {}, {}, at most {}\n",
        built.name,
        number(simulation.time()),
        number(simulation.step_length()),
        simulation.integrator(),
        count(simulation.bodies().len(), "body", "bodies"),
        count(built.seal.group_pairs, "pair of movable groups", "pairs of movable groups"),
        count(statistics.most_contacts, "contact at once", "contacts at once"),
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
    table(&heading, &rows)
}

fn contacts(simulation: &Simulation, statistics: &Statistics) -> String {
    let row = |(id, name): (BodyId, String)| {
        let body = &statistics.bodies[id.index()];
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
    table(&heading, &rows)
}

fn energies(built: &BuiltScene, statistics: &Statistics) -> String {
    let (first, last) = (&statistics.first_energy, &statistics.last_energy);
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
            ", contacts {} J stored, {} J lost\nEnergy drift: {} J at the end, {} J at worst\n",
            number(last.contacts),
            number(last.contact_loss),
            number(last.balance() - first.balance()),
            number(statistics.worst_balance),
        );
    } else {
        text += "\nEnergy drift: not known; set ledger: true in the scene\n";
    }
    text
}
