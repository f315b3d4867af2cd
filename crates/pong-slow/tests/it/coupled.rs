//! Groups that joints connect: an impulse on one moves the others.

use crate::rig::{all_paired, settings};
use nalgebra::{Matrix6, UnitQuaternion, Vector6};
use pong_engine::{Config, InterfaceId, State};
use pong_geometry::{Pose, Quat, Twist, Vec3, Wrench};
use pong_slow::{Coupling, Dynamics, GroupInput, SlowError, SlowHost};
use pong_testkit::ron::{model, surface};

/// A rigid bar along x, with a ball at each end that is a movable group of its own, above a floor. Its motion is that of
/// the mass centre; all wrenches are held along its axes.
struct Bar {
    slow: SlowHost,
    interfaces: Vec<InterfaceId>,
    /// Place of each group along the bar, m.
    out: Vec<f64>,
    pose: Pose,
    velocity: Vec3,
    turning: Vec3,
    frame: f64,
    coupled: bool,
}

const MASS: f64 = 12.0;
const MOMENTS: [f64; 3] = [0.5, 2.0, 2.0];
const HALF: f64 = 1.0;

impl Bar {
    /// One group with both balls, or one group for each.
    fn new(k: f64, groups: usize, frame: f64) -> Self {
        let surface = surface(2.0 * k, "normal: Linear(damping: 0.0), friction: None");
        let ball =
            |name: &str, x: f64| format!("Sphere(name: \"{name}\", center: ({x:?},0,0), radius: 0.05)");
        let (out, mut models) = match groups {
            1 => (
                vec![0.0],
                vec![model("bar", &surface, &format!("{},{}", ball("l", -HALF), ball("r", HALF)))],
            ),
            _ => (
                vec![-HALF, HALF],
                vec![model("l", &surface, &ball("l", 0.0)), model("r", &surface, &ball("r", 0.0))],
            ),
        };
        models.push(model("floor", &surface, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"));
        let texts: Vec<&str> = models.iter().map(String::as_str).collect();
        let (world, interfaces) = all_paired(Config::default(), &texts);
        let slow = SlowHost::new(&world, settings(1.0, 12.0)).unwrap();
        let pose = Pose { position: Vec3::zeros(), orientation: Quat::identity() };
        Self {
            slow,
            interfaces,
            out,
            pose,
            velocity: Vec3::zeros(),
            turning: Vec3::zeros(),
            frame,
            coupled: true,
        }
    }

    /// Motion of a place along the bar per motion of the mass centre, along the axes of the bar.
    fn jacobian(out: f64) -> Matrix6<f64> {
        let mut jacobian = Matrix6::identity();
        // v = v₀ + ω × (out, 0, 0)
        jacobian[(1, 5)] = out;
        jacobian[(2, 4)] = -out;
        jacobian
    }

    fn inverse_mass() -> Matrix6<f64> {
        let [x, y, z] = MOMENTS.map(f64::recip);
        Matrix6::from_diagonal(&Vector6::new(1.0 / MASS, 1.0 / MASS, 1.0 / MASS, x, y, z))
    }

    fn mobility(&self, of: usize, by: usize) -> [[f64; 6]; 6] {
        let block =
            Self::jacobian(self.out[of]) * Self::inverse_mass() * Self::jacobian(self.out[by]).transpose();
        [0, 1, 2, 3, 4, 5].map(|i| [0, 1, 2, 3, 4, 5].map(|j| block[(i, j)]))
    }

    fn inputs(&self) -> Vec<GroupInput> {
        let group = |(index, out): (usize, &f64)| {
            let arm = self.pose.orientation * Vec3::x() * *out;
            let twist = Twist { linear: self.velocity + self.turning.cross(&arm), angular: self.turning };
            let pose = Pose { position: self.pose.position + arm, orientation: self.pose.orientation };
            GroupInput {
                interface: self.interfaces[index],
                state: State::from_motion(&pose, &twist),
                dynamics: Dynamics::Jointed { mobility: self.mobility(index, index) },
                linear_acceleration: self.turning.cross(&self.turning.cross(&arm)).into(),
                angular_acceleration: [0.0; 3],
            }
        };
        let mut inputs: Vec<_> = self.out.iter().enumerate().map(group).collect();
        inputs.push(GroupInput {
            interface: self.interfaces[self.out.len()],
            state: State::identity(),
            dynamics: Dynamics::Prescribed,
            linear_acceleration: [0.0; 3],
            angular_acceleration: [0.0; 3],
        });
        inputs
    }

    fn step(&mut self) {
        if self.coupled && self.out.len() == 2 {
            let [of, by] = [self.interfaces[0], self.interfaces[1]];
            self.slow.set_couplings(&[Coupling { of, by, mobility: self.mobility(0, 1) }]).unwrap();
        }
        self.slow.step(self.frame, &self.inputs()).unwrap();
        let mut impulse = Vector6::zeros();
        for (interface, out) in self.interfaces.iter().zip(&self.out) {
            let Wrench { force, moment } = self.slow.wrench(*interface).unwrap();
            let wrench = Vector6::from_iterator(force.iter().chain(&moment).copied());
            impulse += Self::jacobian(*out).transpose() * wrench * self.frame;
        }
        let gained = Self::inverse_mass() * impulse;
        self.velocity += self.pose.orientation * gained.fixed_rows::<3>(0).into_owned();
        self.turning += self.pose.orientation * gained.fixed_rows::<3>(3).into_owned();
        self.pose.position += self.velocity * self.frame;
        self.pose.orientation =
            UnitQuaternion::from_scaled_axis(self.turning * self.frame) * self.pose.orientation;
    }

    fn kinetic(&self) -> f64 {
        let turning = self.pose.orientation.inverse() * self.turning;
        0.5 * MASS * self.velocity.norm_squared()
            + (0..3).map(|axis| 0.5 * MOMENTS[axis] * turning[axis] * turning[axis]).sum::<f64>()
    }

    /// Drops the bar with this tilt about y, and returns it after the touch, with its greatest energy over that of the
    /// start.
    fn dropped(mut self, height: f64, tilt: f64) -> (Self, f64) {
        self.pose.position.z = 0.05 + HALF * tilt.sin().abs() + height;
        self.pose.orientation = Quat::from_scaled_axis(Vec3::y() * tilt);
        self.velocity = -Vec3::z();
        let start = self.kinetic();
        let mut greatest: f64 = 0.0;
        for _ in 0..12 {
            self.step();
            greatest = greatest.max(self.kinetic() / start);
        }
        (self, greatest)
    }
}

/// A bar of two groups bounces like the same bar as one group: flat, on both balls at once, with its speed reversed.
#[test]
fn coupled_groups_move_as_the_body_that_they_are() {
    let frame = 0.05;
    for k in [1e5, 1e8] {
        for (height, tilt) in [(0.012, 0.0), (0.041, 0.0), (0.02, 0.04), (0.033, -0.1)] {
            let (one, _) = Bar::new(k, 1, frame).dropped(height, tilt);
            let (two, energy) = Bar::new(k, 2, frame).dropped(height, tilt);
            let off = (one.velocity - two.velocity).norm().max((one.turning - two.turning).norm());
            println!("k {k:e} tilt {tilt}: off {off:.1e}, energy {energy:.6}, up {:.6}", two.velocity.z);
            assert!(off < 1e-7 && energy < 1.005);
            if tilt == 0.0 {
                assert!((two.velocity.z - 1.0).abs() < 1e-3);
            }
        }
    }
}

/// Without the coupling each ball is given the impulse that reverses the whole bar: it leaves three times as fast.
#[test]
fn groups_without_their_coupling_gain_energy() {
    let mut bar = Bar::new(1e8, 2, 0.05);
    bar.coupled = false;
    let (bar, _) = bar.dropped(0.012, 0.0);
    assert!(bar.velocity.z > 1.5, "{}", bar.velocity.z);
}

#[test]
fn couplings_that_cannot_be_are_refused() {
    let mut bar = Bar::new(1e5, 2, 0.05);
    let [l, r, floor] = [bar.interfaces[0], bar.interfaces[1], bar.interfaces[2]];
    let mobility = bar.mobility(0, 1);
    let coupling = |of, by| Coupling { of, by, mobility };
    let mut refused = |couplings: &[Coupling], words: &str| {
        let error = bar.slow.set_couplings(couplings).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&[coupling(l, l)], "coupling of `o0/l` and `o0/l`: it is one group; give its own mobility");
    refused(&[coupling(l, r), coupling(r, l)], "it is given twice; one direction is enough");
    refused(&[Coupling { mobility: [[f64::NAN; 6]; 6], ..coupling(l, r) }], "it is not finite");

    let (inputs, back) = (bar.inputs(), bar.mobility(1, 0));
    let mut evaluated = |couplings: &[Coupling]| {
        bar.slow.set_couplings(couplings).unwrap();
        bar.slow.evaluate(0.05, &inputs).map(|_| ()).map_err(|error: SlowError| error.to_string())
    };
    let error = evaluated(&[coupling(l, floor)]).unwrap_err();
    assert!(error.contains("`o2/floor` is not in joints; give it `Jointed` dynamics"), "{error}");
    // Twice the coupling of a rigid bar: an impulse would gain energy.
    let doubled = mobility.map(|row| row.map(|x| 2.0 * x));
    let error = evaluated(&[Coupling { mobility: doubled, ..coupling(l, r) }]).unwrap_err();
    assert!(
        error.contains("mobility of `o0/l`, `o1/r`: an impulse would move the body against itself"),
        "{error}"
    );
    evaluated(&[Coupling { mobility: back, ..coupling(r, l) }]).unwrap();
}
