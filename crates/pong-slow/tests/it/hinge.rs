//! An arm on a hinge whose bar meets a wall.

use crate::rig::{all_paired, settings};
use nalgebra::{Matrix6, Vector6};
use pong_engine::{Config, InterfaceId, State};
use pong_geometry::{Pose, Quat, Twist, Vec3};
use pong_slow::{Dynamics, GroupInput, SlowHost};
use pong_testkit::ron::{model, surface};

const INERTIA: f64 = 0.1;
const LENGTH: f64 = 0.4;

/// An arm along x that turns about y through the common origin; its group's origin is this far out along the arm.
struct Arm {
    slow: SlowHost,
    interfaces: Vec<InterfaceId>,
    angle: f64,
    rate: f64,
    out: f64,
    frame: f64,
    theta: f64,
}

impl Arm {
    fn new(k: f64, zeta: f64, [angle, rate]: [f64; 2], out: f64, frame: f64, theta: f64) -> Self {
        let c = 2.0 * zeta * (k * INERTIA).sqrt() / LENGTH;
        let rest = format!("normal: Linear(damping: {:?}), friction: None", 2.0 * c);
        let surface = surface(2.0 * k, &rest);
        let bar = format!("Sphere(name: \"s\", center: ({:?},0,0), radius: 0.01)", LENGTH - out);
        let arm = model("arm", &surface, &bar);
        let floor = model("floor", &surface, "Plane(name: \"f\", normal: (0,0,1), offset: -0.01)");
        let (world, interfaces) = all_paired(Config::default(), &[&arm, &floor]);
        let slow = SlowHost::new(&world, settings(theta, 12.0)).unwrap();
        Self { slow, interfaces, angle, rate, out, frame, theta }
    }

    /// Positive angles lift the bar.
    fn inputs(&self) -> [GroupInput; 2] {
        let axis = -Vec3::y();
        let orientation = Quat::from_scaled_axis(axis * self.angle);
        let arm = orientation * Vec3::x() * self.out;
        let turning = axis * self.rate;
        let twist = Twist { linear: turning.cross(&arm), angular: turning };
        let screw = Vector6::new(0.0, 0.0, self.out, 0.0, -1.0, 0.0);
        let mobility: Matrix6<f64> = screw * screw.transpose() / INERTIA;
        let group = GroupInput {
            interface: self.interfaces[0],
            state: State::from_motion(&Pose { position: arm, orientation }, &twist),
            dynamics: Dynamics::Jointed {
                mobility: [0, 1, 2, 3, 4, 5].map(|i| [0, 1, 2, 3, 4, 5].map(|j| mobility[(i, j)])),
            },
            linear_acceleration: turning.cross(&twist.linear).into(),
            angular_acceleration: [0.0; 3],
        };
        let ground = GroupInput {
            interface: self.interfaces[1],
            state: State::identity(),
            dynamics: Dynamics::Prescribed,
            linear_acceleration: [0.0; 3],
            angular_acceleration: [0.0; 3],
        };
        [group, ground]
    }

    fn step(&mut self) {
        self.slow.step(self.frame, &self.inputs()).unwrap();
        // Along the group's axes the lever of the force is the same at every angle.
        let wrench = self.slow.wrench(self.interfaces[0]).unwrap();
        let torque = -wrench.moment.y + self.out * wrench.force.z;
        let acceleration = torque / INERTIA;
        self.angle += self.rate * self.frame + self.theta * acceleration * self.frame * self.frame;
        self.rate += acceleration * self.frame;
    }

    fn lead(&self) -> f64 {
        self.angle + (1.0 - self.theta) * self.frame * self.rate
    }
}

#[test]
fn the_rebound_of_an_arm_is_right_at_every_phase() {
    let frame = 0.05;
    for radians in [13.0, 20.0, 63.0, 200.0] {
        let k = INERTIA * (radians / (frame * LENGTH)).powi(2);
        for turn in [0.02, 0.1] {
            for (out, theta) in [(0.0, 1.0), (0.0, 0.5), (0.0, 0.0), (0.3, 1.0), (0.5, 0.0)] {
                let (mut worst, mut energy): (f64, f64) = (0.0, 0.0);
                for phase in 0..20 {
                    let phase = f64::from(phase) / 20.0;
                    let rate = turn / frame;
                    let mut arm = Arm::new(k, 0.0, [turn * (2.0 + phase), -rate], out, frame, theta);
                    for _ in 0..7 {
                        arm.step();
                        let depth = (-LENGTH * arm.lead().sin()).max(0.0);
                        energy = energy.max(
                            (arm.rate * arm.rate * INERTIA + k * depth * depth) / (INERTIA * rate * rate)
                                - 1.0,
                        );
                    }
                    worst = worst.max((arm.rate / rate - 1.0).abs());
                }
                println!(
                    "wT {radians} turn {turn} out {out} theta {theta}: off {worst:.1e} energy {energy:.1e}"
                );
                assert!(worst <= 1e-3 && energy <= 0.017);
            }
        }
    }
}
