//! Twins at other poses: turned, moved, far away, with other group axes, in another unit of length.

use super::Twin;
use crate::make::rescaled;
use crate::random::{Random, rotation_about};
use crate::round_part::RoundKind;
use crate::scene::{Body, Friction, Normal, Scene, Shape};
use pong_engine::{State, SurfaceMotion};
use pong_geometry::{Pose, Quat, Twist, Vec3};

/// Transforms every state to a frame that stands at `pose` in the common one and drifts; `turn` maps the old
/// common components to the new ones.
fn seen(scene: &mut Scene, turn: &Quat, shift: &Vec3, drift: &Vec3) {
    for state in scene.frames.iter_mut().flatten() {
        let (pose, twist) = (state.pose(), state.twist());
        let pose = Pose { position: turn * pose.position + shift, orientation: turn * pose.orientation };
        let twist = Twist { linear: turn * twist.linear + drift, angular: turn * twist.angular };
        *state = State::from_motion(&pose, &twist);
    }
}

/// The whole scene turned.
pub fn turned(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    let turn = match random.chance(0.2) {
        // Quarter turns keep round numbers round.
        true => rotation_about(&random.pick(&[Vec3::x(), Vec3::y(), Vec3::z()]), std::f64::consts::FRAC_PI_2),
        false => random.orientation(),
    };
    seen(&mut twin.scene, &turn, &Vec3::zeros(), &Vec3::zeros());
    twin.back.turn = turn;
    Some(twin)
}

/// The whole scene moved by a few of its sizes, and drifting.
pub fn moved(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    let [shift, drift] = [random.vector(5.0 * scene.size), random.vector(5.0 * scene.size)];
    seen(&mut twin.scene, &Quat::identity(), &shift, &drift);
    Some(twin)
}

/// The whole scene turned and moved to a low orbit or further, drifting at kilometres per second.
pub fn far(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    let turn = random.orientation();
    let distance = random.pick(&[6.8e6, 1e8]);
    let drift = random.direction() * 7.7e3;
    seen(&mut twin.scene, &turn, &(random.direction() * distance), &drift);
    twin.back.turn = turn;
    twin.rounding = 4.0 * f64::EPSILON * distance;
    twin.rounding_of_velocity = 4.0 * f64::EPSILON * drift.norm();
    Some(twin)
}

/// The axes of one or both groups turned and moved; half of the time through the pose of the group that holds
/// the primitives.
pub fn group_frame(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    for body in 0..2 {
        if random.chance(0.3) {
            continue;
        }
        let shift = if random.chance(0.5) { Vec3::zeros() } else { random.vector(scene.size) };
        let frame = Pose { position: shift, orientation: random.orientation() };
        let back = frame.inverse();
        let Body { shapes, place, .. } = &mut twin.scene.bodies[body];
        match random.chance(0.5) {
            true => *place = back.compose(place),
            false => {
                let whole = back.compose(place);
                *shapes = shapes.iter().map(|shape| shape.carried(&whole)).collect();
                *place = Pose::identity();
            }
        }
        (0..scene.frames.len()).for_each(|at| other_axes(&mut twin, (at, body), &frame));
    }
    Some(twin)
}

/// Gives the state of a body in a frame, and the motion of its surface, by other axes of its group, which stand at
/// `frame` in it.
fn other_axes(twin: &mut Twin, (at, body): (usize, usize), frame: &Pose) {
    let state = &mut twin.scene.frames[at][body];
    let (pose, twist) = (state.pose(), state.twist());
    let arm = pose.orientation * frame.position;
    let twist = Twist { linear: twist.linear + twist.angular.cross(&arm), ..twist };
    *state = State::from_motion(&pose.compose(frame), &twist);
    if let Some(motions) = twin.scene.motions.get_mut(at) {
        motions[body] = motion_by(&motions[body], frame);
    }
    twin.back.origins.resize(twin.scene.frames.len(), [Vec3::zeros(); 2]);
    twin.back.origins[at][body] = frame.position;
}

/// Motion of a surface by other axes of its group, which stand at `frame` in it.
fn motion_by(motion: &SurfaceMotion, frame: &Pose) -> SurfaceMotion {
    let turned = |v: Vec3| <[f64; 3]>::from(frame.orientation.inverse() * v);
    let at_origin = |linear: [f64; 3], angular: [f64; 3]| {
        turned(Vec3::from(linear) + Vec3::from(angular).cross(&frame.position))
    };
    SurfaceMotion {
        linear_velocity: at_origin(motion.linear_velocity, motion.angular_velocity),
        angular_velocity: turned(motion.angular_velocity.into()),
        belt_velocity: turned(motion.belt_velocity.into()),
        linear_travel: at_origin(motion.linear_travel, motion.angular_travel),
        angular_travel: turned(motion.angular_travel.into()),
        belt_travel: turned(motion.belt_travel.into()),
    }
}

/// The body B moved instead of its surface: a plane along itself, or about its normal.
pub fn driven(scene: &Scene, _: &mut Random) -> Option<Twin> {
    let [Shape::Plane { normal, .. }] = scene.bodies[1].shapes.as_slice() else { return None };
    // The direction of an axial plunger is not the normal of the plane: of a body that moves it sees the approach.
    let is_axial = |shape: &Shape| matches!(shape, Shape::Ray { axial: true, .. });
    (!scene.bodies[0].shapes.iter().any(is_axial)).then_some(())?;
    let has_bristle =
        scene.bodies.iter().any(|body| matches!(body.surface.friction, Friction::Bristle { .. }));
    let mut twin = Twin::of(scene);
    twin.scene.motions.clear();
    twin.back.origins = vec![[Vec3::zeros(); 2]; scene.frames.len()];
    for (at, [of_a, of_b]) in scene.motions.iter().enumerate() {
        let [linear, angular, travel, turned] =
            [of_b.linear_velocity, of_b.angular_velocity, of_b.linear_travel, of_b.angular_travel]
                .map(Vec3::from);
        let slack = 1e-12 * (linear.norm() + angular.norm() * scene.size) * normal.norm();
        let is_along = normal.dot(&linear).abs() <= slack && normal.cross(&angular).norm() <= slack;
        // A bristle turns with its body, to the second order of the angle, and stays where only the surface turns.
        let turns = angular != Vec3::zeros();
        if *of_a != SurfaceMotion::default()
            || !is_along
            || (turns && (has_bristle || linear != Vec3::zeros()))
        {
            return None;
        }
        let state = &mut twin.scene.frames[at][1];
        let (pose, twist) = (state.pose(), state.twist());
        let turn = rotation_about(&normal.normalize(), turned.dot(&normal.normalize()));
        let moved = Pose { position: travel, orientation: turn };
        let twist = Twist {
            linear: twist.linear
                + twist.angular.cross(&(pose.orientation * travel))
                + pose.orientation * linear,
            angular: twist.angular + pose.orientation * angular,
        };
        *state = State::from_motion(&pose.compose(&moved), &twist);
        twin.back.origins[at][1] = travel;
    }
    (!scene.motions.is_empty()).then_some(twin)
}

/// Bodies of one round part turned about its own axis: by a different angle in every frame, or by the same
/// angle if bristles or a hole's memory depend on the previous pose.
pub fn own_axis(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    let remembers = scene.bodies.iter().any(|body| matches!(body.surface.friction, Friction::Bristle { .. }));
    let mut is_turned = false;
    for (body, told) in scene.bodies.iter().enumerate() {
        let [Shape::Round(part)] = told.shapes.as_slice() else { continue };
        if told.place != Pose::identity() {
            continue;
        }
        is_turned = true;
        let same = random.between(-3.0, 3.0);
        for at in 0..scene.frames.len() {
            let angle =
                if remembers || part.kind == RoundKind::Bore { same } else { random.between(-3.0, 3.0) };
            other_axes(&mut twin, (at, body), &part.own_turn(angle));
        }
    }
    is_turned.then_some(twin)
}

/// Another unit of length: forces scale with it while stiffness in N/m stays.
pub fn scaled(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let s = match random.chance(0.3) {
        true => libm::exp2(random.between(-20.0, 20.0).round()),
        false => random.log_between(1e-6, 1e6),
    };
    let mut twin = Twin::of(scene);
    twin.scene = rescaled(scene, s);
    for body in &mut twin.scene.bodies {
        match &mut body.surface.normal {
            Normal::Linear { ramp, .. } => *ramp *= s,
            Normal::HuntCrossley { dissipation, exponent } => {
                *dissipation /= s;
                if *exponent > 1.0 {
                    body.surface.stiffness /= s.sqrt();
                }
            }
            Normal::PowerLaw { damping, exponent, damping_exponent } => {
                *damping /= libm::pow(s, *damping_exponent);
                if *exponent > 1.0 {
                    body.surface.stiffness /= s.sqrt();
                }
            }
        }
        if let Friction::Coulomb { slip_speed, .. } = &mut body.surface.friction {
            *slip_speed *= s;
        }
    }
    twin.back.force = s;
    twin.back.moment = s * s;
    Some(twin)
}

/// Some quaternions negated.
pub fn negated(scene: &Scene, random: &mut Random) -> Option<Twin> {
    let mut twin = Twin::of(scene);
    for state in twin.scene.frames.iter_mut().flatten() {
        if random.chance(0.5) {
            state.orientation = state.orientation.map(|x| -x);
        }
    }
    Some(twin)
}
