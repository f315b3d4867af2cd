//! 12 t against 420 t on 1e8 N/m, at all phases of the touch.

use crate::rig::{Body, Rig, settings};
use pong_geometry::Vec3;
use pong_testkit::ron::{model, surface};

const MASSES: [f64; 2] = [12e3, 420e3];
const STIFFNESS: f64 = 1e8;
const SPEED: f64 = 0.1;

fn reduced() -> f64 {
    MASSES[0] * MASSES[1] / (MASSES[0] + MASSES[1])
}

/// Frame with this product of frame and rate of the contact.
fn frame(radians: f64) -> f64 {
    radians / (STIFFNESS / reduced()).sqrt()
}

/// Damping of each surface for a contact of damping ratio ζ.
fn rest(zeta: f64) -> String {
    let c = 2.0 * zeta * (STIFFNESS * reduced()).sqrt();
    format!("normal: Linear(damping: {:?}), friction: None", 2.0 * c)
}

/// Restitution of a linear contact that never pulls.
fn restitution(zeta: f64) -> f64 {
    if zeta == 0.0 {
        return 1.0;
    }
    let s = (1.0 - zeta * zeta).sqrt();
    (-zeta / s * (2.0 * zeta * s).atan2(2.0 * zeta * zeta - 1.0)).exp()
}

struct Bounce {
    rebound: f64,
    /// Largest energy over that of the start.
    energy: f64,
    momentum: f64,
    deepest: f64,
}

fn rig(phase: f64, radians: f64, zeta: f64, theta: f64, per_radian: f64) -> Rig {
    let ball = model(
        "ball",
        &surface(2.0 * STIFFNESS, &rest(zeta)),
        "Sphere(name: \"s\", center: (0,0,0), radius: 1.0)",
    );
    let frame = frame(radians);
    let gap = SPEED * frame * (1.0 + phase);
    let bodies = vec![
        Body::ball(MASSES[0], 1.0, Vec3::x() * (-2.0 - gap), Vec3::x() * SPEED),
        Body::ball(MASSES[1], 1.0, Vec3::zeros(), Vec3::zeros()),
    ];
    Rig::new(&[&ball, &ball], bodies, settings(theta, per_radian), frame)
}

fn run(mut rig: Rig, radians: f64) -> Bounce {
    let before = rig.momentum();
    let start = rig.kinetic();
    let mut seen = Bounce { rebound: 0.0, energy: 0.0, momentum: 0.0, deepest: 0.0 };
    let frames = 6 + 2 * (5.0 / radians).ceil() as usize + rig.late;
    for _ in 0..frames {
        rig.step();
        let depth = (2.0 - (rig.leading(1) - rig.leading(0)).x).max(0.0);
        let energy = rig.kinetic() + 0.5 * STIFFNESS * depth * depth;
        seen.energy = seen.energy.max(energy / start);
        seen.deepest = seen.deepest.max(depth);
        seen.momentum = seen.momentum.max((rig.momentum() - before).norm() / before.norm());
    }
    seen.rebound = (rig.bodies[1].velocity - rig.bodies[0].velocity).x / SPEED;
    seen
}

#[test]
fn rebound_energy_and_momentum_hold_at_every_phase() {
    let deepest = SPEED * (reduced() / STIFFNESS).sqrt();
    for (zeta, off_at_12, off_at_40) in [(0.0, 1e-3, 2e-4), (0.2155, 0.02, 0.01)] {
        let e = restitution(zeta);
        for radians in [1.0, 4.63, 20.0, 100.0] {
            for (per_radian, off) in [(12.0, off_at_12), (40.0, off_at_40)] {
                for theta in [1.0, 0.5, 0.0] {
                    if per_radian > 12.0 && theta < 1.0 {
                        continue;
                    }
                    let mut worst = [0.0_f64; 3];
                    let mut energy: f64 = 0.0;
                    let mut mean = 0.0;
                    let phases = 20;
                    for phase in 0..phases {
                        let phase = f64::from(phase) / f64::from(phases);
                        let seen = run(rig(phase, radians, zeta, theta, per_radian), radians);
                        worst[0] = worst[0].max((seen.rebound - e).abs());
                        worst[1] = worst[1].max(seen.momentum);
                        worst[2] = worst[2].max(seen.deepest / deepest);
                        energy = energy.max(seen.energy - 1.0);
                        mean += seen.rebound / f64::from(phases);
                    }
                    println!(
                        "zeta {zeta} wT {radians} n {per_radian} theta {theta}: mean {mean:.5} off {:.2e} momentum {:.1e} depth {:.4} energy {energy:.1e}",
                        worst[0], worst[1], worst[2]
                    );
                    assert!(worst[0] <= off, "rebound");
                    assert!(worst[1] <= 1e-12);
                    assert!(worst[2] <= 1.002);
                    assert!(energy <= 2e-3);
                }
            }
        }
    }
}
