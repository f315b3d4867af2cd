//! What a frame writes, grouped by the stage that writes it.

use crate::frame::energy::accounts::Interval;
use crate::frame::input::FrameInput;
use crate::frame::tunnelling::Passages;
use crate::frame::worker_context::Lane;
use crate::report::{FrameCounts, FrameReport, StageTimes};
use crate::seal::Sealed;
use crate::state::{Books, ContactKey, ContactRecord, PairPose, Role};
use pong_arena::Table;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Pose, Twist, Vec3, Wrench};

/// Everything that evaluate writes, but for what the workers hold while they work.
pub(crate) struct Frame {
    /// Whether a frame has been computed since the world was sealed.
    pub computed: bool,
    // state in
    pub poses: Vec<Pose>,
    pub twists: Vec<Twist>,
    // relative, bounding
    pub input: FrameInput,
    /// Relative poses that a commit would remember.
    pub remembered: Vec<PairPose>,
    // testers, sharing, forces: in no order
    pub lane: Lane,
    // order, limit: the contacts that count, by place in `lane.contacts`, in the order of every sum
    pub order: Table<Place>,
    pub passages: Passages,
    // ledger
    pub work: f64,
    pub dissipated: f64,
    pub books: Books,
    pub intervals: Vec<Interval>,
    // reduce
    pub wrenches: Vec<Wrench>,
    pub report: FrameReport,
    pub counts: FrameCounts,
    pub times: StageTimes,
}

/// Where a contact stands, with the first of what decides the order of sums: few have it in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub head: u64,
    pub index: u32,
}

/// The order of every sum: by key, then by what of B pushes.
pub(crate) type ContactOrder = (ContactKey, u32, u32, Feature);

/// A contact as a tester finds it. Vectors are in the frame of B's movable group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub key: ContactKey,
    pub primitive_b: u32,
    pub element_a: u32,
    pub element_b: u32,
    pub feature: Feature,
    /// Face that memory has reached in the polyhedron of B.
    pub entry_face: u32,
    pub kind_b: PrimitiveKind,
    /// Half a spring (the end of a segment) or a whole one.
    pub half: bool,
    /// Whether contacts under the same key share one spring.
    pub shares: bool,
    pub stance: Stance,
    pub role: Role,
    pub depth: f64,
    pub normal: Vec3,
    pub point_a: Vec3,
    /// Distance along a ray, m; infinite for everything else.
    pub ray_distance: f64,
    /// The weight w of docs/theory.md, 2.2; 1 for a single contact.
    pub weight: f64,
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
    /// A point in a piece, at an inner wall: counts unless the point is in a piece of lower index as well.
    AtWall,
    /// A point at an inner wall of a piece, but beyond: counts only where rounding leaves the point in no piece at all.
    BeyondWall,
    /// Turned out not to count.
    Dropped,
}

/// A contact that counts, with its forces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameContact {
    // testers, sharing
    pub found: Found,
    // forces
    pub point: Vec3,
    pub rate: f64,
    pub normal_force: f64,
    pub friction_force: Vec3,
    pub slip_velocity: Vec3,
    pub bristle: Vec3,
    /// On A about and along A's frame, on B about and along B's.
    pub wrenches: [Wrench; 2],
    pub stored: f64,
    pub sticks: bool,
    /// The committed record that this contact continues.
    pub continues: Option<u32>,
    // ledger
    pub work: f64,
    pub dissipated: f64,
}

impl Found {
    /// A whole contact, as most are.
    pub fn new(key: ContactKey, interference: &Interference) -> Self {
        Self {
            key,
            primitive_b: 0,
            element_a: 0,
            element_b: 0,
            feature: interference.feature,
            entry_face: crate::state::NO_FACE,
            kind_b: PrimitiveKind::Plane,
            half: false,
            shares: false,
            stance: Stance::Plain,
            role: Role::Pushes,
            depth: interference.depth,
            normal: interference.normal,
            point_a: interference.point_a,
            ray_distance: f64::INFINITY,
            weight: 1.0,
        }
    }

    /// Where the contact stands in every sum.
    pub fn order(&self) -> ContactOrder {
        (self.key, self.primitive_b, self.element_b, self.feature)
    }

    /// Weight with the half spring of a segment's end taken in.
    pub fn full_weight(&self) -> f64 {
        if self.half { 0.5 * self.weight } else { self.weight }
    }
}

impl FrameContact {
    /// A contact whose forces are not known yet.
    pub fn new(found: Found) -> Self {
        Self {
            found,
            point: found.point_a,
            rate: 0.0,
            normal_force: 0.0,
            friction_force: Vec3::zeros(),
            slip_velocity: Vec3::zeros(),
            bristle: Vec3::zeros(),
            wrenches: [Wrench::zero(); 2],
            stored: 0.0,
            sticks: true,
            continues: None,
            work: 0.0,
            dissipated: 0.0,
        }
    }

    /// Something to fill memory with.
    pub fn blank() -> Self {
        let nothing = Interference {
            depth: 0.0,
            normal: Vec3::zeros(),
            point_a: Vec3::zeros(),
            feature: Feature::WHOLE,
        };
        let key = ContactKey { group_pair: 0, flipped: 0, primitive_a: 0, shell_b: 0, end: 0 };
        Self::new(Found::new(key, &nothing))
    }

    /// Force on A, N.
    pub fn force(&self) -> Vec3 {
        self.found.normal * self.normal_force + self.friction_force
    }

    /// What a commit remembers of the contact.
    pub fn record(&self) -> ContactRecord {
        let found = &self.found;
        ContactRecord {
            key: found.key,
            feature: found.feature.0,
            element_b: found.element_b,
            entry_face: found.entry_face,
            sticks: self.sticks,
            role: found.role,
            normal: found.normal,
            point: self.point,
            bristle: self.bristle,
            force: self.force(),
            stored: self.stored,
            work: self.work,
            dissipated: self.dissipated,
        }
    }
}

impl Frame {
    pub fn new(bodies: usize, sealed: &Sealed, input: FrameInput) -> Self {
        let pairs = sealed.group_pairs.len();
        let nowhere = Place { head: 0, index: 0 };
        Self {
            computed: false,
            poses: vec![Pose::identity(); bodies],
            twists: vec![Twist::zero(); bodies],
            input,
            remembered: vec![PairPose::unknown(); pairs],
            lane: Lane::new(sealed, sealed.limits.lane_contacts, true),
            order: Table::with_capacity(sealed.limits.lane_contacts, nowhere),
            passages: Passages::default(),
            work: 0.0,
            dissipated: 0.0,
            books: Books::new(sealed.account_pairs(), sealed.late),
            intervals: vec![Interval::default(); sealed.account_pairs()],
            wrenches: vec![Wrench::zero(); bodies],
            report: FrameReport::default(),
            counts: FrameCounts::default(),
            times: StageTimes::default(),
        }
    }

    /// Empties the buffers; their memory stays.
    pub fn begin(&mut self, sealed: &Sealed) {
        self.lane.out.begin(0);
        self.order.clear();
        for &body in &sealed.paired_bodies {
            self.wrenches[body] = Wrench::zero();
        }
        self.report = FrameReport::default();
        self.counts = FrameCounts::default();
        self.times = StageTimes::default();
    }

    /// Every contact that counts, in the order of every sum.
    pub fn in_order(&self) -> impl Iterator<Item = &FrameContact> {
        self.order.iter().map(|place| &self.lane.out.contacts[place.index as usize])
    }

    /// The contacts that push, in the order of every sum.
    pub fn pushing(&self) -> impl Iterator<Item = &FrameContact> {
        self.in_order().filter(|contact| contact.found.role == Role::Pushes)
    }
}
