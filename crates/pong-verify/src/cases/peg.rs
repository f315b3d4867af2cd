//! V20: a peg jams in a hole only if its insertion is shorter than μ·D.
//!
//! The peg leans in the slot; a corner of its tip presses on one wall and its shaft on the opposite edge,
//! each δ₀ deep: a couple N·L that would turn it free. Friction at the two points, D apart, opposes it by a
//! couple T·D with T ≤ μ·N, hence L < μ·D. When jammed, the rotation θ that stretches the bristles (k_t·θ·D/2
//! = T) relieves the springs (N = k·(δ₀ − θ·L/2)), so that N = k·δ₀·k_t·D²/(k·L² + k_t·D²).

use crate::case::{Case, Failure, Outcome};
use crate::measure::{bisect, rotation};
use crate::row::Row;
use crate::scene::{Bristle, Duo, set_bristle};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Vec3};

pub const V20: Case = Case {
    id: "V20",
    title: "Peg wedging in a hole",
    set_up: "A peg 20 mm wide in a slot 20 µm wider, μ = 0.5, leaning so that corner and rim press 1 µm deep, then let \
             go, for insertions of 0.7 to 1.3 times μ·D.",
    source: "wedges only if L < μ·D; where it holds N = k·δ₀·k_t·D²/(k·L² + k_t·D²)",
    rows,
};

const WIDTH: f64 = 0.02;
const CLEARANCE: f64 = 20e-6;
const MU: f64 = 0.5;
const BITE: f64 = 1e-6;
/// Stiffness of the pair, N/m: two surfaces of 1e6 N/m in series.
const STIFFNESS: f64 = 5e5;
const TANGENTIAL: f64 = 5e5;

fn rows() -> Outcome {
    let mut rows = Vec::new();
    for share in [0.7, 0.9, 1.1, 1.3] {
        let insertion = share * MU * WIDTH;
        let (squeeze, speed) = let_go(insertion)?;
        let free = STIFFNESS * BITE;
        let (l2, d2) = (STIFFNESS * insertion * insertion, TANGENTIAL * WIDTH * WIDTH);
        let name = format!("L = {share} μD: squeeze left of each contact");
        if share < 1.0 {
            rows.push(Row::relative(name, "N", free * d2 / (l2 + d2), squeeze, 2e-2));
            rows.push(Row::below(format!("L = {share} μD: speed of the peg"), "m/s", speed, 1e-9));
        } else {
            rows.push(Row::below(name, "N", squeeze, 1e-6 * free));
        }
    }
    Ok(rows)
}

/// Largest normal force and speed of the peg 0.1 s after its release.
fn let_go(insertion: f64) -> Result<(f64, f64), Failure> {
    let bristle = Bristle { mu: MU, excess: 0.0, stiffness: 2.0 * TANGENTIAL, damping: 1500.0 };
    let duo = Duo::new("peg", "hole")?.mover(|s| set_bristle(s, &bristle))?;
    // The tip's corner is BITE deep in the left wall at the insertion depth, for any lean.
    let tip = |lean: f64| {
        let (sine, cosine) = libm::sincos(lean);
        let left = 0.5 * (WIDTH + CLEARANCE) + BITE;
        Vec3::new(0.5 * WIDTH * cosine - left, 0.0, -insertion - 0.5 * WIDTH * sine)
    };
    // Lean for which the right edge is BITE deep in the shaft.
    let rim_depth = |lean: f64| {
        let (sine, cosine) = libm::sincos(lean);
        let rim = Vec3::x() * (0.5 * (WIDTH + CLEARANCE)) - tip(lean);
        0.5 * WIDTH - rim.dot(&Vec3::new(cosine, 0.0, -sine))
    };
    let lean = bisect(0.0, 0.1, |lean| rim_depth(lean) < BITE);
    let mass = MassProperties::cuboid(0.1, [WIDTH, 0.01, WIDTH]);
    let peg = RigidBody::free("peg", mass)
        .at(Pose { position: tip(lean), orientation: rotation(Vec3::y() * lean) });
    let mut run = duo.simulate((Integrator::RungeKutta4, 1e-5), peg, RigidBody::fixed("hole"))?;
    run.sim.commit_initial_states()?;
    if run.contacts().len() != 4 {
        return Err(format!("{} contacts at the start instead of four", run.contacts().len()).into());
    }
    run.sim.run_for(0.1)?;
    let squeeze = run.contacts().iter().map(|c| c.normal_force).fold(0.0, f64::max);
    Ok((squeeze, run.velocity().norm()))
}
