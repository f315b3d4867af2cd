//! Capsules, segments, cylinders and cones on a convex solid that is cut into pieces: it acts as the whole (docs/theory.md, 2.8).

use crate::common::*;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

const HALF: [f64; 3] = [0.5, 0.4, 0.3];
const BARS: [&str; 5] = [
    "Capsule(name: \"l\", ends: ((-0.9,0,0),(0.9,0.1,0)), radius: 0.1)",
    "Capsule(name: \"l\", ends: ((-0.2,0,0),(0.2,0.1,0)), radius: 0.05)",
    "LineSegment(name: \"l\", ends: ((-0.6,0,0),(0.4,0.1,0)))",
    "Cylinder(name: \"l\", ends: ((-0.3,0,0),(0.3,0.1,0)), radius: 0.1)",
    "Cone(name: \"l\", ends: ((-0.1,0,0),(0.1,0.05,0)), radii: (0.2,0.0))",
];

fn part(text: &str) -> String {
    model("part", &surface(1e4, "friction: None"), text)
}

fn whole() -> String {
    box_polyhedron("w", [0.0; 3], HALF, "")
}

/// Three slices; two pieces below a third; six tetrahedra around a diagonal.
fn cuts() -> [String; 3] {
    let slices = [
        box_polyhedron("l", [-0.3, 0.0, 0.0], [0.2, 0.4, 0.3], "5"),
        box_polyhedron("m", [0.1, 0.0, 0.0], [0.2, 0.4, 0.3], "4,5"),
        box_polyhedron("r", [0.4, 0.0, 0.0], [0.1, 0.4, 0.3], "4"),
    ];
    let layers = [
        box_polyhedron("t", [0.0, 0.0, 0.2], [0.5, 0.4, 0.1], "0"),
        box_polyhedron("l", [-0.2, 0.0, -0.1], [0.3, 0.4, 0.2], "1,5"),
        box_polyhedron("r", [0.3, 0.0, -0.1], [0.2, 0.4, 0.2], "1,4"),
    ];
    [slices.join(","), layers.join(","), tetrahedra()]
}

fn tetrahedra() -> String {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let text = orders.map(|order| {
        let mut corners = vec![[0; 3]];
        for axis in order {
            let mut next = corners[corners.len() - 1];
            next[axis] = 1;
            corners.push(next);
        }
        let place = |c: &[i32; 3]| Vec3::from([0, 1, 2].map(|k| HALF[k] * f64::from(2 * c[k] - 1)));
        let (mut faces, mut walls) = (Vec::new(), Vec::new());
        for left_out in 0..4 {
            let mut face: Vec<usize> = (0..4).filter(|&k| k != left_out).collect();
            let [a, b, c] = [0, 1, 2].map(|k| place(&corners[face[k]]));
            if (b - a).cross(&(c - a)).dot(&(place(&corners[left_out]) - a)) > 0.0 {
                face.swap(1, 2);
            }
            let is_side = |axis: usize| face.iter().all(|&k| corners[k][axis] == corners[face[0]][axis]);
            if !(0..3).any(is_side) {
                walls.push(left_out);
            }
            faces.push(face);
        }
        let corners: Vec<String> = corners.iter().map(|c| place_of(&place(c))).collect();
        let name = order.map(|axis| axis.to_string()).concat();
        let corners = corners.join(",");
        format!(
            "Polyhedron(name: \"t{name}\", vertices: [{corners}], faces: {faces:?}, inactive_faces: {walls:?})"
        )
    });
    text.join(",")
}

/// Set down in any pose, shallow or sunk in, a bar is pushed as by the whole.
#[test]
fn pieces_push_a_bar_as_the_whole_does() {
    let mut random = Random(17);
    for (cut, pieces) in cuts().iter().enumerate() {
        for bar in BARS {
            let mut rigs = [&whole(), pieces].map(|b| Rig::new(&part(bar), &part(b)));
            let mut touching = 0;
            for case in 0..300 {
                let place = Vec3::from(HALF).component_mul(&random.vector(1.2));
                let turn = random.orientation();
                let [whole, cut_up] = rigs.each_mut().map(|rig| {
                    rig.world.clear_contact_history(rig.objects[0]).unwrap();
                    rig.place_a(place, turn);
                    rig.world.evaluate().unwrap();
                    (rig.wrench(0), rig.world.contact_count())
                });
                let off = (whole.0.force - cut_up.0.force).norm() + (whole.0.moment - cut_up.0.moment).norm();
                let size = whole.0.force.norm();
                assert!(off <= 1e-9 * size, "{cut} {bar} {case}: {off:e} of {size}");
                assert_eq!(whole.1, cut_up.1, "{cut} {bar} {case}");
                touching += usize::from(size > 0.0);
            }
            assert!(touching > 150, "{cut} {bar}: {touching}");
        }
    }
}

/// Along paths through the solid the side of entry is remembered as on the whole, whatever pieces are passed.
#[test]
fn pieces_remember_the_side_of_entry_as_the_whole_does() {
    let mut random = Random(18);
    for pieces in cuts() {
        for bar in BARS {
            let mut rigs = [&whole(), &pieces].map(|b| Rig::new(&part(bar), &part(b)));
            for path in 0..6 {
                let (from, to) = (random.direction(), Vec3::from(HALF).component_mul(&random.vector(0.8)));
                let (turn, spin) = (random.orientation(), random.vector(0.5));
                rigs.iter_mut().for_each(|rig| rig.world.clear_contact_history(rig.objects[0]).unwrap());
                for step in 0..60 {
                    let share = f64::from(step) / 60.0;
                    let place = from * (1.6 * (1.0 - share)) + to * share;
                    let wrenches = rigs.each_mut().map(|rig| {
                        rig.place_a(place, Quat::from_scaled_axis(spin * share) * turn);
                        rig.world.step().unwrap();
                        rig.wrench(0)
                    });
                    let [whole, cut_up] = wrenches;
                    let off = (whole.force - cut_up.force).norm() + (whole.moment - cut_up.moment).norm();
                    assert!(off <= 1e-9 * whole.force.norm(), "{bar} {path} {step}: {wrenches:?}");
                }
            }
        }
    }
}
