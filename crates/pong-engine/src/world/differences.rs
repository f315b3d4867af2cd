//! Tangent of the last frame by central differences: for contacts without derivatives in closed form.

use super::World;
use crate::error::EngineError;
use crate::ids::InterfaceId;
use crate::scene::State;
use crate::tangent::PairTangent;
use pong_geometry::{Quat, Vec3, Wrench};

/// Width of a difference, relative to the least depth of the contacts of a group.
const OF_DEPTH: f64 = 1e-4;
/// Least width of a difference of poses, relative to the largest coordinate of a group: above it rounding spoils
/// less than the fifth digit.
const OF_POSITION: f64 = 1e-10;
/// Width of a difference of velocities, m/s, relative to a speed of 1 m/s or that of the group, if larger.
const OF_SPEED: f64 = 1e-4;

/// A pair of movable groups that touch, and which of them are perturbed.
struct Touching {
    group_pair: usize,
    bodies: [usize; 2],
    tangent: PairTangent,
}

/// Widths of the differences of one group.
struct Widths {
    /// Translation, m, and rotation, rad.
    pose: [f64; 2],
    /// Velocity, m/s, and angular velocity, rad/s.
    twist: [f64; 2],
}

impl World {
    /// As [`tangents`](Self::tangents), by central differences of the wrenches: for every law and every pair of
    /// kinds, two evaluations for each coordinate of the pose and the twist of each group that touches. The width
    /// is 1e-4 of the least depth of the group's contacts. Contacts that begin or end within the width, and
    /// bristles that let go, spoil the result. The states and the frame are those of before. Allocates.
    ///
    /// # Errors
    /// As [`evaluate`](Self::evaluate); [`EngineError::WrongPhase`] unless the last frame is evaluated and not
    /// committed yet.
    pub fn tangents_by_differences(&mut self) -> Result<Vec<PairTangent>, EngineError> {
        self.require_evaluated_frame()?;
        self.differences(self.touching_pairs())
    }

    /// As [`tangents`](Self::tangents) for the pairs of groups whose contacts all have derivatives in closed form, and
    /// as [`tangents_by_differences`](Self::tangents_by_differences) for the others; in the order of the groups.
    ///
    /// # Errors
    /// As [`tangents_by_differences`](Self::tangents_by_differences).
    pub fn complete_tangents(&mut self) -> Result<Vec<PairTangent>, EngineError> {
        self.require_evaluated_frame()?;
        let known = self.known_tangents();
        let is_unknown = |pair: &Touching| {
            known
                .iter()
                .any(|(group_pair, tangent)| *group_pair as usize == pair.group_pair && tangent.is_err())
        };
        let unknown = self.touching_pairs().into_iter().filter(is_unknown).collect();
        let mut differences = self.differences(unknown)?.into_iter();
        // Both lists are in the order of the pairs.
        let complete =
            known.into_iter().map(|(_, tangent)| tangent.or_else(|_| differences.next().ok_or(())));
        Ok(complete.filter_map(Result::ok).collect())
    }

    /// Tangents of some pairs that touch, by differences.
    fn differences(&mut self, mut touching: Vec<Touching>) -> Result<Vec<PairTangent>, EngineError> {
        let mut bodies: Vec<usize> = touching.iter().flat_map(|pair| pair.bodies).collect();
        bodies.sort_unstable();
        bodies.dedup();
        for body in bodies {
            let widths = self.widths(body);
            let interface = InterfaceId::new(self.scene.stamp, body);
            let Some(state) = self.state_as_set(interface)?.copied() else { continue };
            let differences = self.differences_of(interface, (body, &state), &widths, &mut touching);
            self.set_state(interface, &state)?;
            self.evaluate()?;
            differences?;
        }
        Ok(touching.into_iter().map(|pair| pair.tangent).collect())
    }

    fn touching_pairs(&self) -> Vec<Touching> {
        let touching = |(group_pair, bodies)| {
            let mut tangent = PairTangent::of_groups(self.scene.stamp, bodies);
            tangent.by_differences = true;
            Touching { group_pair, bodies, tangent }
        };
        self.touching_bodies().into_iter().map(touching).collect()
    }

    fn widths(&self, body: usize) -> Widths {
        let interface = InterfaceId::new(self.scene.stamp, body);
        let (mut depth, mut arm, mut far) = (f64::INFINITY, 0.0_f64, 0.0_f64);
        for contact in self.contacts_iter() {
            for side in [&contact.a, &contact.b].into_iter().filter(|side| side.interface == interface) {
                depth = depth.min(contact.depth);
                arm = arm.max(side.arm.norm());
                far = far.max(side.arm.amax().max(contact.point.amax()));
            }
        }
        let width = (OF_DEPTH * depth).max(OF_POSITION * far);
        let lever = arm.max(depth);
        let speed = OF_SPEED * self.runtime.frame.twists[body].linear.norm().max(1.0);
        Widths { pose: [width, width / lever], twist: [speed, speed / lever] }
    }

    fn differences_of(
        &mut self,
        interface: InterfaceId,
        (body, state): (usize, &State),
        widths: &Widths,
        touching: &mut [Touching],
    ) -> Result<(), EngineError> {
        for coordinate in 0..12 {
            let kind = coordinate / 3;
            let width = if kind < 2 { widths.pose[kind] } else { widths.twist[kind - 2] };
            let mut sides = Vec::new();
            for sign in [1.0, -1.0] {
                self.set_state(interface, &moved(state, coordinate, sign * width))?;
                self.evaluate()?;
                sides.push(
                    touching
                        .iter()
                        .map(|pair| self.both_wrenches((pair.group_pair, pair.bodies)))
                        .collect::<Vec<_>>(),
                );
            }
            for (index, pair) in touching.iter_mut().enumerate() {
                let Some(of) = pair.bodies.iter().position(|own| *own == body) else { continue };
                for on in 0..2 {
                    let (ahead, behind) = (&sides[0][index][on], &sides[1][index][on]);
                    let blocks =
                        if kind < 2 { &mut pair.tangent.stiffness } else { &mut pair.tangent.damping };
                    for row in 0..6 {
                        let change = part(ahead, row) - part(behind, row);
                        blocks[on][of][(row, coordinate % 6)] = -change / (2.0 * width);
                    }
                }
            }
        }
        Ok(())
    }
}

fn part(wrench: &Wrench, row: usize) -> f64 {
    if row < 3 { wrench.force[row] } else { wrench.moment[row - 3] }
}

/// A state with one coordinate changed: translation, rotation, velocity or angular velocity.
fn moved(state: &State, coordinate: usize, by: f64) -> State {
    let mut vector = Vec3::zeros();
    vector[coordinate % 3] = by;
    let (mut pose, mut twist) = (state.pose(), state.twist());
    match coordinate / 3 {
        0 => pose.position += vector,
        1 => pose.orientation = Quat::from_scaled_axis(vector) * pose.orientation,
        2 => twist.linear += vector,
        _ => twist.angular += vector,
    }
    State::from_motion(&pose, &twist)
}
