//! What a frame writes, grouped by the stage that writes it.

use crate::frame::energy::buffers::EnergyBuffers;
use crate::frame::forces::contact::FrameContact;
use crate::frame::forces::place::Place;
use crate::frame::input::WorkerInput;
use crate::frame::input::relative::Motions;
use crate::frame::near_pairs::NearPairs;
use crate::frame::tunnelling::events::TunnellingEvents;
use crate::frame::worker_context::WorkerContext;
use crate::report::{FrameCounts, FrameReport, StageTimes};
use crate::scene::Scene;
use crate::sealed::{Direction, Sealed};
use crate::state::CommittedPoses;
use pong_arena::Table;
use pong_geometry::{Pose, Twist, Wrench};

/// Everything that evaluate writes, but for what the workers hold while they work.
pub(crate) struct EvaluationBuffers {
    /// Whether a frame has been computed since the world was sealed.
    pub computed: bool,
    // state in
    pub poses: Vec<Pose>,
    pub twists: Vec<Twist>,
    /// The pairs of movable groups that the frame visits.
    pub near: NearPairs,
    // relative, bounding
    pub input: WorkerInput,
    // testers, sharing, forces: in no order
    pub caller: WorkerContext,
    // order, limit: the contacts that count, by place in `context.contacts`, in the order of every sum
    pub order: Table<Place>,
    pub tunnelling: TunnellingEvents,
    // ledger
    pub energy: EnergyBuffers,
    // reduce
    pub wrenches: Vec<Wrench>,
    /// Whose contact has numbers that nearly leave the range of numbers, if any.
    pub beyond_range: Option<Direction>,
    pub report: FrameReport,
    pub counts: FrameCounts,
    pub times: StageTimes,
}

impl EvaluationBuffers {
    pub fn new(scene: &Scene, sealed: &Sealed, input: WorkerInput) -> Self {
        let bodies = scene.bodies.len();
        Self {
            computed: false,
            poses: vec![Pose::identity(); bodies],
            twists: vec![Twist::zero(); bodies],
            near: NearPairs::new(scene, sealed),
            input,
            caller: WorkerContext::new(sealed, sealed.limits.lane_contacts, true),
            order: Table::with_capacity(sealed.limits.lane_contacts, Place::NOWHERE),
            tunnelling: TunnellingEvents::default(),
            energy: EnergyBuffers::new(sealed),
            wrenches: vec![Wrench::zero(); bodies],
            beyond_range: None,
            report: FrameReport::default(),
            counts: FrameCounts::default(),
            times: StageTimes::default(),
        }
    }

    /// Empties the buffers; their memory stays.
    pub fn begin(&mut self, sealed: &Sealed) {
        self.caller.out.begin(0);
        self.order.clear();
        for &body in &*sealed.paired_bodies {
            self.wrenches[body] = Wrench::zero();
        }
        self.beyond_range = None;
        self.report = FrameReport::default();
        self.counts.clear();
        self.times = StageTimes::default();
    }

    /// The motions of this frame since these poses.
    pub fn motions<'a>(&'a self, sealed: &'a Sealed, committed: &'a CommittedPoses) -> Motions<'a> {
        Motions { sealed, poses: &self.poses, twists: &self.twists, committed }
    }

    /// The contacts that push, in the order of every sum.
    pub fn pushing(&self) -> impl Iterator<Item = &FrameContact> {
        let pushing = self.order.iter().filter(|place| place.pushes());
        pushing.map(|place| &self.caller.out.contacts[place.index as usize])
    }
}
