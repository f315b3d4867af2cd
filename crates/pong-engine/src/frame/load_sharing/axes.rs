//! Load sharing of capsules, cylinders and cones on triangles (docs/theory.md, 2.8). The two ends of the axis yield, each
//! with half a spring, until the body touches the surface nowhere. The places of contact are those of the body as it is.

use super::solver::two_ends::{Loaded, SIZE};
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::{CandidateStatus, ContactCandidate};
use crate::frame::narrow_phase::element_pair::{BETWEEN_DISCS, BETWEEN_ENDS};
use crate::frame::narrow_phase::nearest_side::{Nearby, visit_triangles};
use crate::frame::narrow_phase::on_triangle::thickness_for_disc;
use crate::state::{ContactKey, ContactRole};
use pong_arena::{Arena, Full, List};
use pong_geometry::Vec3;
use pong_geometry::distance::Solid;
use pong_geometry::interference::axis_triangle::{AxisLine, AxisPlace, Reached, axis_triangle};
use pong_geometry::interference::end_disc::EndDisc;
use pong_geometry::interference::frustum_stand::Stand;
use pong_geometry::interference::side_triangle::{Lowest, Push, side_triangle};
use pong_geometry::interference::{Feature, FeatureKind};
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
/// Such a distance for the plane on which a cylinder or a cone stands. Vertices in single precision, 10 m from the origin,
/// are off by some 4e-7 m, and planes of small triangles by ten times that at the far rim.
const FLAT_SLACK: f64 = 1e-4;
/// Difference of two unit normals up to which two faces count as one plane.
const PLANE_SLACK: f64 = 1e-7;
/// Most planes through triangles, edges and vertices beside one cylinder or cone.
const STANDS: usize = 1024;
/// Part of an energy, far above rounding, by which one plane must be better than another.
const TIE: f64 = 1.0 - 1e-12;

/// Contacts that carry load where no tester found one: at most two for each place that carries load.
pub(super) type Added = [Option<ContactCandidate>; 2 * SIZE];

/// Touch of the ends of a body with a surface of triangles: it decides whether they may yield as one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Touch {
    /// They may not.
    Apart,
    /// All of the surface is before the ends.
    InFront,
    /// An end disc is behind some face: it stands on it, or the body lies on a block with its flat end beside that of the
    /// block.
    Behind,
    /// No edge is beside the axis, but a disc is below a face, and no plane holds its lowest and its highest place: it may
    /// stand on faces that are nearly one plane.
    OnFaces,
}

impl Touch {
    /// Judges the contacts of the ends and those between them with edges, or with the face under a disc. The ends of a
    /// capsule, and of a cylinder or a cone, yield as one if an edge is beside the axis; otherwise only faces push, and
    /// each end yields for itself. They do not where an end came from behind, or where the ball of a capsule is behind the
    /// surface.
    pub fn new(ends: &[ContactCandidate], middle: &[ContactCandidate], is_disc: bool) -> Self {
        let beside = || middle.iter().filter(|contact| contact.takes_part());
        let on_triangles = middle.first().is_some_and(|contact| contact.kind_b == PrimitiveKind::Triangle);
        if !on_triangles || beside().next().is_none() {
            return Self::Apart;
        }
        if beside().all(|contact| contact.feature.is_face()) {
            let is_wrong = ends.iter().any(|contact| contact.role == ContactRole::WrongSide);
            return if is_wrong || hold_a_disc(ends) { Self::Apart } else { Self::OnFaces };
        }
        let mut touch = Self::InFront;
        for contact in ends.iter().filter(|contact| contact.status != CandidateStatus::Culled) {
            let is_behind =
                matches!(contact.status, CandidateStatus::BackFace | CandidateStatus::BackFaceFallback);
            if contact.role == ContactRole::Active && !is_behind {
                continue;
            }
            if !is_disc || contact.role == ContactRole::WrongSide {
                return Self::Apart;
            }
            touch = Self::Behind;
        }
        touch
    }
}

/// Returns true if one plane holds the lowest and the highest place of a disc.
fn hold_a_disc(ends: &[ContactCandidate]) -> bool {
    /// Difference of two unit normals from rounding alone: a disc that is level up to another has other places.
    const SAME: f64 = 16.0 * f64::EPSILON;
    let is_highest_of = |low: &ContactCandidate, other: &ContactCandidate| {
        other.key.end == low.key.end + 2 && (low.normal_b - other.normal_b).norm() <= SAME
    };
    let on_faces = || ends.iter().filter(|contact| contact.takes_part() && contact.feature.is_face());
    on_faces().any(|low| on_faces().any(|other| is_highest_of(low, other)))
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
    let mut bar = Bar {
        body: &body,
        places: scratch.list(PLACES)?,
        items: scratch.list(PLACES)?,
        stands: scratch.list(STANDS)?,
        near: scratch.list(STANDS)?,
    };
    let in_front = bar.find_places(context, any.key.shell_b)?;
    match &body {
        Body::Capsule(_) if in_front.is_err() => return Ok(false),
        Body::Capsule(capsule) => bar.keep_one_plane(&context.body_b.triangles, capsule),
        Body::Frustum(frustum) => {
            bar.add_touched(ends)?;
            let is_held = ends.iter().any(ContactCandidate::takes_part);
            let on_one = bar.one_stand(&context.body_b.triangles, frustum);
            match on_one.filter(|(stand, item)| is_before(context, frustum, (stand, *item), is_held)) {
                Some((stand, _)) if touch == Touch::OnFaces && !stand.is_sunk() => return Ok(false),
                Some((stand, _)) if in_front.is_ok() && stand.lies() && bar.keep_on(&stand) => {}
                Some(on_one) => {
                    write_stand(frustum, on_one, (ends, middle), (&any, added));
                    return Ok(true);
                }
                None if in_front.is_err() || touch != Touch::InFront => return Ok(false),
                None => {}
            }
        }
    }
    let [one, other] = body.ends();
    let rounding = ROUNDING * (one.amax() + other.amax());
    let Some(loaded) = Loaded::new(&bar.places, rounding).filter(|loaded| bar.are_coupled(loaded)) else {
        return Ok(false);
    };
    bar.write(&loaded, (ends, middle), (&any, added));
    Ok(true)
}

/// Returns true if a body is in front of a plane on which it is to stand: the middle of its axis is, or one of its discs is
/// held already (`is_held`). A disc wholly below the plane may have its centre so far below as a disc alone on a triangle.
fn is_before(
    context: &PairContext<'_>,
    frustum: &Frustum,
    (stand, item): (&Stand, Item),
    is_held: bool,
) -> bool {
    let below = frustum.ends.map(|end| stand.normal_b.dot(&(stand.point_b - end)));
    let is_sunk = [0, 1].map(|end| stand.at.depths[end + 2] > 0.0);
    let may_be_below = |end: usize| {
        !is_sunk[end] || below[end] < thickness_for_disc(context, item, &EndDisc { frustum, end })
    };
    (below[0] + below[1] < 0.0 || is_held && (is_sunk[0] || is_sunk[1])) && may_be_below(0) && may_be_below(1)
}

/// Writes the contacts of a body that stands on one plane, at its lowest and highest places, each with half a spring.
fn write_stand(
    frustum: &Frustum,
    (stand, item): (Stand, Item),
    (ends, middle): (&mut [ContactCandidate], &mut [ContactCandidate]),
    (any, added): (&ContactCandidate, &mut Added),
) {
    ends.iter_mut().filter(|contact| contact.takes_part()).for_each(|contact| contact.weight = 0.0);
    middle.iter_mut().for_each(|contact| contact.status = CandidateStatus::Culled);
    let places = stand.at.places(frustum);
    for (index, deepest_b) in
        places.into_iter().enumerate().filter(|(index, _)| stand.at.depths[*index] > 0.0)
    {
        let key = ContactKey { end: index as u32, ..any.key };
        let same = |contact: &&mut ContactCandidate| {
            let is_there = match stand.feature.kind() {
                FeatureKind::Face => {
                    contact.feature.is_face() && is_one_plane(&contact.normal_b, &stand.normal_b)
                }
                FeatureKind::Edge | FeatureKind::Vertex => contact.feature == stand.feature,
            };
            contact.takes_part() && contact.key == key && is_there
        };
        let contact = match ends.iter_mut().find(same) {
            Some(contact) => contact,
            None => added[index].insert(fresh(any, key, item, stand.feature)),
        };
        (contact.normal_b, contact.depth, contact.deepest_b) =
            (stand.normal_b, stand.at.depths[index], deepest_b);
        (contact.weight, contact.status) = (1.0, CandidateStatus::Front);
    }
}

/// Contact with half a spring where no tester found one; place and load are not set.
fn fresh(any: &ContactCandidate, key: ContactKey, item: Item, feature: Feature) -> ContactCandidate {
    ContactCandidate {
        key,
        primitive_b: item.primitive,
        element_a: any.element_a,
        element_b: item.element,
        feature,
        kind_b: PrimitiveKind::Triangle,
        lane: any.lane,
        half: true,
        shares: true,
        weight: 0.0,
        ..ContactCandidate::NOTHING
    }
}

fn is_one_plane(one: &Vec3, other: &Vec3) -> bool {
    (one - other).norm() <= PLANE_SLACK
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
    /// Planes that touch a triangle, and the triangle; for a cylinder or a cone alone.
    stands: List<'a, (Stand, Item)>,
    /// Triangles beside a cylinder or a cone.
    near: List<'a, Item>,
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
        let (mut room, mut stood, mut in_front) = (Ok(()), Ok(()), Ok(()));
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
                Body::Frustum(frustum) => {
                    let mut room = self.near.push(item);
                    let found = side_triangle(frustum, set, item.element, is_back, &mut |push| match push {
                        Push::Place(place) => visit(place),
                        Push::Stand(stand) => room = room.and(self.stands.push((*stand, item))),
                    });
                    stood = stood.and(room);
                    found
                }
            };
            in_front = in_front.and(found);
        });
        self.sort();
        room.and(stood).map(|()| in_front)
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
        let key = |(_, item): &(Stand, Item)| (item.primitive, item.element);
        for index in 1..self.stands.len() {
            let mut to = index;
            while to > 0 && key(&self.stands[to - 1]) > key(&self.stands[to]) {
                self.stands.swap(to - 1, to);
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
        let is_low = |contact: &ContactCandidate| contact.takes_part() && contact.key.end < BETWEEN_ENDS;
        for (index, contact) in ends.iter().enumerate().filter(|(_, contact)| is_low(contact)) {
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

    /// Drops all places of a capsule but those on one plane that has all triangles of the places behind it, if there is one:
    /// that on which the capsule stores most. They are convex then: what is clear of the plane is clear of them, and the
    /// other places say nothing new. Deep in the surface their normals would ask for more.
    fn keep_one_plane(&mut self, set: &TriangleSet, capsule: &Capsule) {
        let axis = capsule.ends[1] - capsule.ends[0];
        let most = self.places.iter().map(|place| (place.greatest_square(&axis), *place));
        let Some((_, best)) = most.reduce(|a, b| if b.0 > a.0 { b } else { a }) else { return };
        let height = (capsule.radius - best.depth) - BEHIND_SLACK * capsule.radius;
        let center = self.body.at(best.along);
        let is_behind = |corner: Vec3| best.normal_b.dot(&(center - corner)) >= height;
        if self.items.iter().all(|source| set.corners(source.item.element).into_iter().all(is_behind)) {
            self.keep(best.feature, &best.normal_b);
        }
    }

    /// Drops all places that are not on the plane on which a body stands. Returns false, with nothing dropped, if none is.
    fn keep_on(&mut self, stand: &Stand) -> bool {
        self.keep(stand.feature, &stand.normal_b)
    }

    fn keep(&mut self, feature: Feature, normal_b: &Vec3) -> bool {
        let is_kept = |place: &AxisPlace| match feature.kind() {
            FeatureKind::Face => is_one_plane(&place.normal_b, normal_b),
            FeatureKind::Edge | FeatureKind::Vertex => place.feature == feature,
        };
        if !self.places.iter().any(is_kept) {
            return false;
        }
        let mut kept = 0;
        for index in 0..self.places.len() {
            if is_kept(&self.places[index]) {
                (self.places[kept], self.items[kept]) = (self.places[index], self.items[index]);
                kept += 1;
            }
        }
        self.places.truncate(kept);
        self.items.truncate(kept);
        true
    }

    /// Returns the plane on which a cylinder or a cone stores least, of those that have all triangles that it touches behind
    /// them. They are convex then, and a body that is clear of the plane is clear of them. One that stores nothing tells that
    /// the body touches none.
    fn one_stand(&self, set: &TriangleSet, frustum: &Frustum) -> Option<(Stand, Item)> {
        /// Planes that are tried, from that of the least energy.
        const TRIES: usize = 64;
        let slack = FLAT_SLACK * self.body.around().radius;
        let is_behind = |stand: &Stand, item: &Item| {
            let is_behind = |corner: Vec3| stand.normal_b.dot(&(corner - stand.point_b)) <= slack;
            set.corners(item.element).into_iter().all(is_behind)
        };
        let solid = Solid::frustum(frustum);
        let is_touched = |item: &Item| {
            self.items.iter().any(|source| source.item == *item)
                || solid.to_within(&Solid::triangle(set.corners(item.element)), 0.0).is_some()
        };
        let mut tried = (-1.0, None);
        // Triangle that was in front of a plane, which likely is in front of the next.
        let mut in_front: Option<Item> = None;
        for _ in 0..TRIES {
            let mut best: Option<(f64, usize)> = None;
            for (index, (stand, _)) in self.stands.iter().enumerate() {
                let energy = stand.at.energy;
                let is_next = (energy, Some(index)) > tried;
                // Of planes that differ by rounding the first counts.
                if is_next && best.is_none_or(|(least, _)| energy < least * TIE) {
                    best = Some((energy, index));
                }
            }
            let (energy, index) = best?;
            tried = (energy, Some(index));
            let (stand, _) = &self.stands[index];
            if in_front.is_some_and(|item| !is_behind(stand, &item)) {
                continue;
            }
            in_front = self.near.iter().find(|item| !is_behind(stand, item) && is_touched(item)).copied();
            if in_front.is_none() {
                let (mut stand, item) = self.stands[index];
                // Two that are apart may have a plane that stores something as the least that was found.
                if !is_touched(&item) && !self.near.iter().any(is_touched) {
                    stand.at.depths = [0.0; 4];
                }
                return Some((stand, item));
            }
        }
        None
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
                let fresh = fresh(any, key, *item, place.feature);
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
