//! Properties of friction as a function of poses: continuous, unchanged by a commit, zero in rolling.

use super::differs;
use crate::allowance::distance;
use crate::base::Base;
use crate::judge::Verdict;
use crate::make;
use crate::random::{Random, rotation_about};
use crate::scene::{Body, Friction, Normal, Scene, Shape, Surface};
use pong_engine::State;
use pong_geometry::{Pose, Twist, Vec3};

/// Checks that the states of a commit, evaluated again after it, give the same wrench.
pub fn committed_again(base: &mut Base, _: &mut Random) -> Verdict {
    let frames = base.scene.frames.clone();
    if base.stage.forget().is_err() {
        return Verdict::DoesNotApply;
    }
    for (frame, states) in frames.iter().enumerate() {
        if base.stage.move_surfaces(frame).is_err() {
            return Verdict::DoesNotApply;
        }
        let Ok(first) = base.stage.step(states) else { return Verdict::DoesNotApply };
        let Ok(again) = base.stage.evaluate(states) else { return Verdict::DoesNotApply };
        let apart = distance(&first.wrenches, &again.wrenches, base.scene.size);
        let rounding = 64.0 * f64::EPSILON * base.scene.size * base.scene.stiffness();
        let largest = base.largest(frame);
        if apart > 1e-12 * largest + rounding {
            return differs(base, frame, apart / largest, "evaluated again after the commit", &again);
        }
    }
    Verdict::Agrees
}

/// A smooth body that slides and turns on a smooth one, with a damped bristle.
pub fn sliding(random: &mut Random) -> Scene {
    let name = if random.chance(0.7) { "plane" } else { "ball" };
    let mut scene = loop {
        let scene = make::scene_of(random, name).filter(|scene| scene.bodies[0].shapes.len() == 1);
        let fits = |scene: &Scene| !matches!(scene.bodies[0].shapes[0], Shape::Ray { .. });
        if let Some(scene) = scene.filter(fits) {
            break scene;
        }
    };
    let spring = random.log_between(1e3, 1e6);
    for body in &mut scene.bodies {
        body.surface = Surface {
            stiffness: spring * random.between(0.5, 2.0),
            normal: Normal::Linear { damping: spring * random.between(0.0, 0.05), ramp: 0.0 },
            friction: Friction::Bristle {
                mu: random.between(0.1, 1.0),
                excess: 0.0,
                stiffness: spring * random.between(0.3, 1.0),
                damping: spring * random.between(0.0, 0.05),
            },
        };
    }
    let Some(states) = scene.frames.last().copied() else { return scene };
    // The history continues from the last frame along an arc in the contact plane.
    let size = scene.size;
    let turn = random.between(-1.0, 1.0);
    let axis = random.direction();
    let mut heading = random.direction();
    let speed = random.log_between(1e-3, 1.0) * size;
    let step = random.pick(&[1e-3, 4e-3]);
    let mut pose = states[0].pose();
    scene.frames = (0..12)
        .map(|_| {
            pose.position += heading * (speed * step);
            heading = rotation_about(&axis, turn * step * 10.0) * heading;
            let twist = Twist { linear: heading * speed, angular: Vec3::zeros() };
            [State::from_motion(&pose, &twist), states[1]]
        })
        .collect();
    scene
}

/// Checks that states a tiny step away give an equally near wrench.
pub fn beside(base: &mut Base, random: &mut Random) -> Verdict {
    let scene = base.scene.clone();
    let step = 1e-12 * scene.size;
    if base.stage.forget().is_err() {
        return Verdict::DoesNotApply;
    }
    for (frame, states) in scene.frames.iter().enumerate() {
        let Ok(first) = base.stage.step(states) else { return Verdict::DoesNotApply };
        let mut other = *states;
        other[0].position = (Vec3::from(other[0].position) + random.direction() * step).into();
        let Ok(again) = base.stage.evaluate(&other) else { return Verdict::DoesNotApply };
        let apart = distance(&first.wrenches, &again.wrenches, scene.size);
        let largest = base.largest(frame);
        // Springs of both directions over the step; rotations change by the step over the size, and the line
        // of two centres by the step over their distance.
        let arm = distance_of_centers(&scene, states).min(scene.size);
        let steep = 16.0 * (scene.stiffness() + largest / arm);
        let rounding = 64.0 * f64::EPSILON * scene.size * scene.stiffness();
        let is_same = first.contacts.len() == again.contacts.len();
        if is_same && apart > steep * step + rounding + 1e-12 * largest {
            return differs(base, frame, apart / largest, "evaluated a tiny step away", &again);
        }
    }
    Verdict::Agrees
}

/// Least distance between a point or sphere centre of A and a sphere centre of B, m; infinite without any.
fn distance_of_centers(scene: &Scene, states: &[State; 2]) -> f64 {
    let centers = |body: usize, with_points: bool| {
        let pose = states[body].pose();
        let shapes = scene.bodies[body].shapes.iter().filter_map(move |shape| match shape {
            Shape::Sphere { center, .. } => Some(*center),
            Shape::Point { position } if with_points => Some(*position),
            _ => None,
        });
        shapes.map(move |center| pose.position + pose.orientation * center)
    };
    let of_one = |a: Vec3| centers(1, false).map(|b| (a - b).norm()).fold(f64::INFINITY, f64::min);
    centers(0, true).map(of_one).fold(f64::INFINITY, f64::min)
}

/// A ball led without slip, spinning about the normal, over a fixed ball or a plane.
pub fn rolling(random: &mut Random) -> Scene {
    let radius = random.log_between(0.05, 1.0);
    let hill = random.chance(0.5).then(|| random.log_between(0.3, 3.0));
    let depth = radius * 1e-3;
    let (spin, rate) = (random.between(-20.0, 20.0), random.between(0.1, 0.6));
    let surface = |stiffness: f64, bristle: f64| Surface {
        stiffness,
        normal: Normal::Linear { damping: 0.0, ramp: 0.0 },
        friction: Friction::Bristle { mu: 1e6, excess: 0.0, stiffness: bristle, damping: 0.0 },
    };
    let start = random.orientation();
    // 0.1 s of rolling.
    let count = 64;
    let frames = (0..=count)
        .map(|index| {
            let t = 0.1 * f64::from(index) / f64::from(count);
            let (pose, twist) = match hill {
                Some(hill) => on_a_ball(hill, radius, depth, rate, spin, t),
                None => on_a_plane(radius, depth, rate, spin, t),
            };
            let pose = Pose { position: start * pose.position, orientation: start * pose.orientation };
            let twist = Twist { linear: start * twist.linear, angular: start * twist.angular };
            let rest = Twist { linear: Vec3::zeros(), angular: Vec3::zeros() };
            let under = Pose { position: Vec3::zeros(), orientation: start };
            [State::from_motion(&pose, &twist), State::from_motion(&under, &rest)]
        })
        .collect();
    let under = match hill {
        Some(radius) => Shape::Sphere { center: Vec3::zeros(), radius },
        None => Shape::Plane { normal: Vec3::z(), offset: 0.0 },
    };
    let ball = Shape::Sphere { center: Vec3::zeros(), radius };
    Scene {
        family: "rolling",
        bodies: [
            Body::new(vec![ball], surface(f64::INFINITY, 1e30)),
            Body::new(vec![under], surface(1e5, 1e5)),
        ],
        swapped: false,
        frames,
        motions: Vec::new(),
        size: 1.0,
    }
}

/// Motion along a great circle: a constant rotation of the frame about y, and in that frame a constant
/// rotation of the ball.
fn on_a_ball(hill: f64, radius: f64, depth: f64, rate: f64, spin: f64, t: f64) -> (Pose, Twist) {
    let angle = rate * t;
    let out = Vec3::new(libm::sin(angle), 0.0, libm::cos(angle));
    let along = Vec3::new(libm::cos(angle), 0.0, -libm::sin(angle));
    let apart = hill + radius - depth;
    // The ball is rigid, so the contact point lies on it at its radius, less the depth.
    let roll = apart * rate / radius;
    let own = Vec3::new(0.0, roll - rate, spin);
    let turned = rotation_about(&Vec3::y(), angle) * rotation_about(&own.normalize(), own.norm() * t);
    let twist = Twist { linear: along * (apart * rate), angular: Vec3::y() * roll + out * spin };
    (Pose { position: out * apart, orientation: turned }, twist)
}

fn on_a_plane(radius: f64, depth: f64, rate: f64, spin: f64, t: f64) -> (Pose, Twist) {
    let angular = Vec3::new(0.0, rate, spin);
    let speed = rate * radius;
    let turned = rotation_about(&angular.normalize(), angular.norm() * t);
    let position = Vec3::new(speed * t, 0.0, radius - depth);
    (Pose { position, orientation: turned }, Twist { linear: Vec3::x() * speed, angular })
}

/// Checks that friction, with every fourth, every second and every frame played, falls as the square of the
/// step.
pub fn refined(base: &mut Base, _: &mut Random) -> Verdict {
    let frames = base.scene.frames.clone();
    let mut friction = [0.0; 3];
    for (every, out) in [4, 2, 1].into_iter().zip(&mut friction) {
        let some: Vec<_> = frames.iter().step_by(every).copied().collect();
        let Ok(answers) = base.stage.play(&some) else { return Verdict::DoesNotApply };
        let Some(touch) = answers.last().and_then(|answer| answer.contacts.first()) else {
            return Verdict::DoesNotApply;
        };
        *out = touch.friction.norm();
    }
    // Second order: each is a quarter of the one before; first order: a half. Values below a millionth of the
    // size have no order.
    let small = 1e-10 * base.scene.stiffness() * base.scene.size;
    let [coarse, middle, fine] = friction;
    if fine > 0.4 * middle + small || middle > 0.4 * coarse + small {
        let says =
            format!("friction with every fourth, second and each frame: {coarse:e}, {middle:e}, {fine:e} N");
        let relative = fine / base.largest(base.answers.len() - 1);
        return Verdict::differs(frames.len() - 1, relative, says);
    }
    Verdict::Agrees
}
