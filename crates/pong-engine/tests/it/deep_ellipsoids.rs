//! Feature that pushes an ellipsoid deeper than its smallest radius of curvature: the answer is invariant
//! under rotation and translation of the scene, above and below valleys of any angle, over ridges, in pits,
//! on solids.

use crate::common::*;
use pong_engine::State;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

const STIFFNESS: f64 = 1e5;
/// Both surfaces have the same stiffness, N/m.
const SERIES: f64 = 0.5 * STIFFNESS;
/// Rounding of a force, as a fraction of stiffness times one metre.
const ROUNDING: f64 = 1e-9;

fn steel() -> String {
    surface(STIFFNESS, "normal: Linear(damping: 0.0)")
}

fn points(vertices: &[Vec3]) -> String {
    let texts: Vec<String> = vertices.iter().map(|v| format!("({:?},{:?},{:?})", v.x, v.y, v.z)).collect();
    texts.join(",")
}

fn mesh(vertices: &[Vec3], triangles: &str) -> String {
    let text =
        format!("TriangleMesh(name: \"m\", vertices: [{}], triangles: [{triangles}])", points(vertices));
    model("mesh", &steel(), &text)
}

/// Two walls z = slope·|x| that meet along the y axis, with their fronts up: a valley or a ridge.
fn walls(slope: f64) -> [Vec3; 6] {
    let corner = |x: f64, y: f64| Vec3::new(x, y, slope * x.abs());
    [
        corner(-2.0, -9.0),
        corner(0.0, -9.0),
        corner(2.0, -9.0),
        corner(-2.0, 9.0),
        corner(0.0, 9.0),
        corner(2.0, 9.0),
    ]
}

fn folded(slope: f64) -> String {
    mesh(&walls(slope), "(0,1,4),(0,4,3),(1,2,5),(1,5,4)")
}

/// A pit of four walls, or a pyramid.
fn four_walls(slope: f64) -> String {
    let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    let rim = corners.map(|[x, y]| Vec3::new(x, y, 2.0 * slope));
    mesh(&[rim[0], rim[1], rim[2], rim[3], Vec3::zeros()], "(0,1,4),(1,2,4),(2,3,4),(3,0,4)")
}

/// The solid below a valley, in two pieces that meet below its line.
fn two_pieces(slope: f64) -> String {
    let piece = |name: &str, side: f64| {
        let at = |x: f64, y: f64, z: f64| Vec3::new(side * x, y, z);
        let vertices = [
            at(0.0, -9.0, -4.0),
            at(2.0, -9.0, -4.0),
            at(2.0, -9.0, 2.0 * slope),
            at(0.0, -9.0, 0.0),
            at(0.0, 9.0, -4.0),
            at(2.0, 9.0, -4.0),
            at(2.0, 9.0, 2.0 * slope),
            at(0.0, 9.0, 0.0),
        ];
        let mut faces = [[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]];
        if side < 0.0 {
            faces.iter_mut().for_each(|face| face.reverse());
        }
        format!(
            "Polyhedron(name: \"{name}\", vertices: [{}], faces: {faces:?}, inactive_faces: [5])",
            points(&vertices)
        )
    };
    model("pieces", &steel(), &[piece("left", -1.0), piece("right", 1.0)].join(","))
}

fn ellipsoid(semi_axes: &Vec3) -> String {
    let text = format!("Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: {})", points(&[*semi_axes]));
    model("ellipsoid", &steel(), &text)
}

/// Force on the ellipsoid, N, in the scene's own axes.
fn force(rig: &mut Rig, place: &Vec3, turn: &Quat, frame: &Quat, shift: &Vec3) -> Vec3 {
    rig.place([at(frame * place + shift, frame * turn), at(*shift, *frame)]);
    rig.world.evaluate().unwrap();
    frame.inverse() * rig.wrench(0).force
}

/// Number of poses for which some rotated scene gives another answer, and number of poses in contact.
fn changed_by_turning(body: &str, seed: u64) -> (usize, usize) {
    let mut random = Random(seed);
    let tenths = |x: f64| (10.0 * x).round() / 10.0;
    let (mut changed, mut touched) = (0, 0);
    for pose in 0..400 {
        // Every other pose in round numbers, as an author would write it.
        let round = |x: f64| if pose % 2 == 0 { tenths(x) } else { x };
        let semi_axes = Vec3::from_fn(|_, _| round(random.between(0.3, 1.0)));
        let turn = random.rotation();
        let place = Vec3::new(round(random.between(-1.0, 1.5)), 0.0, round(random.between(-1.0, 1.0)));
        let mut rig = Rig::new(&ellipsoid(&semi_axes), body);
        let unturned = force(&mut rig, &place, &turn, &Quat::identity(), &Vec3::zeros());
        touched += usize::from(unturned != Vec3::zeros());
        let differs = (0..8).any(|_| {
            let (frame, shift) = (random.rotation(), random.vector(2.0));
            let turned = force(&mut rig, &place, &turn, &frame, &shift);
            (turned - unturned).norm() > ROUNDING * SERIES
        });
        changed += usize::from(differs);
    }
    (changed, touched)
}

#[test]
fn turning_the_whole_scene_changes_nothing() {
    let slopes = [2.0, 1.0, 0.5, 0.05, -0.05, -1.0, -2.0];
    let mut all = Vec::new();
    for (seed, slope) in slopes.into_iter().enumerate() {
        let mut bodies = vec![("walls", folded(slope)), ("four walls", four_walls(slope))];
        if slope > 0.0 {
            bodies.push(("pieces", two_pieces(slope)));
        }
        for (name, body) in bodies {
            let (changed, touched) = changed_by_turning(&body, seed as u64);
            println!("{name}, slope {slope}: {changed} of {touched} poses that touch changed");
            assert!(touched > 100);
            all.push(changed);
        }
    }
    assert!(all.iter().all(|changed| *changed == 0), "{all:?}");
}

/// A needle stands so deep in a valley that its lowest points along both normals have passed the line in
/// which the walls meet. Both walls push it, because the centre is in front of both and over both.
#[test]
fn a_needle_sunk_through_the_line_of_a_valley_is_pushed_by_both_walls() {
    let semi_axes = Vec3::new(0.1, 0.1, 1.0);
    for slope in [0.05, 1.0, 2.0] {
        let normal = Vec3::new(-slope, 0.0, 1.0).normalize();
        let center = Vec3::new(0.0, 0.25, 0.5);
        let half_width = semi_axes.component_mul(&normal).norm();
        let depth = half_width - normal.dot(&center);
        let lowest = center - semi_axes.component_mul(&semi_axes).component_mul(&normal) / half_width;
        assert!((lowest + normal * depth).x < 0.0, "the foot of the right wall lies left of the line");
        // The shortest vector that clears both walls.
        let expected = Vec3::z() * (SERIES * depth / normal.z);
        for body in [folded(slope), two_pieces(slope)] {
            let mut rig = Rig::new(&ellipsoid(&semi_axes), &body);
            let mut random = Random(5);
            for _ in 0..20 {
                let (frame, shift) = (random.rotation(), random.vector(1.0));
                let got = force(&mut rig, &center, &Quat::identity(), &frame, &shift);
                // More than 90° apart, the walls do not couple: each pushes on its own.
                let coupled =
                    if slope >= 1.0 { Vec3::z() * (2.0 * SERIES * depth * normal.z) } else { expected };
                assert!((got - coupled).norm() < ROUNDING * SERIES, "slope {slope}: {got:?} {coupled:?}");
            }
        }
    }
}

/// Below a valley narrower than a right angle, a centre outside the fold may be in front of one wall and
/// behind the other; neither pushes there.
#[test]
fn outside_a_narrow_fold_neither_wall_pushes() {
    let poses = [
        (
            [0.8, 0.4, 0.8],
            [0.10050378152592121, 0.10050378152592121, -0.40201512610368484, -0.9045340337332909],
            [0.6, 0.0, 0.1],
        ),
        (
            [1.0, 0.7, 0.7],
            [0.8581163303210331, 0.19069251784911845, 0.28603877677367767, 0.3813850356982369],
            [0.4, 0.0, -0.5],
        ),
    ];
    let mut random = Random(6);
    for (semi_axes, [w, i, j, k], center) in poses {
        let mut rig = Rig::new(&ellipsoid(&Vec3::from(semi_axes)), &folded(2.0));
        let turn = Quat::from_quaternion(nalgebra::Quaternion::new(w, i, j, k));
        for _ in 0..50 {
            let (frame, shift) = (random.rotation(), random.vector(1.0));
            let got = force(&mut rig, &Vec3::from(center), &turn, &frame, &shift);
            assert_eq!(got, Vec3::zeros());
        }
    }
}

/// A centre on the rim of a two-sided plate is pushed by one of its sides, as it is beside the rim.
#[test]
fn a_centre_on_a_rim_is_pushed_once() {
    let sheet = "TriangleMesh(name: \"m\", two_sided: true, \
                 vertices: [(-0.5,-0.4,0),(0.5,-0.4,0),(0.5,0.4,0),(-0.5,0.4,0)], triangles: [(0,1,2),(0,2,3)])";
    let body = "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.3,0.2,0.1))";
    for (place, quaternion) in [
        ([-0.5, 0.15, 0.0], [0.5, 0.5, 0.5, 0.5]),
        ([0.3, 0.4, 0.0], [0.0, 1.0, 0.0, 0.0]),
        ([0.5, -0.1, 0.0], [0.5, 0.5, 0.5, 0.5]),
    ] {
        let mut rig = Rig::new(&model("e", &steel(), body), &model("m", &steel(), sheet));
        let state = State { position: place, orientation: quaternion, ..State::identity() };
        rig.place([state, State::identity()]);
        rig.world.evaluate().unwrap();
        let force = rig.wrench(0).force.norm();
        assert_eq!(rig.world.contacts().len(), 1, "{place:?}");
        assert!((force / (SERIES * 0.1) - 1.0).abs() < 1e-9, "{place:?}: {force}");
    }
}
