//! Capsules on triangles (docs/theory.md, 2.8): the two ends of the axis yield, each with half a spring, until the
//! capsule is clear of the surface.

use crate::common::*;
use pong_geometry::{Quat, Vec3, Wrench};
use pong_testkit::Random;

const K: f64 = 1e4;
/// Stiffness of the pair: two equal springs in series.
const PAIR: f64 = 0.5 * K;
const DEPTH: f64 = 1e-3;
const RADIUS: f64 = 0.1;

fn part(text: &str) -> String {
    model("part", &surface(K, "friction: None"), text)
}

/// A bar along x, its middle at the origin.
fn bar(length: f64) -> String {
    let half = 0.5 * length;
    part(&format!("Capsule(name: \"b\", ends: (({:?},0,0),({half:?},0,0)), radius: {RADIUS})", -half))
}

/// A plate of 2 m by 2 m about the origin, in n × n × 2 triangles.
fn plate(n: usize) -> String {
    part(&plate_mesh("p", n, 2.0, |x, y| Vec3::new(x, y, 0.0)))
}

/// Wrench and energy of a bar that lies at x on a plate, tilted so that its far end is lower.
fn lie(rig: &mut Rig, x: f64, tilt: f64) -> (Wrench, f64) {
    let middle = Vec3::new(x, 0.03, RADIUS - DEPTH);
    rig.set_at(middle, Quat::from_scaled_axis(Vec3::y() * tilt))
}

/// Largest ½k·δ(s)²/(2(1 − s)² + 2s²) over the places s of an axis: the energy of a bar on one convex surface, whose
/// distance from a place is given (decision 0014, equation 3).
fn stored_on_convex(ends: [Vec3; 2], distance: impl Fn(Vec3) -> f64) -> f64 {
    let at = |s: f64| {
        let depth = RADIUS - distance(ends[0] + (ends[1] - ends[0]) * s);
        let stored = 0.5 * PAIR * depth * depth / (2.0 * (1.0 - s).powi(2) + 2.0 * s * s);
        if depth > 0.0 { stored } else { depth }
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..100 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a) > at(b) { high = b } else { low = a }
    }
    at(low).max(at(0.0)).max(at(1.0)).max(0.0)
}

fn stored_on_plate(ends: [Vec3; 2]) -> f64 {
    stored_on_convex(ends, |place| {
        Vec3::new((place.x.abs() - 1.0).max(0.0), (place.y.abs() - 1.0).max(0.0), place.z).norm()
    })
}

/// A bar on a plate: kδ as long as its middle is over it, so with its resultant in the middle; ½kδ on a tip; what the
/// best place stores if its middle is past the rim, about kδ/(2(1 − σ)² + 2σ²) at the rim.
#[test]
fn a_bar_carries_what_its_two_ends_store() {
    for n in [1, 5] {
        let mut rig = Rig::new(&bar(1.0), &plate(n));
        let whole = PAIR * DEPTH;
        for over in [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
            let x = 1.5 - over;
            let (wrench, stored) = lie(&mut rig, x, 0.0);
            let rest: f64 = 1.0 - over;
            let share = if over < 0.5 { 0.5 / (over * over + rest * rest) } else { 1.0 };
            let moment = if over < 0.5 { (x - 1.0) * share * whole } else { 0.0 };
            let limit = if over < 0.5 { 1e-2 } else { 1e-9 } * whole;
            assert!(
                (wrench.force - Vec3::z() * share * whole).norm() < limit,
                "{n} {over}: {}",
                wrench.force
            );
            assert!((wrench.moment.y - moment).abs() < limit, "{n} {over}: {}", wrench.moment);
            let known = stored_on_plate([-0.5, 0.5].map(|half| Vec3::new(x + half, 0.03, RADIUS - DEPTH)));
            assert!((stored - known).abs() < 1e-9 * known, "{n} {over}: {stored} {known}");
        }
        let mut long = Rig::new(&bar(3.0), &plate(n));
        let (wrench, _) = lie(&mut long, 0.2, 0.0);
        assert!(
            (wrench.force - Vec3::z() * whole).norm() + wrench.moment.norm() < 1e-9 * whole,
            "{wrench:?}"
        );
        let lifted = Vec3::new(0.0, 0.0, RADIUS - DEPTH + 0.5 * 0.3_f64.sin());
        let (wrench, _) = rig.set_at(lifted, Quat::from_scaled_axis(Vec3::y() * 0.3));
        assert!((wrench.force - Vec3::z() * (0.5 * whole)).norm() < 1e-9 * whole, "{}", wrench.force);
    }
}

/// Where a bar overhangs on one side or both, a tilt through lying flat moves its load steadily.
#[test]
fn the_load_of_a_bar_that_overhangs_does_not_step() {
    for (length, x) in [(1.0, 0.8), (1.0, 1.2), (3.0, 0.3)] {
        let mut rig = Rig::new(&bar(length), &plate(3));
        let at = [-1e-9, 0.0, 1e-9].map(|tilt| lie(&mut rig, x, tilt).0);
        for tilted in at {
            let off = (tilted.force - at[1].force).norm() + (tilted.moment - at[1].moment).norm();
            assert!(off < 1e-5 * at[1].force.norm(), "{length} {x}: {tilted:?} {:?}", at[1]);
        }
    }
}

/// Over the middle of a plate, past its rim, along it and past its corners: the energy is the known one, and the cuts of
/// the plate change nothing. A wrench at the place of a maximum is known less well than the energy.
#[test]
fn cuts_of_a_plate_change_nothing() {
    let mut random = Random(3);
    for length in [0.4, 1.0, 3.0] {
        let mut rigs = [1, 5, 8].map(|n| Rig::new(&bar(length), &plate(n)));
        let (mut touching, mut worst) = (0, [0.0_f64; 3]);
        for case in 0..400 {
            let middle = random.vector(1.2);
            let along_rim = [std::f64::consts::FRAC_PI_2, 0.02, 3.0, 3.0][case % 4];
            let yaw = Quat::from_scaled_axis(Vec3::z() * random.between(-along_rim, along_rim));
            let tilt = Quat::from_scaled_axis(random.vector([0.0, 0.01][case / 4 % 2]));
            let y = if case % 4 == 1 { 1.0 + 0.01 * middle.y } else { middle.y };
            let place = Vec3::new(middle.x, y, RADIUS - random.between(0.0, 0.01));
            let ends = [-0.5, 0.5].map(|half| place + yaw * tilt * Vec3::x() * (half * length));
            let known = stored_on_plate(ends);
            if ends.iter().any(|end| end.z < 0.01) {
                continue;
            }
            let [whole, others @ ..] = rigs.each_mut().map(|rig| rig.set_at(place, yaw * tilt));
            let scale = PAIR * 0.01;
            for (cut, stored) in others {
                let off = (cut.force - whole.0.force).norm() + (cut.moment - whole.0.moment).norm();
                assert!(off <= 1e-7 * scale, "{length} {case}: {off:e} {whole:?} {cut:?} {ends:?}");
                worst = [
                    worst[0].max(off / scale),
                    worst[1].max((stored - whole.1).abs() / known.max(1e-12)),
                    worst[2],
                ];
            }
            worst[2] = worst[2].max((whole.1 - known).abs() / known.max(1e-9));
            assert!(
                (whole.1 - known).abs() <= 1e-9 * known.max(1e-9),
                "{length} {case}: {whole:?} {known} {ends:?}"
            );
            touching += usize::from(whole.1 > 0.0);
        }
        println!("{length}: {touching}, off by {worst:?}");
        assert!(touching > 100, "{touching}");
    }
}

/// The wrench is minus the derivative of the stored energy on a plate and past its rims, on a roof and in a valley.
#[test]
fn the_wrench_of_a_bar_derives_from_its_energy() {
    let plate = plate_mesh("p", 3, 0.8, |x, y| Vec3::new(x, y, 0.0));
    let roof = plate_mesh("p", 2, 8.0, |x, y| Vec3::new(x, y, -0.2 * x.abs()));
    let valley = plate_mesh("p", 2, 8.0, |x, y| Vec3::new(x, y, 0.2 * x.abs()));
    for (name, mesh, height) in [("plate", plate, 0.1), ("roof", roof, 0.1), ("valley", valley, 0.12)] {
        for length in [0.5, 1.6] {
            let mut rig = Rig::new(&bar(length), &part(&mesh));
            let mut random = Random(17);
            let (mut compared, mut worst) = (0, 0.0_f64);
            for _ in 0..500 {
                let offset = random.vector(0.3);
                let place = Vec3::new(offset.x, offset.y, height + 0.1 * offset.z);
                let orientation = Quat::from_scaled_axis(random.vector(0.1));
                let orientation = orientation * Quat::from_scaled_axis(Vec3::z() * random.between(-3.0, 3.0));
                let Derivative { force, stored, is_kink, off } =
                    rig.derivative((place, orientation), [random.direction(), random.direction()]);
                if force < 1.0 || stored > 0.5 * PAIR * 0.03 * 0.03 || is_kink {
                    continue;
                }
                worst = worst.max(off);
                compared += 1;
            }
            println!("{name} {length}: {compared}, off by {worst:e}");
            assert!(compared > 30 && worst < 1e-6, "{name} {length}: {compared}, off by {worst:e}");
        }
    }
}

/// A plate that is bent by 1e-9 to 1e-2 rad at each of its folds, as vertices in single precision bend it, has the energy
/// of a convex surface, and carries no more than a flat one.
#[test]
fn folds_of_a_flat_plate_change_nothing() {
    const STRIPS: usize = 16;
    for bend in [1e-9, 1e-7, 1e-5, 1e-3, 1e-2] {
        // Heights of strips of an eighth of a metre along y.
        let height = |x: f64| -4.0 * bend * x * x;
        let mut rig =
            Rig::new(&bar(1.0), &part(&plate_mesh("p", STRIPS, 2.0, |x, y| Vec3::new(x, y, height(x)))));
        let distance = |place: Vec3| {
            let to_strip = |strip: usize| {
                let [left, right] = [strip, strip + 1].map(|k| -1.0 + 2.0 * k as f64 / STRIPS as f64);
                let (start, end) = (Vec3::new(left, 0.0, height(left)), Vec3::new(right, 0.0, height(right)));
                let (arm, along) = (Vec3::new(place.x, 0.0, place.z) - start, end - start);
                (arm - along * (arm.dot(&along) / along.norm_squared()).clamp(0.0, 1.0)).norm()
            };
            (0..STRIPS).map(to_strip).fold(f64::INFINITY, f64::min)
        };
        let mut random = Random(5);
        for case in 0..100 {
            let yaw = [random.between(-3.0, 3.0), 0.01 * random.between(-1.0, 1.0), 0.0][case % 3];
            let turn =
                Quat::from_scaled_axis(Vec3::y() * (1e-3 * random.between(-1.0, 1.0) * (case % 2) as f64))
                    * Quat::from_scaled_axis(Vec3::z() * yaw);
            let place = random.vector(0.3);
            let place = Vec3::new(place.x, place.y, RADIUS - DEPTH);
            let (wrench, stored) = rig.set_at(place, turn);
            let known = stored_on_convex([-0.5, 0.5].map(|half| place + turn * Vec3::x() * half), distance);
            assert!(
                (stored - known).abs() < 1e-9 * (0.5 * PAIR * DEPTH * DEPTH),
                "{bend} {case}: {stored} {known}"
            );
            // Where one place carries all, the force is 2U/δ, and no more than kδ.
            assert!(wrench.force.norm() < PAIR * DEPTH * 2.0, "{bend} {case}: {}", wrench.force);
        }
    }
}

/// The load of a bar along a ridge, or across it, acts at two places of its axis, so that friction resists turning.
#[test]
fn a_bar_on_a_ridge_resists_turning() {
    let ridge = part(&plate_mesh("p", 2, 4.0, |x, y| Vec3::new(x, y, -0.5 * x.abs())));
    let mut rig = Rig::new(&bar(1.0), &ridge);
    for (yaw, width) in
        [(std::f64::consts::FRAC_PI_2, 1.0), (0.0, 2.0 * (2.0 * RADIUS * DEPTH - DEPTH * DEPTH).sqrt())]
    {
        let turn = Quat::from_scaled_axis(Vec3::z() * yaw);
        let (wrench, stored) = rig.set_at(Vec3::new(0.0, 0.0, RADIUS - DEPTH), turn);
        assert!((stored - 0.5 * PAIR * DEPTH * DEPTH).abs() < 1e-12, "{stored}");
        assert!(
            (wrench.force - Vec3::z() * (PAIR * DEPTH)).norm() + wrench.moment.norm() < 1e-9,
            "{wrench:?}"
        );
        let places: Vec<Vec3> = rig.world.contacts().iter().map(|contact| contact.point).collect();
        assert!(
            places.len() == 2 && ((places[0] - places[1]).norm() - width).abs() < 1e-9,
            "{places:?} {width}"
        );
    }
}

/// Two plates edge on edge act like one.
#[test]
fn two_plates_edge_on_edge_act_as_one() {
    let half = |name: &str, left: f64, right: f64| {
        format!(
            "TriangleMesh(name: \"{name}\", vertices: [({left:?},-1,0),({right:?},-1,0),({right:?},1,0),({left:?},1,0)], \
             triangles: [(0,1,2),(0,2,3)])"
        )
    };
    let both = format!("{}, {}", half("p", -1.0, 0.2), half("q", 0.2, 1.0));
    let (mut one, mut two) = (Rig::new(&bar(1.0), &plate(1)), Rig::new(&bar(1.0), &part(&both)));
    let mut random = Random(9);
    for case in 0..100 {
        let turn = Quat::from_scaled_axis(random.vector(0.01))
            * Quat::from_scaled_axis(Vec3::z() * random.between(-3.0, 3.0));
        let place = random.vector(1.2);
        let place = Vec3::new(place.x, place.y, RADIUS - random.between(0.0, 0.01));
        let [whole, cut] = [&mut one, &mut two].map(|rig| rig.set_at(place, turn));
        let off = (cut.0.force - whole.0.force).norm() + (cut.0.moment - whole.0.moment).norm();
        assert!(off <= 1e-9 * PAIR * 0.01 && (cut.1 - whole.1).abs() <= 1e-9, "{case}: {whole:?} {cut:?}");
    }
}
