//! Load sharing of capsules on triangles (docs/theory.md, 2.8). The two ends of the axis yield, each with half a spring,
//! until the capsule touches the surface nowhere. The places of contact are those of the axis as it is.

use super::solver::two_ends::{Loaded, SIZE};
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::frame::narrow_phase::element_pair::BETWEEN_ENDS;
use crate::frame::narrow_phase::nearest_side::{Nearby, visit_triangles};
use crate::state::{ContactKey, ContactRole};
use pong_arena::{Arena, Full, List};
use pong_geometry::Vec3;
use pong_geometry::interference::FeatureKind;
use pong_geometry::interference::axis_triangle::{AxisLine, AxisPlace, Reached, axis_triangle};
use pong_geometry::primitive::{Capsule, PrimitiveKind, TriangleSet};
use pong_model::Item;

/// Most places of contact of one capsule with one surface.
const PLACES: usize = 512;
/// Rounding of a depth, relative to the coordinates.
const ROUNDING: f64 = 1e-15;
/// Product of two normals below which contacts count as more than 90° apart, as in load sharing of spheres.
const APART_COSINE: f64 = -1e-14;

/// Distance, relative to the radius, by which a corner may be in front of a plane that has the surface behind it.
const BEHIND_SLACK: f64 = 1e-9;
/// Difference of two unit normals up to which two faces count as one plane.
const PLANE_SLACK: f64 = 1e-7;

/// Contacts that carry load where no tester found one: at most two for each place that carries load.
pub(super) type Added = [Option<ContactCandidate>; 2 * SIZE];

/// Returns true if the ends of a capsule yield as one on a surface of triangles: an edge is beside the axis. Otherwise only
/// faces push, and each end yields for itself. False, too, if an end is behind the surface, or came from behind.
pub(super) fn yields_as_one(ends: &[ContactCandidate], middle: &[ContactCandidate]) -> bool {
    let is_in_front = |contact: &ContactCandidate| {
        let is_behind =
            matches!(contact.status, CandidateStatus::BackFace | CandidateStatus::BackFaceFallback);
        contact.status == CandidateStatus::Culled || contact.role == ContactRole::Active && !is_behind
    };
    let on_triangles = middle.first().is_some_and(|contact| contact.kind_b == PrimitiveKind::Triangle);
    on_triangles && middle.iter().any(ContactCandidate::takes_part) && ends.iter().all(is_in_front)
}

/// Assigns the weights of the contacts of a capsule with one surface of triangles. `ends` have the weights of each end
/// for itself, `middle` are contacts of the axis with edges. Contacts at places where no tester found one are returned
/// in `added`. Returns `false`, with nothing changed, if the axis has reached the surface, or if some contacts that carry
/// load are more than 90° apart.
///
/// # Errors
/// [`Full`] if the places of contact did not fit into the scratch memory. Nothing is changed then.
pub(super) fn share(
    context: &PairContext<'_>,
    (ends, middle): (&mut [ContactCandidate], &mut [ContactCandidate]),
    added: &mut Added,
    scratch: &mut Arena,
) -> Result<bool, Full> {
    let any = middle[0];
    let local = &context.body_a.capsules[any.element_a as usize];
    let capsule =
        Capsule { ends: local.ends.map(|end| context.motion.x_ba.point(&end)), radius: local.radius };
    scratch.reset();
    let scratch = &*scratch;
    let mut bar = Bar { capsule: &capsule, places: scratch.list(PLACES)?, items: scratch.list(PLACES)? };
    if bar.find_places(context, any.key.shell_b)?.is_err() {
        return Ok(false);
    }
    bar.keep_one_plane(&context.body_b.triangles);
    let rounding = ROUNDING * (capsule.ends[0].amax() + capsule.ends[1].amax());
    let Some(loaded) = Loaded::new(&bar.places, rounding).filter(|loaded| bar.are_coupled(loaded)) else {
        return Ok(false);
    };
    bar.write(&loaded, (ends, middle), (&any, added));
    Ok(true)
}

/// A capsule and the places at which a surface may push it.
struct Bar<'a> {
    capsule: &'a Capsule,
    places: List<'a, AxisPlace>,
    /// Triangles of the places.
    items: List<'a, Item>,
}

impl Bar<'_> {
    /// Finds the places at which a surface may push.
    fn find_places(&mut self, context: &PairContext<'_>, shell: u32) -> Result<Result<(), Reached>, Full> {
        let [one, other] = &self.capsule.ends;
        let reach = Vec3::repeat(self.capsule.radius);
        let body = context.body_b;
        let line = AxisLine::new(self.capsule);
        let (mut room, mut in_front) = (Ok(()), Ok(()));
        visit_triangles(body, &(one.inf(other) - reach), &(one.sup(other) + reach), &mut |item| {
            let set = &body.triangles;
            if set.triangles[item.element as usize].shell != shell || line.misses(&set.corners(item.element))
            {
                return;
            }
            let is_back = Nearby { body, item, center_b: *one }.is_mirror();
            let found = axis_triangle(self.capsule, set, item.element, is_back, &mut |place| {
                room = room.and(self.places.push(*place)).and(self.items.push(item));
            });
            in_front = in_front.and(found);
        });
        room.map(|()| in_front)
    }

    /// Drops all places but those on the plane that stores most, if it has all triangles of the places behind it. They are
    /// convex then: what is clear of the plane is clear of them, and the other places say nothing new. Deep in the
    /// surface their normals would ask for more.
    fn keep_one_plane(&mut self, set: &TriangleSet) {
        let axis = self.capsule.ends[1] - self.capsule.ends[0];
        let stored = |place: &AxisPlace| place.greatest_square(&axis);
        let most = self.places.iter().map(|place| (stored(place), place));
        let Some((_, &best)) = most.reduce(|a, b| if b.0 > a.0 { b } else { a }) else { return };
        // Height of the axis above the plane at the place, less what may be rounding.
        let height = (self.capsule.radius - best.depth) - BEHIND_SLACK * self.capsule.radius;
        let center = at(self.capsule, best.along);
        let is_behind = |corner: Vec3| best.normal_b.dot(&(center - corner)) >= height;
        let are_behind = |item: &Item| set.corners(item.element).into_iter().all(is_behind);
        if !self.items.iter().all(are_behind) {
            return;
        }
        let mut kept = 0;
        for index in 0..self.places.len() {
            let place = self.places[index];
            let is_on_plane = match best.feature.kind() {
                FeatureKind::Face => (place.normal_b - best.normal_b).norm() <= PLANE_SLACK,
                FeatureKind::Edge | FeatureKind::Vertex => place.feature == best.feature,
            };
            if is_on_plane {
                (self.places[kept], self.items[kept]) = (place, self.items[index]);
                kept += 1;
            }
        }
        self.places.truncate(kept);
        self.items.truncate(kept);
    }

    /// Returns true if no two places that carry load, and that share an end, are more than 90° apart.
    fn are_coupled(&self, loaded: &Loaded) -> bool {
        let members = loaded.members();
        let couple = |a: &AxisPlace, b: &AxisPlace| {
            let share = (1.0 - a.along) * (1.0 - b.along) + a.along * b.along;
            share * a.normal_b.dot(&b.normal_b) >= APART_COSINE
        };
        members.iter().all(|&(a, _)| members.iter().all(|&(b, _)| couple(&self.places[a], &self.places[b])))
    }

    /// Writes the contacts that carry load: into the candidates of the same end and feature, otherwise into `added`. The
    /// load of an edge or a vertex acts at the two ends of the part of the axis beside it, which have a bristle each.
    fn write(
        &self,
        loaded: &Loaded,
        (ends, middle): (&mut [ContactCandidate], &mut [ContactCandidate]),
        (any, added): (&ContactCandidate, &mut Added),
    ) {
        for contact in ends.iter_mut().chain(&mut *middle).filter(|contact| contact.takes_part()) {
            contact.weight = 0.0;
        }
        for &(index, load) in loaded.members() {
            let (item, place) = (&self.items[index], &self.places[index]);
            for (end, share) in place.shares().into_iter().enumerate().filter(|(_, share)| load * share > 0.0)
            {
                let along = place.part[end];
                let key = ContactKey { end: end_of(along, end as u32), ..any.key };
                let same = |contact: &&mut ContactCandidate| {
                    contact.takes_part() && (contact.key, contact.feature) == (key, place.feature)
                };
                let found = ends.iter_mut().chain(&mut *middle).chain(added.iter_mut().flatten()).find(same);
                let fresh = ContactCandidate {
                    key,
                    primitive_b: item.primitive,
                    element_a: any.element_a,
                    element_b: item.element,
                    feature: place.feature,
                    kind_b: PrimitiveKind::Triangle,
                    lane: any.lane,
                    half: true,
                    shares: true,
                    weight: 0.0,
                    ..ContactCandidate::NOTHING
                };
                let contact = match found {
                    Some(contact) => contact,
                    None => added.iter_mut().find(|slot| slot.is_none()).expect("two a place").insert(fresh),
                };
                (contact.normal_b, contact.depth) = (place.normal_b, place.depth);
                contact.deepest_b = at(self.capsule, along) - place.normal_b * self.capsule.radius;
                contact.weight += load * share / place.depth;
                contact.status = CandidateStatus::Front;
            }
        }
        for contact in middle.iter_mut().filter(|contact| contact.weight == 0.0) {
            contact.status = CandidateStatus::Culled;
        }
    }
}

/// Number of the end in the key of a contact at a place of the axis. `end` is the end of the part of the axis that the
/// contact is at: contacts of one key and normal share a bristle.
fn end_of(along: f64, end: u32) -> u32 {
    match along {
        0.0 => 0,
        1.0 => 1,
        _ => BETWEEN_ENDS + end,
    }
}

/// Place on the axis of a capsule, m.
fn at(capsule: &Capsule, along: f64) -> Vec3 {
    capsule.ends[0] * (1.0 - along) + capsule.ends[1] * along
}
