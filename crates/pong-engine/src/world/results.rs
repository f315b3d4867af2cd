//! What the last frame found.

use super::World;
use crate::contact::Contact;
use crate::error::EngineError;
use crate::frame::TunnellingEvent;
use crate::ids::InterfaceId;
use crate::law::NormalTangent;
use crate::report::{FrameCounts, FrameReport, TunnellingReport};
use crate::runtime::Runtime;
use pong_geometry::Wrench;

impl World {
    /// Wrench on a movable group in the last frame, N and N·m: about the group's origin, expressed in the group's frame.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world, [`EngineError::WrongPhase`] before the first frame.
    #[inline]
    pub fn wrench(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        let index = self.scene.body_index(interface)?;
        Ok(self.framed()?.frame.wrenches[index])
    }

    /// As [`wrench`](Self::wrench), expressed along the axes of the common frame.
    ///
    /// # Errors
    /// As [`wrench`](Self::wrench).
    pub fn wrench_common(&self, interface: InterfaceId) -> Result<Wrench, EngineError> {
        let index = self.scene.body_index(interface)?;
        let frame = &self.framed()?.frame;
        let (orientation, wrench) = (frame.poses[index].orientation, frame.wrenches[index]);
        Ok(Wrench { force: orientation * wrench.force, moment: orientation * wrench.moment })
    }

    /// The contacts of the last frame, in the order of every sum. Allocates; [`contacts_iter`](Self::contacts_iter) does not.
    pub fn contacts(&self) -> Vec<Contact> {
        self.contacts_iter().collect()
    }

    /// As [`contacts`](Self::contacts), one by one and without a list of their own.
    pub fn contacts_iter(&self) -> impl Iterator<Item = Contact> + '_ {
        self.runtime.frame.list_contacts(&self.scene, &self.runtime.sealed)
    }

    /// How the normal force of each contact of the last frame changes with its depth and the rate of that, in the order of
    /// [`contacts_iter`](Self::contacts_iter): what a host needs that chooses its step by them or treats damping implicitly.
    /// It has the weight of the contact, and is zero where the force is cut off at zero. `None` of a normal law of the host's.
    ///
    /// Together with a lever r about the mass centre, a contact adds stiffness·(n, r × n)(n, r × n)ᵀ to the stiffness of a
    /// body; friction is not in it. See docs/theory.md, 3.
    pub fn normal_tangents(&self) -> impl Iterator<Item = Option<NormalTangent>> + '_ {
        let Runtime { frame, sealed, tables, .. } = &self.runtime;
        frame.list_tangents(&self.scene, sealed, tables)
    }

    /// Number of contacts of the last frame.
    pub fn contact_count(&self) -> usize {
        self.report().contacts as usize
    }

    /// The last frame in short.
    pub fn report(&self) -> FrameReport {
        self.runtime.frame.report
    }

    /// What went right through something else between the last commit and the last frame, if anything did
    /// ([`StatusBits::TUNNELLED`](crate::StatusBits)). A point, the centre of a ball, the origin of a ray, the ends and
    /// the middle of a segment are followed along straight lines; what is shorter than half of the thinnest part of the
    /// other movable group is taken to have gone through none.
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

    /// How often what was tested in the last frame, and what that found.
    pub fn counts(&self) -> FrameCounts {
        self.runtime.frame.caller.out.counts
    }

    /// What runs, if a frame has been computed.
    fn framed(&self) -> Result<&Runtime, EngineError> {
        if self.runtime.frame.computed {
            return Ok(&self.runtime);
        }
        Err(EngineError::WrongPhase { call: "get a wrench", cure: "evaluate or step a frame first" })
    }
}
