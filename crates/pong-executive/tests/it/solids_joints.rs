//! Concave solids of convex pieces that hold each other: a nut on a bolt, a hook in an eye.

use super::solids::{G, Part, at, damped, fixed, simulate, solid};
use pong_executive::{Integrator, Load, MassProperties, Pose, Quat, Simulation, Vec3};
use pong_testkit::ron::place_of;
use std::f64::consts::{PI, TAU};

/// Convex polyhedron between two outlines of equally many corners, `low` and `high`. Seen from `high`, both run
/// counter-clockwise. `internal` lists internal side faces; side i begins at corner i.
fn piece(name: &str, low: &[Vec3], high: &[Vec3], internal: &[usize]) -> String {
    let count = low.len();
    let vertices: Vec<String> = low.iter().chain(high).map(place_of).collect();
    let list = |indices: &[usize]| {
        format!("[{}]", indices.iter().map(ToString::to_string).collect::<Vec<_>>().join(","))
    };
    let mut faces =
        vec![list(&(0..count).rev().collect::<Vec<_>>()), list(&(count..2 * count).collect::<Vec<_>>())];
    for index in 0..count {
        let next = (index + 1) % count;
        faces.push(list(&[index, next, next + count, index + count]));
    }
    let inactive: Vec<usize> = internal.iter().map(|side| side + 2).collect();
    format!(
        "Polyhedron(name: \"{name}\", vertices: [{}], faces: [{}], inactive_faces: {})",
        vertices.join(", "),
        faces.join(", "),
        list(&inactive)
    )
}

/// Square thread around z: radii, rise per turn, height of the tooth.
struct Thread {
    radii: [f64; 2],
    rise: f64,
    tooth: f64,
}

/// Sectors of a turn.
const SECTORS: i32 = 36;

impl Thread {
    /// Text of the pieces between two sectors; the lower side of sector 0 begins at the height `lift`. Each sector
    /// is two prisms with a common wall along a diagonal, because the four corners of its top are not in a plane.
    fn pieces(&self, first: i32, last: i32, lift: f64) -> String {
        let mut pieces = Vec::new();
        for sector in first..last {
            let corner = |radius: f64, ray: i32, tooth: f64| {
                let turn = f64::from(ray) / f64::from(SECTORS);
                let (sine, cosine) = (TAU * turn).sin_cos();
                Vec3::new(radius * cosine, radius * sine, self.rise * turn + lift + tooth)
            };
            let [inner, outer] = self.radii;
            let outlines: [[(f64, i32); 3]; 2] = [
                [(inner, sector), (outer, sector), (outer, sector + 1)],
                [(inner, sector), (outer, sector + 1), (inner, sector + 1)],
            ];
            // Walls between sectors are internal, the two end walls are not.
            let begins: &[usize] = if sector == first { &[2] } else { &[0, 2] };
            let ends: &[usize] = if sector + 1 == last { &[0] } else { &[0, 1] };
            for (half, (outline, internal)) in outlines.iter().zip([begins, ends]).enumerate() {
                let at = |tooth: f64| outline.map(|(radius, ray)| corner(radius, ray, tooth));
                pieces.push(piece(&format!("s{sector}h{half}"), &at(0.0), &at(self.tooth), internal));
            }
        }
        pieces.join(", ")
    }

    /// Angular acceleration of a nut that slips down under an axial load, rad/s². The thread couples axial and angular
    /// speed, r·ω·tan α, and the normal force N gives the axial force N·(cos α + μ·sin α) and the moment
    /// r·N·(sin α − μ·cos α).
    fn slip(&self, mu: f64, load: f64, mass: f64, inertia: f64) -> f64 {
        let [inner, outer] = self.radii;
        // Radius of the mean lever of an even pressure between the radii.
        let radius = 2.0 / 3.0 * (outer.powi(3) - inner.powi(3)) / (outer.powi(2) - inner.powi(2));
        let slope = (self.rise / (TAU * radius)).atan();
        let (sine, cosine) = slope.sin_cos();
        let along = (cosine + mu * sine) / (sine - mu * cosine);
        load / (mass * radius * slope.tan() + inertia / radius * along)
    }
}

/// A nut under an axial load turns down its bolt with the acceleration of a screw if μ < tan α, and stays if μ > tan α.
#[test]
fn nut_on_a_bolt_locks_itself_above_the_slope_of_its_thread() {
    let (mu, mass, inertia, load) = (0.15_f64, 0.5, 2e-4, 200.0);
    for (factor, slips) in [(0.93, false), (1.15, true)] {
        let rise = factor * mu * TAU * 0.02;
        let surface = damped(2e10, 100.0, mu);
        let thread = Thread { radii: [0.019, 0.021], rise, tooth: 0.4 * rise };
        let bolt = fixed(solid(&surface, &thread.pieces(-SECTORS / 2, 3 * SECTORS / 2, 0.0)));
        let nut = solid(&surface, &thread.pieces(0, SECTORS, thread.tooth));
        let moves = MassProperties::principal(mass, [1.2e-4, 1.2e-4, inertia]).with_mass_center(Vec3::new(
            0.0,
            0.0,
            thread.tooth + 0.5 * rise,
        ));
        let nut = Part { text: nut, moves: Some(moves), pose: at([0.0; 3]) };
        let (mut simulation, bodies) = simulate(&[bolt, nut], Integrator::RungeKutta4, 5e-5);
        simulation.add_load(Load::force(bodies[1], Vec3::new(0.0, 0.0, -load))).unwrap();
        simulation.run_for(0.01).unwrap();
        let (pose, spin) = (simulation.pose(bodies[1]), simulation.twist(bodies[1]).angular.z);
        simulation.run_for(0.015).unwrap();
        let turned = (simulation.pose(bodies[1]).orientation * pose.orientation.inverse()).scaled_axis();
        let gained = (simulation.twist(bodies[1]).angular.z - spin) / 0.015;
        let sunk = simulation.pose(bodies[1]).position.z - pose.position.z;
        let expected = -thread.slip(mu, load + mass * G, mass, inertia);
        println!(
            "tan α {factor} μ: turned {:e} rad, down {sunk:e} m, gained {gained:.1} rad/s², screw {expected:.1}",
            turned.z
        );
        if slips {
            assert!((sunk / (rise / TAU * turned.z) - 1.0).abs() < 0.05, "{sunk} {}", turned.z);
            assert!((gained / expected - 1.0).abs() < 0.04, "{gained} {expected}");
        } else {
            assert!(turned.z.abs() < 1e-6, "{}", turned.z);
        }
    }
}

/// Ring around y, as wide along y as between its radii, of trapezoids between the rays `first` and `last` of `rays`.
/// Ray 0 is half a step below x, and the rays follow each other towards −z. `carry` turns the whole.
fn arc(radii: [f64; 2], rays: i32, [first, last]: [i32; 2], carry: Quat) -> String {
    let half = 0.5 * (radii[1] - radii[0]);
    let mut pieces = Vec::new();
    for ray in first..last {
        let place = |radius: f64, ray: i32, y: f64| {
            let (sine, cosine) = (TAU * (f64::from(ray) + 0.5) / f64::from(rays)).sin_cos();
            carry * Vec3::new(radius * cosine, y, -radius * sine)
        };
        let outline = |y: f64| {
            [(0, ray), (1, ray), (1, ray + 1), (0, ray + 1)].map(|(side, ray)| place(radii[side], ray, y))
        };
        let closed = last - first == rays;
        let internal: Vec<usize> = [(0, closed || ray > first), (2, closed || ray + 1 < last)]
            .into_iter()
            .filter_map(|(side, joined)| joined.then_some(side))
            .collect();
        pieces.push(piece(&format!("ray{ray}"), &outline(-half), &outline(half), &internal));
    }
    pieces.join(", ")
}

/// Greatest growth of the mechanical energy over the least one so far.
struct EnergyWatch {
    least: f64,
    growth: f64,
}

impl EnergyWatch {
    fn new(simulation: &Simulation) -> EnergyWatch {
        EnergyWatch { least: simulation.energy().mechanical(), growth: 0.0 }
    }

    fn look(&mut self, simulation: &Simulation) {
        let now = simulation.energy().mechanical();
        self.growth = self.growth.max(now - self.least);
        self.least = self.least.min(now);
    }
}

/// An eye that falls into a hook, turned and aside, swings, comes to rest and hangs: the hook carries its weight, and no
/// energy is gained on the way.
#[test]
fn eye_hangs_in_a_hook() {
    let (radii, mass) = ([0.02, 0.03], 0.5);
    let surface = damped(1e9, 2000.0, 0.3);
    // Three quarters of a ring of twelve, open above.
    let hook = fixed(solid(&surface, &arc(radii, 12, [-2, 7], Quat::identity())));
    let across = Quat::from_scaled_axis(Vec3::z() * (0.5 * PI));
    let eye = solid(&surface, &arc(radii, 12, [0, 12], across));
    let moves =
        MassProperties::principal(mass, [2e-4, 4e-4, 2e-4]).with_mass_center(Vec3::new(0.0, 0.0, -0.02));
    let turn = Quat::from_scaled_axis(Vec3::new(0.1, 0.05, 0.2));
    let pose = Pose { position: Vec3::new(0.001, 0.0005, -0.036), orientation: turn };
    let eye = Part { text: eye, moves: Some(moves), pose };
    let (mut simulation, bodies) = simulate(&[hook, eye], Integrator::RungeKutta4, 5e-5);
    let first = simulation.energy().mechanical();
    let mut watch = EnergyWatch::new(&simulation);
    for _ in 0..40_000 {
        simulation.step().unwrap();
        watch.look(&simulation);
    }
    let lost = first - simulation.energy().mechanical();
    let carried = simulation.contact_wrench(bodies[1]).force;
    let twist = simulation.twist(bodies[1]);
    println!(
        "carried {carried:?} of {} N, speed {:e} m/s, {:e} rad/s, {lost:e} J lost, growth {:e} J, contacts {}",
        mass * G,
        twist.linear.norm(),
        twist.angular.norm(),
        watch.growth,
        simulation.world().contacts().len()
    );
    assert!((carried - Vec3::new(0.0, 0.0, mass * G)).norm() < 1e-3 * mass * G, "{carried:?}");
    assert!(twist.linear.norm() + 0.03 * twist.angular.norm() < 1e-4, "{twist:?}");
    assert!(watch.growth < 1e-4 * lost, "{}", watch.growth);
}
