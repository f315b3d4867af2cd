//! Memory of the side of entry: a body is pushed back to where it entered, and its depth never jumps up.

use crate::base::Base;
use crate::judge::Verdict;
use crate::make::solids;
use crate::random::Random;
use crate::scene::{Body, Friction, Normal, Scene, Shape, Surface};
use pong_engine::State;
use pong_geometry::{Pose, Twist, Vec3};

/// A point on a winding path into and through a hull, in small steps.
pub fn path_in_a_hull(random: &mut Random) -> Scene {
    let surface = Surface {
        stiffness: 1e5,
        normal: Normal::Linear { damping: 0.0, ramp: 0.0 },
        friction: Friction::Smooth,
    };
    let hull = solids::random_hull(random);
    let step = random.pick(&[0.002, 0.006, 0.02]);
    let mut place = random.pick(&hull.vertices) * random.between(0.5, 1.1);
    let mut heading = (random.vector(0.4) - place).normalize();
    let frames = (0..60)
        .map(|_| {
            place += heading * step;
            heading = (heading + random.vector(0.3)).normalize();
            let at = |position: &Vec3| {
                let still = Twist { linear: Vec3::zeros(), angular: Vec3::zeros() };
                State::from_motion(&Pose { position: *position, ..Pose::identity() }, &still)
            };
            [at(&place), at(&Vec3::zeros())]
        })
        .collect();
    let body = |shape| Body::new(vec![shape], surface);
    Scene {
        family: "path in a hull",
        bodies: [body(Shape::Point { position: Vec3::zeros() }), body(Shape::Polyhedron(hull))],
        swapped: false,
        frames,
        motions: Vec::new(),
        size: 1.0,
    }
}

/// Checks that each face's depth changes by no more than the point moves; a memory that changes faces may
/// only choose a lesser depth.
pub fn depth_steps(base: &mut Base, _: &mut Random) -> Verdict {
    let place = |frame: usize| {
        let [a, b] = [0, 1].map(|body| base.scene.frames[frame][body].pose());
        Pose::relative(&a, &b).position
    };
    for frame in 1..base.answers.len() {
        let depth = |frame: usize| base.answers[frame].contacts.first().map(|touch| touch.depth);
        let (Some(before), Some(now)) = (depth(frame - 1), depth(frame)) else { continue };
        let way = (place(frame) - place(frame - 1)).norm();
        let beyond = now - before - way;
        if beyond > 1e-12 * base.scene.size {
            let says = format!("depth {before} m, then {now} m, though the point moved by {way} m alone");
            return Verdict::differs(frame, beyond / now, says);
        }
    }
    Verdict::Agrees
}
