//! Status, counts and times of a frame.

use crate::ids::InterfaceId;
use pong_geometry::bounding::Volume;
use pong_geometry::primitive::PrimitiveKind;

/// Flags of a frame for contacts that were left out or missed, or whose force is wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StatusBits(u32);

impl StatusBits {
    /// More contacts than the world's capacity: the deepest were kept. Raise `Config::contact_capacity`.
    pub const CONTACT_LIMIT: Self = Self(1);

    /// One element has more contacts with one surface, of which some normals are more than 90° apart, than
    /// can be shared exactly: only the deepest were. Raise `Config::contact_capacity`.
    pub const LOAD_SHARING_LIMIT: Self = Self(2);

    /// Something passed through something else since the last commit, or came out on the far side of a
    /// contact that pushed it back: a contact was missed. [`World::tunnelling`](crate::World::tunnelling)
    /// names it. Use shorter frames, a thicker wall or stiffer surfaces; before an intended jump, call
    /// [`World::clear_contact_history`](crate::World::clear_contact_history).
    pub const TUNNELLED: Self = Self(4);

    /// A solid is deeper in a mesh that is not convex than the regions below its facets: the force no longer grows as it
    /// should, and may push to another side. [`World::deep_in_mesh`](crate::World::deep_in_mesh) names the two. Use
    /// stiffer surfaces, a thicker mesh or one with longer edges, or divide the mesh into convex pieces (`pong decompose`).
    pub const DEEP_IN_MESH: Self = Self(8);

    /// Returns true if no flag is set.
    pub fn is_complete(self) -> bool {
        self.0 == 0
    }

    /// Returns true if a flag is set.
    pub fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Returns true if a limit was exceeded, so that contacts were left out.
    pub fn leaves_contacts_out(self) -> bool {
        self.contains(Self::CONTACT_LIMIT) || self.contains(Self::LOAD_SHARING_LIMIT)
    }

    /// Flags that are set here or in `other`, for a host that joins the frames of several substeps.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The flags as a number.
    pub fn bits(self) -> u32 {
        self.0
    }

    pub(crate) fn set(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// Report of tunnelling between two commits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TunnellingReport {
    /// Movable group that passed through the other; it is A of the pair.
    pub interface: InterfaceId,
    /// Index of its primitive in the movable group's list (see
    /// [`Scene::primitive_path`](crate::Scene::primitive_path)).
    pub primitive: u32,
    /// Movable group that it passed through.
    pub through: InterfaceId,
    /// Number of tunnelling events of the frame; this report is the first.
    pub count: u32,
}

/// Report of a solid that is deeper in a mesh than the regions below its facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeepInMeshReport {
    /// Movable group of the mesh.
    pub mesh: InterfaceId,
    /// Movable group of the solid in the mesh.
    pub other: InterfaceId,
    /// Number of facets, of all meshes in the frame, whose region is not deep enough. The two movable groups are those
    /// of one of these facets.
    pub facets: u32,
}

/// Summary of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameReport {
    /// Contacts that were left out or missed, or whose force is wrong.
    pub status: StatusBits,
    /// Contacts that push.
    pub contacts: u32,
    /// Contact capacity that the frame needed: the number of contacts that push. With
    /// [`StatusBits::CONTACT_LIMIT`] it is larger if contacts that are only remembered, or the candidates of
    /// a chunk, need more room.
    pub contacts_wanted: u32,
}

impl FrameReport {
    /// Contact capacity to use instead of `present` if contacts were left out; `None` if none were. After
    /// [`StatusBits::LOAD_SHARING_LIMIT`] alone it is twice the present one, and may have to be doubled
    /// again.
    pub fn advised_capacity(&self, present: usize) -> Option<usize> {
        let wanted = self.status.contains(StatusBits::CONTACT_LIMIT).then_some(self.contacts_wanted as usize);
        let twice = self.status.contains(StatusBits::LOAD_SHARING_LIMIT).then_some(present.saturating_mul(2));
        wanted.max(twice)
    }
}

/// Number of tests of some kind, and of hits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Tests.
    pub tested: u32,
    /// Tests that did not separate the two. For contact tests: contacts found; one test may find several.
    pub met: u32,
}

impl Tally {
    #[inline]
    fn add(&mut self, other: Self) {
        self.tested = self.tested.saturating_add(other.tested);
        self.met = self.met.saturating_add(other.met);
    }
}

/// Tallies of the pairs of `KINDS` kinds. Most frames use a few, so the used ones are marked, and adding or
/// clearing a table costs only those.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct TallyTable<const KINDS: usize> {
    /// Bit per row with a non-zero tally, by number of A's kind.
    used: u16,
    /// Per row, a bit per non-zero tally, by number of B's kind.
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

    /// Tallies of pairs that were tested, in order of A's kind, then B's.
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

/// Indices of the bits that are set, lowest first.
fn ones(mut bits: u16) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = (bits != 0).then(|| bits.trailing_zeros() as usize)?;
        bits &= bits - 1;
        Some(place)
    })
}

/// Kinds of primitives.
const KINDS: usize = PrimitiveKind::ALL.len();
/// Kinds of bounding volumes: box, sphere, oriented box, custom, unbounded.
const VOLUME_KINDS: usize = 5;

/// Counts of one frame; equal for any number of workers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameCounts {
    /// Pairs of leaves of A and B that may touch, counted in each direction and once per batch of A's leaf.
    pub leaf_pairs: u64,
    /// Comparisons of one box with eight, in the trees of boxes of the leaves.
    pub boxes_tested: u64,
    volumes: TallyTable<VOLUME_KINDS>,
    testers: TallyTable<KINDS>,
}

impl FrameCounts {
    /// Tests of authored bounding volumes: names of the two kinds, A's first, and their tally; without empty
    /// ones.
    pub fn volumes(&self) -> impl Iterator<Item = (&'static str, &'static str, Tally)> + '_ {
        const NAMES: [&str; VOLUME_KINDS] = ["Aabb", "Sphere", "Obb", "Custom", "Unbounded"];
        self.volumes.tested().map(|(a, b, tally)| (NAMES[a], NAMES[b], tally))
    }

    /// Contact tests: the two kinds, A's first, and their tally; without empty ones.
    pub fn testers(&self) -> impl Iterator<Item = (PrimitiveKind, PrimitiveKind, Tally)> + '_ {
        let kinds = PrimitiveKind::ALL;
        self.testers.tested().map(move |(a, b, tally)| (kinds[a], kinds[b], tally))
    }

    /// Number of tested pairs of authored bounding volumes.
    pub fn volumes_tested(&self) -> u64 {
        self.volumes.tested().map(|(_, _, tally)| u64::from(tally.tested)).sum()
    }

    /// Number of tested pairs of primitives.
    pub fn primitives_tested(&self) -> u64 {
        self.testers.tested().map(|(_, _, tally)| u64::from(tally.tested)).sum()
    }

    /// Counts a test of two bounding volumes, A's first.
    #[inline]
    pub(crate) fn note_volumes(&mut self, a: &Volume, b: &Volume, meets: bool) {
        self.volumes_against(a).note(b, meets);
    }

    /// Tallies for tests of one bounding volume of A against several of B.
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

/// Tallies of the tests of one bounding volume of A.
pub(crate) struct VolumeTallies<'c> {
    used: &'c mut u16,
    used_bit: u16,
    used_in: &'c mut u16,
    tallies: &'c mut [Tally; VOLUME_KINDS],
}

impl VolumeTallies<'_> {
    /// Counts a test against one volume of B.
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

/// A timed stage of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Stage {
    /// States in, relative motion.
    Input = 0,
    /// Broad phase, narrow phase, load sharing and forces, on all threads.
    Contacts = 1,
    /// Sorting into summation order; limits.
    Order = 2,
    /// Energies, if they are kept.
    Energy = 3,
    /// Wrenches.
    Output = 4,
    /// Contact state, in a commit.
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

/// A part of [`Stage::Contacts`], which all threads share. The clock is read a few times per chunk of up to
/// eight elements of A, not at every test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub enum Work {
    /// Block layout, bounding volumes, boxes.
    BroadPhase = 0,
    /// Contact tests.
    NarrowPhase = 1,
    /// Selection of contacts, and their weights.
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

/// Time of one thread, or of all threads together, per part of the contact stage, ns; all zero without a
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

/// Time per stage of the last frame, ns; all zero without a clock.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTimes {
    stages: [u64; Stage::ALL.len()],
    /// Time per part of [`Stage::Contacts`], summed over all threads. With workers, the sum may exceed the
    /// time of the stage; on the calling thread alone it covers nearly all of it.
    pub work: WorkTimes,
}

impl StageTimes {
    /// Elapsed time of one stage on the calling thread, ns.
    pub fn of(&self, stage: Stage) -> u64 {
        self.stages[stage as usize]
    }
}

/// The host's clock in ns, if any; the engine itself never reads a clock.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Clock(pub Option<fn() -> u64>);

/// Stopwatch for consecutive stages.
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
    /// Books the time since the last lap to a stage.
    pub fn lap(&mut self, stage: Stage, times: &mut StageTimes) {
        if let Some(now) = self.clock.0 {
            let now = now();
            times.stages[stage as usize] = now.saturating_sub(self.last);
            self.last = now;
        }
    }

    /// Books the time since the last lap to a part of the contact stage.
    pub fn lap_work(&mut self, work: Work, times: &mut WorkTimes) {
        if let Some(now) = self.clock.0 {
            let now = now();
            times.0[work as usize] += now.saturating_sub(self.last);
            self.last = now;
        }
    }
}

/// Stopwatch for the parts of one thread's work.
pub(crate) trait Laps {
    /// Books the time since the last lap to a part.
    fn lap(&mut self, work: Work, times: &mut WorkTimes);
}

/// Stopwatch without a clock.
pub(crate) struct Untimed;

impl Laps for Untimed {
    #[inline(always)]
    fn lap(&mut self, _: Work, _: &mut WorkTimes) {}
}

/// Stopwatch with the host's clock.
pub(crate) struct Timed {
    now: fn() -> u64,
    last: u64,
}

impl Timed {
    /// Starts now.
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

/// Peak use of memory against its capacity, in bytes or, where stated, in contacts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryReport {
    /// Peak number of contacts in a frame, including those only remembered.
    pub contacts_peak: usize,
    /// Capacity in contacts.
    pub contacts_capacity: usize,
    /// Peak arena use of the broad phase of one block, bytes.
    pub arena_peak: usize,
    /// Arena capacity, bytes.
    pub arena_capacity: usize,
    /// Peak use of the scratch memory, bytes: for load sharing, rays, ledger or ended contacts.
    pub scratch_peak: usize,
    /// Scratch capacity, bytes.
    pub scratch_capacity: usize,
}
