//! Cylinders and cones on their side on triangles (docs/theory.md, 2.8): the two discs yield, each with half a spring,
//! until the body is clear of the surface.

use crate::common::*;
use pong_geometry::{Quat, Vec3, Wrench};
use pong_testkit::Random;
use std::cell::RefCell;

const K: f64 = 1e4;
/// Stiffness of the pair: two equal springs in series.
const PAIR: f64 = 0.5 * K;
const DEPTH: f64 = 1e-3;

fn part(text: &str) -> String {
    model("part", &surface(K, "friction: None"), text)
}

/// A cylinder or a cone along x, its middle at the origin.
#[derive(Clone, Copy, Debug)]
struct Drum {
    length: f64,
    radii: [f64; 2],
}

impl Drum {
    const fn new(length: f64, radii: [f64; 2]) -> Self {
        Self { length, radii }
    }

    fn model(&self) -> String {
        let (half, [first, last]) = (0.5 * self.length, self.radii);
        let ends = format!("ends: (({:?},0,0),({half:?},0,0))", -half);
        part(&match first == last {
            true => format!("Cylinder(name: \"d\", {ends}, radius: {first:?})"),
            false => format!("Cone(name: \"d\", {ends}, radii: ({first:?},{last:?}))"),
        })
    }

    fn centers(&self, (place, turn): (Vec3, Quat)) -> [Vec3; 2] {
        [-0.5, 0.5].map(|half| place + turn * Vec3::x() * (half * self.length))
    }

    /// Energy that the lowest places of the two discs store on a plane at `height` along its unit normal.
    fn stored_on_plane(&self, pose: (Vec3, Quat), normal: &Vec3, height: f64) -> f64 {
        let sine = normal.cross(&(pose.1 * Vec3::x())).norm();
        let depth = |(center, radius): (Vec3, f64)| height - normal.dot(&center) + radius * sine;
        let squares = self.centers(pose).into_iter().zip(self.radii).map(depth).map(|d| d.max(0.0).powi(2));
        0.25 * PAIR * squares.sum::<f64>()
    }

    /// Least energy on planes that lean by less than 35° along x and y and have the corners of a convex surface behind them
    /// (decision 0014, equation 2).
    fn least_on_planes(&self, pose: (Vec3, Quat), corners: &[Vec3]) -> f64 {
        let stored = |x: f64, y: f64| {
            let normal = Vec3::new(x, y, 1.0).normalize();
            let height = corners.iter().map(|corner| normal.dot(corner)).fold(f64::NEG_INFINITY, f64::max);
            self.stored_on_plane(pose, &normal, height)
        };
        least_of(|x| least_of(|y| stored(x, y)))
    }
}

/// Least value of a function that falls and then rises between −0.7 and 0.7.
fn least_of(value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (-0.7, 0.7);
    for _ in 0..60 {
        let third = (high - low) / 3.0;
        let (a, b) = (low + third, high - third);
        if value(a) < value(b) { high = b } else { low = a }
    }
    value(0.5 * (low + high))
}

const DRUMS: [Drum; 3] =
    [Drum::new(1.0, [0.1, 0.1]), Drum::new(0.3, [0.25, 0.25]), Drum::new(0.6, [0.15, 0.1])];

fn plate(n: usize) -> String {
    plate_mesh("p", n, 2.0, |x, y| Vec3::new(x, y, 0.0))
}

fn corners_of_plate() -> Vec<Vec3> {
    [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)].map(|(x, y)| Vec3::new(x, y, 0.0)).to_vec()
}

fn set_at(rig: &mut Rig, (place, turn): (Vec3, Quat)) -> (Wrench, f64) {
    rig.set_at(place, turn)
}

fn on(drum: &Drum, ground: &str) -> Rig {
    Rig::new(&drum.model(), &part(ground))
}

fn share(s: f64) -> f64 {
    0.5 / ((1.0 - s) * (1.0 - s) + s * s)
}

/// A drum on a plate carries kδ in its middle as long as its middle is over it; past the rim about kδ/(2(1 − s)² + 2s²) at
/// the rim. Across a ridge it carries that at the place s of the ridge. A rim alone carries ½kδ.
#[test]
fn a_drum_carries_what_its_two_discs_store() {
    let whole = PAIR * DEPTH;
    let drum = DRUMS[0];
    for n in [1, 5] {
        let mut rig = on(&drum, &plate(n));
        for over in [0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
            let x = 1.5 - over;
            let (wrench, _) = set_at(&mut rig, (Vec3::new(x, 0.03, 0.1 - DEPTH), Quat::identity()));
            let (force, at) = if over < 0.5 { (share(over), 1.0) } else { (1.0, x) };
            let limit = if over < 0.5 { 1e-2 } else { 1e-9 };
            assert!(
                (wrench.force - Vec3::z() * force * whole).norm() < limit * whole,
                "{n} {over}: {wrench:?}"
            );
            let moment = (x - at) * force * whole;
            assert!((wrench.moment.y - moment).abs() < limit * whole, "{n} {over}: {wrench:?} {moment}");
        }
        let lifted = 0.1 * 0.3_f64.cos() + 0.5 * 0.3_f64.sin() - DEPTH;
        let (wrench, _) =
            set_at(&mut rig, (Vec3::new(0.0, 0.0, lifted), Quat::from_scaled_axis(Vec3::y() * 0.3)));
        assert!((wrench.force - Vec3::z() * (0.5 * whole)).norm() < 1e-9 * whole, "{}", wrench.force);
    }
    let mut ridge = on(&drum, &plate_mesh("p", 2, 4.0, |x, y| Vec3::new(x, y, -0.5 * x.abs())));
    for s in [0.1_f64, 0.3, 0.5, 0.8] {
        let (wrench, _) = set_at(&mut ridge, (Vec3::new(0.5 - s, 0.0, 0.1 - DEPTH), Quat::identity()));
        let off = (wrench.force - Vec3::z() * (share(s) * whole)).norm();
        assert!(off < 2e-2 * whole && (s != 0.5 || off < 1e-9 * whole), "{s}: {wrench:?}");
        assert!((wrench.moment.y - (0.5 - s) * share(s) * whole).abs() < 1e-2 * whole, "{s}: {wrench:?}");
    }
}

/// Where a drum overhangs on one side or both, or lies across a ridge, a tilt through lying flat moves its load steadily.
#[test]
fn the_load_of_a_drum_that_overhangs_does_not_step() {
    let ridge = plate_mesh("p", 2, 4.0, |x, y| Vec3::new(x, y, -0.5 * x.abs()));
    let strip = plate_mesh("p", 3, 2.0, |x, y| Vec3::new(0.2 * x, y, 0.0));
    for (drum, ground, x) in [
        (DRUMS[0], &plate(3), 0.8),
        (DRUMS[0], &plate(3), 1.2),
        (DRUMS[1], &plate(3), 0.95),
        (DRUMS[0], &strip, 0.05),
        (DRUMS[0], &ridge, 0.0),
        (DRUMS[0], &ridge, 0.2),
    ] {
        let mut rig = on(&drum, ground);
        let mut at = |tilt: f64| {
            let turn = Quat::from_scaled_axis(Vec3::y() * tilt);
            set_at(&mut rig, (Vec3::new(x, 0.03, drum.radii[0] - DEPTH), turn)).0
        };
        let at = [-1e-7, -1e-9, 0.0, 1e-9, 1e-7].map(&mut at);
        for (tilted, tilt) in at.iter().zip([1e-7, 1e-9, 0.0, 1e-9, 1e-7]) {
            let off = (tilted.force - at[2].force).norm() + (tilted.moment - at[2].moment).norm();
            assert!(off <= 1e3 * tilt * at[2].force.norm(), "{x} {tilt}: {tilted:?} {:?}", at[2]);
        }
    }
}

/// A pose on its side near `place`, its lowest place less than 10 mm below z = 0.
fn near(drum: &Drum, random: &mut Random, case: usize) -> (Vec3, Quat) {
    let middle = random.vector(1.2);
    let yaw = [3.0, 0.02, 3.0, 1e-7][case % 4];
    let yaw = Quat::from_scaled_axis(Vec3::z() * random.between(-yaw, yaw));
    let turn = yaw * Quat::from_scaled_axis(random.vector([0.0, 0.01, 0.2][case / 4 % 3]));
    let axis = turn * Vec3::x();
    let sine = (1.0 - axis.z * axis.z).sqrt();
    let low = [-0.5, 0.5].map(|half| half * drum.length * axis.z);
    let low = (drum.radii[0] * sine - low[0]).max(drum.radii[1] * sine - low[1]);
    let y = if case % 3 == 1 { 1.0 + 0.02 * middle.y } else { middle.y };
    (Vec3::new(middle.x, y, low - random.between(0.0, 0.01)), turn)
}

/// Over a plate, past its rims and corners: the energy is the least on planes that have the plate behind them, and the cuts
/// change nothing.
#[test]
fn cuts_of_a_plate_change_nothing() {
    let corners = corners_of_plate();
    for (index, drum) in DRUMS.iter().enumerate() {
        let mut rigs = [1, 3, 8].map(|n| on(drum, &plate(n)));
        let mut random = Random(7 + index as u64);
        let (mut touching, mut compared, mut worst) = (0, 0, [0.0_f64; 3]);
        for case in 0..150 {
            let pose = near(drum, &mut random, case);
            let [whole, others @ ..] = rigs.each_mut().map(|rig| set_at(rig, pose));
            if whole.1 == 0.0 {
                assert!(others.iter().all(|(_, stored)| *stored == 0.0), "{index} {case}");
                continue;
            }
            touching += 1;
            let scale = PAIR * 0.01;
            for (cut, stored) in others {
                let off = (cut.force - whole.0.force).norm() + (cut.moment - whole.0.moment).norm();
                worst[0] = worst[0].max(off / scale);
                worst[1] = worst[1].max((stored - whole.1).abs() / whole.1);
                assert!(off <= 1e-7 * scale, "{index} {case}: {off:e} {whole:?} {cut:?} {pose:?}");
            }
            // Where a flat end is beside the rim, its way out may be along the axis.
            set_at(&mut rigs[0], pose);
            if rigs[0].world.contacts_iter().any(|contact| contact.weight == 0.0 || contact.normal.z < 0.9) {
                continue;
            }
            compared += 1;
            let known = drum.least_on_planes(pose, &corners);
            let off = (whole.1 - known).abs() / known.max(1e-6);
            worst[2] = worst[2].max(off);
            assert!(off < 1e-6, "{index} {case}: {whole:?} {known} {pose:?}");
        }
        println!("{index}: {touching} of which {compared}, off by {worst:?}");
        assert!(compared > 40, "{touching} {compared}");
    }
}

/// The wrench is minus the derivative of the stored energy on a plate, a roof, a block, a dome and in a valley.
#[test]
fn the_wrench_of_a_drum_derives_from_its_energy() {
    let grounds = [
        ("plate", plate_mesh("p", 3, 0.8, |x, y| Vec3::new(x, y, 0.0)), 1e-6),
        ("roof", plate_mesh("p", 2, 8.0, |x, y| Vec3::new(x, y, -0.2 * x.abs())), 1e-6),
        ("block", block(0.4, 0.3), 1e-6),
        ("dome", plate_mesh("p", 8, 0.8, |x, y| Vec3::new(x, y, -0.3 * (x * x + y * y))), 1e-6),
        ("valley", plate_mesh("p", 2, 8.0, |x, y| Vec3::new(x, y, 0.2 * x.abs())), 1e-6),
    ];
    for (name, mesh, limit) in grounds {
        for (index, drum) in DRUMS.iter().enumerate() {
            let mut rig = on(drum, &mesh);
            let mut random = Random(17);
            let (mut compared, mut kinks, mut worst) = (0, 0, 0.0_f64);
            for _ in 0..600 {
                let offset = random.vector(0.35);
                let height = drum.radii[1] + if name == "valley" { 0.05 } else { 0.0 };
                let place = Vec3::new(offset.x, offset.y, height + 0.1 * offset.z);
                let turn = Quat::from_scaled_axis(random.vector(0.1))
                    * Quat::from_scaled_axis(Vec3::z() * random.between(-3.0, 3.0));
                let Derivative { force, stored, is_kink, off } =
                    rig.derivative((place, turn), [random.direction(), random.direction()]);
                if force < 1.0 || stored > 0.5 * PAIR * 0.03 * 0.03 {
                    continue;
                }
                if is_kink {
                    kinks += 1;
                    continue;
                }
                worst = worst.max(off);
                compared += 1;
            }
            println!("{name} {index}: {compared}, {kinks} at kinks, off by {worst:e}");
            assert!(compared > 30 && worst < limit, "{name} {index}: {compared}, off by {worst:e}");
        }
    }
}

/// A closed block of triangles, 2·x by 2·y wide and 0.2 m high, its top at z = 0.
pub fn block(x: f64, y: f64) -> String {
    block_of(x, y, 0.2)
}

/// Closed block of triangles of any height, m, its top at z = 0.
pub fn block_of(x: f64, y: f64, height: f64) -> String {
    let corner = |i: usize| {
        let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        format!("({:?},{:?},{:?})", x * sign(0), y * sign(1), if i >> 2 & 1 == 1 { 0.0 } else { -height })
    };
    let corners: Vec<String> = (0..8).map(corner).collect();
    format!(
        "TriangleMesh(name: \"b\", vertices: [{}], triangles: [(4,5,7),(4,7,6),(0,2,3),(0,3,1),(0,1,5),(0,5,4),\
         (2,6,7),(2,7,3),(0,4,6),(0,6,2),(1,3,7),(1,7,5)])",
        corners.join(",")
    )
}

/// Turns the axis of a drum, along x, to one that leans from the vertical by `tilt`, with end 0 or end 1 below.
fn upright(end: usize, tilt: Vec3) -> Quat {
    let turn = [-0.5, 0.5][end] * std::f64::consts::PI;
    Quat::from_scaled_axis(tilt) * Quat::from_scaled_axis(Vec3::y() * turn)
}

/// A coin and two drums, one of them a cone.
const STANDING: [Drum; 3] =
    [Drum::new(0.05, [0.2, 0.2]), Drum::new(0.3, [0.25, 0.25]), Drum::new(0.4, [0.1, 0.2])];

/// A drum that stands carries kδ in its middle as long as its middle is over the plate, whatever overhangs; with its middle
/// past a rim by x, kδ/(1 + (x/R)²) at the rim. A sheet and a block are the same.
#[test]
fn a_standing_drum_carries_what_its_places_store() {
    let whole = PAIR * DEPTH;
    // What the first plate gives; the cuts of the others, and the sides of the block, change nothing.
    let mut known: Vec<Wrench> = Vec::new();
    for ground in [plate(1), plate(3), plate(8), block(1.0, 1.0)] {
        let mut found = Vec::new();
        for (drum, end) in STANDING.into_iter().flat_map(|drum| [(drum, 0), (drum, 1)]) {
            let radius = drum.radii[end];
            let mut rig = on(&drum, &ground);
            for (x, y) in
                [(0.0, 0.3), (-0.9, 0.3), (-0.2, 0.2), (-0.05, -0.05), (0.3, 0.03), (0.6, -0.7), (0.9, 0.1)]
            {
                let at = Vec3::new(1.0 + x * radius, (1.0 + y * radius).min(0.9), 0.5 * drum.length - DEPTH);
                let (wrench, _) = set_at(&mut rig, (at, upright(end, Vec3::zeros())));
                found.push(wrench);
                let past = x.max(0.0);
                let force = whole / (1.0 + past * past);
                let limit = if x > 0.0 { 0.03 } else { 1e-9 };
                let off = (wrench.force - Vec3::z() * force).norm();
                assert!(off < limit * whole, "{drum:?} {end} {x} {y}: {wrench:?} {force}");
                // About the middle of the drum.
                let moment = Vec3::new(0.0, past * radius * force, 0.0);
                assert!(
                    (wrench.moment - moment).norm() < limit * whole * radius,
                    "{drum:?} {end} {x}: {wrench:?} {moment}"
                );
            }
        }
        for (one, other) in known.iter().zip(&found) {
            let off = (one.force - other.force).norm() + (one.moment - other.moment).norm();
            assert!(off < 1e-9 * whole, "{one:?} {other:?}");
        }
        known = if known.is_empty() { found } else { known };
    }
}

/// Standing, on a plate that it overhangs on one side, on both, at a corner, with its middle past a rim or a corner, and on
/// a ridge: a tilt of 1e-7 in any direction changes neither force nor moment by more than its stiffness gives.
#[test]
fn the_load_of_a_standing_drum_does_not_step() {
    let ridge = plate_mesh("p", 2, 4.0, |x, y| Vec3::new(x, y, -0.5 * x.abs()));
    let strip = plate_mesh("p", 3, 2.0, |x, y| Vec3::new(0.04 * x, y, 0.0));
    for (drum, end) in STANDING.into_iter().flat_map(|drum| [(drum, 0), (drum, 1)]) {
        for (ground, x, y) in [
            (&plate(3), 0.95, 0.03),
            (&plate(3), 1.03, 0.03),
            (&plate(3), 0.95, 0.97),
            (&plate(3), 1.03, 0.98),
            (&plate(3), 1.03, 1.02),
            (&block(1.0, 1.0), 1.03, 0.03),
            (&block(1.0, 1.0), 0.95, 0.97),
            (&strip, 0.01, 0.1),
            (&ridge, 0.0, 0.1),
            (&ridge, 0.03, 0.1),
        ] {
            let mut rig = on(&drum, ground);
            let mut at = |tilt: Vec3| {
                let place = Vec3::new(x, y, 0.5 * drum.length - DEPTH);
                set_at(&mut rig, (place, upright(end, tilt))).0
            };
            let level = at(Vec3::zeros());
            assert!(level.force.norm() > 0.3 * PAIR * DEPTH, "{drum:?} {end} {x} {y}: {level:?}");
            for direction in [Vec3::x(), -Vec3::x(), Vec3::y(), -Vec3::y(), Vec3::new(0.6, 0.8, 0.0)] {
                for tilt in [1e-9, 1e-7] {
                    let tilted = at(direction * tilt);
                    let off = (tilted.force - level.force).norm() + (tilted.moment - level.moment).norm();
                    let most = 1e3 * tilt * level.force.norm();
                    assert!(off <= most, "{drum:?} {end} {x} {y} {direction:?} {tilt}: {tilted:?} {level:?}");
                }
            }
        }
    }
}

/// A pose on the block whose top is at z = 0 between ±x and ±y, standing, leaning or lying, not deeper than `most`.
fn beside_block(drum: &Drum, random: &mut Random, case: usize, most: f64) -> (Vec3, Quat) {
    let lean = [1e-6, 1e-2, 0.5, 3.0][case % 4];
    let turn = Quat::from_scaled_axis(random.vector(lean)) * upright(case / 4 % 2, Vec3::zeros());
    let axis = turn * Vec3::x();
    let sine = (1.0 - axis.z * axis.z).max(0.0).sqrt();
    let low = [-0.5, 0.5].map(|half| half * drum.length * axis.z);
    let low = (drum.radii[0] * sine - low[0]).max(drum.radii[1] * sine - low[1]);
    let middle = random.vector(0.45);
    (Vec3::new(middle.x, middle.y, low - random.between(0.0, most)), turn)
}

/// On a closed block of triangles a drum that stands, leans or lies has the wrench that it has on the same block as a convex
/// solid.
#[test]
fn a_block_of_triangles_is_the_solid_block() {
    let solid = box_polyhedron("s", [0.0, 0.0, -0.5], [0.4, 0.3, 0.5], "");
    for (index, drum) in STANDING.into_iter().chain(DRUMS).enumerate() {
        let mut rigs = [on(&drum, &block_of(0.4, 0.3, 1.0)), on(&drum, &solid)];
        let mut random = Random(3 + index as u64);
        let (mut touching, mut worst) = (0, 0.0_f64);
        let most = 0.02 * drum.radii[0].min(drum.radii[1]);
        for case in 0..400 {
            let pose = beside_block(&drum, &mut random, case, most);
            let [one, other] = rigs.each_mut().map(|rig| set_at(rig, pose));
            let scale = PAIR * most;
            let off = (one.0.force - other.0.force).norm() + (one.0.moment - other.0.moment).norm();
            assert!(off < 1e-9 * scale, "{index} {case}: {:e} {one:?} {other:?} {pose:?}", off / scale);
            worst = worst.max(off / scale);
            touching += usize::from(other.1 > 0.0);
        }
        println!("{index}: {touching} touch, off by {worst:e}");
        assert!(touching > 200, "{index}: {touching}");
    }
}

/// The wrench of a drum that stands is minus the derivative of its energy, over rims and corners.
#[test]
fn the_wrench_of_a_standing_drum_derives_from_its_energy() {
    for (name, mesh) in [
        ("plate", plate_mesh("p", 3, 0.8, |x, y| Vec3::new(x, 0.75 * y, 0.0))),
        ("block", block_of(0.4, 0.3, 1.0)),
        ("dome", plate_mesh("p", 8, 0.8, |x, y| Vec3::new(x, y, -0.3 * (x * x + y * y)))),
    ] {
        for (index, drum) in STANDING.iter().enumerate() {
            let mut rig = on(drum, &mesh);
            let mut random = Random(17);
            let (mut compared, mut kinks, mut worst) = (0, 0, 0.0_f64);
            for case in 0..400 {
                let pose = beside_block(drum, &mut random, case / 3 * 4 + case % 3, 0.01);
                let Derivative { force, stored, is_kink, off } =
                    rig.derivative(pose, [random.direction(), random.direction()]);
                if force < 1.0 {
                    continue;
                }
                if is_kink {
                    kinks += 1;
                    continue;
                }
                assert!(off < 1e-6, "{name} {index} {case}: {off:e} {force} {stored} {pose:?}");
                worst = worst.max(off);
                compared += 1;
            }
            println!("{name} {index}: {compared}, {kinks} at kinks, off by {worst:e}");
            assert!(compared > 50, "{name} {index}: {compared}");
        }
    }
}

/// A floor that is flat but for rounding, in one fold or at each vertex, holds a standing drum as a plane does: kδ in its
/// middle, level or tilted by little, its disc above two triangles or hundreds.
#[test]
fn a_floor_of_rounded_vertices_holds_a_standing_drum_as_a_plane() {
    let random = RefCell::new(Random(29));
    for (drum, end) in STANDING.into_iter().flat_map(|drum| [(drum, 0), (drum, 1)]) {
        for off in [0.0, 1e-13, 1e-11, 1e-9, 1e-7, 5e-7] {
            let rounded = |is_fold: bool, x: f64| match is_fold {
                true => off * x.abs(),
                false => random.borrow_mut().between(-off, off),
            };
            for (is_fold, n) in [(true, 2), (true, 20), (false, 6), (false, 20), (false, 40)] {
                let mut rig =
                    on(&drum, &plate_mesh("p", n, 2.0, |x, y| Vec3::new(x, y, rounded(is_fold, x))));
                for (x, tilt) in [(0.0, 0.0), (0.013, 0.0), (0.31, 1e-9), (-0.2, 1e-7), (0.07, -1e-7)] {
                    let turn = upright(end, Vec3::new(tilt, 0.7 * tilt, 0.3));
                    let (wrench, _) = set_at(&mut rig, (Vec3::new(x, 0.03, 0.5 * drum.length - DEPTH), turn));
                    let (force, moment) =
                        (wrench.force / (PAIR * DEPTH), wrench.moment / (PAIR * DEPTH * drum.radii[end]));
                    let most = 40.0 * off / DEPTH + 3.0 * tilt.abs() * drum.radii[end] / DEPTH + 1e-9;
                    let what = format!(
                        "{drum:?} {end}: {off:e} {is_fold} {n} at {x}, {tilt:e}: {force:?} {moment:?}"
                    );
                    assert!((force - Vec3::z()).norm() <= most && moment.norm() <= most, "{what}");
                }
            }
        }
    }
}

/// A plate in single precision, turned and 6 m from its origin, as modellers export it, holds a standing drum with kδ in its
/// middle wherever the drum stands on it.
#[test]
fn an_exported_plate_holds_a_standing_drum() {
    let (turn, offset) = (Quat::from_scaled_axis(Vec3::new(0.4, -0.7, 1.1)), Vec3::new(3.0, -2.0, 5.0));
    let single = |v: Vec3| v.map(|v| f64::from(v as f32));
    let mut random = Random(31);
    for (drum, end) in STANDING.into_iter().flat_map(|drum| [(drum, 0), (drum, 1)]) {
        for n in [1, 4, 15, 40] {
            let mut rig =
                on(&drum, &plate_mesh("p", n, 2.0, |x, y| single(turn * Vec3::new(x, y, 0.0) + offset)));
            for _ in 0..20 {
                let place = Vec3::new(
                    random.between(-0.5, 0.5),
                    random.between(-0.5, 0.5),
                    0.5 * drum.length - DEPTH,
                );
                let upright = upright(end, Vec3::z() * random.between(0.0, 3.0));
                let (wrench, _) = set_at(&mut rig, (turn * place + offset, turn * upright));
                let [force, moment] =
                    [wrench.force, wrench.moment / drum.radii[end]].map(|v| v / (PAIR * DEPTH));
                assert!(
                    (force - turn * Vec3::z()).norm() < 5e-3 && moment.norm() < 1e-2,
                    "{drum:?} {end}: {n} at {place:?}: {force:?} {moment:?}"
                );
            }
        }
    }
}
