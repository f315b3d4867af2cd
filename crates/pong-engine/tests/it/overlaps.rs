//! Cylinders and cones on convex solids: a wrench exactly where the two overlap by the search of Gilbert, Johnson and
//! Keerthi, however deep.

use crate::common::*;
use pong_geometry::distance::Solid;
use pong_geometry::primitive::{Frustum, Polyhedron};
use pong_geometry::{Transform, Vec3};
use pong_testkit::{Random, long_samples};

const MOVERS: [(&str, Ends, [f64; 2]); 4] = [
    ("wheel", [[0.0, -0.15, 0.0], [0.0, 0.15, 0.0]], [0.25, 0.25]),
    ("log", [[-0.6, 0.0, 0.0], [0.6, 0.0, 0.0]], [0.1, 0.1]),
    ("plug", [[0.0, 0.0, -0.15], [0.0, 0.0, 0.15]], [0.1, 0.05]),
    ("spike", [[0.0, 0.0, -0.3], [0.0, 0.0, 0.4]], [0.15, 0.0]),
];

type Ends = [[f64; 3]; 2];

fn frustum((_, ends, radii): &(&str, Ends, [f64; 2])) -> Frustum {
    Frustum::new(ends.map(Vec3::from), *radii)
}

fn part((_, ends, radii): &(&str, Ends, [f64; 2])) -> String {
    let [one, other] = ends.map(|end| place_of(&end.into()));
    match radii[0] == radii[1] {
        true => format!("Cylinder(name: \"a\", ends: ({one},{other}), radius: {:?})", radii[0]),
        false => format!("Cone(name: \"a\", ends: ({one},{other}), radii: ({:?},{:?}))", radii[0], radii[1]),
    }
}

fn grounds() -> Vec<(&'static str, String)> {
    vec![
        ("block", box_polyhedron("b", [0.0; 3], [0.35, 0.3, 0.2], "")),
        ("small block", box_polyhedron("b", [0.0; 3], [0.05, 0.06, 0.04], "")),
        ("plate", box_polyhedron("b", [0.0; 3], [0.4, 0.3, 0.01], "")),
        (
            "thorn",
            "Polyhedron(name: \"b\", vertices: [(0.2,0,-0.1),(-0.1,0.15,-0.1),(-0.1,-0.15,-0.1),(0,0,0.6)], \
             faces: [[0,2,1],[0,1,3],[1,2,3],[2,0,3]])"
                .to_owned(),
        ),
    ]
}

fn polyhedron(text: &str) -> Polyhedron {
    let extensions = pong_model::Extensions::new();
    let model = pong_model::parse(text, "ground.ron", None, &extensions).unwrap();
    model.bodies[0].polyhedra[0].clone()
}

/// On lines through the middle of each ground: just apart, just in, deep.
#[test]
fn what_overlaps_a_polyhedron_is_pushed() {
    let elastic = surface(1e5, "friction: None");
    let lines = long_samples(400, 4000);
    for mover in &MOVERS {
        for (name, parts) in grounds() {
            let ground = model(name, &elastic, &parts);
            let solid = polyhedron(&ground);
            let mut rig = Rig::new(&model("part", &elastic, &part(mover)), &ground);
            let mut random = Random::new(49, 21, 0);
            let (mut lost, mut invented, mut tested) = (Vec::new(), Vec::new(), 0);
            for _ in 0..lines {
                let (turn, way) = (random.rotation(), random.direction());
                let aside = random.across(&way) * random.between(0.0, 0.2);
                let at = |far: f64| Transform {
                    rotation: turn.to_rotation_matrix().into_inner(),
                    translation: aside + way * far,
                };
                let apart = |far: f64| {
                    let moved = frustum(mover).carried(&at(far));
                    let solid = Solid::polyhedron(&solid, &Transform::identity());
                    Solid::frustum(&moved).to(&solid).distance > 0.0
                };
                let (mut inside, mut outside) = (0.0, 3.0);
                if apart(inside) {
                    continue;
                }
                for _ in 0..40 {
                    let half = 0.5 * (inside + outside);
                    *(if apart(half) { &mut outside } else { &mut inside }) = half;
                }
                let depths = [1e-4, 0.002, 0.01, 0.025].map(|most| most * random.between(0.1, 1.0));
                let deep = [0.3, 0.8].map(|most| inside * random.between(0.0, most));
                for depth in depths.into_iter().chain(deep).filter(|depth| *depth < inside) {
                    let object = rig.objects[0];
                    rig.world.clear_contact_history(object).unwrap();
                    rig.place_a(at(inside - depth).translation, turn);
                    rig.world.evaluate().unwrap();
                    tested += 1;
                    if rig.wrench(0).force.norm() == 0.0 {
                        lost.push((turn, at(inside - depth).translation, depth));
                    }
                }
                rig.place_a(at(inside + 1e-6).translation, turn);
                rig.world.evaluate().unwrap();
                let depth = rig.world.contacts().iter().map(|contact| contact.depth).fold(0.0, f64::max);
                // As thick as the flat ellipsoids that stand for the discs.
                if depth > 1e-5 {
                    invented.push((turn, at(inside + 1e-6).translation, depth));
                }
            }
            println!(
                "{} on {name}: {tested} poses, {} lost, {} invented",
                mover.0,
                lost.len(),
                invented.len()
            );
            assert!(lost.is_empty() && invented.is_empty(), "{lost:?} {invented:?}");
            assert!(tested > 2 * lines, "{tested}");
        }
    }
}
