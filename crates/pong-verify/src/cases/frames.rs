//! V25, V26: the common frame does not matter, and action is reaction.

use crate::case::{Case, Failure, Outcome};
use crate::measure::rotation;
use crate::row::Row;
use crate::scene::{Duo, at, moving, point_mass};
use pong_engine::{InterfaceId, State, World};
use pong_executive::{Integrator, Path, Pose, RigidBody, Twist, Vec3, Wrench};
use pong_testkit::Random;

pub const V25: Case = Case {
    id: "V25",
    title: "Moving and far frames",
    set_up: "A docking with every kind of pair in touch, 60 steps of rough motion with friction, seen at rest, turned, \
             from 6.8e6 m, at 7.7 km/s, and both at 1e8 m. Largest difference of force and moment, over what rounding \
             of the inputs allows. Then an undamped \
             bounce of 1 kg at 1 m/s on 1e5 N/m.",
    source: "contact depends on relative motion alone; allowed k·ε·|x| + c·ε·|v|, summed over the contacts",
    rows: far_frames,
};

pub const V26: Case = Case {
    id: "V26",
    title: "Action and reaction",
    set_up: "The docking of V25, 300 steps. Sums over both bodies, over the largest term.",
    source: "Newton's third law; listed contacts sum to the wrenches",
    rows: balance,
};

/// Pair stiffness is half of the surfaces' 2e5 N/m; a segment's end and similar features weigh less.
const STIFFNESS: f64 = 1e5;
/// Pair damping along and across the normal, N·s/m.
const DAMPING: f64 = 150.0 + 20.0;

struct Docking {
    world: World,
    sides: [InterfaceId; 2],
}

impl Docking {
    fn new() -> Result<Self, Failure> {
        let (world, sides) = Duo::new("probe", "socket")?.world()?;
        Ok(Self { world, sides })
    }

    fn step(&mut self, states: &[(Pose, Twist); 2]) -> Result<(), Failure> {
        let set = |i: usize| (self.sides[i], State::from_motion(&states[i].0, &states[i].1));
        let both = [set(0), set(1)];
        self.world.set_states(&both)?;
        self.world.step()?;
        Ok(())
    }

    /// Wrench along the common axes.
    fn wrench(&self, side: usize) -> Result<Wrench, Failure> {
        Ok(self.world.wrench_common(self.sides[side])?)
    }
}

fn some_motion(random: &mut Random) -> [(Pose, Twist); 2] {
    let mut body = |place: f64, turn: f64| {
        (
            Pose { position: random.vector(place), orientation: rotation(random.vector(turn)) },
            Twist { linear: random.vector(0.05), angular: random.vector(0.1) },
        )
    };
    [body(0.01, 0.05), body(0.003, 0.02)]
}

/// A drifting frame in which everything stands at a pose.
struct Seen {
    pose: Pose,
    drift: Vec3,
}

impl Seen {
    fn motion(&self, (pose, twist): &(Pose, Twist), time: f64) -> (Pose, Twist) {
        let moved = Pose { position: self.pose.position + self.drift * time, ..self.pose };
        let turn = self.pose.orientation;
        let twist = Twist { linear: turn * twist.linear + self.drift, angular: turn * twist.angular };
        (moved.compose(pose), twist)
    }
}

fn far_frames() -> Outcome {
    let turn = rotation(Vec3::new(0.3, -1.1, 0.7));
    let cases = [
        ("turned", Vec3::new(1.0, -2.0, 0.5), Vec3::zeros()),
        ("6.8e6 m away", Vec3::new(5.1e6, -2.0e6, 4.0e6), Vec3::zeros()),
        ("at 7.7 km/s", Vec3::zeros(), Vec3::new(7000.0, -3000.0, 1000.0)),
        ("1e8 m away at 7.7 km/s", Vec3::new(-9e7, 3e7, 3e7), Vec3::new(1000.0, 2000.0, -7300.0)),
    ];
    cases
        .iter()
        .map(|(name, position, drift)| {
            let seen = Seen { pose: Pose { position: *position, orientation: turn }, drift: *drift };
            Ok(Row::below(format!("{name}: difference over allowed"), "", difference(&seen)?, 1.0))
        })
        .chain(std::iter::once_with(without_rounding))
        .chain(std::iter::once_with(far_bounce))
        .collect()
}

/// Without rounding of positions and velocities the wrench is the same bit for bit.
fn without_rounding() -> Result<Row, Failure> {
    let mut random = Random(25);
    let (mut near, mut far) = (Docking::new()?, Docking::new()?);
    // Of 53 bits, 24 are left for the fraction.
    let coarse = |v: Vec3| v.map(|x| libm::round(x * 16_777_216.0) / 16_777_216.0);
    let (origin, drift) = (Vec3::new(5.1e6, -2.0e6, 4.0e6), Vec3::new(7000.0, -3000.0, 1000.0));
    let mut different = 0;
    for _ in 0..60 {
        let states = some_motion(&mut random).map(|(pose, twist)| {
            let position = coarse(pose.position);
            (Pose { position, ..pose }, Twist { linear: coarse(twist.linear), ..twist })
        });
        near.step(&states)?;
        far.step(&states.map(|(pose, twist)| {
            let position = pose.position + origin;
            (Pose { position, ..pose }, Twist { linear: twist.linear + drift, ..twist })
        }))?;
        for side in 0..2 {
            different += usize::from(near.wrench(side)? != far.wrench(side)?);
        }
    }
    Ok(Row::count("6.8e6 m away at 7.7 km/s, inputs exact: wrenches that differ in any bit", 0, different))
}

/// One undamped bounce on ground that orbits 6.8e6 m away at 7.7 km/s.
fn far_bounce() -> Result<Row, Failure> {
    let origin = at(Vec3::new(5.1e6, -2.0e6, 4.0e6));
    let orbit = moving(Vec3::new(7000.0, -3000.0, 1000.0));
    let ground = RigidBody::prescribed("ground", Path::ConstantTwist { pose: origin, twist: orbit });
    let start = Pose { position: origin.position + Vec3::z() * 1e-3, ..origin };
    let mass = point_mass(1.0).at(start).moving(moving(orbit.linear - Vec3::z()));
    let duo = Duo::new("point", "ground")?.mover(|s| s.stiffness = 1e5)?;
    let mut run = duo.simulate((Integrator::RungeKutta4, 1e-5), mass, ground)?;
    run.sim.run_for(0.02)?;
    let speed = run.velocity() - orbit.linear;
    // A position error of ε·|x| at touch and at release changes the speed by ω·ε·|x| each.
    let allowed = 2.0 * 1e5_f64.sqrt() * f64::EPSILON * 6.8e6;
    Ok(Row::absolute("bounce at 6.8e6 m and 7.7 km/s: speed of rebound", "m/s", 1.0, speed.z, allowed))
}

/// Largest difference of wrenches, as a multiple of the allowance.
fn difference(seen: &Seen) -> Result<f64, Failure> {
    let mut random = Random(11);
    let (mut near, mut far) = (Docking::new()?, Docking::new()?);
    let back = seen.pose.orientation.inverse();
    let mut worst = 0.0_f64;
    for step in 0..60 {
        let states = some_motion(&mut random);
        near.step(&states)?;
        let time = f64::from(step) * 1e-3;
        far.step(&states.map(|state| seen.motion(&state, time)))?;
        let contacts = near.world.contacts();
        if contacts.len() < 8 || far.world.contact_count() != contacts.len() {
            return Err(format!("{} contacts near, {} far", contacts.len(), far.world.contact_count()).into());
        }
        // Each coordinate is rounded twice, with geometry near 1 m; the bristle has ⅔ of the spring's
        // stiffness.
        let place = f64::EPSILON * ((seen.pose.position + seen.drift * time).norm() + 1.0);
        let speed = f64::EPSILON * (seen.drift.norm() + 1.0);
        let allowed = contacts.len() as f64 * 2.0 * (5.0 / 3.0 * STIFFNESS * place + DAMPING * speed);
        for side in 0..2 {
            let (a, b) = (near.wrench(side)?, far.wrench(side)?);
            let force = (back * b.force - a.force).norm();
            let moment = (back * b.moment - a.moment).norm();
            worst = worst.max(force / allowed).max(moment / allowed);
        }
    }
    Ok(worst)
}

fn balance() -> Outcome {
    let mut random = Random(3);
    let mut docking = Docking::new()?;
    let [mut force, mut moment, mut listed] = [0.0_f64; 3];
    for _ in 0..300 {
        let states = some_motion(&mut random);
        docking.step(&states)?;
        let contacts = docking.world.contacts();
        let largest = contacts.iter().map(|c| c.force.norm()).fold(0.0, f64::max);
        let [a, b] = [docking.wrench(0)?, docking.wrench(1)?];
        let [xa, xb] = states.map(|(pose, _)| pose.position);
        force = force.max((a.force + b.force).norm() / largest);
        let about_origin = a.moment + xa.cross(&a.force) + b.moment + xb.cross(&b.force);
        moment = moment.max(about_origin.norm() / largest);
        let mut sum = Wrench::zero();
        for c in &contacts {
            // The probe is named first, so it is A in every pair.
            sum += Wrench::of_force_at(c.force, &c.a.arm);
        }
        let off = (sum.force - a.force).norm().max((sum.moment - a.moment).norm());
        listed = listed.max(off / largest);
    }
    Ok(vec![
        Row::below("sum of forces", "", force, 1e-12),
        Row::below("sum of moments about the common origin", "m", moment, 1e-12),
        Row::below("listed contacts less the wrench", "", listed, 1e-12),
    ])
}
