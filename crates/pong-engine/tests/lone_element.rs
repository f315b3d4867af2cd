//! An element by itself goes through the trees of the other movable group on a way of its own. It finds what the same element
//! finds among others, to the last bit.

mod common;

use common::*;
use pong_engine::{Config, StatusBits};
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;
use pong_testkit::ron::carried_box;

const CELLS: usize = 40;

/// An uneven sheet of `2 CELLS²` triangles, 4 m wide, in other axes, and a bed of as many boxes as there are cells in a
/// quarter of it.
fn ground(random: &mut Random, turn: &Quat, shift: &Vec3) -> String {
    let at = |i: usize, cells: usize| 4.0 * (i as f64 / cells as f64 - 0.5);
    let mut vertices = Vec::new();
    for j in 0..=CELLS {
        for i in 0..=CELLS {
            let vertex = Vec3::new(at(i, CELLS), at(j, CELLS), random.between(-0.03, 0.03));
            vertices.push(turn * vertex + shift);
        }
    }
    let number = |i: usize, j: usize| j * (CELLS + 1) + i;
    let cell = |(i, j)| {
        let [a, b, c, d] = [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let cells = (0..CELLS).flat_map(|j| (0..CELLS).map(move |i| (i, j)));
    let triangles: Vec<[usize; 3]> = cells.flat_map(cell).collect();
    let mut all = vec![triangle_mesh("sheet", &vertices, &triangles, "")];
    const BOXES: usize = CELLS / 2;
    for j in 0..BOXES {
        for i in 0..BOXES {
            let middle = Vec3::new(at(i, BOXES), at(j, BOXES), random.between(-0.07, -0.03));
            let about = [middle, Vec3::new(0.07, 0.08, 0.05)];
            all.push(carried_box(&format!("box{i}x{j}"), about, "", |corner| turn * corner + shift));
        }
    }
    model("ground", &steel(), &all.join(","))
}

fn steel() -> String {
    surface(1e5, "friction: Bristle(mu: 0.3, stiffness: 1e5)")
}

/// Elements that reach many of the ground's, a few, and one.
fn elements() -> Vec<(&'static str, String)> {
    let shape = |kind: &str, fields: &str| format!("{kind}(name: \"NAME\", {fields}),\n");
    let center = "center: (CENTER)";
    vec![
        ("point", shape("Point", "position: (CENTER)")),
        ("sphere", shape("Sphere", &format!("{center}, radius: 0.25"))),
        ("large sphere", shape("Sphere", &format!("{center}, radius: 30.0"))),
        ("ellipsoid", shape("Ellipsoid", &format!("{center}, semi_axes: (0.4, 0.3, 0.2)"))),
        ("large ellipsoid", shape("Ellipsoid", &format!("{center}, semi_axes: (20.0, 15.0, 9.0)"))),
        ("capsule", shape("Capsule", "ends: ((CENTER), (END)), radius: 0.2")),
        ("line segment", shape("LineSegment", "ends: ((CENTER), (END))")),
    ]
}

fn element(shape: &str, name: &str, center: f64) -> String {
    let text = |x: f64| format!("{x:?}, 0.0, 0.0");
    shape.replace("NAME", name).replace("CENTER", &text(center)).replace("END", &text(center + 0.7))
}

/// How far the element reaches below its centre when it stands upright, m.
fn reach(name: &str) -> f64 {
    match name {
        "sphere" => 0.25,
        "large sphere" => 30.0,
        "ellipsoid" | "capsule" => 0.2,
        "large ellipsoid" => 9.0,
        _ => 0.0,
    }
}

#[test]
fn an_element_by_itself_finds_what_it_finds_among_others() {
    let mut random = Random::new(91, 0, 0);
    for (name, shape) in elements() {
        let (turn, shift) = (random.rotation(), random.vector(3.0));
        let ground = ground(&mut random, &turn, &shift);
        let config = || Config { ledger: true, contact_capacity: Some(4000), ..Config::default() };
        let rig = |elements: String| Rig::with_config(config(), &model("a", &steel(), &elements), &ground);
        let own = element(&shape, "own", 0.0);
        let far = element(&shape, "far", 300.0);
        let mut rigs = [rig(own.clone()), rig(own + &far)];
        let (mut found, mut most) = (0, 0);
        for frame in 0..40 {
            let along = Vec3::new(random.between(-1.2, 1.2), random.between(-1.2, 1.2), 0.0);
            let height = reach(name) + random.between(-0.04, 0.01);
            let tilt = Quat::from_scaled_axis(random.vector(0.01));
            let position = turn * (along + Vec3::z() * height) + shift;
            let velocity = random.vector(0.2);
            for rig in &mut rigs {
                rig.place([
                    moving(position, turn * tilt, velocity, Vec3::zeros()),
                    pong_engine::State::identity(),
                ]);
                let report = rig.world.step().unwrap();
                assert!(!report.status.contains(StatusBits::CONTACT_LIMIT), "{name}");
            }
            let [alone, among_others] = [told(&rigs[0].world), told(&rigs[1].world)];
            assert_eq!(alone, among_others, "{name}, frame {frame}");
            (found, most) = (found + alone.len(), most.max(alone.len()));
        }
        println!("{name}: {found} contacts, at most {most} in a frame");
        assert!(found > 10, "{name}: {found}");
    }
}
