//! One movable group in a frame.

use crate::chart::{self, Axes, angular, linear, six};
use crate::error::SlowError;
use crate::input::{Dynamics, GroupInput, mobility_of, vector};
use nalgebra::{Matrix6, Vector6};
use pong_engine::{InterfaceId, State};
use pong_geometry::{Pose, Twist, Vec3, Wrench};

/// A movable group at the start of a frame, in its chart.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub interface: InterfaceId,
    /// `object/path`, for messages.
    pub name: String,
    pub axes: Axes,
    dynamics: Dynamics,
    /// Mass centre of a free body in the group frame, m; zero otherwise.
    mass_center: Vec3,
    /// Pose of the frame that moves (`chart.rs`).
    pub pose: Pose,
    /// Leading pose: `pose` moved on by (1 − θ)·T·velocity.
    pub leading: Pose,
    pub velocity: Vector6<f64>,
    /// Acceleration without contact.
    pub acceleration: Vector6<f64>,
}

impl Body {
    /// A group as the host gives it. Its leading pose is set by [`lead`](Self::lead).
    pub fn of(input: &GroupInput, name: String) -> Result<Self, SlowError> {
        let (group, twist) = (input.state.pose(), input.state.twist());
        let (axes, mass_center) = match input.dynamics {
            Dynamics::Free { mass_center, .. } => (Axes::Common, vector(mass_center)),
            Dynamics::Jointed { .. } => (Axes::Group, Vec3::zeros()),
            Dynamics::Prescribed => (Axes::Common, Vec3::zeros()),
        };
        let arm = group.orientation * mass_center;
        let pose = Pose { position: group.position + arm, orientation: group.orientation };
        let (given, turning) = (vector(input.linear_acceleration), vector(input.angular_acceleration));
        let (velocity, acceleration) = match axes {
            Axes::Common => (six(twist.at(&arm), twist.angular), six(given, turning)),
            Axes::Group => {
                let back = group.orientation.inverse();
                // Rate of the velocity along axes that turn: the centripetal part is not in it.
                let rate = given - twist.angular.cross(&twist.linear);
                (six(back * twist.linear, back * twist.angular), six(back * rate, back * turning))
            }
        };
        let dynamics = input.dynamics;
        let interface = input.interface;
        Ok(Self { interface, name, axes, dynamics, mass_center, pose, leading: pose, velocity, acceleration })
    }

    /// Sets the leading pose for a frame of this length, s.
    pub fn lead(&mut self, theta: f64, length: f64) {
        self.leading = self.moved(&self.pose, &(self.velocity * ((1.0 - theta) * length)));
    }

    /// Mobility in the chart; `None` of a body that contact does not move.
    pub fn mobility(&self) -> Result<Option<Matrix6<f64>>, SlowError> {
        let rotation = self.pose.orientation.to_rotation_matrix().into_inner();
        mobility_of(&self.dynamics, &rotation, &self.name)
    }

    /// Returns true if joints hold the body.
    pub fn is_jointed(&self) -> bool {
        matches!(self.dynamics, Dynamics::Jointed { .. })
    }

    /// Pose after a displacement.
    pub fn moved(&self, pose: &Pose, by: &Vector6<f64>) -> Pose {
        chart::moved(self.axes, pose, by)
    }

    /// State of the movable group for a pose and velocity in the chart.
    pub fn state_at(&self, pose: &Pose, velocity: &Vector6<f64>) -> State {
        let arm = pose.orientation * self.mass_center;
        let group = Pose { position: pose.position - arm, orientation: pose.orientation };
        let twist = match self.axes {
            Axes::Common => {
                let angular = angular(velocity);
                Twist { linear: linear(velocity) - angular.cross(&arm), angular }
            }
            Axes::Group => Twist {
                linear: pose.orientation * linear(velocity),
                angular: pose.orientation * angular(velocity),
            },
        };
        State::from_motion(&group, &twist)
    }

    /// Wrench in the chart from one about the group's origin along the group's axes.
    pub fn wrench_in_chart(&self, pose: &Pose, wrench: &Wrench) -> Vector6<f64> {
        match self.axes {
            Axes::Group => six(wrench.force, wrench.moment),
            Axes::Common => {
                let moment = wrench.moment - self.mass_center.cross(&wrench.force);
                six(pose.orientation * wrench.force, pose.orientation * moment)
            }
        }
    }

    /// Wrench about the group's origin, along common axes for the start of the frame, whose impulse over `length` this
    /// is.
    pub fn wrench_of(&self, impulse: &Vector6<f64>, length: f64) -> Wrench {
        let held = impulse / length;
        let turned = match self.axes {
            Axes::Common => held,
            Axes::Group => six(self.pose.orientation * linear(&held), self.pose.orientation * angular(&held)),
        };
        let force = linear(&turned);
        let arm = self.pose.orientation * self.mass_center;
        Wrench { force, moment: angular(&turned) + arm.cross(&force) }
    }
}
