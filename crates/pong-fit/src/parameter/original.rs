//! Values of a scene as built, and all values of a case set together.

use super::address::{BodyValue, Parameter, Target};
use crate::error::Result;
use pong_engine::ModelId;
use pong_executive::scene::BuiltScene;
use pong_executive::{BodyId, MassProperties, Motion, Pose, Quat, Simulation, Spring, Twist, Vec3};
use pong_model::Surface;

/// Start of a body: its pose and twist in the common frame.
pub(crate) type Start = (Pose, Twist);

/// Values of a scene as built.
pub(crate) struct Original {
    starts: Vec<Start>,
    /// True for each body that follows a path, which nothing displaces.
    led: Vec<bool>,
    masses: Vec<Option<MassProperties>>,
    springs: Vec<Spring>,
    gravity: Vec3,
    surfaces: Vec<(ModelId, Surface)>,
    /// Bodies of each Object, its root first.
    objects: Vec<Vec<BodyId>>,
}

impl Original {
    pub fn of(scene: &BuiltScene) -> Result<Self> {
        let simulation = &scene.simulation;
        let world = simulation.world();
        let mut surfaces = Vec::new();
        for (model, _) in world.scene().models() {
            surfaces.extend(world.surfaces(model)?.iter().map(|surface| (model, surface.clone())));
        }
        let bodies = || simulation.bodies();
        Ok(Self {
            starts: bodies().map(|(id, _)| (simulation.pose(id), simulation.twist(id))).collect(),
            led: bodies().map(|(_, body)| matches!(body.motion, Motion::Prescribed(_))).collect(),
            masses: bodies().map(|(_, body)| body.mass().copied()).collect(),
            springs: simulation.springs().to_vec(),
            gravity: simulation.gravity(),
            surfaces,
            objects: scene.objects.iter().map(|object| object.bodies.clone()).collect(),
        })
    }

    /// Sets the values of all parameters, then the states of all bodies: those of the scene, or those given.
    /// The result depends on the arguments alone, not on earlier values.
    pub fn set(
        &self,
        simulation: &mut Simulation,
        parameters: &[Parameter],
        values: &[f64],
        starts: &[Option<Start>],
    ) -> Result<()> {
        self.set_surfaces(simulation, parameters, values)?;
        self.set_masses(simulation, parameters, values)?;
        self.set_springs(simulation, parameters, values)?;
        let mut gravity = self.gravity;
        for (parameter, value) in parameters.iter().zip(values) {
            if let Target::Gravity(axis) = parameter.target {
                gravity[axis] = *value;
            }
        }
        simulation.set_gravity(gravity);
        self.set_starts(simulation, parameters, values, starts)
    }

    fn set_surfaces(
        &self,
        simulation: &mut Simulation,
        parameters: &[Parameter],
        values: &[f64],
    ) -> Result<()> {
        for (of_model, original) in &self.surfaces {
            let mut wanted = original.clone();
            for (parameter, value) in parameters.iter().zip(values) {
                if let Target::Surface { model, surface, value: name } = &parameter.target
                    && (model, surface) == (of_model, &original.name)
                    && let Some(number) = wanted.number_mut(name)
                {
                    *number = *value;
                }
            }
            // The engine combines all pairs of surfaces again, so equal values are not set again.
            if simulation.world().surface(*of_model, &original.name)? != &wanted {
                simulation.world_mut().set_surface(*of_model, &wanted)?;
            }
        }
        Ok(())
    }

    fn set_masses(
        &self,
        simulation: &mut Simulation,
        parameters: &[Parameter],
        values: &[f64],
    ) -> Result<()> {
        let ids: Vec<BodyId> = simulation.bodies().map(|(id, _)| id).collect();
        for (id, original) in ids.into_iter().zip(&self.masses) {
            let Some(mut mass) = *original else { continue };
            let mut given: Vec<(BodyValue, f64)> = Vec::new();
            for (parameter, number) in parameters.iter().zip(values) {
                if let Target::Body { body, value } = parameter.target
                    && body == id
                {
                    given.push((value, *number));
                }
            }
            given.sort_by_key(|(value, _)| *value);
            given.iter().for_each(|(value, number)| value.set(&mut mass, *number));
            simulation.set_mass(id, mass)?;
        }
        Ok(())
    }

    fn set_springs(
        &self,
        simulation: &mut Simulation,
        parameters: &[Parameter],
        values: &[f64],
    ) -> Result<()> {
        for (number, spring) in self.springs.iter().enumerate() {
            simulation.set_spring(number, *spring)?;
        }
        let factors_last = [false, true];
        for factor in factors_last {
            for (parameter, value) in parameters.iter().zip(values) {
                let is_factor = matches!(parameter.target, Target::Spring { axis: None, .. });
                if is_factor == factor
                    && let Some((number, spring)) = parameter.target.set_in_spring(simulation, *value)
                {
                    simulation.set_spring(number, spring)?;
                }
            }
        }
        Ok(())
    }

    fn set_starts(
        &self,
        simulation: &mut Simulation,
        parameters: &[Parameter],
        values: &[f64],
        given: &[Option<Start>],
    ) -> Result<()> {
        let start = |index: usize| given.get(index).copied().flatten().unwrap_or(self.starts[index]);
        let mut starts: Vec<Start> = (0..self.starts.len()).map(start).collect();
        for (object, bodies) in self.objects.iter().enumerate() {
            let mut change = [Vec3::zeros(); 4];
            for (parameter, value) in parameters.iter().zip(values) {
                if let Target::Motion { object: of, quantity, axis } = parameter.target
                    && of == object
                {
                    change[quantity][axis] += *value;
                }
            }
            if change.iter().any(|part| *part != Vec3::zeros()) {
                displace(&mut starts, bodies, &change);
            }
        }
        let ids: Vec<BodyId> = simulation.bodies().map(|(id, _)| id).collect();
        for (index, id) in ids.into_iter().enumerate() {
            if !self.led[index] {
                simulation.set_motion(id, starts[index].0, starts[index].1)?;
            }
        }
        Ok(())
    }
}

/// Displaces the bodies of an Object as one rigid body about the origin of its root: position, rotation
/// vector, velocity and angular velocity, along the common axes. Velocities keep their direction.
fn displace(starts: &mut [Start], bodies: &[BodyId], change: &[Vec3; 4]) {
    let Some(root) = bodies.first() else { return };
    let at = starts[root.index()].0.position;
    let [position, rotation, velocity, angular_velocity] = change;
    let turn = Quat::from_scaled_axis(*rotation);
    for body in bodies {
        let (pose, twist) = &mut starts[body.index()];
        let arm = turn * (pose.position - at);
        pose.position = at + arm + position;
        pose.orientation = Quat::new_normalize((turn * pose.orientation).into_inner());
        twist.linear += velocity + angular_velocity.cross(&arm);
        twist.angular += angular_velocity;
    }
}
