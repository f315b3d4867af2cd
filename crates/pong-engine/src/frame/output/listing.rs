//! Contacts of a frame as the host sees them: with ids, in the common frame.

use super::FrameResults;
use crate::contact::{Contact, ContactSide};
use crate::energy::account::EnergyAccount;
use crate::frame::forces::bristle_share;
use crate::frame::forces::contact::FrameContact;
use crate::ids::{InterfaceId, ObjectId, PairId};
use crate::law::{ContactTangent, FrictionProps, NormalTangent, normal_tangent};
use crate::seal::{SurfaceTable, values_of};
use pong_geometry::{Pose, Vec3};

impl<'a> FrameResults<'a> {
    /// Contacts that push, in key order.
    pub fn list_contacts(self) -> impl Iterator<Item = Contact> + use<'a> {
        self.contacts.pushing().map(move |contact| self.list_contact(contact))
    }

    /// Energy accounts of the contacts that push, in key order.
    pub fn list_accounts(self) -> impl Iterator<Item = EnergyAccount> + use<'a> {
        let pushing = self.contacts.order.iter().filter(|reference| reference.pushes());
        pushing.filter_map(move |reference| {
            let energy = self.energies.get(reference.slot.index())?.energy;
            Some(EnergyAccount { stored: self.contacts.found.contact(reference).stored, ..energy.account })
        })
    }

    /// Normal-force tangents of the contacts that push, in key order.
    pub fn list_tangents(
        self,
        tables: &'a [SurfaceTable],
    ) -> impl Iterator<Item = Option<NormalTangent>> + use<'a> {
        let Self { scene, sealed, .. } = self;
        self.contacts.pushing().map(move |contact| {
            let found = &contact.found;
            let props = values_of(scene, sealed, tables, found);
            normal_tangent(props, found.full_weight(), found.depth, contact.rate)
        })
    }

    /// Stiffness and damping that act in the contacts that push, in key order.
    pub fn list_contact_tangents(
        self,
        tables: &'a [SurfaceTable],
    ) -> impl Iterator<Item = Option<ContactTangent>> + use<'a> {
        let Self { scene, sealed, contacts, .. } = self;
        contacts.pushing().map(move |contact| {
            let found = &contact.found;
            if !found.key.is_tested() {
                return None;
            }
            let props = values_of(scene, sealed, tables, found);
            let normal = normal_tangent(props, found.full_weight(), found.depth, contact.rate)?;
            let same_key = contacts
                .with_head(found.key.head())
                .map(|reference| &contacts.found.contact(reference).found)
                .filter(|other| other.key == found.key);
            let (stiffness, damping) = match props.friction {
                FrictionProps::Bristle { stiffness, damping, .. } if contact.sticks => (stiffness, damping),
                FrictionProps::Custom { .. } => return None,
                _ => (0.0, 0.0),
            };
            let share = bristle_share(found, same_key);
            let tangential = NormalTangent { stiffness: share * stiffness, damping: share * damping };
            Some(ContactTangent { normal, tangential })
        })
    }

    fn list_contact(&self, contact: &FrameContact) -> Contact {
        let Self { scene, sealed, .. } = *self;
        let pair = &sealed.group_pairs[contact.found.key.group_pair as usize];
        let (body_a, body_b) = sealed.bodies_of(contact.found.key.direction());
        let x_wb = &self.poses[body_b];
        let x_ba = Pose::relative(&self.poses[body_a], x_wb);
        let to_common = |v: &Vec3| x_wb.orientation * v;
        let side = |body: usize, primitive: u32, element: u32, arm: Vec3| ContactSide {
            object: ObjectId::new(scene.stamp, scene.bodies[body].object),
            interface: InterfaceId::new(scene.stamp, body),
            primitive,
            element: element - scene.body(body).primitives[primitive as usize].elements.start,
            arm,
        };
        let arm_a = to_common(&(contact.point_b - x_ba.position));
        let arm_b = to_common(&contact.point_b);
        Contact {
            pair: PairId::new(scene.stamp, pair.pair),
            a: side(body_a, contact.found.key.primitive_a, contact.found.element_a, arm_a),
            b: side(body_b, contact.found.primitive_b, contact.found.element_b, arm_b),
            feature: contact.found.feature,
            end: contact.found.key.end,
            point: x_wb.position + arm_b,
            normal: to_common(&contact.found.normal_b),
            depth: contact.found.depth,
            depth_rate: contact.rate,
            weight: contact.found.full_weight(),
            normal_force: contact.normal_force,
            friction_force: to_common(&contact.friction_force_b),
            force: to_common(&contact.force()),
            slip_velocity: to_common(&contact.slip_velocity_b),
            sticks: contact.sticks,
            stored: contact.stored,
            work: contact.work,
            dissipated: contact.dissipated,
        }
    }
}
