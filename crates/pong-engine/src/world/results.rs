//! Results of the last frame.

use super::World;
use crate::contact::Contact;
use crate::error::EngineError;
use crate::frame::{DeepInMeshes, FrameResults, TunnellingEvent};
use crate::ids::InterfaceId;
use crate::law::NormalTangent;
use crate::report::{DeepInMeshReport, FrameCounts, FrameReport, TunnellingReport};
use pong_geometry::Wrench;

impl World {
    /// Wrench on a movable group in the last frame, N and N·m: about the group's origin, expressed in the
    /// group's frame.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world, [`EngineError::WrongPhase`] before the
    /// first frame.
    #[inline]
    pub fn wrench(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        let index = self.scene.body_index(interface)?;
        Ok(self.results()?.wrenches[index])
    }

    /// As [`wrench`](Self::wrench), expressed along the axes of the common frame.
    ///
    /// # Errors
    /// As [`wrench`](Self::wrench).
    pub fn wrench_common(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        let index = self.scene.body_index(interface)?;
        let results = self.results()?;
        Ok(results.along_common_axes(&results.wrenches[index], index))
    }

    /// Contacts of the last frame, in summation order. Allocates; [`contacts_iter`](Self::contacts_iter) does
    /// not.
    pub fn contacts(&self) -> Vec<Contact> {
        self.contacts_iter().collect()
    }

    /// Contacts of the last frame one by one, without allocating.
    pub fn contacts_iter(&self) -> impl Iterator<Item = Contact> + '_ {
        self.last_results().list_contacts()
    }

    /// Derivatives of the normal force of each contact of the last frame with respect to its depth and depth
    /// rate, in the order of [`contacts_iter`](Self::contacts_iter), for a host that chooses its step by them
    /// or treats damping implicitly. They include the contact's weight, and are zero where the force is cut
    /// off at zero. `None` for a host's normal law.
    ///
    /// With r the vector from the mass centre of a body to the contact point and n the normal, a contact adds
    /// stiffness·(n, r × n)(n, r × n)ᵀ to the stiffness matrix of the body; friction is not included. See
    /// docs/theory.md, 3.
    pub fn normal_tangents(&self) -> impl Iterator<Item = Option<NormalTangent>> + '_ {
        self.last_results().list_tangents(&self.runtime.tables)
    }

    /// Number of contacts of the last frame.
    pub fn contact_count(&self) -> usize {
        self.report().contacts as usize
    }

    /// Summary of the last frame.
    pub fn report(&self) -> FrameReport {
        self.runtime.frame.report
    }

    /// Tunnelling between the last commit and the last frame, if any
    /// ([`StatusBits::TUNNELLED`](crate::StatusBits)).
    ///
    /// It is found along the straight path of a point, of the centre of a sphere or ellipsoid, of the origin
    /// of a ray, and of the ends and the middle of a segment or an axis; and from contacts that have ended on
    /// the other side. A path shorter than half of the thinnest part of the other movable group counts as
    /// passing through nothing.
    pub fn tunnelling(&self) -> Option<TunnellingReport> {
        let events = &self.runtime.frame.tunnelling;
        let TunnellingEvent { body_a, primitive_a, body_b } = events.first?;
        let interface = |body| InterfaceId::new(self.scene.stamp, body);
        Some(TunnellingReport {
            interface: interface(body_a),
            primitive: primitive_a,
            through: interface(body_b),
            count: events.count,
        })
    }

    /// Solid that is deeper in a mesh than the regions below its facets in the last frame, if any
    /// ([`StatusBits::DEEP_IN_MESH`](crate::StatusBits)). `pong check` prints the least depth of these regions.
    pub fn deep_in_mesh(&self) -> Option<DeepInMeshReport> {
        let DeepInMeshes { facets, first } = self.runtime.frame.caller.out.demand.deep_in_meshes;
        let (mesh, other) = first?;
        let interface = |body| InterfaceId::new(self.scene.stamp, body);
        Some(DeepInMeshReport { mesh: interface(mesh), other: interface(other), facets })
    }

    /// Test counts and hits of the last frame.
    pub fn counts(&self) -> FrameCounts {
        self.runtime.frame.caller.out.counts
    }

    /// Results of the last frame.
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] before the first frame.
    #[inline]
    pub(super) fn results(&self) -> Result<FrameResults<'_>, EngineError> {
        if self.runtime.frame.computed {
            return Ok(self.last_results());
        }
        Err(EngineError::WrongPhase { call: "get a wrench", cure: "evaluate or step a frame first" })
    }

    /// Results of the last frame; without contacts before the first.
    #[inline]
    pub(super) fn last_results(&self) -> FrameResults<'_> {
        self.runtime.frame.results(&self.scene, &self.runtime.sealed)
    }
}
