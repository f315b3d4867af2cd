//! What went right through something between two commits. A frame knows poses, not what was between them: a fast point
//! may be in front of a wall in one frame and behind it in the next, and no force ever told it. The forces stay what they
//! are; the status says it, so that no passage goes unnoticed.
//!
//! An element of A is followed at its *places*: a point, the centre of a ball, the origin of a ray, the ends and the
//! middle of a segment, each along its straight line since the last commit, seen from B. It went through where
//!
//! * the line goes into a solid of B and out again, or from the front through a sheet, and no contact pushes the element
//!   back to the side it came from;
//! * a contact that pushed it to one side ended with the place on the other side, or now pushes it there.
//!
//! Lines are followed where the body may have moved farther than half of what is thinnest in B ([`least_travel_m`]): a
//! shorter line may cut an edge or a corner, it goes through no wall. In all other frames only contacts that ended are
//! looked at.

mod curved;
mod ended;
mod sheets;
mod solids;
mod travel;

pub(crate) use travel::{least_travel_m, reach_m};

use crate::frame::buffers::Found;
use crate::frame::input::PairContext;
use crate::frame::{Frame, Given};
use crate::report::StatusBits;
use crate::seal::Plan;
use crate::state::{ContactKey, ContactRecord, Role};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::Portable;
use pong_model::box_tree::{Child, lanes};
use pong_model::{Batch, Body, Item};

/// A contact pushes to a side where the cosine between its normal and that of the side exceeds this (60°).
const SAME_SIDE_COSINE_MIN: f64 = 0.5;

/// What went through.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Passages {
    /// How often an element of A did: once per place at most.
    pub count: u32,
    /// The first in the order of plans.
    pub first: Option<Passed>,
}

/// An element of A that went through B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passed {
    pub body_a: usize,
    pub primitive_a: u32,
    pub body_b: usize,
}

impl Passages {
    fn note(&mut self, passed: Passed) {
        self.count = self.count.saturating_add(1);
        self.first.get_or_insert(passed);
    }
}

/// Tells the status of what went through.
pub(crate) fn watch(given: &Given<'_>, frame: &mut Frame) {
    frame.lane.scratch.reset();
    frame.passages = find(given, frame);
    if frame.passages.count > 0 {
        frame.report.status.set(StatusBits::TUNNELLED);
    }
}

fn find(given: &Given<'_>, frame: &Frame) -> Passages {
    let mut passages = Passages::default();
    for plan in &given.sealed.plans {
        let motion = &frame.input.motions[plan.group_pair as usize][plan.flipped as usize];
        let enabled = given.states.enabled[given.sealed.group_pairs[plan.group_pair as usize].pair];
        if enabled && travel::may_go_through(plan, motion) {
            Seen::new(given, plan, frame).follow_lines(plan, &mut passages);
        }
    }
    ended::look_at_ended(given, frame, &mut passages);
    passages
}

/// One direction of a pair of movable groups, with the contacts that the frame has found.
struct Seen<'a> {
    context: PairContext<'a>,
    bodies: (usize, usize),
    frame: &'a Frame,
}

/// A place of an element of A and its line since the last commit, in B's frame, m.
struct Line {
    from: Vec3,
    to: Vec3,
}

/// What a line did to one shell of B.
enum Met {
    /// Into it and out again, or through it, coming in by a side with this normal.
    Through(Vec3),
    /// Into it, where it still is.
    Into(Vec3),
}

impl<'a> Seen<'a> {
    fn new(given: &Given<'a>, plan: &Plan, frame: &'a Frame) -> Self {
        Self::of_direction(given, (plan.group_pair, plan.flipped), (plan.body_a, plan.body_b), frame)
    }

    fn of_direction(
        given: &Given<'a>,
        (pair, flipped): (u32, u32),
        bodies: (usize, usize),
        frame: &'a Frame,
    ) -> Self {
        let mut context = PairContext::of_direction(given.scene, given.sealed, &frame.input, pair, flipped);
        context.memory = given.memory;
        Self { context, bodies, frame }
    }

    /// Follows every place of every element of A that anything of B can touch.
    fn follow_lines(&self, plan: &Plan, passages: &mut Passages) {
        let (body_a, body_b) = (self.context.body_a, self.context.body_b);
        for batch_a in body_a.tree.batches.iter().filter(|batch| plan.element_ns(batch.kind).is_some()) {
            let meets = |batch: &&Batch| {
                plan.tests(batch_a.kind, batch.kind) && travel::sweeps(self.context.motion, batch_a, batch)
            };
            for batch_b in body_b.tree.batches.iter().filter(meets) {
                for item in &body_a.tree.items[batch_a.items.start as usize..batch_a.items.end as usize] {
                    for place in places(body_a, batch_a.kind, *item).into_iter().flatten() {
                        self.follow(*item, &place, batch_b, passages);
                    }
                }
            }
        }
    }

    fn line(&self, place: &Vec3) -> Option<Line> {
        let motion = self.context.motion;
        let since = motion.since_commit.as_ref()?;
        Some(Line { from: since.x_ba.point(place), to: motion.x_ba.point(place) })
    }

    /// Follows one place through one batch of B: a shell that it went through counts once.
    fn follow(&self, item_a: Item, place: &Vec3, batch: &Batch, passages: &mut Passages) {
        let Some(line) = self.line(place) else { return };
        let query = batch.boxes.narrowed(&line.from.inf(&line.to), &line.from.sup(&line.to));
        if !query.meets(&batch.boxes.around) {
            return;
        }
        let mut went = false;
        batch.boxes.visit(Portable, &query, |node, met| {
            for lane in lanes(met) {
                let Child::Element(place) = node.child(lane) else { continue };
                let item_b = self.context.body_b.tree.items[(batch.items.start + place) as usize];
                went = went || self.goes_through(item_a, &line, batch.kind, item_b);
            }
        });
        if went {
            passages.note(self.passed(item_a.primitive));
        }
    }

    fn goes_through(&self, item_a: Item, line: &Line, kind_b: PrimitiveKind, item_b: Item) -> bool {
        let body = self.context.body_b;
        let (shell, met) = match kind_b {
            PrimitiveKind::Polyhedron => {
                let shell = body.primitives[item_b.primitive as usize].shell;
                (shell, solids::meet(body, shell, item_b.element, line))
            }
            PrimitiveKind::Triangle => {
                let set = &body.triangles;
                (set.triangles[item_b.element as usize].shell, sheets::meet(set, item_b.element, line))
            }
            _ => {
                let shell = body.primitives[item_b.primitive as usize].shell;
                (shell, curved::meet(&self.context, item_a, item_b, line))
            }
        };
        let (side, went) = match met {
            None => return false,
            Some(Met::Through(side)) => (side, !self.pushes_to(&side, item_a.primitive, shell)),
            Some(Met::Into(side)) => (side, self.pushes_away_from(&side, item_a.primitive, shell)),
        };
        went && !self.comes_back(&side, item_a.primitive, shell, item_b)
    }

    /// Whether the primitive was on the wrong side of this element of B and pushed back: it comes in by the far side, and
    /// out where it belongs. The two sides of a sheet are two shells of one primitive.
    fn comes_back(&self, side: &Vec3, primitive_a: u32, shell_b: u32, item_b: Item) -> bool {
        let (records, info) =
            (&self.context.memory.records, self.context.body_b.primitives.get(item_b.primitive as usize));
        let head = self.key(primitive_a, shell_b).head();
        let first = records.partition_point(|record| record.key.head() < head);
        let mut same_head = records[first..].iter().take_while(|record| record.key.head() == head);
        let triangles = &self.context.body_b.triangles.triangles;
        let of_sheet = |record: &ContactRecord| {
            let triangle = triangles.get(record.element_b as usize);
            triangle.is_some_and(|triangle| triangle.shell == record.key.shell_b)
                && info.is_some_and(|info| {
                    info.kind == PrimitiveKind::Triangle && info.elements.contains(&record.element_b)
                })
        };
        same_head.any(|record| {
            record.role == Role::Pushes
                && record.normal.dot(side) < -SAME_SIDE_COSINE_MIN
                && (record.key.shell_b == shell_b || of_sheet(record))
        })
    }

    fn key(&self, primitive_a: u32, shell_b: u32) -> ContactKey {
        let (group_pair, flipped) = (self.context.group_pair, self.context.flipped);
        ContactKey { group_pair, flipped, primitive_a, shell_b, end: 0 }
    }

    /// Whether a contact of the primitive with the shell pushes to this side.
    fn pushes_to(&self, side: &Vec3, primitive_a: u32, shell_b: u32) -> bool {
        self.pushing(primitive_a, shell_b).any(|normal| normal.dot(side) > SAME_SIDE_COSINE_MIN)
    }

    /// Whether contacts push to the opposite side, and none to this.
    fn pushes_away_from(&self, side: &Vec3, primitive_a: u32, shell_b: u32) -> bool {
        self.pushing(primitive_a, shell_b).any(|normal| normal.dot(side) < -SAME_SIDE_COSINE_MIN)
            && !self.pushes_to(side, primitive_a, shell_b)
    }

    /// Normals of the contacts of a primitive of A with a shell of B.
    fn pushing(&self, primitive_a: u32, shell_b: u32) -> impl Iterator<Item = &'a Vec3> + use<'a> {
        pushing(self.frame, self.key(primitive_a, shell_b))
    }

    fn passed(&self, primitive_a: u32) -> Passed {
        Passed { body_a: self.bodies.0, primitive_a, body_b: self.bodies.1 }
    }
}

/// Normals of the contacts under a key, whatever end of a segment they are at.
fn pushing(frame: &Frame, key: ContactKey) -> impl Iterator<Item = &Vec3> + use<'_> {
    let head = key.head();
    let first = frame.order.partition_point(|place| place.head < head);
    let same_head = frame.order[first..].iter().take_while(move |place| place.head == head);
    let found = same_head.map(|place| &frame.lane.out.contacts[place.index as usize].found);
    let counts = move |found: &&Found| found.role == Role::Pushes && found.key.shell_b == key.shell_b;
    found.filter(counts).map(|found| &found.normal)
}

/// Where an element of A is followed, in A's frame, m.
fn places(body: &Body, kind: PrimitiveKind, item: Item) -> [Option<Vec3>; 3] {
    let i = item.element as usize;
    match kind {
        PrimitiveKind::Point => [Some(body.points[i].position), None, None],
        PrimitiveKind::Sphere => [Some(body.spheres[i].center), None, None],
        PrimitiveKind::Ellipsoid => [Some(body.ellipsoids[i].center), None, None],
        PrimitiveKind::Ray => [Some(body.rays[i].origin), None, None],
        PrimitiveKind::LineSegment => {
            let [a, b] = body.segments[i].ends;
            [Some(a), Some(b), Some(0.5 * (a + b))]
        }
        _ => [None; 3],
    }
}
