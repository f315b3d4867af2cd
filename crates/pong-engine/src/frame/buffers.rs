//! Buffers that a frame writes, grouped by stage.

use crate::energy::buffers::EnergyBuffers;
use crate::frame::broad_phase::blocks::PendingParts;
use crate::frame::forces::contact_buffer::ContactBuffer;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::forces::found::{FoundContacts, WorkerBuffers};
use crate::frame::input::WorkerInput;
use crate::frame::input::relative::Motions;
use crate::frame::near_pairs::NearPairs;
use crate::frame::output::FrameResults;
use crate::frame::output::order::OrderedContacts;
use crate::frame::tunnelling::followed::TunnellingEvents;
use crate::frame::worker_context::WorkerContext;
use crate::report::{FrameReport, StageTimes};
use crate::scene::Scene;
use crate::seal::Sealed;
use crate::state::CommittedPoses;
use pong_arena::Table;
use pong_geometry::{Pose, Twist, Wrench};

/// Everything that evaluate writes, except the workers' own contexts.
pub(crate) struct EvaluationBuffers {
    /// True if a frame has been computed since the seal.
    pub computed: bool,
    /// Frame number; the first frame is 1.
    pub number: u64,
    // state in
    pub poses: Vec<Pose>,
    pub twists: Vec<Twist>,
    /// The pairs of movable groups that the frame visits.
    pub near: NearPairs,
    // relative motion, broad phase
    pub input: WorkerInput,
    /// Stack of the parts of A's trees that have not been laid out as blocks yet.
    pub pending: PendingParts,
    // narrow phase, load sharing, forces: unordered
    /// Context of the calling thread. Boxed, because a world is moved on the stack several times while it is
    /// built or cloned.
    pub caller: Box<WorkerContext>,
    /// Contacts that the workers found in the last round, if their buffers were swapped in. Otherwise these
    /// contacts have been copied into the caller's buffer.
    pub workers: WorkerBuffers,
    // order, limit: references to the contacts, in summation order
    pub order: Table<ContactRef>,
    pub tunnelling: TunnellingEvents,
    // ledger
    pub energy: EnergyBuffers,
    // reduce
    pub wrenches: Vec<Wrench>,
    pub report: FrameReport,
    pub times: StageTimes,
}

impl EvaluationBuffers {
    /// Allocates the buffers of a frame that this many workers may share.
    pub fn new(scene: &Scene, sealed: &Sealed, input: WorkerInput, workers: usize) -> Self {
        let bodies = scene.bodies.len();
        // Friction-law state, ledger and the first hit of each ray need all contacts in the caller's buffer,
        // so that no worker's buffer is swapped in.
        let one_buffer = sealed.law_state_len > 0 || scene.config.ledger || sealed.rays_meet_groups;
        let swapped = if one_buffer { 0 } else { workers };
        let contacts = sealed.limits.worker_contacts(workers + 1);
        let buffer = |thread| WorkerContext::buffer(sealed, thread, contacts);
        Self {
            computed: false,
            number: 0,
            poses: vec![Pose::identity(); bodies],
            twists: vec![Twist::zero(); bodies],
            near: NearPairs::new(scene, sealed),
            input,
            pending: PendingParts::for_tree(sealed.limits.tree_parts),
            caller: Box::new(WorkerContext::new(sealed, 0, sealed.limits.thread_contacts)),
            workers: WorkerBuffers::new((1..=swapped).map(buffer).collect()),
            order: Table::with_capacity(sealed.limits.thread_contacts, ContactRef::NOWHERE),
            tunnelling: TunnellingEvents::default(),
            energy: EnergyBuffers::new(scene, sealed),
            wrenches: vec![Wrench::zero(); bodies],
            report: FrameReport::default(),
            times: StageTimes::default(),
        }
    }

    /// Empties the buffers for the next frame and keeps their memory.
    #[inline]
    pub fn begin(&mut self, sealed: &Sealed) {
        self.number += 1;
        self.caller.out.begin(ContactBuffer::NO_PHASE);
        self.order.clear();
        for &body in &*sealed.paired_bodies {
            self.wrenches[body] = Wrench::zero();
        }
        self.workers.empty();
        self.report = FrameReport::default();
        self.times = StageTimes::default();
    }

    /// Motions of this frame relative to the committed poses.
    pub fn motions<'a>(&'a self, sealed: &'a Sealed, committed: &'a CommittedPoses) -> Motions<'a> {
        Motions {
            sealed,
            frame: self.number,
            near: &self.near,
            poses: &self.poses,
            twists: &self.twists,
            committed,
        }
    }

    /// Contacts of the frame, in summation order.
    pub fn contacts(&self) -> OrderedContacts<'_> {
        OrderedContacts { order: &self.order, found: self.found() }
    }

    /// Results of the frame.
    #[inline]
    pub fn results<'a>(&'a self, scene: &'a Scene, sealed: &'a Sealed) -> FrameResults<'a> {
        FrameResults {
            scene,
            sealed,
            poses: &self.poses,
            contacts: self.contacts(),
            wrenches: &self.wrenches,
            energies: &self.energy.contacts,
        }
    }

    /// Contacts found by all threads.
    pub fn found(&self) -> FoundContacts<'_> {
        FoundContacts { caller: &self.caller.out, workers: &self.workers }
    }
}
