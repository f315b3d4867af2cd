//! Velocity that the host can reach nearest to the end of the copies, in the energy norm of the contacts that are closed
//! there: the least ½·(u − w)·M·(u − w) + ½·Σ k·e², e the distance between the two points of a contact after a frame with
//! the velocity u (docs/theory.md, 9).

use crate::body::Body;
use crate::contact_set::{Row, axes_of};
use crate::copies::Touch;
use crate::island::Island;
use crate::system::System;
use nalgebra::{DMatrix, DVector, Vector6};
use pong_geometry::{Pose, Vec3};

/// Linearisations; two are enough for a body that turns by 0.1 rad.
const ITERATIONS: usize = 4;

/// A spring that pulls two points of a contact together.
struct Pull {
    row: Row,
    distance: f64,
    stiffness: f64,
}

fn pulls<'t>(bodies: &[Body], poses: &[Pose], touches: impl Iterator<Item = &'t Touch>) -> Vec<Pull> {
    let mut pulls = Vec::new();
    for touch in touches {
        let (a, b) = touch.bodies;
        let at = |body: usize, point: &Vec3| poses[body].position + poses[body].orientation * point;
        let points = [at(a, &touch.points[0]), at(b, &touch.points[1])];
        let apart = points[0] - points[1];
        let [along, across] = touch.stiffness;
        let axes = axes_of(&(poses[b].orientation * touch.normal));
        for (direction, stiffness) in axes.iter().zip([along, across, across]) {
            if stiffness > 0.0 {
                let row = Row::new(bodies, poses, (a, b), [&points[0], &points[1]], direction);
                pulls.push(Pull { row, distance: apart.dot(direction), stiffness });
            }
        }
    }
    pulls
}

/// Impulses over the frame that lead the bodies of an island to the nearest velocity. Those of other bodies are as
/// `reached`, the impulses of the copies.
pub(crate) fn project(
    system: &System,
    island: &Island,
    touches: &[Touch],
    reached: &[Vector6<f64>],
    length: f64,
) -> Vec<Vector6<f64>> {
    let within = |touch: &&Touch| island.has(touch.bodies.0) || island.has(touch.bodies.1);
    let touches: Vec<&Touch> = touches.iter().filter(within).collect();
    let mut impulses = reached.to_vec();
    if touches.is_empty() {
        return impulses;
    }
    let mut z = DVector::zeros(island.size());
    for _ in 0..ITERATIONS {
        let poses = landing(system, island, &impulses, length);
        let pulls = pulls(&system.bodies, &poses, touches.iter().copied());
        let mut stiffness = DMatrix::zeros(island.size(), island.size());
        let mut right = DVector::zeros(island.size());
        let mut rows = Vec::with_capacity(pulls.len());
        for pull in &pulls {
            let row = island.row(system, &pull.row);
            stiffness.ger(length * length * pull.stiffness, &row, &row, 1.0);
            let ahead = length * row.dot(&z) - pull.distance;
            right.axpy(length * pull.stiffness * ahead, &row, 1.0);
            rows.push(row);
        }
        let next = Island::solve(stiffness, &right);
        impulses.copy_from_slice(reached);
        for (pull, row) in pulls.iter().zip(&rows) {
            let distance = pull.distance + length * row.dot(&(&next - &z));
            let push = -length * pull.stiffness * distance;
            for (body, on) in [(pull.row.a, &pull.row.on_a), (pull.row.b, &pull.row.on_b)] {
                if island.has(body) {
                    impulses[body] += on * push;
                }
            }
        }
        z = next;
    }
    impulses
}

/// Leading poses of all bodies after a frame in which those of an island get these impulses, and the others none.
fn landing(system: &System, island: &Island, impulses: &[Vector6<f64>], length: f64) -> Vec<Pose> {
    let of_island = |(body, impulse): (usize, &Vector6<f64>)| match island.has(body) {
        true => *impulse,
        false => Vector6::zeros(),
    };
    let impulses: Vec<_> = impulses.iter().enumerate().map(of_island).collect();
    system.landing(&impulses, length)
}
