//! Solids that friction wedges, against closed forms: a drawer pushed off its middle, an eccentric peg, a wedge between jaws.

use super::solids::{G, Part, at, damped, fixed, simulate, solid};
use super::solids_scenes::{bar_of, fixed_at};
use pong_executive::{Axes, Integrator, Load, LoadHistory, MassProperties, Twist, Vec3, Wrench};
use pong_testkit::ron::box_polyhedron;
use std::sync::Arc;

/// A drawer of the length l between two walls, pushed by F at e beside its middle, leans on two opposite corners with
/// N = F·e/l each. It moves with a = F·(1 − 2·μ·e/l)/m below e = l/(2·μ), and jams above.
#[test]
fn drawer_pushed_off_its_middle_jams_beyond_half_its_length_over_friction() {
    let (mu, half, clearance, mass, push) = (0.5, [0.05, 0.03, 0.02], 5e-4, 1.0, 20.0);
    let length = 2.0 * half[0];
    let surface = damped(1e12, 1.0, mu);
    for factor in [0.5, 0.9, 1.1] {
        let offset = factor * length / (2.0 * mu);
        let walls = [-1.0, 1.0].map(|side| {
            let middle = [0.2, side * (half[1] + clearance + 0.02), 0.0];
            fixed(solid(&surface, &box_polyhedron("wall", middle, [0.4, 0.02, 0.04], "")))
        });
        let moves = MassProperties::cuboid(mass, half.map(|h| 2.0 * h));
        let drawer = solid(&surface, &box_polyhedron("drawer", [0.0; 3], half, ""));
        let [first, second] = walls;
        let parts = [first, second, Part { text: drawer, moves: Some(moves), pose: at([0.0; 3]) }];
        let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 2e-5);
        simulation.set_gravity(Vec3::zeros());
        // The push grows slowly, so that the drawer turns onto its corners without a blow.
        let grown = move |now: f64| push * (now / 0.04).min(1.0).powi(2);
        let wrench = move |now: f64| Wrench {
            force: Vec3::new(grown(now), 0.0, 0.0),
            moment: Vec3::new(0.0, 0.0, -grown(now) * offset),
        };
        let history = LoadHistory::Function(Arc::new(wrench));
        let load = Load { body: bodies[2], point: Vec3::zeros(), axes: Axes::Common, history };
        simulation.add_load(load).unwrap();
        simulation.run_for(0.05).unwrap();
        let speed = simulation.twist(bodies[2]).linear.x;
        simulation.run_for(0.02).unwrap();
        let gained = (simulation.twist(bodies[2]).linear.x - speed) / 0.02;
        let expected = push * (1.0 - factor) / mass;
        println!("e {factor} l/(2μ): {gained:.3} m/s² for {expected:.3}");
        assert!((gained - expected).abs() < 0.02 * push / mass, "{gained} {expected}");
        if factor > 1.0 {
            simulation.run_for(0.1).unwrap();
            let start = simulation.pose(bodies[2]).position.x;
            simulation.run_for(0.05).unwrap();
            let moved = simulation.pose(bodies[2]).position.x - start;
            println!("jams, and moves by {moved:e} m in 0.05 s");
            assert!(moved.abs() < 1e-6, "{moved}");
        }
    }
}

/// A peg whose centre of mass is e beside its middle falls freely through a slot of the height l, even if e is twice
/// l/(2·μ): its weight acts in the centre of mass and turns nothing, so no edge presses.
#[test]
fn eccentric_peg_falls_freely_through_a_slot() {
    let (mu, height) = (0.5, 0.04);
    let surface = damped(1e12, 100.0, mu);
    let block = |side: f64| {
        let half = [0.02, 0.05, 0.5 * height];
        fixed_at(solid(&surface, &box_polyhedron("block", [0.0; 3], half, "")), [side * 0.04005, 0.0, 0.0])
    };
    let center = Vec3::new(2.0 * height / (2.0 * mu), 0.0, 0.0);
    let moves = MassProperties::cuboid(1.0, [0.04, 0.04, 0.2]).with_mass_center(center);
    let peg = solid(&surface, &box_polyhedron("peg", [0.0; 3], [0.02, 0.02, 0.1], ""));
    let parts = [block(-1.0), block(1.0), Part { text: peg, moves: Some(moves), pose: at([0.0; 3]) }];
    let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 1e-4);
    simulation.run_for(0.1).unwrap();
    let position = simulation.pose(bodies[2]).position;
    println!("fallen {}", -position.z);
    assert!((position.z + 0.5 * G * 0.01).abs() < 1e-9 && position.xy().norm() < 1e-12, "{position:?}");
}

/// Wedge between fixed jaws: friction, tan α of its half angle α, damping beside 1e5 N/m, first speed in m/s.
struct Wedge {
    mu: f64,
    slope: f64,
    damping: f64,
    speed: f64,
}

/// Push on the wedge, N.
const PUSH: f64 = 200.0;

impl Wedge {
    /// Normal and tangential force of a jaw, N, 0.15 s after the push began. It grows for 0.1 s, or is there at once.
    fn pressed(&self, grows: bool) -> [f64; 2] {
        let surface = damped(2e9, self.damping, self.mu);
        let (lean, deep) = (0.02 * self.slope, 0.04 * self.slope);
        let wedge = [[-0.03 + lean, -0.02], [0.03 - lean, -0.02], [0.03 + lean, 0.02], [-0.03 - lean, 0.02]];
        let right = [[0.03 - deep, -0.04], [0.08, -0.04], [0.08, 0.04], [0.03 + deep, 0.04]];
        let left = [[-0.08, -0.04], [-0.03 + deep, -0.04], [-0.03 - deep, 0.04], [-0.08, 0.04]];
        let moves = Some(MassProperties::cuboid(1.0, [0.06, 0.04, 0.04]));
        let parts = [
            fixed(solid(&surface, &bar_of("left", &left, 0.03))),
            fixed(solid(&surface, &bar_of("right", &right, 0.03))),
            Part { text: solid(&surface, &bar_of("wedge", &wedge, 0.02)), moves, pose: at([0.0; 3]) },
        ];
        let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 5e-5);
        simulation.set_gravity(Vec3::zeros());
        let twist = Twist { linear: Vec3::new(0.0, 0.0, -self.speed), angular: Vec3::zeros() };
        simulation.set_motion(bodies[2], at([0.0; 3]), twist).unwrap();
        let share = move |now: f64| if grows { (now / 0.1).min(1.0) } else { 1.0 };
        let load = Load::force_over_time(bodies[2], move |now| Vec3::new(0.0, 0.0, -PUSH * share(now)));
        simulation.add_load(load).unwrap();
        simulation.run_for(0.15).unwrap();
        let force = simulation.contact_wrench(bodies[1]).force;
        let (sine, cosine) = self.slope.atan().sin_cos();
        [force.dot(&Vec3::new(cosine, 0.0, -sine)), force.dot(&Vec3::new(-sine, 0.0, -cosine))]
    }
}

/// A wedge between fixed jaws, pushed slowly by F, presses each with N = F/(2·(sin α + μ·cos α)). One that is struck goes
/// in farther. If tan α < μ it stays there, and presses with more than twice as much under the same F, up to what the
/// energy of the blow allows: ½·m·v² + F·x = x·N·(sin α + μ·cos α) at the way x = N/(k·sin α).
#[test]
fn wedge_presses_as_its_push_says_and_more_after_a_blow() {
    for (mu, slope) in [(0.0, 0.25), (0.1, 0.25), (0.3, 0.25), (0.3, 0.5)] {
        let (sine, cosine) = f64::atan(slope).sin_cos();
        let expected = PUSH / (2.0 * (sine + mu * cosine));
        let [normal, along] = Wedge { mu, slope, damping: 300.0, speed: 0.0 }.pressed(true);
        println!("μ {mu}, tan α {slope}: N {normal:.2}, along {along:.2}, closed form {expected:.2}");
        assert!(
            (normal / expected - 1.0).abs() < 1e-3 && (along - mu * normal).abs() < 1e-3 * normal,
            "{normal}"
        );
    }
    let (mu, slope, speed) = (0.3, 0.25_f64, 0.5);
    let (sine, cosine) = slope.atan().sin_cos();
    let stiffness = 1e9 * 0.04 * 0.04 / cosine;
    let (square, linear) = ((sine + mu * cosine) / (stiffness * sine), PUSH / (stiffness * sine));
    let most = (linear + (linear * linear + 2.0 * square * speed * speed).sqrt()) / (2.0 * square);
    let slow = PUSH / (2.0 * (sine + mu * cosine));
    let [normal, _] = Wedge { mu, slope, damping: 3.0, speed }.pressed(false);
    println!("struck: N {normal:.2}, slowly pushed {slow:.2}, at most {most:.2}");
    assert!(normal > 2.0 * slow && normal < most, "{normal} {slow} {most}");
}
