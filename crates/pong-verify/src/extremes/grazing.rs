//! Grazing contact, coincident and parallel features, exact symmetry.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, block, model, sheet, spring};
use crate::case::{Failure, Outcome};
use crate::row::Row;
use pong_executive::{Quat, Vec3, Wrench};

pub const TOUCH: Extreme = Extreme {
    id: "E6",
    asked: "Grazing contact: finite, the same every time, continuous.",
    set_up: "Every kind of A is lowered onto every kind of B that it is tested with, from 1e-3 m above contact to \
             1e-3 m below, by steps that shrink to one unit in the last place where contact begins. Allowed change \
             of force: twice the stiffness times the step, and rounding of the positions.",
    answer: Answer::Safe,
    limit: "none",
    also: "`crates/pong-geometry/tests/it/segment_grazing.rs`, `crates/pong-engine/tests/it/seams.rs`",
    rows: touch,
};

pub const COINCIDENT: Extreme = Extreme {
    id: "E7",
    asked: "Coincident points, parallel edges, a point at a centre, exact symmetry: finite and the same every time.",
    set_up: "Features placed exactly on features, in 24 exact quarter turns each, evaluated twice and in a second world.",
    answer: Answer::Safe,
    limit: "where a normal is not unique the engine chooses one, always the same; there is no force at depth 0",
    also: "`crates/pong-geometry/tests/it/oracle_*.rs`",
    rows: coincident,
};

const STIFFNESS: f64 = 1e5;

/// Kinds of A with the lowest point at the origin.
const MOVERS: [(&str, &str); 5] = [
    ("point", "Point(name: \"x\", position: (0,0,0))"),
    ("segment", "LineSegment(name: \"x\", ends: ((-0.2,0,0),(0.2,0,0)))"),
    ("ball", "Sphere(name: \"x\", center: (0,0,0.125), radius: 0.125)"),
    ("ellipsoid", "Ellipsoid(name: \"x\", center: (0,0,0.125), semi_axes: (0.25,0.2,0.125))"),
    ("ray", "Ray(name: \"x\", origin: (0,0,1), direction: (0,0,-1), length: 1.0)"),
];

/// Kinds of B with the highest point at the origin.
fn grounds() -> Vec<(&'static str, String)> {
    let half = Vec3::new(0.5, 0.5, 0.25);
    vec![
        ("plane", "Plane(name: \"y\", normal: (0,0,1), offset: 0.0)".to_owned()),
        ("polyhedron", block("y", Vec3::new(0.0, 0.0, -0.25), half, |p| p)),
        ("sheet", sheet("y", "thickness: 0.01,", 4, |x, y| Vec3::new(x, y, 0.0))),
        ("ball", "Sphere(name: \"y\", center: (0,0,-0.5), radius: 0.5)".to_owned()),
        ("ellipsoid", "Ellipsoid(name: \"y\", center: (0,0,-0.25), semi_axes: (0.5,0.4,0.25))".to_owned()),
    ]
}

fn is_finite(wrench: &Wrench) -> bool {
    wrench.force.iter().chain(wrench.moment.iter()).all(|x| x.is_finite())
}

/// Heights from 1e-3 m to −1e-3 m, dense near 0.
fn heights() -> Vec<f64> {
    let mut sizes = vec![0.0, f64::EPSILON];
    while sizes.last().is_some_and(|last| *last < 1e-3) {
        sizes.push(sizes[sizes.len() - 1] * 1.25);
    }
    let above = sizes.iter().rev().copied();
    above.chain(sizes.iter().skip(1).map(|size| -size)).collect()
}

fn touch(_: Length) -> Outcome {
    let (mut sweeps, mut bad, mut unlike) = (0, 0, 0);
    let mut steepest = 0.0_f64;
    for (_, mover) in MOVERS {
        for (_, ground) in grounds() {
            let surface = spring(STIFFNESS);
            let scene = || Rig::new(&model(&surface, mover), &model(&surface, &ground));
            let (mut rig, mut other) = (scene()?, scene()?);
            let (mut last, mut met) = (None::<(f64, Vec3)>, false);
            for height in heights() {
                let place = Vec3::z() * height;
                let wrench = rig.step(place, Quat::identity(), Vec3::zeros())?;
                unlike += usize::from(other.step(place, Quat::identity(), Vec3::zeros())? != wrench);
                bad += usize::from(!is_finite(&wrench));
                if let Some((before, force)) = last {
                    // Positions are sums of numbers up to 1 m.
                    let rounding = 8.0 * f64::EPSILON;
                    let allowed = STIFFNESS * ((before - height).abs() + rounding);
                    steepest = steepest.max((wrench.force - force).norm() / allowed);
                }
                met |= wrench.force.norm() > 0.0;
                last = Some((height, wrench.force));
            }
            sweeps += usize::from(met);
        }
    }
    Ok(vec![
        // Point: all except the sheet. Segment: plane, polyhedron. Sphere, ellipsoid and ray: all.
        Row::count("pairs of kinds with contact", 4 + 2 + 5 + 5 + 5, sweeps),
        Row::count("wrenches that are not finite", 0, bad),
        Row::count("wrenches that differ in a second world", 0, unlike),
        Row::below("steepest change of force over stiffness × step", "", steepest, 2.0),
    ])
}

/// A, B, and the position of A's origin in B.
fn coincidences() -> Vec<(&'static str, String, String, Vec3)> {
    let half = Vec3::repeat(0.5);
    let cube = || block("y", Vec3::zeros(), half, |p| p);
    let ball = |radius: f64| format!("Sphere(name: \"x\", center: (0,0,0), radius: {radius:?})");
    let point = "Point(name: \"x\", position: (0,0,0))";
    let bar = "LineSegment(name: \"x\", ends: ((-0.5,0,0),(0.5,0,0)))";
    let egg = "Ellipsoid(name: \"x\", center: (0,0,0), semi_axes: (0.3,0.2,0.1))";
    let flat = || sheet("y", "thickness: 0.2,", 2, |x, y| Vec3::new(x, y, 0.0));
    let centre = Vec3::zeros();
    vec![
        ("point at a ball's centre", point.to_owned(), ball(0.5), centre),
        ("point at an ellipsoid's centre", point.to_owned(), egg.to_owned(), centre),
        ("balls with one centre", ball(0.2), ball(0.2), centre),
        ("point on a vertex", point.to_owned(), cube(), half),
        ("point on an edge", point.to_owned(), cube(), Vec3::new(0.5, 0.5, 0.0)),
        ("point on a face", point.to_owned(), cube(), Vec3::new(0.5, 0.0, 0.0)),
        ("point at a cube's centre", point.to_owned(), cube(), centre),
        ("ball's centre on a vertex", ball(0.1), cube(), half),
        ("ball's centre on an edge", ball(0.1), cube(), Vec3::new(0.5, 0.5, 0.0)),
        ("ball at a cube's centre", ball(0.1), cube(), centre),
        ("bar along an edge", bar.to_owned(), cube(), Vec3::new(0.0, 0.5, 0.5)),
        ("bar in a face", bar.to_owned(), cube(), Vec3::new(0.0, 0.0, 0.5)),
        ("bar through the middle", bar.to_owned(), cube(), centre),
        ("bar's end on a vertex", bar.to_owned(), cube(), Vec3::new(1.0, 0.5, 0.5)),
        ("ellipsoid at a cube's centre", egg.to_owned(), cube(), centre),
        ("ellipsoid's centre on a vertex", egg.to_owned(), cube(), half),
        ("ball's centre in a sheet", ball(0.1), flat(), centre),
        ("ball's centre on a free edge", ball(0.1), flat(), Vec3::new(0.5, 0.0, 0.0)),
        ("ball's centre on a corner of a sheet", ball(0.1), flat(), Vec3::new(0.5, 0.5, 0.0)),
        ("ellipsoid's centre in a sheet", egg.to_owned(), flat(), centre),
        (
            "plane through a ball's centre",
            ball(0.1),
            "Plane(name: \"y\", normal: (0,0,1), offset: 0.0)".to_owned(),
            centre,
        ),
    ]
}

/// The 24 rotations of a cube, exact except for √½.
fn quarter_turns() -> Vec<Quat> {
    let quarter = std::f64::consts::FRAC_PI_2;
    let up = [Vec3::zeros(), Vec3::x(), -Vec3::x(), Vec3::y(), -Vec3::y(), 2.0 * Vec3::x()];
    let spins = (0..4).map(f64::from);
    spins
        .flat_map(|spin| {
            up.map(|tilt| {
                Quat::from_scaled_axis(tilt * quarter) * Quat::from_scaled_axis(Vec3::z() * (spin * quarter))
            })
        })
        .collect()
}

fn coincident(_: Length) -> Outcome {
    let (mut bad, mut unlike, mut blind, mut frames) = (0, 0, 0, 0);
    for (_, a, b, place) in coincidences() {
        let surface = spring(STIFFNESS);
        let scene = || -> Result<Rig, Failure> { Rig::new(&model(&surface, &a), &model(&surface, &b)) };
        let (mut rig, mut other) = (scene()?, scene()?);
        for turn in quarter_turns() {
            let wrench = rig.step(place, turn, Vec3::zeros())?;
            rig.world.evaluate()?;
            let contacts = rig.contacts();
            let units = contacts.iter().all(|contact| (contact.normal.norm() - 1.0).abs() < 1e-12);
            bad += usize::from(!is_finite(&wrench));
            blind += usize::from(!units);
            let again = other.step(place, turn, Vec3::zeros())?;
            unlike += usize::from(again != wrench);
            frames += 1;
        }
    }
    Ok(vec![
        Row::count("frames", 21 * 24, frames),
        Row::count("wrenches that are not finite", 0, bad),
        Row::count("frames with a normal that is not a unit vector", 0, blind),
        Row::count("wrenches that differ in a second world", 0, unlike),
    ])
}
