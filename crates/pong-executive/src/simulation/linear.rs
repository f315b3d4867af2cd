//! The bodies, contacts, springs and loads of the present instant as a linear system (docs/modes.md).

use super::Simulation;
use crate::body::BodyId;
use crate::error::Result;
use crate::load::Load;
use crate::spring::{Spring, SpringEnd};
use pong_advise::{Carrier, LinearBody, LinearSystem, contact_name};
use pong_engine::{Contact, EngineError, InterfaceId, PairTangent, TangentMatrix};
use pong_geometry::{Mat3, Pose, Quat, Twist, Vec3, Wrench};

type Blocks = [[TangentMatrix; 2]; 2];

/// Width of the differences of a spring, m and rad: its force is linear but for rotations.
const WIDTH: f64 = 1e-5;

/// The free bodies of a simulation with the stiffness and damping between them at one instant.
#[derive(Clone, Debug)]
pub struct Linearised {
    /// Masses, stiffness and damping. Its bodies are the free bodies, in their order.
    pub system: LinearSystem,
    /// The free bodies.
    pub bodies: Vec<BodyId>,
    /// Tangents of every two movable groups that touch.
    pub tangents: Vec<PairTangent>,
    /// Reason why the tangents of the contacts come from differences; `None` if they are in closed form.
    pub by_differences: Option<String>,
    /// Number of contacts that push.
    pub contacts: usize,
    /// Number of contacts whose friction slips.
    pub slipping: usize,
    /// Least damping over stiffness of the contacts, s; 0 if it is not known.
    pub least_ratio: f64,
    /// Largest acceleration of a mass centre (m/s²), and the body: zero in equilibrium.
    pub unbalanced: Option<(BodyId, f64)>,
}

impl Linearised {
    /// Share of the largest eigenvalue below which one counts as zero.
    pub fn tolerance(&self) -> f64 {
        if self.by_differences.is_some() { 1e-6 } else { 1e-10 }
    }
}

impl Simulation {
    /// Linear system of the free bodies at the present instant: contacts by their tangents
    /// ([`World::tangents`](pong_engine::World::tangents), or by differences where these are not known), springs and
    /// loads. Gyroscopic moments of bodies that spin are left out. The instant stays as it is.
    ///
    /// # Errors
    /// As [`commit_initial_states`](Self::commit_initial_states).
    pub fn linearised(&mut self) -> Result<Linearised> {
        self.commit_initial_states()?;
        let time = self.time();
        self.system.touch(time)?;
        let (tangents, by_differences) = match self.system.world.tangents() {
            Ok(tangents) => (tangents, None),
            Err(EngineError::BadValue { what, cause }) => {
                let why = cause.split(';').next().unwrap_or_default();
                let tangents = self.system.world.tangents_by_differences()?;
                (tangents, Some(format!("{what}: {why}")))
            }
            Err(error) => return Err(error.into()),
        };
        let bodies: Vec<BodyId> = self.free_bodies().collect();
        let system = LinearSystem::new(bodies.iter().map(|body| self.linear_body(*body)).collect())?;
        let contacts: Vec<Contact> = self.system.world.contacts();
        let mut linear = Linearised {
            system,
            bodies,
            tangents,
            by_differences,
            contacts: contacts.len(),
            slipping: contacts.iter().filter(|contact| slips(contact)).count(),
            least_ratio: 0.0,
            unbalanced: None,
        };
        self.add_contacts(&mut linear, &contacts)?;
        self.add_springs(&mut linear);
        self.add_loads(&mut linear);
        Ok(linear)
    }

    fn linear_body(&self, body: BodyId) -> LinearBody {
        let known = &self.system.bodies[body.index()];
        let turn = self.pose(body).orientation.to_rotation_matrix().into_inner();
        let (mass, inertia, center) = known
            .mass()
            .map_or((0.0, Mat3::zeros(), Vec3::zeros()), |mass| (mass.mass, mass.inertia, mass.mass_center));
        LinearBody {
            name: known.name.clone(),
            mass,
            inertia: turn * inertia * turn.transpose(),
            arm: turn * center,
        }
    }

    /// Place of a group among the free bodies; `None` if it does not yield.
    fn free_place(&self, interface: InterfaceId) -> Option<usize> {
        let of = |index: usize| self.system.bodies[index].interface == Some(interface);
        self.system.free.iter().position(|(index, _)| of(*index))
    }

    fn add_contacts(&self, linear: &mut Linearised, contacts: &[Contact]) -> Result<()> {
        for tangent in &linear.tangents {
            let sides = tangent.groups.map(|group| self.free_place(group));
            linear.system.add(sides, &tangent.stiffness, &tangent.damping);
        }
        let scene = self.system.world.scene();
        let mut carriers: Vec<Carrier> = Vec::new();
        let mut unknown: Vec<[InterfaceId; 2]> = Vec::new();
        linear.least_ratio = f64::INFINITY;
        for (contact, springs) in contacts.iter().zip(self.system.world.contact_tangents()) {
            let groups = [contact.a.interface, contact.b.interface];
            let Some(springs) = springs else {
                linear.least_ratio = 0.0;
                unknown.push(groups);
                continue;
            };
            if springs.normal.stiffness > 0.0 {
                let ratio = springs.normal.damping / springs.normal.stiffness;
                linear.least_ratio = linear.least_ratio.min(ratio);
            }
            if springs.tangential.stiffness > 0.0 {
                let ratio = springs.tangential.damping / springs.tangential.stiffness;
                linear.least_ratio = linear.least_ratio.min(ratio);
            }
            let name = contact_name(scene, contact)?;
            let along = contact.normal * contact.normal.transpose();
            let spring =
                along * springs.normal.stiffness + (Mat3::identity() - along) * springs.tangential.stiffness;
            let stiffness = of_spring(&spring, &[contact.a.arm, contact.b.arm]);
            merge(
                &mut carriers,
                Carrier { name, contacts: 1, sides: groups.map(|g| self.free_place(g)), stiffness },
            );
        }
        for tangent in &linear.tangents {
            let of_pair =
                |groups: &&[InterfaceId; 2]| tangent.groups.iter().all(|group| groups.contains(group));
            let count = unknown.iter().filter(of_pair).count();
            if count > 0 {
                let [a, b] = tangent.groups.map(|group| scene.interface_name(group));
                let sides = tangent.groups.map(|group| self.free_place(group));
                let name = format!("{} · {}", a?, b?);
                carriers.push(Carrier { name, contacts: count, sides, stiffness: tangent.stiffness });
            }
        }
        for carrier in carriers.into_iter().filter(|carrier| carrier.sides.iter().any(Option::is_some)) {
            linear.system.add_carrier(carrier);
        }
        Ok(())
    }

    fn add_springs(&self, linear: &mut Linearised) {
        let place = |end: &SpringEnd| {
            let body = end.body?;
            self.system.free.iter().position(|(index, _)| *index == body.index())
        };
        for (number, spring) in self.system.springs.iter().enumerate() {
            let sides = [place(&spring.first), place(&spring.second)];
            let ends = [self.system.motion_of(&spring.first), self.system.motion_of(&spring.second)];
            let (stiffness, damping) = spring_blocks(spring, ends);
            linear.system.add(sides, &stiffness, &damping);
            if sides.iter().any(Option::is_some) {
                let name = format!("spring {number}");
                linear.system.add_carrier(Carrier { name, contacts: 0, sides, stiffness });
            }
        }
    }

    /// Adds loads that turn with their bodies, and the moments that all forces but gravity have because the mass
    /// centres turn about the origins; finds the largest acceleration.
    fn add_loads(&mut self, linear: &mut Linearised) {
        let time = self.time();
        let (none, mut rates) = ([TangentMatrix::zeros(); 2], Vec::new());
        self.system.rates(time, &self.states, &self.system.contact.clone(), &mut rates);
        for (place, body) in linear.bodies.iter().enumerate() {
            let index = body.index();
            let pose = self.system.motions[index].0;
            for load in self.system.loads.iter().filter(|load| load.body == *body) {
                let stiffness = [[load_block(load, time, &pose), none[0]], none];
                linear.system.add([Some(place), None], &stiffness, &[none, none]);
            }
            let force = self.system.contact[index].force + self.system.applied_force(time, index);
            linear.system.add_force(place, &force);
            let acceleration = rates[place].acceleration.norm();
            if linear.unbalanced.is_none_or(|(_, most)| acceleration > most) {
                linear.unbalanced = Some((*body, acceleration));
            }
        }
    }
}

fn slips(contact: &Contact) -> bool {
    !contact.sticks && contact.friction_force.norm() > 0.0
}

/// Adds a contact to the other contacts of the same two primitives.
fn merge(carriers: &mut Vec<Carrier>, contact: Carrier) {
    match carriers.iter_mut().find(|known| known.name == contact.name && known.sides == contact.sides) {
        Some(known) => {
            known.contacts += 1;
            for (sum, more) in known.stiffness.iter_mut().flatten().zip(contact.stiffness.iter().flatten()) {
                *sum += more;
            }
        }
        None => carriers.push(contact),
    }
}

/// Blocks of a spring (N/m, three directions) between two points with these arms from the origins of their groups.
fn of_spring(spring: &Mat3, arms: &[Vec3; 2]) -> Blocks {
    // Motion of the point of a group: v + θ × arm.
    let moved = arms.map(|arm| {
        let mut rows = nalgebra::SMatrix::<f64, 3, 6>::zeros();
        rows.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
        rows.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
        rows
    });
    let sign = [1.0, -1.0];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| moved[i].transpose() * spring * moved[j] * (sign[i] * sign[j]))
    })
}

/// −∂W/∂x and −∂W/∂v of a spring about the origins of its bodies, by central differences.
fn spring_blocks(spring: &Spring, ends: [(Pose, Twist); 2]) -> (Blocks, Blocks) {
    // Places relative to the first end keep digits far from the common origin.
    let origin = ends[0].0.position;
    let near = ends.map(|(pose, twist)| (Pose { position: pose.position - origin, ..pose }, twist));
    let mut blocks = [[[TangentMatrix::zeros(); 2]; 2]; 2];
    for of in 0..2 {
        for coordinate in 0..12 {
            let wrenches = [1.0, -1.0].map(|sign| {
                let mut ends = near;
                ends[of] = shifted(&near[of], coordinate, sign * WIDTH);
                let action = spring.act(&ends[0], &ends[1]);
                [action.on_first, action.on_second]
            });
            for on in 0..2 {
                let block = &mut blocks[coordinate / 6][on][of];
                set_column(block, coordinate % 6, &wrenches[0][on], &wrenches[1][on]);
            }
        }
    }
    (blocks[0], blocks[1])
}

/// −∂W/∂x of a load about the origin of its body: only rotations of the body change it.
fn load_block(load: &Load, time: f64, pose: &Pose) -> TangentMatrix {
    let mut block = TangentMatrix::zeros();
    for coordinate in 3..6 {
        let wrench = |sign: f64| {
            let (moved, _) = shifted(&(*pose, Twist::zero()), coordinate, sign * WIDTH);
            load.wrench(time, &moved)
        };
        set_column(&mut block, coordinate, &wrench(1.0), &wrench(-1.0));
    }
    block
}

fn set_column(block: &mut TangentMatrix, column: usize, ahead: &Wrench, behind: &Wrench) {
    let force = (behind.force - ahead.force) / (2.0 * WIDTH);
    let moment = (behind.moment - ahead.moment) / (2.0 * WIDTH);
    block.fixed_view_mut::<3, 1>(0, column).copy_from(&force);
    block.fixed_view_mut::<3, 1>(3, column).copy_from(&moment);
}

/// A motion with one coordinate changed: translation, rotation, velocity or angular velocity.
fn shifted((pose, twist): &(Pose, Twist), coordinate: usize, by: f64) -> (Pose, Twist) {
    let mut vector = Vec3::zeros();
    vector[coordinate % 3] = by;
    let (mut pose, mut twist) = (*pose, *twist);
    match coordinate / 3 {
        0 => pose.position += vector,
        1 => pose.orientation = Quat::from_scaled_axis(vector) * pose.orientation,
        2 => twist.linear += vector,
        _ => twist.angular += vector,
    }
    (pose, twist)
}
