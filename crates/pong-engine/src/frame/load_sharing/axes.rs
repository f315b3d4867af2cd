//! Load sharing of capsules, cylinders and cones on triangles (docs/theory.md, 2.8). The two ends of the axis yield, each
//! with half a spring, until the body touches the surface nowhere. The places of contact are those of the body as it is.

use super::solver::two_ends::{Loaded, SIZE};
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::frame::narrow_phase::element_pair::{BETWEEN_DISCS, BETWEEN_ENDS};
use crate::frame::narrow_phase::nearest_side::{Nearby, visit_triangles};
use crate::state::{ContactKey, ContactRole};
use pong_arena::{Arena, Full, List};
use pong_geometry::Vec3;
use pong_geometry::interference::FeatureKind;
use pong_geometry::interference::axis_triangle::{AxisLine, AxisPlace, Reached, axis_triangle};
use pong_geometry::interference::side_triangle::{Lowest, side_triangle};
use pong_geometry::primitive::{Capsule, Frustum, PrimitiveKind, TriangleSet};
use pong_model::Item;

/// Most places of contact of one body with one surface.
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

/// Touch of the ends of a body with a surface of triangles: it decides whether they may yield as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Touch {
    /// They may not.
    Apart,
    /// All of the surface is before the ends.
    InFront,
    /// An end disc is behind some face, as that of a drum beside the end of a block that it lies on.
    Beside,
}

impl Touch {
    /// Judges the contacts of the ends and those between them. The ends of a capsule, and of a cylinder or a cone, yield as
    /// one if an edge is beside the axis; otherwise only faces push, and each end yields for itself. They do not where an
    /// end is behind the surface, came from behind, or stands on it.
    pub fn new(ends: &[ContactCandidate], middle: &[ContactCandidate], is_disc: bool) -> Self {
        let on_triangles = middle.first().is_some_and(|contact| contact.kind_b == PrimitiveKind::Triangle);
        if !on_triangles || !middle.iter().any(ContactCandidate::takes_part) {
            return Self::Apart;
        }
        let mut touch = Self::InFront;
        for contact in ends.iter().filter(|contact| contact.status != CandidateStatus::Culled) {
            let is_behind =
                matches!(contact.status, CandidateStatus::BackFace | CandidateStatus::BackFaceFallback);
            if contact.role == ContactRole::Active && !is_behind {
                continue;
            }
            if !is_disc || contact.key.end >= BETWEEN_ENDS || contact.role == ContactRole::WrongSide {
                return Self::Apart;
            }
            touch = Self::Beside;
        }
        touch
    }
}

/// Assigns the weights of the contacts of a body with one surface of triangles. `ends` have the weights of each end for
/// itself, `middle` are contacts between the ends with edges. Contacts at places where no tester found one are returned
/// in `added`. Returns `false`, with nothing changed, if the axis has reached the surface, or if some contacts that carry
/// load are more than 90° apart.
///
/// # Errors
/// [`Full`] if the places of contact did not fit into the scratch memory. Nothing is changed then.
pub(super) fn share(
    context: &PairContext<'_>,
    touch: Touch,
    (ends, middle): (&mut [ContactCandidate], &mut [ContactCandidate]),
    added: &mut Added,
    scratch: &mut Arena,
) -> Result<bool, Full> {
    let any = middle[0];
    let body = Body::new(context, &any);
    scratch.reset();
    let scratch = &*scratch;
    let mut bar = Bar { body: &body, places: scratch.list(PLACES)?, items: scratch.list(PLACES)? };
    if bar.find_places(context, any.key.shell_b)?.is_err() {
        return Ok(false);
    }
    bar.add_touched(ends)?;
    if !bar.keep_one_plane(&context.body_b.triangles) && touch == Touch::Beside {
        return Ok(false);
    }
    let [one, other] = body.ends();
    let rounding = ROUNDING * (one.amax() + other.amax());
    let Some(loaded) = Loaded::new(&bar.places, rounding).filter(|loaded| bar.are_coupled(loaded)) else {
        return Ok(false);
    };
    bar.write(&loaded, (ends, middle), (&any, added));
    Ok(true)
}

/// A body with two ends, in B's frame.
enum Body {
    Capsule(Capsule),
    Frustum(Frustum),
}

impl Body {
    fn new(context: &PairContext<'_>, found: &ContactCandidate) -> Self {
        let (body, x_ba) = (context.body_a, &context.motion.x_ba);
        let element = found.element_a as usize;
        match body.primitives[found.key.primitive_a as usize].kind {
            PrimitiveKind::Capsule => Self::Capsule(body.capsules[element].carried(x_ba)),
            _ => Self::Frustum(body.frusta[element].carried(x_ba)),
        }
    }

    fn ends(&self) -> &[Vec3; 2] {
        match self {
            Self::Capsule(capsule) => &capsule.ends,
            Self::Frustum(frustum) => &frustum.ends,
        }
    }

    /// Capsule around the axis that has the body's side in it.
    fn around(&self) -> Capsule {
        match self {
            Self::Capsule(capsule) => *capsule,
            Self::Frustum(Frustum { ends, radii, .. }) => {
                Capsule { ends: *ends, radius: radii[0].max(radii[1]) }
            }
        }
    }

    /// Place on the axis, m.
    fn at(&self, along: f64) -> Vec3 {
        let [one, other] = self.ends();
        one * (1.0 - along) + other * along
    }

    /// Depths of the two ends below the plane of a place, m.
    fn depths(&self, place: &AxisPlace) -> [f64; 2] {
        let below = match self {
            Self::Capsule(Capsule { ends, .. }) => *ends,
            Self::Frustum(frustum) => Lowest::new(frustum, &place.normal_b).points_b,
        };
        let rise = -place.normal_b.dot(&(below[1] - below[0]));
        [0.0, 1.0].map(|end| place.depth + rise * (end - place.along))
    }

    /// Height of the axis above the lowest place of the body, along the normal of a place, m.
    fn thickness(&self, normal: &Vec3, along: f64) -> f64 {
        match self {
            Self::Capsule(capsule) => capsule.radius,
            Self::Frustum(frustum) => Lowest::new(frustum, normal).thickness(along),
        }
    }

    fn deepest(&self, normal: &Vec3, along: f64) -> Vec3 {
        match self {
            Self::Capsule(capsule) => self.at(along) - normal * capsule.radius,
            Self::Frustum(frustum) => Lowest::new(frustum, normal).point(along),
        }
    }
}

/// A body and the places at which a surface may push it.
struct Bar<'a> {
    body: &'a Body,
    places: List<'a, AxisPlace>,
    /// Where the places come from.
    items: List<'a, Source>,
}

/// Origin of a place.
#[derive(Clone, Copy)]
struct Source {
    /// Triangle.
    item: Item,
    /// Index of the contact of an end that a tester has found.
    touched: Option<usize>,
}

impl Bar<'_> {
    /// Finds the places at which a surface may push.
    fn find_places(&mut self, context: &PairContext<'_>, shell: u32) -> Result<Result<(), Reached>, Full> {
        let around = self.body.around();
        let [one, other] = &around.ends;
        let reach = Vec3::repeat(around.radius);
        let body = context.body_b;
        let line = AxisLine::new(&around);
        let (mut room, mut in_front) = (Ok(()), Ok(()));
        visit_triangles(body, &(one.inf(other) - reach), &(one.sup(other) + reach), &mut |item| {
            let set = &body.triangles;
            if set.triangles[item.element as usize].shell != shell || line.misses(&set.corners(item.element))
            {
                return;
            }
            let is_back = Nearby { body, item, center_b: *one }.is_mirror();
            let visit = &mut |place: &AxisPlace| {
                let source = Source { item, touched: None };
                room = room.and(self.places.push(*place)).and(self.items.push(source));
            };
            let found = match self.body {
                Body::Capsule(capsule) => axis_triangle(capsule, set, item.element, is_back, visit),
                Body::Frustum(frustum) => side_triangle(frustum, set, item.element, is_back, visit),
            };
            in_front = in_front.and(found);
        });
        self.sort();
        room.map(|()| in_front)
    }

    /// Sorts the places by triangle: of equal ones the first pushes, in whatever order the bounding volumes gave them.
    fn sort(&mut self) {
        let key = |source: &Source| (source.item.primitive, source.item.element);
        for index in 1..self.items.len() {
            let mut to = index;
            while to > 0 && key(&self.items[to - 1]) > key(&self.items[to]) {
                self.items.swap(to - 1, to);
                self.places.swap(to - 1, to);
                to -= 1;
            }
        }
    }

    /// Adds what touches the discs, in place of the faces that were found there, too. What touches an edge or a vertex
    /// between the discs is there already.
    fn add_touched(&mut self, ends: &[ContactCandidate]) -> Result<(), Full> {
        if let Body::Capsule(_) = self.body {
            return Ok(());
        }
        for (index, contact) in ends.iter().enumerate().filter(|(_, contact)| contact.takes_part()) {
            let along = f64::from(contact.key.end);
            let item = Item { primitive: contact.primitive_b, element: contact.element_b };
            let is_same = |place: &AxisPlace| {
                place.feature == contact.feature && (!place.feature.is_face() || place.along == along)
            };
            match self.places.iter().position(is_same) {
                Some(same) if contact.feature.is_face() => self.items[same].touched = Some(index),
                Some(_) => {}
                None => {
                    self.places.push(AxisPlace {
                        normal_b: contact.normal_b,
                        along,
                        depth: contact.depth,
                        part: [along; 2],
                        feature: contact.feature,
                    })?;
                    self.items.push(Source { item, touched: Some(index) })?;
                }
            }
        }
        Ok(())
    }

    /// Drops all places but those on one plane that has all triangles of the places behind it, if there is one. They are
    /// convex then: what is clear of the plane is clear of them, and the other places say nothing new. Deep in the
    /// surface their normals would ask for more. Returns false if there is no such plane, or if the axis of a cylinder
    /// or a cone has sunk through it.
    fn keep_one_plane(&mut self, set: &TriangleSet) -> bool {
        let Some(best) = self.one_plane(set) else { return false };
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
        let is_above =
            |end: usize, depth: f64| depth <= 0.0 || depth < self.body.thickness(&best.normal_b, end as f64);
        let depths = self.body.depths(&best);
        depths.into_iter().enumerate().all(|(end, depth)| is_above(end, depth))
    }

    /// Returns a place on the plane that has all triangles of the places behind it. A capsule is pushed to the plane on
    /// which it stores most in the places found, a disc, which may have several ways out of a solid, to that of the least.
    fn one_plane(&self, set: &TriangleSet) -> Option<AxisPlace> {
        let has_all_behind = |place: &AxisPlace| {
            let slack = BEHIND_SLACK * self.body.around().radius;
            let height = (self.body.thickness(&place.normal_b, place.along) - place.depth) - slack;
            let center = self.body.at(place.along);
            let is_behind = |corner: Vec3| place.normal_b.dot(&(center - corner)) >= height;
            self.items.iter().all(|source| set.corners(source.item.element).into_iter().all(is_behind))
        };
        if let Body::Capsule(Capsule { ends, .. }) = self.body {
            let axis = ends[1] - ends[0];
            let most = self.places.iter().map(|place| (place.greatest_square(&axis), *place));
            let (_, best) = most.reduce(|a, b| if b.0 > a.0 { b } else { a })?;
            return has_all_behind(&best).then_some(best);
        }
        let mut least: Option<(f64, AxisPlace)> = None;
        for place in self.places.iter() {
            let stored: f64 =
                self.body.depths(place).map(|depth| depth.max(0.0)).iter().map(|depth| depth * depth).sum();
            if least.is_none_or(|(least, _)| stored < least) && has_all_behind(place) {
                least = Some((stored, *place));
            }
        }
        least.map(|(_, place)| place)
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
        let between = if let Body::Capsule(_) = self.body { BETWEEN_ENDS } else { BETWEEN_DISCS };
        for contact in ends.iter_mut().chain(&mut *middle).filter(|contact| contact.takes_part()) {
            contact.weight = 0.0;
        }
        for &(index, load) in loaded.members() {
            let (Source { item, touched }, place) = (&self.items[index], &self.places[index]);
            if let Some(touched) = *touched {
                ends[touched].weight += load / place.depth;
                continue;
            }
            for (end, share) in place.shares().into_iter().enumerate().filter(|(_, share)| load * share > 0.0)
            {
                let along = place.part[end];
                let key = ContactKey { end: end_of(along, between + end as u32), ..any.key };
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
                contact.deepest_b = self.body.deepest(&place.normal_b, along);
                contact.weight += load * share / place.depth;
                contact.status = CandidateStatus::Front;
            }
        }
        for contact in middle.iter_mut().filter(|contact| contact.weight == 0.0) {
            contact.status = CandidateStatus::Culled;
        }
    }
}

/// Number of the end in the key of a contact at a place of the axis. `between` is that of a place between the ends:
/// contacts of one key and normal share a bristle.
fn end_of(along: f64, between: u32) -> u32 {
    match along {
        0.0 => 0,
        1.0 => 1,
        _ => between,
    }
}
