//! Sphere (A) – triangle (B), one-sided (docs/theory.md, 2.2).
//!
//! Degenerate cases: a centre in the plane of the triangle counts as in front. If the centre is on a convex
//! edge or vertex, the normal is the mean of the face normals there.

use super::behind_triangle::has_behind;
use super::triangle_features::{
    EdgeClass, Standing, TriangleContact, TriangleEdges, TriangleView, vertex_pushes, walk_fan,
    walk_fan_while,
};
use super::triangle_reach::InReach;
use super::{Feature, Interference, ball_over_point};
use crate::Vec3;
use crate::primitive::{Sphere, TriangleSet};

/// Distance beyond an edge, relative to the coordinates, up to which a centre behind the face still gives a
/// fallback ([`Standing::SpareBehind`]). It is some thousand times the rounding error.
const FOOT_SLACK: f64 = 1e-12;

/// Tests a sphere against one triangle and emits a contact for each of its features that pushes.
///
/// `thickness` (m) is the distance up to which a centre behind the face is still pushed to the front. An edge
/// or a vertex is emitted only by the triangle that owns it, so that each feature of a surface counts once.
#[inline(always)]
pub fn sphere_triangle(
    sphere: &Sphere,
    set: &TriangleSet,
    triangle: u32,
    thickness: f64,
    emit: &mut dyn FnMut(TriangleContact),
) {
    if let Some(mut near) = InReach::of(sphere, set, triangle, thickness) {
        emit_features(sphere, set, &mut near, thickness, emit);
    }
}

/// Returns the contact of a sphere with a triangle of which only the face may push. The sphere's centre must
/// be in front; `None` if the sphere does not reach the face.
#[inline]
pub fn sphere_over_face(sphere: &Sphere, set: &TriangleSet, triangle: u32) -> Option<TriangleContact> {
    let view = TriangleView::new(set, triangle);
    let height = view.height(&sphere.center);
    (height < sphere.radius).then(|| face_contact(sphere, &view, height))
}

fn emit_features(
    sphere: &Sphere,
    set: &TriangleSet,
    near: &mut InReach,
    thickness: f64,
    emit: &mut dyn FnMut(TriangleContact),
) {
    near.view.normal = near.view.normal.normalize();
    let view = &near.view;
    let height = view.height(&sphere.center);
    if height >= sphere.radius || height <= -(thickness.max(sphere.radius)) {
        return;
    }
    let edges = TriangleEdges::new(set, view);
    let beyond = [0, 1, 2].map(|k| {
        let sure = near.beyond[k] | near.within[k];
        if sure { near.beyond[k] } else { edges.is_beyond(k, &sphere.center) }
    });
    match on_convex_rim(sphere, &edges, height) {
        Some(Rim::Edge(k)) => return emit_on_edge(sphere, &edges, k, emit),
        Some(Rim::Vertex(corner)) => return emit_on_vertex(sphere, &edges, corner, emit),
        None => {}
    }
    // A centre that is in front and clearly beyond an edge belongs to another feature.
    let of_other_feature = near.in_front && near.beyond.contains(&true);
    let has_beyond = || match height > 0.0 {
        true => (0..3).all(|k| !beyond[k] || edges.has_on_seam(k, &sphere.center)),
        false => has_behind(&edges, &sphere.center, thickness, 0.0),
    };
    if !of_other_feature && (!beyond.contains(&true) || has_beyond()) {
        emit_face(sphere, view, height, thickness, &mut *emit);
    } else if height < 0.0 && !near.beyond.contains(&true) && hardly_beyond(sphere, &edges, beyond) {
        let spare = |contact| emit(TriangleContact { standing: Standing::SpareBehind, ..contact });
        emit_face(sphere, view, height, thickness, spare);
    }
    for k in (0..3).filter(|&k| beyond[k]) {
        emit_edge(sphere, &edges, k, height, emit);
    }
    for corner in 0..3 {
        emit_vertex(sphere, set, view, corner, emit);
    }
}

/// Returns the rounding error of a centre's position relative to the triangle, m.
fn foot_slack(center: &Vec3, edges: &TriangleEdges) -> f64 {
    FOOT_SLACK * ((center - edges.view.corners[0]).amax() + center.amax())
}

/// Convex feature of a triangle on which a centre may lie.
enum Rim {
    Edge(usize),
    Vertex(usize),
}

/// Returns the convex edge or vertex of the triangle on which the centre lies, within rounding; otherwise
/// `None`. The centre then lies in the planes of all faces there, but only the edge or the vertex pushes.
fn on_convex_rim(sphere: &Sphere, edges: &TriangleEdges, height: f64) -> Option<Rim> {
    let (center, corners) = (&sphere.center, &edges.view.corners);
    let slack = foot_slack(center, edges);
    if height.abs() > slack {
        return None;
    }
    if let Some(corner) = (0..3).find(|&corner| (center - corners[corner]).amax() <= slack) {
        return is_convex_at(edges, corner).then_some(Rim::Vertex(corner));
    }
    let is_on = |k: usize| {
        let [first, second] = edges.view.edge_ends(k);
        let along = second - first;
        let is_in_other_plane = || match edges.class(k) {
            EdgeClass::Convex { normal, .. } => normal.dot(&(center - first)).abs() <= slack,
            EdgeClass::Free | EdgeClass::Silent { .. } => false,
        };
        edges.beyond(k, center).abs() <= slack
            && along.dot(&(center - first)) > 0.0
            && along.dot(&(center - second)) < 0.0
            && is_in_other_plane()
    };
    (0..3).find(|&k| is_on(k)).map(Rim::Edge)
}

/// Returns `true` if a vertex is convex: of the edges that end in it, at least one is convex and none is
/// concave.
fn is_convex_at(edges: &TriangleEdges, corner: usize) -> bool {
    let mut has_convex = false;
    let all = walk_fan_while(edges.set, edges.view.index, corner, |t, at| {
        let view = TriangleView::new(edges.set, t);
        [at, (at + 2) % 3].into_iter().all(|k| match view.classify_edge(edges.set, k) {
            EdgeClass::Convex { .. } => {
                has_convex = true;
                true
            }
            EdgeClass::Free => true,
            EdgeClass::Silent { outward, .. } => !view.meets_concavely(&outward),
        })
    });
    all.is_some() && has_convex
}

/// Emits the contact of a centre on convex edge `k`, with the mean of the two face normals.
fn emit_on_edge(sphere: &Sphere, edges: &TriangleEdges, k: usize, emit: &mut dyn FnMut(TriangleContact)) {
    let EdgeClass::Convex { normal, .. } = edges.class(k) else { return };
    let view = edges.view;
    if view.pushes_with_edge(edges.set, k) {
        emit_on_rim(sphere, &(view.normal + normal), Feature::edge(3 * view.index as usize + k), emit);
    }
}

/// Emits the contact of a centre on a convex vertex, with the mean of the face normals there.
fn emit_on_vertex(
    sphere: &Sphere,
    edges: &TriangleEdges,
    corner: usize,
    emit: &mut dyn FnMut(TriangleContact),
) {
    let (set, view) = (edges.set, edges.view);
    if view.may_own_vertex(set, corner) {
        let mut mean = Vec3::zeros();
        let fan = walk_fan(set, view.index, corner, &mut |t, _| mean += set.normal(t));
        let vertex = set.triangles[view.index as usize].vertices[corner];
        if fan.lowest == view.index {
            emit_on_rim(sphere, &mean, Feature::vertex(vertex as usize), emit);
        }
    }
}

fn emit_on_rim(sphere: &Sphere, mean: &Vec3, feature: Feature, emit: &mut dyn FnMut(TriangleContact)) {
    let normal_b = mean.normalize();
    let deepest_b = sphere.center - normal_b * sphere.radius;
    let interference = Interference { depth: sphere.radius, normal_b, deepest_b, feature };
    emit(TriangleContact { interference, standing: Standing::Front });
}

/// Returns `true` if a centre behind a triangle is beyond some of its edges only by rounding, and these edges
/// are concave or flat. Behind a vertex of a flat surface, rounding can put the centre beyond an edge of
/// every triangle there, so that no face would push.
fn hardly_beyond(sphere: &Sphere, edges: &TriangleEdges, beyond: [bool; 3]) -> bool {
    let slack = foot_slack(&sphere.center, edges);
    let is_silent = |k: usize| matches!(edges.class(k), EdgeClass::Silent { .. });
    (0..3).filter(|&k| beyond[k]).all(|k| edges.beyond(k, &sphere.center) <= slack && is_silent(k))
}

fn emit_face(
    sphere: &Sphere,
    view: &TriangleView,
    height: f64,
    thickness: f64,
    mut emit: impl FnMut(TriangleContact),
) {
    let depth = sphere.radius - height;
    let behind = height < 0.0;
    if depth > 0.0 && !(behind && -height >= thickness) {
        emit(face_contact(sphere, view, height));
    }
}

#[inline]
fn face_contact(sphere: &Sphere, view: &TriangleView, height: f64) -> TriangleContact {
    TriangleContact {
        interference: Interference {
            depth: sphere.radius - height,
            normal_b: view.normal,
            deepest_b: sphere.center - view.normal * sphere.radius,
            feature: Feature::face(view.index as usize),
        },
        standing: if height < 0.0 { Standing::Behind } else { Standing::Front },
    }
}

fn emit_edge(
    sphere: &Sphere,
    edges: &TriangleEdges,
    k: usize,
    height: f64,
    emit: &mut dyn FnMut(TriangleContact),
) {
    let view = edges.view;
    if !view.pushes_with_edge(edges.set, k) {
        return;
    }
    let [first, second] = view.edge_ends(k);
    let along = second - first;
    let from_first = sphere.center - first;
    let from_second = sphere.center - second;
    if from_first.dot(&along) < 0.0 || from_second.dot(&along) > 0.0 {
        return;
    }
    let foot = first + along * (from_first.dot(&along) / along.norm_squared());
    let other_normal = match edges.class(k) {
        EdgeClass::Silent { .. } => return,
        EdgeClass::Free if height < 0.0 => return,
        EdgeClass::Free => None,
        EdgeClass::Convex { outward, .. } if outward.dot(&from_first) <= 0.0 => return,
        EdgeClass::Convex { normal, .. } => Some(normal),
    };
    let feature = Feature::edge(3 * view.index as usize + k);
    let contact = ball_over_point(sphere, &foot, feature, || {
        view.normal + other_normal.unwrap_or_else(|| edges.outward(k))
    });
    emit_at(contact, Standing::Front, emit);
}

fn emit_vertex(
    sphere: &Sphere,
    set: &TriangleSet,
    view: &TriangleView,
    corner: usize,
    emit: &mut dyn FnMut(TriangleContact),
) {
    let apex = view.corners[corner];
    let direction = sphere.center - apex;
    if direction.norm_squared() >= sphere.radius * sphere.radius || !view.may_own_vertex(set, corner) {
        return;
    }
    let mut in_front = |t: &TriangleView| t.height(&sphere.center) >= 0.0;
    let Some(strictly) = vertex_pushes(set, view.index, corner, &direction, &mut in_front) else { return };
    let vertex = set.triangles[view.index as usize].vertices[corner];
    let standing = if strictly { Standing::Front } else { Standing::Spare };
    let contact = ball_over_point(sphere, &apex, Feature::vertex(vertex as usize), || {
        let mut mean = Vec3::zeros();
        walk_fan(set, view.index, corner, &mut |t, _| mean += set.normal(t));
        mean
    });
    emit_at(contact, standing, emit);
}

fn emit_at(contact: Option<Interference>, standing: Standing, emit: &mut dyn FnMut(TriangleContact)) {
    if let Some(interference) = contact {
        emit(TriangleContact { interference, standing });
    }
}
