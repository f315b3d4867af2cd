//! W2: two surfaces in series.

use crate::case::{Case, Failure, Outcome};
use crate::row::Row;
use crate::scene::{Bristle, Duo, set_bristle, set_damping, set_dissipation};
use pong_engine::{Contact, State};

pub const W2: Case = Case {
    id: "W2",
    title: "Two surfaces in series",
    set_up: "A point held 1 mm deep in a plane, also closing at 0.1 m/s and drawn aside by 1 µm at 1 mm/s, for \
             surfaces that both yield, for either one rigid, and for the exponents 1 and 3/2.",
    source: "same force in both springs: k = k_A·k_B/(k_A + k_B), yields k_B : k_A, damping by squared shares; exponent \
             3/2 with κ_i = k_i^(2/3)",
    rows,
};

const DEPTH: f64 = 1e-3;
const RATE: f64 = 0.1;
const ASIDE: f64 = 1e-6;
const DRAG: f64 = 1e-3;

/// The contact of a point held at the depth, closing, and displaced tangentially since the last commit.
fn held(duo: Duo, rate: f64) -> Result<Contact, Failure> {
    let (mut world, [point, ground]) = duo.world()?;
    let mut state = State { position: [0.0, 0.0, -DEPTH], ..State::identity() };
    world.set_states(&[(point, state), (ground, State::identity())])?;
    world.step()?;
    state.position[0] = ASIDE;
    state.linear_velocity = [DRAG, 0.0, -rate];
    world.set_state(point, &state)?;
    world.evaluate()?;
    world.contacts().first().copied().ok_or_else(|| "the point does not touch".into())
}

fn linear(k_a: f64, k_b: f64) -> Result<Contact, Failure> {
    let bristle = |stiffness, damping| Bristle { mu: 0.5, excess: 0.0, stiffness, damping };
    let duo = Duo::new("point_rough", "ground_rough")?
        .mover(|s| {
            s.stiffness = k_a;
            set_damping(s, 900.0);
            set_bristle(s, &bristle(2e4, 90.0));
        })?
        .ground(|s| {
            s.stiffness = k_b;
            set_damping(s, 100.0);
            set_bristle(s, &bristle(3e4, 40.0));
        })?;
    held(duo, RATE)
}

fn rows() -> Outcome {
    let mut rows = Vec::new();
    let cases = [
        ("3e5 on 1e5 N/m", 3e5, 1e5, 7.5e4, 0.25),
        ("rigid on 1e5 N/m", f64::INFINITY, 1e5, 1e5, 0.0),
        ("3e5 N/m on rigid", 3e5, f64::INFINITY, 3e5, 1.0),
    ];
    for (name, k_a, k_b, stiffness, share) in cases {
        let contact = linear(k_a, k_b)?;
        let damping = 900.0 * share * share + 100.0 * (1.0 - share) * (1.0 - share);
        let force = stiffness * DEPTH + damping * RATE;
        rows.push(Row::relative(format!("{name}: force"), "N", force, contact.normal_force, 1e-12));
        // The tip is the depth below the plane; A's share of the deflection moves the point up again.
        let height = -DEPTH * (1.0 - share);
        rows.push(Row::absolute(format!("{name}: height of the place"), "m", height, contact.point.z, 1e-15));
        // The softer bristle, A's, takes 0.6 of the displacement.
        let pull = 2e4 * 3e4 / (2e4 + 3e4) * ASIDE + (90.0 * 0.36 + 40.0 * 0.16) * DRAG;
        rows.push(Row::relative(
            format!("{name}: bristle's force"),
            "N",
            pull,
            contact.friction_force.norm(),
            1e-9,
        ));
    }
    rows.extend(hertz()?);
    Ok(rows)
}

fn hertz() -> Result<[Row; 2], Failure> {
    let (k_a, k_b) = (4e6_f64, 9e5_f64);
    let kappa = |k: f64| libm::pow(k, 2.0 / 3.0);
    let (kappa_a, kappa_b) = (kappa(k_a), kappa(k_b));
    let share = kappa_b / (kappa_a + kappa_b);
    let chi = 0.8 * share + 0.3 * (1.0 - share);
    let duo = Duo::new("point_hertz", "ground_hertz")?
        .mover(|s| {
            s.stiffness = k_a;
            set_dissipation(s, 0.8);
        })?
        .ground(|s| {
            s.stiffness = k_b;
            set_dissipation(s, 0.3);
        })?;
    let contact = held(duo, RATE)?;
    let stiffness = libm::pow(kappa_a * kappa_b / (kappa_a + kappa_b), 1.5);
    let force = stiffness * libm::pow(DEPTH, 1.5) * (1.0 + chi * RATE);
    Ok([
        Row::relative("exponent 3/2: force", "N", force, contact.normal_force, 1e-12),
        Row::absolute(
            "exponent 3/2: height of the place",
            "m",
            -DEPTH * (1.0 - share),
            contact.point.z,
            1e-15,
        ),
    ])
}
