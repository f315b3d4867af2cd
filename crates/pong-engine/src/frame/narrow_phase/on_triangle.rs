//! Common part of the tests of a sphere or an ellipsoid against a triangle: the side from which the centre
//! came, and the thickness of the triangle.

use super::candidate::CandidateStatus;
use super::element_pair::{ChunkCandidates, ElementPair};
use super::nearest_side::{KnownSides, Nearby};
use super::side_of_entry::TriangleEntry;
use crate::frame::broad_phase::chunk::Ellipsoidal;
use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::input::PairContext;
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;
use pong_geometry::interference::ellipsoid_triangle::ellipsoid_triangle;
use pong_geometry::interference::end_disc::EndDisc;
use pong_geometry::interference::sphere_triangle::sphere_triangle;
use pong_geometry::interference::triangle_features::{Standing, TriangleContact};
use pong_geometry::primitive::{Ellipsoid, Primitive, Sphere};
use pong_model::Item;

/// Centre of a sphere, of an ellipsoid, or of a capsule's end sphere.
pub(crate) struct Centre {
    /// Centre in A's frame, m.
    pub center_a: Vec3,
    /// Centre in B's frame, m.
    pub center_b: Vec3,
    /// End index, for a capsule.
    pub end: Option<u32>,
}

/// Adds a contact of a sphere or ellipsoid with one triangle, with its role. Adds nothing if the centre is
/// behind the feature and did not come from the front.
pub(crate) fn on_triangle(
    pair: &ElementPair<'_>,
    center: &Centre,
    contact: TriangleContact,
    found: &mut ChunkCandidates<'_>,
) {
    let earlier = pair.motion().since_commit.map(|since| since.x_ba.point(&center.center_a));
    if earlier.is_none() && is_set_down_in_front(pair, center, &contact, &mut found.sides) {
        return;
    }
    let key = pair.key_at(center.end.unwrap_or(0));
    let remembered = pair.context.memory.under(&key);
    let entry = TriangleEntry {
        remembered: &remembered,
        shell: key.shell_b,
        body: pair.body_b(),
        triangle: pair.item_b,
        center_b: center.center_b,
        earlier_b: earlier,
        touched_behind: &|feature| touched_triangle_behind(pair, center.end, feature),
    };
    let Some(role) = entry.role(&contact) else { return };
    pair.emit(key, &contact.interference, found, |out| {
        out.remembered = Some(remembered.range);
        out.share(center.end.is_some());
        out.role = role;
        out.status = match contact.standing {
            Standing::Front => CandidateStatus::Front,
            Standing::Behind => CandidateStatus::BackFace,
            Standing::Spare => CandidateStatus::Fallback,
            Standing::SpareBehind => CandidateStatus::BackFaceFallback,
            Standing::StandIn => CandidateStatus::StandIn,
        };
    });
}

/// Returns true if A touched this feature of the triangle at the last commit while the centre was behind the
/// feature. It does not matter whether that contact pushed.
fn touched_triangle_behind(pair: &ElementPair<'_>, end: Option<u32>, feature: Feature) -> bool {
    let Some(since) = pair.motion().since_commit else { return false };
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let mut touched = false;
    let mut note = |contact: TriangleContact| {
        let is_behind = matches!(contact.standing, Standing::Behind | Standing::StandIn);
        touched |= contact.interference.feature == feature && is_behind;
    };
    let mut note_sphere = |sphere: &Sphere| {
        let thickness = thickness_for_sphere(pair.context, pair.item_b, sphere);
        sphere_triangle(sphere, set, triangle, thickness, &mut note);
    };
    let Item { primitive, element } = pair.item_a;
    let kind = pair.body_a().primitives[primitive as usize].kind;
    match TransformedPrimitive::new(pair.body_a(), kind, element, &since.x_ba) {
        Some(TransformedPrimitive::Sphere(sphere)) => note_sphere(&sphere),
        Some(TransformedPrimitive::Capsule(capsule)) => {
            let center = capsule.ends[end.unwrap_or(0) as usize];
            note_sphere(&Sphere { center, radius: capsule.radius });
        }
        Some(TransformedPrimitive::Ellipsoid(ellipsoid)) => {
            let thickness = thickness_for_ellipsoid(pair.context, pair.item_b, &ellipsoid);
            ellipsoid_triangle(&ellipsoid, set, triangle, thickness, &mut note);
        }
        Some(TransformedPrimitive::Frustum(frustum)) => {
            let disc = EndDisc { frustum: &frustum, end: end.unwrap_or(0) as usize % 2 };
            disc.on_triangle(set, triangle, thickness_for_disc(pair.context, pair.item_b, &disc), &mut note);
        }
        _ => {}
    }
    touched
}

/// Distance behind a triangle up to which an ellipsoid's centre is pushed to the front, m: the `thickness` of
/// the model, otherwise the smallest semi-axis.
pub(crate) fn thickness_for_ellipsoid(
    context: &PairContext<'_>,
    triangle: Item,
    ellipsoid: &Ellipsoid,
) -> f64 {
    let given = context.body_b.primitives[triangle.primitive as usize].thickness;
    given.unwrap_or(ellipsoid.smallest_semi_axis())
}

/// Distance behind a triangle up to which the centre of an end disc is pushed to the front, m: the `thickness` of the
/// model, otherwise the smaller radius of the body.
pub(crate) fn thickness_for_disc(context: &PairContext<'_>, triangle: Item, disc: &EndDisc<'_>) -> f64 {
    let given = context.body_b.primitives[triangle.primitive as usize].thickness;
    given.or(disc.frustum.smallest_radius_m()).unwrap_or(0.0)
}

/// Returns true if a centre without an earlier position is behind the contact's feature, but in front of the
/// surface at the surface point nearest to it. Such a contact does not count.
fn is_set_down_in_front(
    pair: &ElementPair<'_>,
    center: &Centre,
    contact: &TriangleContact,
    sides: &mut KnownSides,
) -> bool {
    let nearby = Nearby { body: pair.body_b(), item: pair.item_b, center_b: center.center_b };
    let end = center.end.unwrap_or(0);
    nearby.is_behind(contact) && sides.in_front((pair.item_a, end), nearby.surface(), || nearby.is_in_front())
}

/// Distance behind a triangle up to which a sphere's centre is pushed to the front, m: the `thickness` of the
/// model, otherwise the radius.
#[inline]
pub(crate) fn thickness_for_sphere(context: &PairContext<'_>, triangle: Item, sphere: &Sphere) -> f64 {
    context.body_b.primitives[triangle.primitive as usize].thickness.unwrap_or(sphere.radius)
}

/// Distance behind a triangle up to which an element's centre is pushed to the front, m.
#[inline(always)]
pub(crate) fn thickness_for(context: &PairContext<'_>, element: &Ellipsoidal<'_>, triangle: Item) -> f64 {
    match element {
        Ellipsoidal::Ellipsoid(ellipsoid) => thickness_for_ellipsoid(context, triangle, ellipsoid),
        Ellipsoidal::Sphere(sphere) => thickness_for_sphere(context, triangle, sphere),
    }
}
