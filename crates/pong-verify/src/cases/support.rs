//! V30: an ellipsoid on a plane.

use crate::case::{Case, Outcome};
use crate::measure::rotation;
use crate::row::Row;
use crate::scene::Duo;
use pong_engine::State;
use pong_executive::{Pose, Twist, Vec3};
use pong_testkit::Random;

pub const V30: Case = Case {
    id: "V30",
    title: "Ellipsoid on a plane",
    set_up: "Semi-axes 0.3, 0.25, 0.2 m in 2,000 random poses against a plane in 2,000 random poses within 3 m. Errors \
             are over the largest coordinate.",
    source: "plane n·x = h: depth h − n·c + √Σ(a_i·n_i)², deepest point c − A²n/|A·n|, n along the ellipsoid's axes",
    rows,
};

const AXES: [f64; 3] = [0.3, 0.25, 0.2];

fn rows() -> Outcome {
    let (mut world, [egg, ground]) = Duo::new("ellipsoid", "ground")?.world()?;
    let mut random = Random(30);
    let [mut depth_off, mut place_off] = [0.0_f64; 2];
    let (mut touching, mut wrong) = (0, 0);
    for _ in 0..2000 {
        let mut pose = |place: f64| Pose {
            position: random.vector(place),
            orientation: rotation(random.vector(core::f64::consts::PI)),
        };
        let (x_g, x_near) = (pose(3.0), pose(0.3));
        let x_e = x_g.compose(&x_near);
        world.set_states(&[
            (egg, State::from_motion(&x_e, &Twist::zero())),
            (ground, State::from_motion(&x_g, &Twist::zero())),
        ])?;
        world.evaluate()?;
        let normal = x_g.orientation * Vec3::z();
        let along_axes = x_e.orientation.inverse() * normal;
        let scaled = Vec3::from(AXES).component_mul(&along_axes);
        let depth = -normal.dot(&(x_e.position - x_g.position)) + scaled.norm();
        let found = world.contacts();
        if depth <= 0.0 {
            wrong += found.len();
            continue;
        }
        touching += 1;
        let [contact] = found.as_slice() else {
            wrong += 1;
            continue;
        };
        let deepest = Vec3::from(AXES).component_mul(&scaled) / -scaled.norm();
        // The ground is rigid: the force acts at the deepest point, moved outwards by the depth.
        let place = x_e.position + x_e.orientation * deepest + normal * depth;
        let largest = place.amax().max(x_e.position.amax()).max(x_g.position.amax()).max(1.0);
        depth_off = depth_off.max((contact.depth - depth).abs() / largest);
        place_off = place_off.max((contact.point - place).norm() / largest);
    }
    Ok(vec![
        Row::count("contacts told wrong", 0, wrong),
        Row::below(format!("depth, {touching} contacts"), "", depth_off, 1e-14),
        Row::below("place of the force", "", place_off, 1e-14),
    ])
}
