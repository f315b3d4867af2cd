//! Hosts that apply a wrench some frames late.

use crate::rig::{Body, Rig};
use pong_geometry::Vec3;
use pong_slow::Settings;
use pong_testkit::ron::{model, surface};

const MASS: f64 = 100.0;
const SPEED: f64 = 0.1;
const FRAME: f64 = 0.01;

/// A ball that meets a wall with a contact of this duration (s).
fn rig(duration: f64, zeta: f64, delay_frames: u32, phase: f64) -> Rig {
    let rate = std::f64::consts::PI / duration;
    let k = MASS * rate * rate;
    let c = 2.0 * zeta * MASS * rate;
    let rest = format!("normal: Linear(damping: {:?}), friction: None", 2.0 * c);
    let surface = surface(2.0 * k, &rest);
    let ball = model("ball", &surface, "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)");
    let wall = model("wall", &surface, "Plane(name: \"f\", normal: (1,0,0), offset: 0.0)");
    let gap = SPEED * FRAME * (3.0 + f64::from(delay_frames) + phase);
    let bodies = vec![Body::ball(MASS, 0.1, Vec3::x() * (0.1 + gap), Vec3::x() * -SPEED), Body::fixed()];
    let settings = Settings { delay_frames, substeps_per_radian: 40.0, ..Settings::default() };
    Rig::new(&[&ball, &wall], bodies, settings, FRAME)
}

fn restitution(rig: &mut Rig, duration: f64) -> f64 {
    let frames = (3.0 * duration / FRAME) as usize + 10 + 2 * rig.late;
    (0..frames).for_each(|_| drop(rig.step()));
    rig.bodies[0].velocity.x / SPEED
}

#[test]
fn a_late_host_rebounds_as_one_in_time() {
    for (duration, zeta, e) in [(0.2, 0.0, 1.0), (0.4, 0.0, 1.0), (0.8, 0.0, 1.0), (0.4, 0.2, 0.5745)] {
        for delay_frames in [0, 1, 20] {
            let mut rig = rig(duration, zeta, delay_frames, 0.37);
            let seen = restitution(&mut rig, duration);
            println!("contact {duration} zeta {zeta} late {delay_frames}: {seen:.5}");
            assert!((seen - e).abs() <= 0.01);
        }
    }
}

/// An error of the masses is an error of the rebound; without the queue a late wrench gains energy.
#[test]
fn wrong_masses_and_an_unknown_delay_are_seen() {
    for (duration, off) in [(0.2, 0.25), (0.4, 0.13), (0.8, 0.04)] {
        for told in [0.9, 1.1] {
            let mut rig = rig(duration, 0.0, 20, 0.37);
            rig.told = told;
            let mut inserted: f64 = 0.0;
            let frames = (3.0 * duration / FRAME) as usize + 50;
            for _ in 0..frames {
                let report = rig.step();
                inserted = inserted.max(report.inserted.abs());
            }
            let seen = rig.bodies[0].velocity.x / SPEED;
            println!("contact {duration} masses {told}: {seen:.4}, inserted {inserted:.1e} J");
            assert!((seen - 1.0).abs() <= off && inserted > 0.0);
        }
        let mut rig = rig(duration, 0.0, 0, 0.37);
        rig.late = 20;
        let seen = restitution(&mut rig, duration);
        println!("contact {duration} without the queue: {seen:.3}");
        assert!(seen > 2.0);
    }
}
