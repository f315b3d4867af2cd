//! Ten thousand contacts at once.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, model, spring};
use crate::case::Outcome;
use crate::row::Row;
use pong_engine::{Config, StatusBits, WorkerSettings};
use pong_executive::{Quat, Vec3};

pub const CROWD: Extreme = Extreme {
    id: "E13",
    asked: "10,000 contacts at once.",
    set_up: "100 × 100 spheres of one body, 10 mm apart, 0.1 mm deep in a plane, 1e5 N/m; level, and tilted so that \
             the depth differs from sphere to sphere. With room for all, on one thread and with two workers; with \
             room for 4,000.",
    answer: Answer::Told,
    limit: "room is set at the seal: by default an estimate from the scene up to 65,536; beyond it the deepest contacts \
            are kept, `CONTACT_LIMIT` is set and the report says how many there were",
    also: "`crates/pong-engine/tests/it/limits.rs`, `crates/pong-engine/tests/workers.rs`",
    rows,
};

const SIDE: usize = 100;
const SPACING: f64 = 0.01;
const STIFFNESS: f64 = 1e5;
const DEPTH: f64 = 1e-4;
const TILT: f64 = 1e-4;

fn balls() -> String {
    let place = |i: usize| (i as f64 - 0.5 * (SIDE - 1) as f64) * SPACING;
    let ball = |i: usize, j: usize| {
        format!("Sphere(name: \"b{i}_{j}\", center: ({:?},{:?},0), radius: 0.004)", place(i), place(j))
    };
    let all: Vec<String> = (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| ball(i, j))).collect();
    model(&spring(STIFFNESS), &all.join(","))
}

fn crowd(capacity: Option<usize>, workers: usize) -> Result<Rig, crate::Failure> {
    let workers = (workers > 0).then(|| WorkerSettings { workers, ..WorkerSettings::default() });
    let config = Config { contact_capacity: capacity, workers, ..Config::default() };
    let floor = "Plane(name: \"y\", normal: (0,0,1), offset: 0.0)";
    Rig::with(config, &balls(), &model("stiffness: inf, normal: Linear(damping: 0.0)", floor))
}

fn rows(_: Length) -> Outcome {
    let count = SIDE * SIDE;
    let place = Vec3::z() * (0.004 - DEPTH);
    let mut alone = crowd(None, 0)?;
    let level = alone.step(place, Quat::identity(), Vec3::zeros())?;
    let found = alone.world.report();
    let whole = count as f64 * STIFFNESS * DEPTH;
    // A small tilt about y lowers a ball at x by x·sin: the moment is k·sin·Σx², the force is as before.
    let tilt = Quat::from_scaled_axis(Vec3::y() * TILT);
    let tilted = alone.step(place, tilt, Vec3::zeros())?;
    let mut shared = crowd(None, 2)?;
    shared.step(place, Quat::identity(), Vec3::zeros())?;
    let same = shared.step(place, tilt, Vec3::zeros())? == tilted;
    let squares: f64 = (0..SIDE).map(|i| (i as f64 - 0.5 * (SIDE - 1) as f64) * SPACING).map(|x| x * x).sum();
    let moment = STIFFNESS * libm::sin(TILT) * squares * SIDE as f64 * libm::cos(TILT);
    let mut tight = crowd(Some(4000), 0)?;
    tight.step(place, tilt, Vec3::zeros())?;
    let limited = tight.world.report();
    let shallowest = tight.contacts().iter().map(|contact| contact.depth).fold(f64::INFINITY, f64::min);
    // The balls lie in columns of equal depth: the 4,000 deepest are the 40 lowest columns.
    let fortieth = DEPTH + (0.5 * (SIDE - 1) as f64 - 39.0) * SPACING * libm::sin(TILT);
    Ok(vec![
        Row::count("contacts", count, found.contacts as usize),
        Row::count("left out", 0, usize::from(!found.status.is_complete())),
        Row::relative("level: force", "N", whole, level.force.z, 1e-10),
        Row::below("level: moment over force × 1 m", "", level.moment.norm() / whole, 1e-10),
        Row::relative("tilted: force", "N", whole, tilted.force.z, 1e-8),
        Row::relative("tilted: moment", "N·m", -moment, tilted.moment.y, 1e-6),
        Row::count("the same bits with two workers", 1, usize::from(same)),
        Row::count("room for 4,000: contacts kept", 4000, limited.contacts as usize),
        Row::count(
            "room for 4,000: reported",
            1,
            usize::from(limited.status.contains(StatusBits::CONTACT_LIMIT)),
        ),
        Row::count("room for 4,000: contacts wanted", count, limited.contacts_wanted as usize),
        Row::relative("room for 4,000: depth of the shallowest kept", "m", fortieth, shallowest, 1e-4),
    ])
}
