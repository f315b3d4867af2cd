//! What a frame reports: what was left out, counts and times.

use crate::ids::InterfaceId;
use pong_geometry::bounding::Volume;
use pong_geometry::primitive::PrimitiveKind;

/// What a frame had to leave out, or missed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StatusBits(u32);

impl StatusBits {
    /// More contacts than the world's capacity: the deepest were kept. Raise `Config::contact_capacity`.
    pub const CONTACT_LIMIT: Self = Self(1);

    /// More contacts of one ball with one surface, with normals more than 90° apart, than could be shared exactly: the
    /// deepest were. Raise `Config::contact_capacity`.
    pub const LOAD_SHARING_LIMIT: Self = Self(2);

    /// Something went right through something else since the last commit, or came out on the far side of what pushed it
    /// back: a contact was missed. [`World::tunnelling`](crate::World::tunnelling) names it. Make the frames shorter, the wall
    /// thicker or the surfaces stiffer; after a jump that is meant, call [`World::clear_contact_history`](crate::World::clear_contact_history) first.
    pub const TUNNELLED: Self = Self(4);

    /// Whether nothing was left out or missed.
    pub fn is_complete(self) -> bool {
        self.0 == 0
    }

    /// Whether a bit is set.
    pub fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Whether a limit was hit, so that contacts were left out.
    pub fn leaves_contacts_out(self) -> bool {
        self.contains(Self::CONTACT_LIMIT) || self.contains(Self::LOAD_SHARING_LIMIT)
    }

    /// The bits as a number.
    pub fn bits(self) -> u32 {
        self.0
    }

    pub(crate) fn set(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// What went right through something between two commits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TunnellingReport {
    /// The movable group that moved through the other, by which of the two is A.
    pub interface: InterfaceId,
    /// Its primitive: index into the movable group's list (see
    /// [`Scene::primitive_path`](crate::Scene::primitive_path)).
    pub primitive: u32,
    /// The movable group it went through.
    pub through: InterfaceId,
    /// How many events of tunnelling the frame has; this is the first.
    pub count: u32,
}

/// The frame in short.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameReport {
    /// What had to be left out.
    pub status: StatusBits,
    /// Contacts listed.
    pub contacts: u32,
    /// Contacts that would have been listed without [`StatusBits::CONTACT_LIMIT`].
    pub contacts_wanted: u32,
}

impl FrameReport {
    /// The contact capacity to ask for instead of the present one, where contacts were left out; `None` where none were. After
    /// [`StatusBits::LOAD_SHARING_LIMIT`] alone it is twice the present one, and may have to be doubled again.
    pub fn advised_capacity(&self, present: usize) -> Option<usize> {
        let wanted = self.status.contains(StatusBits::CONTACT_LIMIT).then_some(self.contacts_wanted as usize);
        let twice = self.status.contains(StatusBits::LOAD_SHARING_LIMIT).then_some(present.saturating_mul(2));
        wanted.max(twice)
    }
}

/// How often something was tested, and how often that found something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Tests.
    pub tested: u32,
    /// Tests that did not find the two apart. Of contact tests: contacts found, of which a test may find several.
    pub met: u32,
}

impl Tally {
    #[inline]
    fn add(&mut self, other: Self) {
        self.tested = self.tested.saturating_add(other.tested);
        self.met = self.met.saturating_add(other.met);
    }
}

/// Tallies of the pairs of `KINDS` kinds. Most frames use a few of them, so those in use are marked: to add two tables, or to
/// clear one, then takes as long as what is in them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct TallyTable<const KINDS: usize> {
    /// A bit per row in which a tally is not zero, by number of A's kind.
    used: u16,
    /// Of each row a bit per such tally, by number of B's kind.
    used_in: [u16; KINDS],
    tallies: [[Tally; KINDS]; KINDS],
}

impl<const KINDS: usize> Default for TallyTable<KINDS> {
    fn default() -> Self {
        const { assert!(KINDS <= u16::BITS as usize) };
        Self { used: 0, used_in: [0; KINDS], tallies: [[Tally::default(); KINDS]; KINDS] }
    }
}

impl<const KINDS: usize> TallyTable<KINDS> {
    #[inline]
    fn note(&mut self, a: usize, b: usize, more: Tally) {
        if more != Tally::default() {
            self.used |= 1 << a;
            self.used_in[a] |= 1 << b;
            self.tallies[a][b].add(more);
        }
    }

    /// The tallies of pairs that were tested, in order of A's kind, then B's.
    fn tested(&self) -> impl Iterator<Item = (usize, usize, Tally)> + '_ {
        let pairs = ones(self.used).flat_map(|a| ones(self.used_in[a]).map(move |b| (a, b)));
        pairs.map(|(a, b)| (a, b, self.tallies[a][b])).filter(|(_, _, tally)| tally.tested > 0)
    }

    fn add(&mut self, other: &Self) {
        for a in ones(other.used) {
            for b in ones(other.used_in[a]) {
                self.note(a, b, other.tallies[a][b]);
            }
        }
    }

    #[inline]
    fn clear(&mut self) {
        for a in ones(std::mem::take(&mut self.used)) {
            for b in ones(std::mem::take(&mut self.used_in[a])) {
                self.tallies[a][b] = Tally::default();
            }
        }
    }
}

/// The places of the bits that are set, from the lowest.
fn ones(mut bits: u16) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = (bits != 0).then(|| bits.trailing_zeros() as usize)?;
        bits &= bits - 1;
        Some(place)
    })
}

/// Kinds of primitives.
const KINDS: usize = PrimitiveKind::ALL.len();
/// Kinds of bounding volumes: box, ball, turned box, a user's own, none.
const VOLUME_KINDS: usize = 5;

/// Counts of one frame: the same numbers for any number of workers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameCounts {
    /// Pairs of leaves whose contents were tested, each direction of A and B for itself.
    pub leaf_pairs: u64,
    /// Comparisons of a box with the eight boxes of a node below a leaf.
    pub boxes_tested: u64,
    volumes: TallyTable<VOLUME_KINDS>,
    testers: TallyTable<KINDS>,
}

impl FrameCounts {
    /// Tests of authored bounding volumes: names of the two kinds, A's first, and their tally, if there were any.
    pub fn volumes(&self) -> impl Iterator<Item = (&'static str, &'static str, Tally)> + '_ {
        const NAMES: [&str; VOLUME_KINDS] = ["Aabb", "Sphere", "Obb", "Custom", "Unbounded"];
        self.volumes.tested().map(|(a, b, tally)| (NAMES[a], NAMES[b], tally))
    }

    /// Contact tests: the two kinds, A's first, and their tally, if there were any.
    pub fn testers(&self) -> impl Iterator<Item = (PrimitiveKind, PrimitiveKind, Tally)> + '_ {
        let kinds = PrimitiveKind::ALL;
        self.testers.tested().map(move |(a, b, tally)| (kinds[a], kinds[b], tally))
    }

    /// Pairs of authored bounding volumes tested.
    pub fn volumes_tested(&self) -> u64 {
        self.volumes.tested().map(|(_, _, tally)| u64::from(tally.tested)).sum()
    }

    /// Pairs of primitives tested.
    pub fn primitives_tested(&self) -> u64 {
        self.testers.tested().map(|(_, _, tally)| u64::from(tally.tested)).sum()
    }

    /// Notes a test of two bounding volumes, A's first.
    #[inline]
    pub(crate) fn note_volumes(&mut self, a: &Volume, b: &Volume, meets: bool) {
        self.volumes_against(a).note(b, meets);
    }

    /// Where tests of a bounding volume of A against several of B's are noted.
    #[inline]
    pub(crate) fn volumes_against(&mut self, a: &Volume) -> VolumeTallies<'_> {
        let (row, table) = (place(a), &mut self.volumes);
        VolumeTallies {
            used: &mut table.used,
            used_bit: 1 << row,
            used_in: &mut table.used_in[row],
            tallies: &mut table.tallies[row],
        }
    }

    #[inline]
    pub(crate) fn note_testers(&mut self, a: PrimitiveKind, b: PrimitiveKind, tested: u32, found: u32) {
        self.testers.note(a as usize, b as usize, Tally { tested, met: found });
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.leaf_pairs += other.leaf_pairs;
        self.boxes_tested += other.boxes_tested;
        self.volumes.add(&other.volumes);
        self.testers.add(&other.testers);
    }

    pub(crate) fn clear(&mut self) {
        self.leaf_pairs = 0;
        self.boxes_tested = 0;
        self.volumes.clear();
        self.testers.clear();
    }
}

/// The tallies of tests of one bounding volume of A.
pub(crate) struct VolumeTallies<'c> {
    used: &'c mut u16,
    used_bit: u16,
    used_in: &'c mut u16,
    tallies: &'c mut [Tally; VOLUME_KINDS],
}

impl VolumeTallies<'_> {
    /// Notes a test against one of B's.
    #[inline]
    pub fn note(&mut self, b: &Volume, meets: bool) {
        let column = place(b);
        *self.used |= self.used_bit;
        *self.used_in |= 1 << column;
        self.tallies[column].add(Tally { tested: 1, met: u32::from(meets) });
    }
}

fn place(volume: &Volume) -> usize {
    match volume {
        Volume::Aabb { .. } => 0,
        Volume::Sphere { .. } => 1,
        Volume::Obb { .. } => 2,
        Volume::Custom(_) => 3,
        Volume::Unbounded => 4,
    }
}

/// A part of a frame that is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Stage {
    /// States in, relative motion.
    Input = 0,
    /// Bounding volumes, contact testers, load sharing and forces, by all threads.
    Contacts = 1,
    /// The order of every sum; limits.
    Order = 2,
    /// Energies, if they are kept.
    Energy = 3,
    /// Wrenches.
    Output = 4,
    /// Contact state, when a frame is committed.
    Commit = 5,
}

impl Stage {
    /// All stages in order.
    pub const ALL: [Self; 6] =
        [Self::Input, Self::Contacts, Self::Order, Self::Energy, Self::Output, Self::Commit];

    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Contacts => "contacts",
            Self::Order => "order",
            Self::Energy => "energy",
            Self::Output => "output",
            Self::Commit => "commit",
        }
    }
}

/// A part of the work of [`Stage::Contacts`], which all threads share. The engine asks the clock between groups of 64
/// elements, not between tests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Work {
    /// Laying out the work, bounding volumes, boxes.
    BroadPhase = 0,
    /// Contact tests.
    NarrowPhase = 1,
    /// Which contacts count, and their weights.
    LoadSharing = 2,
    /// Normal and friction forces.
    Forces = 3,
}

impl Work {
    /// All parts in order.
    pub const ALL: [Self; 4] = [Self::BroadPhase, Self::NarrowPhase, Self::LoadSharing, Self::Forces];

    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::BroadPhase => "broad phase",
            Self::NarrowPhase => "narrow phase",
            Self::LoadSharing => "load sharing",
            Self::Forces => "forces",
        }
    }
}

/// Time of a lane, or of all lanes together, in the parts of the contacts' work, ns; all zero unless the host has given a
/// clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WorkTimes([u64; Work::ALL.len()]);

impl WorkTimes {
    /// Time of one part, ns.
    pub fn of(&self, work: Work) -> u64 {
        self.0[work as usize]
    }

    /// Time of all parts, ns.
    pub fn sum(&self) -> u64 {
        self.0.iter().sum()
    }

    pub(crate) fn add(&mut self, other: &Self) {
        self.0.iter_mut().zip(other.0).for_each(|(own, more)| *own += more);
    }
}

/// Time per stage of the last frame, ns; all zero unless the host has given a clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTimes {
    stages: [u64; Stage::ALL.len()],
    /// Time in each part of the work of [`Stage::Contacts`]: the sum of all lanes. With workers the parts together may
    /// take longer than the stage; on the calling thread alone hardly anything of the stage is in none of them.
    pub work: WorkTimes,
}

impl StageTimes {
    /// Time of one stage, ns, as the caller waits for it.
    pub fn of(&self, stage: Stage) -> u64 {
        self.stages[stage as usize]
    }
}

/// A host's clock in ns, or none: the engine itself never asks the time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Clock(pub Option<fn() -> u64>);

/// Measures one stage after another.
pub(crate) struct Watch {
    clock: Clock,
    last: u64,
}

impl Clock {
    pub fn start(self) -> Watch {
        Watch { clock: self, last: self.0.map_or(0, |now| now()) }
    }
}

impl Watch {
    /// The time since the last lap belongs to a stage.
    pub fn lap(&mut self, stage: Stage, times: &mut StageTimes) {
        if let Some(now) = self.clock.0 {
            let now = now();
            times.stages[stage as usize] = now.saturating_sub(self.last);
            self.last = now;
        }
    }

    /// The time since the last lap belongs to a part of the work as well.
    pub fn lap_work(&mut self, work: Work, times: &mut WorkTimes) {
        if let Some(now) = self.clock.0 {
            let now = now();
            times.0[work as usize] += now.saturating_sub(self.last);
            self.last = now;
        }
    }
}

/// Measures the parts of a lane's work one after another, or does not.
pub(crate) trait Laps {
    /// The time since the last lap belongs to a part.
    fn lap(&mut self, work: Work, times: &mut WorkTimes);
}

/// No clock was lent.
pub(crate) struct Untimed;

impl Laps for Untimed {
    #[inline(always)]
    fn lap(&mut self, _: Work, _: &mut WorkTimes) {}
}

/// By the host's clock.
pub(crate) struct Timed {
    now: fn() -> u64,
    last: u64,
}

impl Timed {
    /// Begins now.
    pub fn start(now: fn() -> u64) -> Self {
        Self { now, last: now() }
    }
}

impl Laps for Timed {
    #[inline(always)]
    fn lap(&mut self, work: Work, times: &mut WorkTimes) {
        let now = (self.now)();
        times.0[work as usize] += now.saturating_sub(self.last);
        self.last = now;
    }
}

/// Memory in use against memory taken at seal; in bytes, or contacts where that is said.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryReport {
    /// Most contacts that a frame found, those only remembered included.
    pub contacts_peak: usize,
    /// Contacts that there is room for.
    pub contacts_capacity: usize,
    /// Most that the testers of one block needed.
    pub arena_peak: usize,
    /// What there is for them.
    pub arena_capacity: usize,
    /// Most that the solution among contacts of one surface needed.
    pub scratch_peak: usize,
    /// What there is for it.
    pub scratch_capacity: usize,
}
