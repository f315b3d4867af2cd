//! What a frame writes, grouped by the stage that writes it.

use super::relative::Motion;
use crate::contact::FrameReport;
use crate::sealed::Sealed;
use crate::sharing::Sharer;
use crate::state::{ContactKey, ContactMemory, Role};
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Twist, Vec3, Wrench};

/// Everything that evaluate writes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frame {
    /// Whether a frame has been computed since the world was sealed.
    pub computed: bool,
    // state in
    pub poses: Vec<Pose>,
    pub twists: Vec<Twist>,
    // relative: two directions per pair of movable groups
    pub motions: Vec<[Motion; 2]>,
    // bounding
    pub stack: Vec<(u32, u32)>,
    // testers, then sharing and limit
    pub contacts: Vec<FrameContact>,
    // sharing
    pub sharers: Vec<Sharer>,
    // forces
    pub trial: ContactMemory,
    // reduce
    pub wrenches: Vec<Wrench>,
    pub report: FrameReport,
}

/// A contact on its way through the frame. Vectors are in the frame of B's movable group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameContact {
    // testers
    pub key: ContactKey,
    pub primitive_b: u32,
    pub element_a: u32,
    pub element_b: u32,
    pub kind_b: PrimitiveKind,
    pub feature: Feature,
    pub depth: f64,
    pub normal: Vec3,
    pub point_a: Vec3,
    /// Half a spring (the end of a segment) or a whole one.
    pub half: bool,
    /// Whether contacts under the same key share one spring.
    pub shares: bool,
    pub stance: Stance,
    /// Face that memory has reached in the polyhedron of B.
    pub entry_face: u32,
    /// Distance along a ray, m.
    pub ray_distance: Option<f64>,
    pub role: Role,
    // sharing
    /// w of the contract's section 2.2; 1 for a single contact.
    pub weight: f64,
    // forces
    pub point: Vec3,
    pub rate: f64,
    pub normal_force: f64,
    pub friction_force: Vec3,
    pub slip_velocity: Vec3,
    pub sticks: bool,
    pub stored: f64,
    /// The committed record that this contact continues.
    pub continues: Option<u32>,
    // ledger
    pub work: f64,
    pub dissipated: f64,
}

/// How a contact stands among those of the same surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stance {
    /// Nothing special.
    Plain,
    /// The centre is behind the face.
    Behind,
    /// Counts only where nothing else is as deep.
    Spare,
    /// Turned out not to count.
    Dropped,
}

impl FrameContact {
    /// A contact as a tester finds it.
    pub fn found(key: ContactKey, interference: &Interference) -> Self {
        Self {
            key,
            primitive_b: 0,
            element_a: 0,
            element_b: 0,
            kind_b: PrimitiveKind::Plane,
            feature: interference.feature,
            depth: interference.depth,
            normal: interference.normal,
            point_a: interference.point_a,
            half: false,
            shares: false,
            stance: Stance::Plain,
            entry_face: crate::state::NO_FACE,
            ray_distance: None,
            role: Role::Pushes,
            weight: 1.0,
            point: interference.point_a,
            rate: 0.0,
            normal_force: 0.0,
            friction_force: Vec3::zeros(),
            slip_velocity: Vec3::zeros(),
            sticks: true,
            stored: 0.0,
            continues: None,
            work: 0.0,
            dissipated: 0.0,
        }
    }

    /// Weight with the half spring of a segment's end taken in.
    pub fn full_weight(&self) -> f64 {
        if self.half { 0.5 * self.weight } else { self.weight }
    }

    /// Force on A, N.
    pub fn force(&self) -> Vec3 {
        self.normal * self.normal_force + self.friction_force
    }
}

impl Frame {
    pub fn new(bodies: usize, memory: &ContactMemory) -> Self {
        Self {
            poses: vec![Pose::identity(); bodies],
            twists: vec![Twist::zero(); bodies],
            wrenches: vec![Wrench::zero(); bodies],
            trial: memory.clone(),
            ..Self::default()
        }
    }

    /// Empties the buffers; their memory stays.
    pub fn begin(&mut self, sealed: &Sealed) {
        self.motions.clear();
        self.contacts.clear();
        self.trial.records.clear();
        self.trial.custom.clear();
        self.trial.poses.clear();
        self.trial.custom_stride = sealed.custom_stride;
        self.wrenches.fill(Wrench::zero());
        self.report = FrameReport::default();
        self.computed = true;
    }

    /// Number of contacts that push.
    pub fn listed(&self) -> usize {
        self.contacts.iter().filter(|contact| contact.role == Role::Pushes).count()
    }
}
