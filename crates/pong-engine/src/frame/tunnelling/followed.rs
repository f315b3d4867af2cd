//! Follows elements of A along their paths, and checks whether contacts push them back.

use super::solids::{self, Line, Met};
use super::swept::{self, Swept};
use super::travel;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::input::motion::Motion;
use crate::frame::input::{PairContext, Round};
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::frame::output::order::OrderedContacts;
use crate::seal::{Direction, Plan};
use crate::state::{ContactKey, ContactRecord, ContactRole};
use pong_geometry::Vec3;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::primitive::{Primitive, PrimitiveKind, Ray};
use pong_geometry::simd::Portable;
use pong_model::box_tree::{Child, lanes};
use pong_model::{Batch, Item};

/// Cosine between the normals of a contact and of a side above which the contact pushes to that side (60°).
pub(super) const SAME_SIDE_COSINE_MIN: f64 = 0.5;

/// Tunnelling events of a frame.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TunnellingEvents {
    /// Number of events: at most one per batch of B for each followed point or axis of A, and one per ended
    /// contact.
    pub count: u32,
    /// First event, in the order of pairs and directions.
    pub first: Option<TunnellingEvent>,
}

/// An element of A that passed through B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TunnellingEvent {
    pub body_a: usize,
    pub primitive_a: u32,
    pub body_b: usize,
}

impl TunnellingEvents {
    /// Records one event.
    pub fn note(&mut self, passed: TunnellingEvent) {
        self.count = self.count.saturating_add(1);
        self.first.get_or_insert(passed);
    }
}

/// One direction of a pair of movable groups, with the contacts of the frame.
pub(super) struct Seen<'a> {
    pub context: PairContext<'a>,
    bodies: (usize, usize),
    contacts: OrderedContacts<'a>,
}

impl<'a> Seen<'a> {
    pub fn new(
        round: Round<'a>,
        direction: Direction,
        motion: &'a Motion,
        contacts: OrderedContacts<'a>,
    ) -> Self {
        let bodies = round.sealed.bodies_of(direction);
        Self { context: PairContext::new(&round, direction, motion), bodies, contacts }
    }

    /// Follows the points and axes of all elements of A through the batches of B that they can touch, and
    /// records tunnelling events.
    pub fn follow_lines(&self, plan: &Plan, events: &mut TunnellingEvents) {
        let (body_a, body_b) = (self.context.body_a, self.context.body_b);
        let batches_a = body_a.tree.batches.iter().enumerate();
        for (a, batch_a) in batches_a.filter(|(_, batch)| plan.element_ns(batch.kind).is_some()) {
            let meets = |(b, batch): &(usize, &Batch)| {
                plan.tests_batches((a, batch_a.kind), (*b, batch.kind))
                    && travel::sweeps(self.context.motion, batch_a, batch)
            };
            for (_, batch_b) in body_b.tree.batches.iter().enumerate().filter(meets) {
                let first_b = &body_b.tree.items[batch_b.items.start as usize];
                let is_round = swept::round(body_b, batch_b.kind, first_b.element).is_some();
                for item in &body_a.tree.items[batch_a.items.start as usize..batch_a.items.end as usize] {
                    let Some(facts) = body_a.element(batch_a.kind, item.element).facts() else { continue };
                    if is_round {
                        self.follow_axis(*item, batch_b, events);
                        continue;
                    }
                    for place in facts.followed().into_iter().flatten() {
                        self.follow(*item, &place, batch_b, events);
                    }
                }
            }
        }
    }

    /// Path of a point, given in A's frame, since the last commit; `None` without an earlier pose.
    pub fn line(&self, place: &Vec3) -> Option<Line> {
        let motion = self.context.motion;
        let since = motion.since_commit.as_ref()?;
        Some(Line { from_b: since.x_ba.point(place), to_b: motion.x_ba.point(place) })
    }

    /// Follows one point of an element of A through one batch of B; adds at most one event.
    fn follow(&self, item_a: Item, place: &Vec3, batch: &Batch, events: &mut TunnellingEvents) {
        let Some(line) = self.line(place) else { return };
        // Against spheres and ellipsoids the box includes the radius of the element, because a ball may pass
        // through a smaller one beside its own centre.
        let is_ball = matches!(batch.kind, PrimitiveKind::Sphere | PrimitiveKind::Ellipsoid);
        let beside = if is_ball { self.radius(item_a) } else { 0.0 };
        let (low, high) = (line.from_b.inf(&line.to_b), line.from_b.sup(&line.to_b));
        let bounds = [low.add_scalar(-beside), high.add_scalar(beside)];
        let went = any_met(batch, &bounds, |place| {
            let item_b = self.context.body_b.tree.items[(batch.items.start + place) as usize];
            self.goes_through(item_a, self.met(item_a, &line, batch.kind, item_b), item_b)
        });
        if went {
            events.note(self.passed(item_a.primitive));
        }
    }

    /// Follows the axis of an element of A through one batch of round solids.
    fn follow_axis(&self, item_a: Item, batch: &Batch, events: &mut TunnellingEvents) {
        let Some(swept) = self.swept(item_a) else { return };
        let body = self.context.body_b;
        let went = any_met(batch, &swept.bounds(), |place| {
            let item_b = body.tree.items[(batch.items.start + place) as usize];
            let solid = swept::round(body, batch.kind, item_b.element);
            self.goes_through(item_a, solid.and_then(|solid| swept.meet(solid)), item_b)
        });
        if went {
            events.note(self.passed(item_a.primitive));
        }
    }

    /// Axis of an element of A at the last commit and now; `None` for kinds without an axis, and without an
    /// earlier pose.
    pub fn swept(&self, item_a: Item) -> Option<Swept> {
        let (body, motion) = (self.context.body_a, self.context.motion);
        let kind = body.primitives[item_a.primitive as usize].kind;
        let (axis, radius) = core(body.element(kind, item_a.element).facts()?)?;
        let since = motion.since_commit.as_ref()?;
        let [from_b, to_b] = [&since.x_ba, &motion.x_ba].map(|x_ba| axis.map(|place| x_ba.point(&place)));
        Some(Swept { from_b, to_b, radius })
    }

    /// Radius of an element whose centre is followed, m; 0 for other elements.
    fn radius(&self, item_a: Item) -> f64 {
        let body = self.context.body_a;
        let kind = body.primitives[item_a.primitive as usize].kind;
        let core = body.element(kind, item_a.element).facts().and_then(core);
        core.filter(|(ends, _)| ends[0] == ends[1]).map_or(0.0, |(_, radius)| radius)
    }

    /// Outcome of a path against an element of B; `None` if the path does not pass or enter it. Planes are
    /// half-spaces and cannot be passed; custom kinds are not checked.
    fn met(&self, item_a: Item, line: &Line, kind_b: PrimitiveKind, item_b: Item) -> Option<Met> {
        let body = self.context.body_b;
        match kind_b {
            PrimitiveKind::Polyhedron => solids::meet(body, self.shell(item_b), item_b.element, line),
            // A path from behind is no tunnelling (docs/theory.md, 2.2).
            PrimitiveKind::Triangle => {
                let ray = Ray::between(&line.from_b, &line.to_b)?;
                let hit = ray_triangle(&ray, &body.triangles, item_b.element, 0.0);
                hit.map(|_| Met::Through(body.triangles.normal(item_b.element)))
            }
            _ => {
                let surface = body.element(kind_b, item_b.element).facts()?.curved()?;
                surface.passed(&line.from_b, &line.to_b, self.radius(item_a)).map(Met::Through)
            }
        }
    }

    fn shell(&self, item_b: Item) -> u32 {
        let (body, info) = (self.context.body_b, &self.context.body_b.primitives[item_b.primitive as usize]);
        match info.kind {
            PrimitiveKind::Triangle => body.triangles.triangles[item_b.element as usize].shell,
            _ => info.shell,
        }
    }

    fn goes_through(&self, item_a: Item, met: Option<Met>, item_b: Item) -> bool {
        let Some(met) = met else { return false };
        let shell = self.shell(item_b);
        let (side, went) = match met {
            Met::Through(side) => (side, !self.pushes_to(&side, item_a.primitive, shell)),
            Met::Into(side) => (side, self.pushes_away_from(&side, item_a.primitive, shell)),
        };
        went && !self.comes_back(&side, item_a.primitive, shell, item_b)
    }

    /// Returns true if a committed contact with this element of B pushed the primitive opposite to `side`.
    /// The path then enters from the far side and ends on the side to which the contact pushed: no
    /// tunnelling. The front and the back of a two-sided mesh are two shells of one primitive, so a contact
    /// with either counts.
    fn comes_back(&self, side: &Vec3, primitive_a: u32, shell_b: u32, item_b: Item) -> bool {
        let (records, info) =
            (&self.context.memory.records, self.context.body_b.primitives.get(item_b.primitive as usize));
        let head = self.key(primitive_a, shell_b).head();
        let mut same_head = records.in_range(&records.of_head(head)).iter();
        let triangles = &self.context.body_b.triangles.triangles;
        let of_sheet = |record: &ContactRecord| {
            let triangle = triangles.get(record.element_b as usize);
            triangle.is_some_and(|triangle| triangle.shell == record.key.shell_b)
                && info.is_some_and(|info| {
                    info.kind == PrimitiveKind::Triangle && info.elements.contains(&record.element_b)
                })
        };
        same_head.any(|record| {
            record.role == ContactRole::Active
                && record.normal_b.dot(side) < -SAME_SIDE_COSINE_MIN
                && (record.key.shell_b == shell_b || of_sheet(record))
        })
    }

    fn key(&self, primitive_a: u32, shell_b: u32) -> ContactKey {
        let (group_pair, flipped) = (self.context.group_pair, self.context.flipped);
        ContactKey { group_pair, flipped, primitive_a, shell_b, end: 0 }
    }

    /// Returns true if a contact of the primitive with the shell now pushes to `side`.
    pub fn pushes_to(&self, side: &Vec3, primitive_a: u32, shell_b: u32) -> bool {
        self.pushing(primitive_a, shell_b).any(|normal| normal.dot(side) > SAME_SIDE_COSINE_MIN)
    }

    /// Returns true if a contact pushes to the side opposite to `side`, and none pushes to `side`.
    fn pushes_away_from(&self, side: &Vec3, primitive_a: u32, shell_b: u32) -> bool {
        self.pushing(primitive_a, shell_b).any(|normal| normal.dot(side) < -SAME_SIDE_COSINE_MIN)
            && !self.pushes_to(side, primitive_a, shell_b)
    }

    /// Normals of the contacts that push a primitive of A away from a shell of B.
    pub fn pushing(&self, primitive_a: u32, shell_b: u32) -> impl Iterator<Item = &'a Vec3> + use<'a> {
        let key = self.key(primitive_a, shell_b);
        pushing(self.contacts, self.contacts.with_head(key.head()), key).map(|found| &found.normal_b)
    }

    /// Normals of the contacts that push one end of a segment away from a shell of B.
    pub fn pushing_at_end(&self, key: ContactKey) -> impl Iterator<Item = &'a Vec3> + use<'a> {
        let same_head = self.contacts.with_head(key.head());
        let at_end = pushing(self.contacts, same_head, key).filter(move |found| found.key.end == key.end);
        at_end.map(|found| &found.normal_b)
    }

    /// Tunnelling event of a primitive of A through B.
    pub fn passed(&self, primitive_a: u32) -> TunnellingEvent {
        TunnellingEvent { body_a: self.bodies.0, primitive_a, body_b: self.bodies.1 }
    }
}

/// Axis and radius by which an element is followed through round solids, m; of an ellipsoid the centre and the smallest
/// semi-axis, of a cylinder or a cone the smaller radius.
fn core(facts: &dyn Primitive) -> Option<([Vec3; 2], f64)> {
    facts.core().or_else(|| {
        let [one, other, _] = facts.followed();
        Some(([one?, other.or(one)?], facts.smallest_radius_m()?))
    })
}

/// Returns true if `holds` is true for any element of `batch` whose box overlaps the box from `low` to
/// `high`.
fn any_met(batch: &Batch, [low, high]: &[Vec3; 2], holds: impl Fn(u32) -> bool) -> bool {
    let query = batch.boxes.narrowed(low, high);
    let mut any = false;
    if query.meets(&batch.boxes.around) {
        batch.boxes.visit(Portable, &query, |node, met| {
            for lane in lanes(met) {
                let Child::Element(place) = node.child(lane) else { continue };
                any = any || holds(place);
            }
        });
    }
    any
}

/// Contacts that push a primitive of A away from a shell of B, at any end of a segment, among the contacts
/// with the key's high word.
pub(super) fn pushing<'a>(
    contacts: OrderedContacts<'a>,
    same_head: impl Iterator<Item = &'a ContactRef>,
    key: ContactKey,
) -> impl Iterator<Item = &'a ContactCandidate> {
    let pushing = same_head.filter(|place| place.pushes());
    let found = pushing.map(move |place| &contacts.found.contact(place).found);
    found.filter(move |found| found.key.shell_b == key.shell_b)
}
