//! Frames of solids that touch by volume.

use super::common::{Rig, moving};
use super::heap::{counted, during, my_turn};
use pong_engine::{Config, State};
use pong_geometry::{Quat, Vec3};
use pong_testkit::ron::box_polyhedron;

fn solids(primitives: &[String]) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "solids",
            surfaces: {{ "s": (stiffness: 1e5, friction: Bristle(mu: 0.5)) }},
            root: (name: "solids", surface: "s", contact: Solid, primitives: [{}]))"#,
        primitives.join(", ")
    )
}

/// Boxes that turn and sink through boxes, so deep that many faces have cells, and come out again.
#[test]
fn frames_of_solids_allocate_nothing() {
    let _turn = my_turn();
    let boxes = |from: f64| {
        let one = |index: usize| {
            let x = from + 0.3 * index as f64;
            box_polyhedron(&format!("box {index}"), [x, 0.0, 0.0], [0.1, 0.15, 0.2], "")
        };
        solids(&(0..4).map(one).collect::<Vec<_>>())
    };
    let mut rig = Rig::with_config(Config { ledger: true, ..Config::default() }, &boxes(-0.4), &boxes(-0.5));
    let mut most = 0;
    let calls = counted(|| {
        for frame in 0..3000 {
            let t = 0.01 * f64::from(frame);
            let place = Vec3::new(0.2 * (0.7 * t).sin(), 0.1 * t.cos(), 0.45 * (1.3 * t).cos());
            let turn = Quat::from_scaled_axis(Vec3::new((0.3 * t).sin(), 0.4 * t, 0.2 * t));
            let states = [moving(place, turn, Vec3::x(), Vec3::y()), State::identity()];
            during("set_states", || rig.place(states));
            during("step", || _ = rig.world.step().unwrap());
            most = most.max(rig.world.contact_count());
        }
    });
    assert!(most > 30, "{most}");
    assert!(calls.is_empty(), "{calls:?}");
}
