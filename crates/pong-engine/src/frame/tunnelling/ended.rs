//! Tunnelling found from ended contacts: a contact pushed an element to one side, and the element is now on
//! the other side. This also finds an element that is pressed slowly through a surface that is too soft: its
//! path in one frame is too short to show it.

use super::followed::{SAME_SIDE_COSINE_MIN, Seen, TunnellingEvents, pushing};
use super::solids::{self, Line};
use super::swept;
use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, WorkerInput};
use crate::frame::output::order::OrderedContacts;
use crate::seal::Direction;
use crate::state::{ContactKey, ContactRecord, ContactRole, Records};
use pong_arena::{Arena, List};
use pong_geometry::interference::ball_bore::is_behind_wall;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::interference::triangle_features::TriangleView;
use pong_geometry::primitive::{PrimitiveKind, Ray};
use pong_geometry::simd::Portable;
use pong_geometry::{Vec3, divisor};
use pong_model::Item;
use pong_model::box_tree::{Child, lanes};
use std::borrow::Cow;

/// Cosine between the normals of two faces below which the faces are opposite sides of a wall (150°). At a
/// smaller angle they form a wedge, and an element pressed on one face may slide round the edge to the other.
const BOTH_SIDES_COSINE_MAX: f64 = -0.866;

/// Least number of ended contacts for which [`Seen::fetch`] pays.
const WORTH_FETCHING: usize = 4;

/// Checks every committed contact that no current contact continues, and records tunnelling events.
#[inline]
pub(super) fn look_at_ended(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &WorkerInput,
    contacts: OrderedContacts<'_>,
    scratch: &Arena,
    events: &mut TunnellingEvents,
) {
    let ended = ended(&given.memory.records, contacts.order, scratch);
    if !ended.is_empty() {
        look_at(&ended, given, motions, input, contacts, events);
    }
}

/// Checks the records of ended contacts, given in key order. A separate function, so that frames without
/// ended contacts do not pay for it.
#[inline(never)]
fn look_at(
    ended: &[u32],
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &WorkerInput,
    contacts: OrderedContacts<'_>,
    events: &mut TunnellingEvents,
) {
    let records = &given.memory.records;
    // Records and contacts are both in key order, so one pass over the contacts is enough.
    let mut present = contacts.order;
    for of_direction in ended.chunk_by(|&a, &b| direction(records, a) == direction(records, b)) {
        let direction = direction(records, of_direction[0]);
        let pair = &given.sealed.group_pairs[direction.group_pair as usize];
        if !given.states.enabled[pair.pair] {
            continue;
        }
        // The two groups may be far apart by now, so that the frame has not visited their pair and stores no
        // motion of it.
        let motion = motions.known(input, direction);
        let seen = Seen::new(given.round(input), direction, &motion, contacts);
        let of_direction = of_direction.iter().map(|&index| &records[index as usize]);
        if of_direction.len() >= WORTH_FETCHING {
            seen.fetch(of_direction.clone());
        }
        for record in of_direction {
            let head = record.key.head();
            let passed = present.iter().take_while(|place| place.head < head).count();
            present = &present[passed..];
            let same_head = present.iter().take_while(|place| place.head == head);
            // Usual case: a neighbouring face pushes to the same side.
            let mut pushing = pushing(contacts, same_head, record.key);
            if !pushing.any(|found| found.normal_b.dot(&record.normal_b) > SAME_SIDE_COSINE_MIN)
                && seen.came_out_behind(record)
            {
                events.note(seen.passed(record.key.primitive_a));
            }
        }
    }
}

/// Indices of the records with the role `Active` that no current contact continues, in key order.
#[inline]
fn ended<'a>(records: &Records, order: &[ContactRef], scratch: &'a Arena) -> List<'a, u32> {
    let room = "sealing has sized the scratch";
    let (continued, mut left) = (scratch.slice(records.len(), false).expect(room), records.len());
    for record in order.iter().filter_map(|place| place.continues()) {
        left -= usize::from(!std::mem::replace(&mut continued[record], true));
    }
    let mut ended = scratch.list(left).expect(room);
    if left == 0 {
        return ended;
    }
    // A record whose contact continues is not read: another core wrote most of these, so that each read would
    // be a cache miss. Of the remaining records only the role is read. These reads do not depend on each
    // other, so their cache misses overlap.
    for index in (0..records.len()).filter(|&index| !continued[index]) {
        if records[index].role == ContactRole::Active && records[index].key.is_tested() {
            ended.push(index as u32).expect(room);
        }
    }
    ended
}

fn direction(records: &Records, index: u32) -> Direction {
    ContactKey::direction_of(records.head(index as usize))
}

fn are_both_sides(one: &Vec3, other: &Vec3) -> bool {
    one.dot(other) < BOTH_SIDES_COSINE_MAX
}

impl Seen<'_> {
    /// Loads the start points of the paths of ended contacts into the cache. They are rarely there, and
    /// loaded together their cache misses overlap.
    fn fetch<'r>(&self, records: impl Iterator<Item = &'r ContactRecord> + Clone) {
        let body_a = self.context.body_a;
        let info = |record: &ContactRecord| &body_a.primitives[record.key.primitive_a as usize];
        let elements = records.clone().fold(0, |all, record| all ^ info(record).elements.start);
        let places = records.map(|record| self.place_of(record).map_or(0.0, |place| place.x));
        std::hint::black_box((elements, places.sum::<f64>()));
    }

    /// Reference point of a contact in A's frame, m; `None` for custom primitives.
    fn place_of(&self, record: &ContactRecord) -> Option<Cow<'_, Vec3>> {
        let body_a = self.context.body_a;
        let info = &body_a.primitives[record.key.primitive_a as usize];
        let is_followed = info.kind != PrimitiveKind::Custom;
        is_followed.then(|| body_a.element(info.kind, info.elements.start).reference_point(record.key.end))
    }

    /// Returns true if the element of an ended contact, which pushed it to one side, is now on the other side
    /// or is pushed to it. An element that has moved in the direction of the push did not pass through.
    fn came_out_behind(&self, record: &ContactRecord) -> bool {
        let (body, key) = (self.context.body_b, &record.key);
        let Some(line) = self.place_of(record).and_then(|place| self.line(&place)) else { return false };
        if record.normal_b.dot(&(line.to_b - line.from_b)) >= 0.0 {
            return false;
        }
        if body.is_joint(key.shell_b) {
            return self.came_out_of_joint(record, &line);
        }
        let of_shell = |kind| {
            let mut infos = body.primitives.iter();
            infos.any(|info| info.kind == kind && info.shell == key.shell_b)
        };
        if of_shell(PrimitiveKind::Polyhedron) {
            self.came_out_of_solid(record, &line)
        } else if of_shell(PrimitiveKind::Bore) {
            body.bores.get(record.element_b as usize).is_some_and(|bore| is_behind_wall(&line.to_b, bore))
        } else if body
            .triangles
            .triangles
            .get(record.element_b as usize)
            .is_some_and(|t| t.shell == key.shell_b)
        {
            self.came_out_of_sheet(record, &line)
        } else {
            let info = body
                .primitives
                .iter()
                .find(|info| info.kind != PrimitiveKind::Triangle && info.shell == key.shell_b);
            info.is_some_and(|info| {
                info.elements.contains(&record.element_b) && self.came_out_of_round(record, info.kind)
            })
        }
    }

    /// Returns true if the element of an ended contact with a declared surface came out of its polyhedra, or went
    /// through its triangles. A record does not tell the kind of its primitive, so both must be possible only for
    /// kinds that the surface has; nothing passes through a plane.
    fn came_out_of_joint(&self, record: &ContactRecord, line: &Line) -> bool {
        let (body, shell) = (self.context.body_b, record.key.shell_b);
        let planes =
            body.primitives.iter().filter(|info| info.shell == shell && info.kind == PrimitiveKind::Plane);
        let mut planes = planes.map(|info| &body.planes[info.elements.start as usize]);
        if planes.any(|plane| plane.normal.dot(&record.normal_b) > SAME_SIDE_COSINE_MIN) {
            return false;
        }
        let triangle = body.triangles.triangles.get(record.element_b as usize);
        let is_of_triangle = triangle.is_some_and(|triangle| {
            let normal = body.triangles.normal(record.element_b);
            triangle.shell == shell && normal.dot(&record.normal_b) > SAME_SIDE_COSINE_MIN
        });
        self.came_out_of_solid(record, line) || is_of_triangle && self.came_out_of_sheet(record, line)
    }

    fn came_out_of_solid(&self, record: &ContactRecord, line: &Line) -> bool {
        let (body, shell, primitive_a) = (self.context.body_b, record.key.shell_b, record.key.primitive_a);
        if solids::holds(body, shell, &line.to_b) {
            // The point is still inside. It has passed if a contact at the same end of the segment now pushes
            // the opposite way, and no contact of the primitive pushes the earlier way. A contact elsewhere
            // on the segment, such as with an edge that it crosses, may push the opposite way without a
            // passage.
            let mut pushing = self.pushing_at_end(record.key);
            return pushing.any(|normal| are_both_sides(normal, &record.normal_b))
                && !self.pushes_to(&record.normal_b, primitive_a, shell);
        }
        let out = solids::way_out(body, shell, line).filter(|_| solids::holds(body, shell, &line.from_b));
        out.is_some_and(|out| are_both_sides(&out, &record.normal_b))
    }

    /// Returns true if the element was inside a round solid and left it on the side opposite to the push.
    fn came_out_of_round(&self, record: &ContactRecord, kind_b: PrimitiveKind) -> bool {
        let info = &self.context.body_a.primitives[record.key.primitive_a as usize];
        let item_a = Item { primitive: record.key.primitive_a, element: info.elements.start };
        let solid = swept::round(self.context.body_b, kind_b, record.element_b);
        let out = solid.and_then(|solid| self.swept(item_a)?.way_out(solid));
        out.is_some_and(|out| are_both_sides(&out, &record.normal_b))
    }

    /// Returns true if the element was behind its triangle, is now farther behind, and did not go round the
    /// rim. The triangle stops pushing where the element is as far behind as the thickness. If the sheet lies
    /// in front of the element at this point, the element did not go round the rim.
    fn came_out_of_sheet(&self, record: &ContactRecord, line: &Line) -> bool {
        let body = self.context.body_b;
        let view = TriangleView::new(&body.triangles, record.element_b);
        let (before, now) = (-view.height(&line.from_b), -view.height(&line.to_b));
        if before <= 0.0 || now <= before {
            return false;
        }
        let mut sheets = body.primitives.iter().filter(|info| info.kind == PrimitiveKind::Triangle);
        let sheet = sheets.find(|info| info.elements.contains(&record.element_b));
        let thickness = sheet.and_then(|info| info.thickness).unwrap_or_else(|| self.smallest_of(record));
        let lost = ((thickness - before) / divisor(now - before)).clamp(0.0, 1.0);
        let place = line.from_b + (line.to_b - line.from_b) * lost;
        let above = place + record.normal_b * (2.0 * now.min(thickness));
        self.sheet_between(&above, &place, record.key.shell_b)
    }

    /// Smallest semi-axis of the element of a contact, m; 0 for kinds without a radius.
    fn smallest_of(&self, record: &ContactRecord) -> f64 {
        let body = self.context.body_a;
        let info = &body.primitives[record.key.primitive_a as usize];
        let facts = body.element(info.kind, info.elements.start).facts();
        facts.and_then(|facts| facts.smallest_radius_m()).unwrap_or(0.0)
    }

    /// Returns true if a path goes through a shell of triangles from the front.
    fn sheet_between(&self, from: &Vec3, to: &Vec3, shell: u32) -> bool {
        let body = self.context.body_b;
        let Some(ray) = Ray::between(from, to) else { return false };
        let mut hit = false;
        for batch in body.tree.batches.iter().filter(|batch| batch.kind == PrimitiveKind::Triangle) {
            let query = batch.boxes.narrowed(&from.inf(to), &from.sup(to));
            batch.boxes.visit(Portable, &query, |node, met| {
                for lane in lanes(met) {
                    let Child::Element(place) = node.child(lane) else { continue };
                    let element = body.tree.items[(batch.items.start + place) as usize].element;
                    hit = hit
                        || (body.triangles.triangles[element as usize].shell == shell
                            && ray_triangle(&ray, &body.triangles, element, 0.0).is_some());
                }
            });
        }
        hit
    }
}
