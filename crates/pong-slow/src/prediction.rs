//! Differences between the motion of the host and the prediction of the last frame, with their energy.

use crate::body::Body;
use crate::chart::{angular, displacement, linear};
use crate::contact_set::{Spring, springs_at};
use crate::error::SlowError;
use crate::memory::Memory;
use crate::report::GroupReport;
use pong_engine::World;
use pong_geometry::Pose;

/// Differences below this share of the sizes are rounding.
const ROUNDING: f64 = 1e-12;

/// Differences between the motion of the host and the prediction.
pub(crate) fn inserted(
    world: &mut World,
    memory: &Memory,
    bodies: &[Body],
) -> Result<Vec<GroupReport>, SlowError> {
    let mut reports = Vec::with_capacity(bodies.len());
    let mut predicted = Vec::with_capacity(bodies.len());
    let mut differs = false;
    for (index, body) in bodies.iter().enumerate() {
        let kept = memory.of(index, body.axes);
        let (pose, velocity) =
            kept.map_or((body.leading, body.velocity), |kept| (kept.predicted, kept.predicted_velocity));
        let by = displacement(body.axes, &pose, &body.leading);
        let gained = body.velocity - velocity;
        let size = body.leading.position.norm() + memory.length * linear(&body.velocity).norm();
        differs |= linear(&by).norm() > ROUNDING * size || angular(&by).norm() > ROUNDING;
        let energy = body.kinetic(&body.velocity) - body.kinetic(&velocity) + body.potential(&by);
        predicted.push(pose);
        reports.push(GroupReport {
            interface: body.interface,
            position: linear(&by).into(),
            rotation: angular(&by).into(),
            linear_velocity: linear(&gained).into(),
            angular_velocity: angular(&gained).into(),
            inserted: energy,
        });
    }
    if differs {
        let found: Vec<Pose> = bodies.iter().map(|body| body.leading).collect();
        for (poses, sign) in [(&found, 1.0), (&predicted, -1.0)] {
            for spring in springs_at(world, bodies, poses)? {
                share(&mut reports, bodies, &spring, sign);
            }
        }
    }
    Ok(reports)
}

fn share(reports: &mut [GroupReport], bodies: &[Body], spring: &Spring, sign: f64) {
    let (a, b) = (spring.normal.a, spring.normal.b);
    let share = if bodies[a].moves() && bodies[b].moves() { 0.5 } else { 1.0 };
    for body in [a, b] {
        if bodies[body].moves() {
            reports[body].inserted += sign * share * spring.energy;
        }
    }
}
