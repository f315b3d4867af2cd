//! 12 t against 420 t on 1e8 N/m at 20 Hz: dispersed approaches beside runs at 10 µs.

use crate::rig::{Body, Rig, all_paired, settings};
use pong_engine::{Config, World};
use pong_geometry::{Quat, Vec3};
use pong_testkit::random::Random;
use pong_testkit::ron::{model, surface};

const MASSES: [f64; 2] = [12e3, 420e3];
const STIFFNESS: f64 = 1e8;
const FRAME: f64 = 0.05;
const FINE: f64 = 1e-5;
/// Distance of the probe's centre from the vehicle's mass centre, and radius of the probe, m.
const REACH: f64 = 1.5;
const RADIUS: f64 = 0.5;

/// An approach to a face that lies across z.
struct Approach {
    /// Closing speed of the probe, m/s.
    closing: f64,
    theta: f64,
    /// Damping of each surface, N·s/m.
    damping: f64,
    friction: f64,
    bodies: Vec<Body>,
}

impl Approach {
    /// Speeds of 5 mm/s to 0.3 m/s; up to 0.2 m, 3°, 20 mm/s and 0.3°/s off; any phase of the touch within a frame.
    fn draw(random: &mut Random) -> Self {
        let closing = random.log_between(0.005, 0.3);
        let phase = random.between(1.0, 2.0);
        let theta = random.pick(&[1.0, 0.5, 0.0]);
        let damping = random.pick(&[0.0, 2.16e5, 4.32e5]);
        let friction = random.pick(&[0.0, 0.2, 0.4]);
        let mut within = |most: f64| Vec3::from_fn(|_, _| random.between(-most, most));
        let (tilt, turning, aside, offset) = (within(0.05), within(5e-3), within(0.02), within(0.2));
        let orientation = Quat::from_scaled_axis(tilt);
        let probe = orientation * (Vec3::z() * -REACH);
        // The lowest point of the probe closes at this speed, the gap ends after `phase` frames.
        let velocity = Vec3::new(aside.x, aside.y, -closing - turning.cross(&probe).z);
        let height = RADIUS - probe.z + closing * FRAME * phase;
        let mut vehicle = Body::ball(MASSES[0], 1.5, Vec3::new(offset.x, offset.y, height), velocity);
        (vehicle.orientation, vehicle.turning) = (orientation, turning);
        let station = Body::ball(MASSES[1], 5.0, Vec3::zeros(), Vec3::zeros());
        Self { closing, theta, damping, friction, bodies: vec![vehicle, station] }
    }

    /// The approach at the rate of a slow host, the same at 10 µs, and a world for that.
    fn rigs(&self) -> (Rig, Rig, World) {
        let friction =
            if self.friction > 0.0 { format!("Bristle(mu: {:?})", self.friction) } else { "None".into() };
        let law = format!("normal: Linear(damping: {:?}), friction: {friction}", self.damping);
        let steel = surface(2.0 * STIFFNESS, &law);
        let vehicle = model(
            "vehicle",
            &steel,
            &format!("Sphere(name: \"s\", center: (0, 0, {:?}), radius: {RADIUS:?})", -REACH),
        );
        let station = model("station", &steel, "Plane(name: \"f\", normal: (0, 0, 1), offset: 0.0)");
        let (world, interfaces) = all_paired(Config::default(), &[&vehicle, &station]);
        let rig = |frame, theta| {
            Rig::of(&world, interfaces.clone(), self.bodies.clone(), settings(theta, 12.0), frame)
        };
        (rig(FRAME, self.theta), rig(FINE, 1.0), world)
    }
}

/// Height of the probe above the face, m, and its speed along the normal of the face, m/s.
fn gap(rig: &Rig) -> (f64, f64) {
    let [vehicle, station] = &rig.bodies[..] else { unreachable!("two bodies") };
    let normal = station.orientation * Vec3::z();
    let arm = vehicle.orientation * (Vec3::z() * -REACH);
    let ahead = (1.0 - rig.theta) * rig.frame;
    let probe = vehicle.position + arm - station.position;
    let speed =
        vehicle.velocity + vehicle.turning.cross(&arm) - station.velocity - station.turning.cross(&probe);
    (normal.dot(&probe) - RADIUS + normal.dot(&speed) * ahead, normal.dot(&speed))
}

/// Speed at which the probe leaves over that at which it came, and the largest energy over that of the start.
fn outcome(rig: &mut Rig, closing: f64, mut step: impl FnMut(&mut Rig)) -> (f64, f64) {
    let start = rig.kinetic();
    let mut most = 1.0_f64;
    let steps = (0.4 / rig.frame).ceil() as usize;
    for _ in 0..steps {
        step(rig);
        let depth = (-gap(rig).0).max(0.0);
        most = most.max((rig.kinetic() + 0.5 * STIFFNESS * depth * depth) / start);
        if gap(rig).0 > 0.0 && gap(rig).1 > 0.0 && depth == 0.0 && rig.frame < FRAME {
            break;
        }
    }
    (gap(rig).1 / closing, most)
}

/// Worst rebound, and largest gain, over a number of approaches.
fn worst(count: u32) -> (f64, f64) {
    let mut random = Random(48);
    let (mut worst, mut most) = (0.0_f64, 1.0_f64);
    let mut sum = 0.0;
    for number in 0..count {
        let approach = Approach::draw(&mut random);
        let (mut slow, mut fine, mut world) = approach.rigs();
        let (rebound, energy) = outcome(&mut slow, approach.closing, |rig| drop(rig.step()));
        // Free flight is exact in one step.
        fine.fly(0.97 * gap(&fine).0 / approach.closing);
        let (exact, _) = outcome(&mut fine, approach.closing, |rig| rig.step_plainly(&mut world));
        let off = (rebound - exact).abs();
        if off > worst {
            println!(
                "approach {number}: {:.4} m/s, theta {}, damping {:e}, friction {:.2}: rebound {rebound:.4}, at 10 µs {exact:.4}",
                approach.closing, approach.theta, approach.damping, approach.friction
            );
        }
        (worst, most, sum) = (worst.max(off), most.max(energy), sum + off);
        if (number + 1) % 500 == 0 {
            println!(
                "{} approaches: rebound off by {worst:.4} at most; energy {most:.5} at most",
                number + 1
            );
        }
    }
    println!(
        "{count} approaches: rebound off by {worst:.4} at most, {:.4} in the mean; energy {most:.5} at most",
        sum / f64::from(count)
    );
    (worst, most)
}

#[test]
fn dispersed_approaches_rebound_as_in_short_steps() {
    let (off, energy) = worst(40);
    assert!(off <= 0.02 && energy <= 1.002, "{off} {energy}");
}

#[test]
#[ignore = "minutes"]
fn ten_thousand_dispersed_approaches() {
    let (off, energy) = worst(10_000);
    assert!(off <= 0.02 && energy <= 1.002, "{off} {energy}");
}
