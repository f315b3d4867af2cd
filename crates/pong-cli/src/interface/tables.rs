//! Interface as tables for the terminal and as CSV.

use crate::text::{count, number, numbers};
use pong_advise::{Ending, LinearInterface, LoadLimit};
use pong_engine::TangentMatrix;
use pong_model::printable;
use pong_report::table;
use std::fmt::Write as _;

/// Names of the six components of a load.
pub(super) const LOADS: [&str; 6] = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];

/// Share of √(Kᵢᵢ·Kⱼⱼ) above which off-diagonal terms are reported: a CBUSH leaves them out.
pub(super) const SMALL: f64 = 0.01;

/// Origin of an interface, for the heads of tables and files.
pub(super) struct About {
    /// Scene or log, and the time.
    pub source: String,
    /// Names of both sets, as they were given.
    pub sets: [String; 2],
    /// Name of the group whose origin and axes are those of the interface.
    pub reference: String,
}

pub(super) fn text(about: &About, interface: &LinearInterface) -> String {
    let mut text = format!("{}: {}\n", printable(&about.source), sides(about));
    let _ = writeln!(
        text,
        "{} ({} slipping); reference point and axes: those of `{}`",
        count(interface.contacts, "contact", "contacts"),
        interface.slipping,
        about.reference,
    );
    let preload = [interface.preload.force, interface.preload.moment];
    let [force, moment] = preload.map(|vector| numbers(vector.as_slice()));
    let _ = writeln!(text, "preload on `{}`: force {force} N, moment {moment} N·m\n", about.reference);
    let heading = ["", "stiffness", "damping"];
    let rows = (0..6).map(|i| {
        let units = if i < 3 { ["N/m", "N·s/m"] } else { ["N·m/rad", "N·m·s/rad"] };
        let value = |matrix: &TangentMatrix, unit: &str| format!("{} {unit}", number(matrix[(i, i)]));
        vec![LOADS[i].to_owned(), value(&interface.stiffness, units[0]), value(&interface.damping, units[1])]
    });
    text += &table::aligned_left(&heading, &rows.collect::<Vec<_>>());
    text + "\n" + &limits(interface)
}

/// `` `a, b` on `c` ``.
pub(super) fn sides(about: &About) -> String {
    let [first, second] = &about.sets;
    format!("`{first}` on `{second}`")
}

/// A row for each direction of each component of a load.
fn limits(interface: &LinearInterface) -> String {
    let heading = ["load", "opens at", "first contact that opens", "slides at", "first contact that slides"];
    let mut rows = Vec::new();
    for (component, load) in LOADS.iter().enumerate() {
        for (sign, name) in [(1.0, "+"), (-1.0, "-")] {
            let mut row = vec![format!("{name}{load}")];
            for ending in [Ending::Opens, Ending::Slides] {
                match limit(interface, component, sign, ending) {
                    Some(limit) => row.extend([of_limit(limit), limit.contact.clone()]),
                    None => {
                        let held = if interface.holds[component] { "-" } else { "not held" };
                        row.extend([held.to_owned(), "-".to_owned()]);
                    }
                }
            }
            rows.push(row);
        }
    }
    table::aligned_left(&heading, &rows)
}

fn limit(interface: &LinearInterface, component: usize, sign: f64, ending: Ending) -> Option<&LoadLimit> {
    let same = |limit: &&LoadLimit| {
        limit.component == component
            && limit.ending == ending
            && limit.load.is_sign_positive() == (sign > 0.0)
    };
    interface.limits.iter().find(same)
}

/// A load with its unit.
fn of_limit(limit: &LoadLimit) -> String {
    format!("{} {}", number(limit.load.abs()), if limit.component < 3 { "N" } else { "N·m" })
}

/// `Fz = 1200 N opens a · b`, one line for each limit.
pub(super) fn limit_lines(interface: &LinearInterface) -> impl Iterator<Item = String> + '_ {
    interface.limits.iter().map(|limit| {
        let unit = if limit.component < 3 { "N" } else { "N·m" };
        let (load, does) = (number(limit.load), word(limit.ending));
        format!("{} = {load} {unit} {does} {}", LOADS[limit.component], limit.contact)
    })
}

fn word(ending: Ending) -> &'static str {
    match ending {
        Ending::Opens => "opens",
        Ending::Slides => "slides",
    }
}

/// Lines of quantity, name and six numbers; the first lines are comments.
pub(super) fn csv(about: &About, interface: &LinearInterface) -> String {
    let mut text = format!("# {}: {}\n", printable(&about.source), sides(about));
    let position = numbers(interface.frame.position.as_slice());
    let q = interface.frame.orientation;
    let turn = numbers(&[q.w, q.i, q.j, q.k]);
    text += "# K = -dF/dx (N/m, N/rad, N, N.m/rad), D = -dF/dv (N.s/m, N.s/rad, N.s, N.m.s/rad): wrench on the first set by its own motion\n";
    let _ = writeln!(
        text,
        "# reference point and axes of `{}`: position {position} m, quaternion w x y z {turn} in the common frame",
        about.reference
    );
    text += "# preload: wrench on the first set (N, N.m); opens, slides: load beyond it (N, N.m) at which the named contact does so first\n";
    text += "quantity,name,1,2,3,4,5,6\n";
    let mut row = |quantity: &str, name: &str, values: [f64; 6]| {
        let values = values.map(|value| format!("{value:e}")).join(",");
        let _ = writeln!(text, "{quantity},\"{}\",{values}", name.replace('"', "\"\""));
    };
    for (quantity, matrix) in [("K", &interface.stiffness), ("D", &interface.damping)] {
        for (index, name) in LOADS.iter().enumerate() {
            row(quantity, name, std::array::from_fn(|column| matrix[(index, column)]));
        }
    }
    let (force, moment) = (interface.preload.force, interface.preload.moment);
    row("preload", "", [force.x, force.y, force.z, moment.x, moment.y, moment.z]);
    for limit in &interface.limits {
        let mut loads = [0.0; 6];
        loads[limit.component] = limit.load;
        row(word(limit.ending), &limit.contact, loads);
    }
    text
}

/// Largest off-diagonal stiffness over the root of the two diagonal ones, with row and column.
pub(super) fn largest_off_diagonal(interface: &LinearInterface) -> (f64, [usize; 2]) {
    let (mut largest, mut place) = (0.0, [0, 1]);
    for row in 0..6 {
        for column in (0..6).filter(|column| *column != row) {
            let stiffness = &interface.stiffness;
            let both = (stiffness[(row, row)] * stiffness[(column, column)]).abs().sqrt();
            let share = stiffness[(row, column)].abs() / both.max(f64::MIN_POSITIVE);
            // Where a diagonal term is zero, there is nothing to compare with.
            if both > 0.0 && share > largest {
                (largest, place) = (share, [row, column]);
            }
        }
    }
    (largest, place)
}
