//! Small surveys around what once disagreed: each must find nothing, and finds again what is put back (`ci/planted`).

use pong_invariance::base::Base;
use pong_invariance::invariances::{find, numbers};
use pong_invariance::judge::Verdict;
use pong_invariance::make;
use pong_invariance::random::Random;
use pong_invariance::scene::{Scene, Shape};
use pong_invariance::text;
use pong_invariance::{Order, Survey};

/// Nothing differs in so many scenes of a family, or of those that the invariances make for themselves.
fn nothing_differs(only: &[&str], family: Option<&str>, scenes: u64) {
    let order = Order {
        seed: 20,
        first: 0,
        scenes,
        only: only.iter().map(|name| (*name).to_owned()).collect(),
        family: family.map(str::to_owned),
        threads: 1,
        kept: 1,
    };
    let survey = Survey::run(&order, &|_| {});
    let found: String = survey.found.iter().map(|found| found.text()).collect();
    assert!(survey.differ() == 0 && survey.refused == 0, "{}\n{found}", survey.text());
    assert!(survey.compared() > scenes / 40, "too little was compared:\n{}", survey.text());
}

/// Nothing differs in the scenes of a family that are asked for, of so many.
fn nothing_differs_where(only: &[&str], family: &str, scenes: u64, is_asked: impl Fn(&Scene) -> bool) {
    const SEED: u64 = 20;
    let mut compared = 0;
    for index in 0..scenes {
        let scene = make::scene_of(&mut Random::new(SEED, 0, index), family).expect("a family of scenes");
        if !is_asked(&scene) {
            continue;
        }
        let mut base = Base::new(scene).expect("a scene that loads");
        for name in only {
            let invariance = find(name).expect("an invariance");
            let verdict = invariance.judge(&mut base, &mut numbers(invariance, SEED, index));
            compared += u64::from(!matches!(verdict, Verdict::DoesNotApply));
            if let Verdict::Differs(found) = verdict {
                panic!("{name}, scene {index}: {}\n{}", found.says, text::scene(&base.scene));
            }
        }
    }
    assert!(compared > scenes / 20, "only {compared} compared");
}

fn all_touch_as(kind: &str, scene: &Scene) -> bool {
    scene.bodies[0].shapes.iter().all(|shape| shape.kind() == kind)
}

/// Balls on a mesh that has no back: which of its two sides pushes is another matter.
fn are_balls_on_fronts(scene: &Scene) -> bool {
    let is_front =
        |shape: &Shape| matches!(shape, Shape::Mesh(mesh) if !mesh.two_sided && mesh.thickness.is_none());
    all_touch_as("Sphere", scene) && scene.bodies[1].shapes.iter().all(is_front)
}

/// Scenes of long runs that differed once, each for a cause of its own.
#[test]
fn scenes_that_once_differed() {
    const SEED: u64 = 5;
    let told = [
        // An edge whose triangles disagreed on where it ends.
        ("turned", 40234),
        // A line in the plane of a face had crossed it.
        ("turned", 94889),
        // A line through a vertex from outside was inside for one face, and outside for the next.
        ("moved", 56296),
        ("moved", 62356),
        // A centre on a convex vertex, pushed by all of its faces.
        ("turned", 62386),
        // The foot of a deep ellipsoid lay beyond a cut and a fold.
        ("cut", 48490),
        ("cut", 74128),
        // The foot of a slender ellipsoid lay beside its box.
        ("group_frame", 98704),
        // A bar left two pieces, or none, through the edge in which their wall ends.
        ("reordered", 23975),
        ("scaled", 69375),
        ("reordered", 85273),
        ("group_frame", 97611),
        // A ball's centre on the edge in which the wall between two pieces ends, pushed by both.
        ("scaled", 48503),
        ("cut", 64721),
        // A vertex that lies in front of its own face by the rounding of single precision, below an ellipsoid.
        ("reordered", 87530),
        // An ellipsoid's centre on the rim of a plate.
        ("group_frame", 93627),
        // Two balls, one almost in the other's centre.
        ("beside", 26535),
        // Two jumps at one place, which rounding combined otherwise.
        ("turned", 75486),
        ("turned", 87486),
    ];
    for (name, index) in told {
        does_not_differ(name, None, SEED, index);
    }
}

/// The same with round parts.
#[test]
fn scenes_with_round_parts_that_once_differed() {
    const SEED: u64 = 3;
    let told = [
        // A pin that stands in a hole: rounding across its axis was taken for a direction on its rim.
        ("group_frame", "hole", 150),
        ("group_frame", "hole", 416),
        ("turned", "hole", 4798),
        // A pin along the wall is as deep at its end as at the mouth: rounding chose the place.
        ("group_frame", "hole", 1466),
        ("group_frame", "hole", 2110),
        // A pin flat over a mouth: the search stopped short of where the slope steps, and the place was any of the rim.
        ("moved", "hole", 8116),
        ("own_axis", "hole", 10209),
        // A rod along a shaft: what rounding left along it of a short way across moved the place to an end.
        ("reordered", "shaft", 18971),
        ("group_frame", "shaft", 1709),
        ("own_axis", "shaft", 4145),
        ("scaled", "cone", 4132),
        // An axis through the edge of a triangle, or its corner: the way between them is noise.
        ("turned", "rod_on_mesh", 1735),
        ("own_axis", "rod_on_mesh", 314),
        ("cut", "rod_on_mesh", 314),
    ];
    for (name, family, index) in told {
        does_not_differ(name, Some(family), SEED, index);
    }
}

fn does_not_differ(name: &str, family: Option<&str>, seed: u64, index: u64) {
    let invariance = find(name).expect("an invariance");
    let scene = pong_invariance::invariances::scene(invariance, family, seed, index);
    let mut base = Base::new(scene).expect("a scene that loads");
    if let Verdict::Differs(found) = invariance.judge(&mut base, &mut numbers(invariance, seed, index)) {
        panic!("{name}, scene {index}: {}\n{}", found.says, text::scene(&base.scene));
    }
}

#[test]
fn balls_on_the_seams_of_flat_plates() {
    nothing_differs_where(&["turned", "scaled", "cut", "group_frame"], "plate", 2000, are_balls_on_fronts);
}

#[test]
fn balls_in_valleys_and_bowls() {
    let told = ["turned", "scaled", "cut", "group_frame", "reordered"];
    nothing_differs_where(&told, "valley", 1500, are_balls_on_fronts);
    nothing_differs_where(&told, "bowl", 800, are_balls_on_fronts);
}

/// Few are compared: an ellipsoid so deep that it reaches several pieces has an answer of its own there.
#[test]
fn ellipsoids_beside_the_walls_between_pieces() {
    let are_ellipsoids = |scene: &Scene| all_touch_as("Ellipsoid", scene);
    nothing_differs_where(&["cut", "turned"], "solid", 3000, are_ellipsoids);
    nothing_differs_where(&["reordered"], "junction", 4000, are_ellipsoids);
}

#[test]
fn balls_at_the_walls_between_pieces() {
    let are_balls = |scene: &Scene| all_touch_as("Sphere", scene);
    nothing_differs_where(&["turned", "group_frame"], "pieces", 3000, are_balls);
}

#[test]
fn ellipsoids_set_down_outside() {
    nothing_differs(&["set_down"], None, 2600);
}

#[test]
fn friction_among_nearly_equal_normals() {
    nothing_differs(&["committed_again"], Some("bowl"), 500);
    nothing_differs(&["committed_again"], Some("plate"), 800);
}

#[test]
fn points_where_pieces_meet() {
    let are_points = |scene: &Scene| all_touch_as("Point", scene);
    nothing_differs_where(&["turned", "group_frame", "reordered"], "junction", 4000, are_points);
}

#[test]
fn rays_where_pieces_meet() {
    let are_rays = |scene: &Scene| all_touch_as("Ray", scene);
    nothing_differs_where(&["turned", "far"], "pieces", 2000, are_rays);
    nothing_differs_where(&["cut"], "solid", 3000, are_rays);
}

#[test]
fn bars_on_the_edges_of_hulls() {
    let are_bars = |scene: &Scene| all_touch_as("LineSegment", scene);
    nothing_differs_where(&["turned", "reordered"], "hull", 2000, are_bars);
    nothing_differs_where(&["turned", "reordered"], "pieces", 2000, are_bars);
}

#[test]
fn points_and_balls_in_pieces() {
    let are = |scene: &Scene| all_touch_as("Point", scene) || all_touch_as("Sphere", scene);
    nothing_differs_where(&["turned", "group_frame"], "pieces", 2000, are);
}

#[test]
fn ellipsoids_in_valleys() {
    nothing_differs_where(&["turned"], "valley", 1500, |scene| all_touch_as("Ellipsoid", scene));
}

#[test]
fn bodies_set_down_outside() {
    nothing_differs(&["set_down"], None, 400);
}

#[test]
fn points_that_wind_through_hulls() {
    nothing_differs(&["depth_steps"], None, 600);
}

#[test]
fn balls_that_roll_and_spin() {
    nothing_differs(&["rolling"], None, 160);
}

#[test]
fn slip_evaluated_again_and_beside() {
    nothing_differs(&["committed_again"], Some("plane"), 200);
    nothing_differs(&["beside"], None, 200);
}

#[test]
fn whatever_touches_rods() {
    nothing_differs(&["turned", "own_axis", "reordered", "scaled"], Some("rod"), 400);
}

#[test]
fn round_parts_on_floors() {
    let told = ["turned", "group_frame", "own_axis", "reordered", "scaled"];
    nothing_differs(&told, Some("floor"), 400);
}

#[test]
fn balls_and_rays_in_holes_and_on_shafts() {
    let told = ["turned", "own_axis", "cut", "reordered", "scaled"];
    let is_thin = |scene: &Scene| !scene.bodies[0].shapes.iter().any(is_rod);
    for family in ["hole", "shaft", "cone"] {
        nothing_differs_where(&told, family, 300, is_thin);
    }
}

/// What has two ends.
fn is_rod(shape: &Shape) -> bool {
    matches!(shape, Shape::Round(_) | Shape::Segment { .. })
}

#[test]
fn what_must_be_the_same_bits_with_round_parts() {
    let bits =
        ["swapped", "regrouped", "bounded", "negated", "thrown_away", "restored", "forgotten", "workers"];
    nothing_differs(&bits, Some(make::round::ALL), 500);
}

#[test]
fn what_must_be_the_same_bits() {
    let bits =
        ["swapped", "regrouped", "bounded", "negated", "thrown_away", "restored", "forgotten", "workers"];
    nothing_differs(&bits, None, 400);
}
