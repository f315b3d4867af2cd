//! Frames in degenerate poses raise no floating-point exception at any SIMD level: neither 0/0 nor a division
//! by zero, including unused lanes.

use crate::common::*;
use pong_geometry::simd::{Level, set_level};
use pong_geometry::{Quat, Vec3};
use pong_testkit::exceptions::are_raised_by;
use std::sync::Mutex;

/// The SIMD level is global to the process, so tests that set it take turns. Other tests are not affected,
/// because the answers are bit-identical at every level.
static TURN: Mutex<()> = Mutex::new(());

fn steel() -> String {
    surface(1e5, "")
}

/// Two models, with A at each of the positions for three frames.
fn assert_none(what: &str, a: &str, b: &str, places: &[Vec3]) {
    let _turn = TURN.lock();
    for level in Level::available() {
        set_level(level);
        for place in places {
            let mut rig = Rig::new(a, b);
            for frame in 0..3 {
                let raised = are_raised_by(|| {
                    rig.place_a(*place, Quat::identity());
                    rig.world.step().expect("a good frame");
                });
                assert!(!raised, "{what} at {place:?}, frame {frame}, {}", level.name());
            }
        }
    }
    set_level(Level::best());
}

/// A ball whose centre rests in a two-sided sheet: its path since the last commit has length zero.
#[test]
fn a_ball_that_rests_in_a_sheet() {
    let mesh = plate_mesh("m", 2, 1.0, |x, y| Vec3::new(0.0, x, y));
    let sheet =
        model("sheet", &steel(), &mesh.replace("TriangleMesh(name", "TriangleMesh(two_sided: true, name"));
    let ball = model("ball", &steel(), "Sphere(name: \"s\", center: (0,0,0), radius: 0.05)");
    let places = [Vec3::zeros(), Vec3::new(0.0, 0.1, 0.2), Vec3::new(0.0, 0.5, 0.0)];
    assert_none("a ball", &ball, &sheet, &places);
}

/// A plunger and a bar along the faces of a box: in their planes, above and below them.
#[test]
fn lines_along_the_faces_of_a_box() {
    let block = model("block", &steel(), &box_polyhedron("w", [0.0; 3], [1.0; 3], ""));
    let plunger =
        model("plunger", &steel(), "Ray(name: \"r\", origin: (-2,0,0), direction: (1,0,0), length: 1.5)");
    let bar = model("bar", &steel(), "LineSegment(name: \"l\", ends: ((-2,0,0), (0.5,0,0)))");
    let heights = [1.0, 0.5, 0.0, -1.0];
    let places: Vec<Vec3> =
        heights.into_iter().flat_map(|y| heights.into_iter().map(move |z| Vec3::new(0.0, y, z))).collect();
    assert_none("a plunger", &plunger, &block, &places);
    assert_none("a bar", &bar, &block, &places);
}
