//! Differences between the motion of the host and the prediction of the last frame, with their energy.

use crate::chart::{angular, displacement, linear};
use crate::contact_set::{Spring, springs_at};
use crate::error::SlowError;
use crate::memory::Memory;
use crate::report::GroupReport;
use crate::system::System;
use pong_engine::World;
use pong_geometry::Pose;

/// Differences below this share of the sizes are rounding.
const ROUNDING: f64 = 1e-12;

/// Differences between the motion of the host and the prediction.
pub(crate) fn inserted(
    world: &mut World,
    memory: &Memory,
    system: &System,
) -> Result<Vec<GroupReport>, SlowError> {
    let bodies = &system.bodies;
    let mut reports = Vec::with_capacity(bodies.len());
    let (mut predicted, mut displacements) =
        (Vec::with_capacity(bodies.len()), Vec::with_capacity(bodies.len()));
    let [mut found_velocities, mut predicted_velocities] = [Vec::new(), Vec::new()];
    let mut differs = false;
    for (index, body) in bodies.iter().enumerate() {
        let kept = memory.of(index, body.axes);
        let (pose, velocity) =
            kept.map_or((body.leading, body.velocity), |kept| (kept.predicted, kept.predicted_velocity));
        let by = displacement(body.axes, &pose, &body.leading);
        let gained = body.velocity - velocity;
        let size = body.leading.position.norm() + memory.length * linear(&body.velocity).norm();
        differs |= linear(&by).norm() > ROUNDING * size || angular(&by).norm() > ROUNDING;
        predicted.push(pose);
        displacements.push(by);
        found_velocities.push(body.velocity);
        predicted_velocities.push(velocity);
        reports.push(GroupReport {
            interface: body.interface,
            position: linear(&by).into(),
            rotation: angular(&by).into(),
            linear_velocity: linear(&gained).into(),
            angular_velocity: angular(&gained).into(),
            inserted: 0.0,
        });
    }
    for (index, assembly) in system.assemblies.iter().enumerate() {
        let energy = system.kinetic(index, &found_velocities) - system.kinetic(index, &predicted_velocities)
            + system.potential(index, &displacements);
        let share = energy / assembly.bodies.len() as f64;
        assembly.bodies.iter().for_each(|&body| reports[body].inserted = share);
    }
    if differs {
        let found: Vec<Pose> = bodies.iter().map(|body| body.leading).collect();
        for (poses, sign) in [(&found, 1.0), (&predicted, -1.0)] {
            for spring in springs_at(world, bodies, poses)? {
                share(&mut reports, system, &spring, sign);
            }
        }
    }
    Ok(reports)
}

fn share(reports: &mut [GroupReport], system: &System, spring: &Spring, sign: f64) {
    let (a, b) = (spring.normal.a, spring.normal.b);
    let share = if system.moves(a) && system.moves(b) { 0.5 } else { 1.0 };
    for body in [a, b] {
        if system.moves(body) {
            reports[body].inserted += sign * share * spring.energy;
        }
    }
}
