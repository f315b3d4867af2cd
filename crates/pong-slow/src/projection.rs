//! Velocity that the host can reach nearest to the end of the copies, in the energy norm of the contacts that are closed
//! there: the least ½·(u − w)·M·(u − w) + ½·Σ k·e², e the distance between the two points of a contact after a frame with
//! the velocity u (docs/theory.md, 9).

use crate::body::Body;
use crate::contact_set::{Row, axes_of};
use crate::copies::{Ends, Touch};
use crate::island::Island;
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

/// Impulses over the frame for the bodies of an island, in their order, that lead to the nearest velocity.
pub(crate) fn project(bodies: &[Body], island: &Island, ends: &Ends, length: f64) -> Vec<Vector6<f64>> {
    let within =
        |touch: &&Touch| island.place(touch.bodies.0).is_some() || island.place(touch.bodies.1).is_some();
    let reached: Vec<Vector6<f64>> = island.bodies.iter().map(|&body| ends.copies[body].impulse).collect();
    if ends.touches.iter().filter(within).count() == 0 {
        return reached;
    }
    let mut impulses = reached.clone();
    let mut z = DVector::zeros(island.size());
    for _ in 0..ITERATIONS {
        let poses = landing(bodies, island, &impulses, length);
        let pulls = pulls(bodies, &poses, ends.touches.iter().filter(within));
        let mut stiffness = DMatrix::zeros(island.size(), island.size());
        let mut right = DVector::zeros(island.size());
        let mut rows = Vec::with_capacity(pulls.len());
        for pull in &pulls {
            let row = island.coordinates(bodies, &pull.row);
            stiffness.ger(length * length * pull.stiffness, &row, &row, 1.0);
            let ahead = length * row.dot(&z) - pull.distance;
            right.axpy(length * pull.stiffness * ahead, &row, 1.0);
            rows.push(row);
        }
        let next = Island::solve(stiffness, &right);
        impulses.clone_from(&reached);
        for (pull, row) in pulls.iter().zip(&rows) {
            let distance = pull.distance + length * row.dot(&(&next - &z));
            let push = -length * pull.stiffness * distance;
            for (body, on) in [(pull.row.a, &pull.row.on_a), (pull.row.b, &pull.row.on_b)] {
                if let Some(place) = island.place(body) {
                    impulses[place] += on * push;
                }
            }
        }
        z = next;
    }
    impulses
}

/// Leading poses of all bodies after a frame in which those of an island get these impulses, and the others none.
fn landing(bodies: &[Body], island: &Island, impulses: &[Vector6<f64>], length: f64) -> Vec<Pose> {
    let pose = |(index, body): (usize, &Body)| {
        let impulse = island.place(index).map_or_else(Vector6::zeros, |place| impulses[place]);
        body.moved(&body.leading, &(body.velocity_after(&impulse, length) * length))
    };
    bodies.iter().enumerate().map(pose).collect()
}
