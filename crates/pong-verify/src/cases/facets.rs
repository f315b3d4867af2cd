//! W7: friction survives the crossing from facet to facet.

use super::rolling::{RADIUS, down_slope};
use crate::case::{Case, Failure, Outcome};
use crate::row::Row;
use crate::scene::{Bristle, Duo, with_friction};
use pong_engine::State;
use pong_executive::Vec3;

pub const W7: Case = Case {
    id: "W7",
    title: "Rolling and sliding over facets",
    set_up: "The ball of V11 on 20° and 30° slopes made of triangles and of abutting blocks, to 100 rad/s; then a ball \
             that slides without turning over a convex ridge of nine facets of 8°, always 1 mm deep.",
    source: "as V11: a flat surface is one plane however it is cut; sliding friction stays μ·N against the motion",
    rows,
};

fn rows() -> Outcome {
    let mut rows = Vec::new();
    for (ground, name) in [("mesh_rough", "triangles"), ("tiles_rough", "blocks")] {
        for degrees in [20.0, 30.0] {
            for row in down_slope(ground, degrees, 100.0, 0.0)? {
                rows.push(Row { quantity: format!("{name}, {}", row.quantity), ..row });
            }
        }
    }
    rows.extend(over_the_ridge()?);
    Ok(rows)
}

const DEPTH: f64 = 1e-3;
const STIFFNESS: f64 = 1e5;
const MU: f64 = 0.5;
/// Half of a facet's angle.
const HALF_ANGLE: f64 = 4.0 * core::f64::consts::PI / 180.0;

/// Centre of a ball 1 mm deep, and its heading, by the path length from the middle of the ridge: straight
/// over facets, on an arc over edges.
fn along_ridge(way: f64) -> (Vec3, Vec3) {
    let gap = RADIUS - DEPTH;
    let (flat, arc) = (2.0 * libm::sin(HALF_ANGLE), 2.0 * HALF_ANGLE * gap);
    let facet = libm::round(way / (flat + arc));
    let rest = way - facet * (flat + arc);
    // Over the facet of this index, tilted by its angle, or over the edge after it.
    let over_flat = rest.clamp(-0.5 * flat, 0.5 * flat);
    let tilt = facet * 2.0 * HALF_ANGLE + (rest - over_flat) / gap;
    let (sine, cosine) = libm::sincos(facet * 2.0 * HALF_ANGLE);
    let foot = Vec3::new(sine, 0.0, cosine) * libm::cos(HALF_ANGLE)
        + Vec3::new(cosine, 0.0, -sine) * over_flat
        - Vec3::z();
    let (sine, cosine) = libm::sincos(tilt);
    (foot + Vec3::new(sine, 0.0, cosine) * gap, Vec3::new(cosine, 0.0, -sine))
}

fn over_the_ridge() -> Result<[Row; 3], Failure> {
    let bristle = Bristle { mu: MU, excess: 0.0, stiffness: 6e4, damping: 0.0 };
    let duo =
        with_friction(Duo::new("ridge_rough", "ball_rough")?.mover(|s| s.stiffness = STIFFNESS)?, &bristle)?;
    let (mut world, [ridge, ball]) = duo.world()?;
    world.set_state(ridge, &State::identity())?;
    let [mut depth_off, mut length_off, mut heading_off] = [0.0_f64; 3];
    let (steps, reach) = (6000, 0.5);
    for step in 0..=steps {
        let (place, heading) = along_ridge(reach * (2.0 * f64::from(step) / f64::from(steps) - 1.0));
        let state = State { position: place.into(), linear_velocity: heading.into(), ..State::identity() };
        world.set_state(ball, &state)?;
        world.step()?;
        let contacts = world.contacts();
        let [contact] = contacts.as_slice() else {
            return Err(format!("{} contacts on the ridge instead of one", contacts.len()).into());
        };
        depth_off = depth_off.max((contact.depth / DEPTH - 1.0).abs());
        // The bristle needs p_k, 0.8 mm, to break away.
        if step > 20 {
            let force = contact.friction_force;
            length_off = length_off.max((force.norm() / (MU * contact.normal_force) - 1.0).abs());
            heading_off = heading_off.max((force.normalize() + heading).norm());
        }
    }
    Ok([
        Row::below("ridge: depth off 1 mm", "", depth_off, 1e-9),
        Row::below("ridge: friction off μ·N", "", length_off, 1e-9),
        Row::below("ridge: friction's direction off the motion", "rad", heading_off, 1e-9),
    ])
}
