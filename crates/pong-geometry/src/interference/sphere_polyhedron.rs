//! Sphere (A) – polyhedron (B) (docs/theory.md, 2.2 and 2.4). If the centre is outside, the contact is with
//! the nearest surface point. If the centre is inside, it is that of a point, with the radius added to the
//! depth.
//!
//! Degenerate cases: a centre on a face counts as outside. If the centre is on an edge or a vertex, the
//! active face of lowest index there pushes. If the centre is straight above the seam of two pieces, both may
//! push, and the two contacts share one spring.

use super::point_polyhedron::{point_below_face, shallowest_face};
use super::{Feature, Interference, ball_over_point};
use crate::Vec3;
use crate::primitive::{EdgeBlock, Polyhedron, Sphere};
use crate::simd::{LANES, LaneBits, Simd, Splat, run_at_level};

/// Returns the contact of a sphere without a remembered face. It is with the nearest feature if the centre is
/// outside, otherwise with the active face of least depth. `None` if there is no overlap or that feature may
/// not push.
#[inline]
pub fn sphere_polyhedron(sphere: &Sphere, polyhedron: &Polyhedron) -> Option<Interference> {
    run_at_level!(sphere_polyhedron_in(sphere: Sphere, polyhedron: Polyhedron) -> Option<Interference>)
}

#[inline(always)]
fn sphere_polyhedron_in<S: Simd>(simd: S, sphere: &Sphere, polyhedron: &Polyhedron) -> Option<Interference> {
    let near = Near::new(simd, sphere, polyhedron);
    let survey = near.survey()?;
    if !survey.is_inside {
        return near.contact(&survey);
    }
    let face = shallowest_face(&sphere.center, polyhedron)?;
    Some(sphere_inside_polyhedron(sphere, polyhedron, face))
}

/// Returns the contact of a sphere whose centre is outside: with the feature nearest to the centre. `None` if
/// the sphere does not reach that feature, or if the feature may not push.
#[inline]
pub fn sphere_outside_polyhedron(sphere: &Sphere, polyhedron: &Polyhedron) -> Option<Interference> {
    run_at_level!(outside_in(sphere: Sphere, polyhedron: Polyhedron) -> Option<Interference>)
}

#[inline(always)]
fn outside_in<S: Simd>(simd: S, sphere: &Sphere, polyhedron: &Polyhedron) -> Option<Interference> {
    let near = Near::new(simd, sphere, polyhedron);
    near.contact(&near.survey()?)
}

/// A sphere beside or in a polyhedron.
#[derive(Clone, Copy, Debug)]
pub(super) enum Beside {
    /// The centre is inside.
    Inside,
    /// The contact with the nearest feature; the centre is outside.
    At(Interference),
    /// The sphere does not reach the polyhedron.
    Far,
}

/// Returns the contact of a sphere with the nearest feature, if its centre is outside.
#[inline]
pub(super) fn sphere_beside_polyhedron(sphere: &Sphere, polyhedron: &Polyhedron) -> Beside {
    run_at_level!(beside_in(sphere: Sphere, polyhedron: Polyhedron) -> Beside)
}

#[inline(always)]
fn beside_in<S: Simd>(simd: S, sphere: &Sphere, polyhedron: &Polyhedron) -> Beside {
    let near = Near::new(simd, sphere, polyhedron);
    let Some(survey) = near.survey() else { return Beside::Far };
    if survey.is_inside {
        return Beside::Inside;
    }
    near.contact(&survey).map_or(Beside::Far, Beside::At)
}

/// Returns the contact of a sphere whose centre is inside, with the face that pushes.
#[inline]
pub fn sphere_inside_polyhedron(sphere: &Sphere, polyhedron: &Polyhedron, face: usize) -> Interference {
    let normal = polyhedron.faces[face].normal;
    let below = point_below_face(&sphere.center, polyhedron, face);
    Interference {
        depth: sphere.radius + below.map_or(0.0, |contact| contact.depth),
        normal_b: normal,
        deepest_b: sphere.center - normal * sphere.radius,
        feature: Feature::face(face),
    }
}

/// Sphere and polyhedron, ready for tests of eight planes at a time.
struct Near<'a, S: Simd> {
    simd: S,
    sphere: &'a Sphere,
    polyhedron: &'a Polyhedron,
    center: Splat<S>,
}

/// Position of the centre relative to all planes, if no plane separates the sphere from the polyhedron.
struct Survey {
    is_inside: bool,
    /// Greatest height of the centre above a plane, m.
    top: f64,
}

impl<'a, S: Simd> Near<'a, S> {
    #[inline(always)]
    fn new(simd: S, sphere: &'a Sphere, polyhedron: &'a Polyhedron) -> Self {
        Self { simd, sphere, polyhedron, center: Splat::new(simd, &sphere.center) }
    }

    /// Returns the position of the centre relative to all planes; `None` if one of them separates the sphere.
    #[inline(always)]
    fn survey(&self) -> Option<Survey> {
        let simd = self.simd;
        let radius = simd.splat(self.sphere.radius);
        let mut top = simd.splat(f64::NEG_INFINITY);
        let mut held = LaneBits::MAX;
        for block in &self.polyhedron.planes().blocks {
            let heights = block.heights(simd, &self.center);
            if simd.bits(simd.at_least(heights, radius)) != 0 {
                return None;
            }
            top = simd.larger(heights, top);
            held &= block.held(simd, heights);
        }
        Some(Survey { is_inside: held == LaneBits::MAX, top: simd.largest(top) })
    }

    /// Returns the contact with the feature nearest to the centre; `None` if the sphere does not reach it or
    /// it may not push.
    #[inline(always)]
    fn contact(&self, survey: &Survey) -> Option<Interference> {
        if let Some(face) = self.face_below(survey) {
            return self.on_face(face);
        }
        match self.nearest_edge() {
            Some(contact) => Some(contact),
            None => self.nearest_vertex(),
        }
    }

    /// Returns the face that contains the centre's foot point, its projection onto the plane of the face;
    /// `None` if no face does.
    #[inline(always)]
    fn face_below(&self, survey: &Survey) -> Option<usize> {
        let (simd, planes) = (self.simd, self.polyhedron.planes());
        // Outlines are widened at internal faces, so the bound does not apply there.
        let lowest = match planes.simple {
            true => self.polyhedron.least_height_over_face(&self.sphere.center, survey.top).max(0.0),
            false => 0.0,
        };
        let mut found: Option<usize> = None;
        for (index, block) in planes.blocks.iter().enumerate() {
            let heights = block.heights(simd, &self.center);
            let mut faces = simd.bits(simd.at_least(heights, simd.splat(lowest))) & block.own;
            while faces != 0 {
                let face = index * LANES + faces.trailing_zeros() as usize;
                // By rounding, both an internal face and an active face may contain the foot point. Then the
                // active face counts.
                let counts = match found {
                    None => true,
                    Some(best) => self.polyhedron.faces[face].active && !self.polyhedron.faces[best].active,
                };
                if counts && holds_foot(&self.sphere.center, self.polyhedron, face) {
                    found = Some(face);
                }
                faces &= faces - 1;
            }
        }
        found
    }

    #[inline(always)]
    fn on_face(&self, index: usize) -> Option<Interference> {
        let face = &self.polyhedron.faces[index];
        if !face.active {
            return None;
        }
        Some(Interference {
            depth: self.sphere.radius - face.height(&self.sphere.center),
            normal_b: face.normal,
            deepest_b: self.sphere.center - face.normal * self.sphere.radius,
            feature: Feature::face(index),
        })
    }

    #[inline(always)]
    fn nearest_edge(&self) -> Option<Interference> {
        let edges = self.polyhedron.edge_blocks();
        let reach = self.reach();
        let mut best = None;
        for (eight, boxes) in edges.boxes.iter().enumerate() {
            let mut near = boxes.near(self.simd, &self.center, reach);
            while near != 0 {
                let index = eight * LANES + near.trailing_zeros() as usize;
                if let Some(block) = edges.blocks.get(index) {
                    best = self.nearest_edge_of(block, best);
                }
                near &= near - 1;
            }
        }
        best
    }

    #[inline(always)]
    fn nearest_edge_of(&self, block: &EdgeBlock, mut best: Option<Interference>) -> Option<Interference> {
        let mut edges = block.between(self.simd, &self.center);
        while edges != 0 {
            let index = block.index[edges.trailing_zeros() as usize] as usize;
            best = deeper(best, edge_contact(self.sphere, self.polyhedron, index));
            edges &= edges - 1;
        }
        best
    }

    /// Returns the distance from the centre within which the sphere may touch a feature, m.
    #[inline(always)]
    fn reach(&self) -> f64 {
        /// Far above the rounding of a distance.
        const SLACK: f64 = 1e-9;
        self.sphere.radius + SLACK * (self.sphere.radius + self.sphere.center.amax())
    }

    #[inline(always)]
    fn nearest_vertex(&self) -> Option<Interference> {
        let mut best = None;
        for (index, block) in self.polyhedron.vertex_blocks().iter().enumerate() {
            let mut vertices = block.within(self.simd, &self.center, self.sphere.radius);
            while vertices != 0 {
                let vertex = index * LANES + vertices.trailing_zeros() as usize;
                best = deeper(best, vertex_contact(self.sphere, self.polyhedron, vertex));
                vertices &= vertices - 1;
            }
        }
        best
    }
}

/// Returns `true` if the projection of `p` onto a face's plane lies in the face. Where the face continues in
/// the next piece, its outline is widened by a tolerance. Otherwise a point straight above the seam could
/// miss both faces, because each piece computes the seam from its own normals.
#[inline(always)]
fn holds_foot(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> bool {
    if !polyhedron.planes().all_active {
        return holds_foot_beside_walls(p, polyhedron, face);
    }
    // Branch-free in groups of four, because most points outside are outside of an edge in the first group.
    polyhedron
        .rim(face)
        .chunks(4)
        .all(|rims| rims.iter().fold(true, |held, rim| held & (rim.outward.dot(&(p - rim.anchor)) <= 0.0)))
}

fn holds_foot_beside_walls(p: &Vec3, polyhedron: &Polyhedron, face: usize) -> bool {
    const SEAM_SINE_SLACK: f64 = 1e-12;
    polyhedron.rim(face).iter().all(|rim| {
        let arm = p - rim.anchor;
        let beyond = rim.outward.dot(&arm);
        let at_wall = !polyhedron.faces[rim.neighbor as usize].active;
        beyond <= 0.0 || (at_wall && beyond <= SEAM_SINE_SLACK * arm.norm())
    })
}

/// Returns the contact with an edge, for a centre in the Voronoi region of the edge; `None` if the edge never
/// pushes or the sphere does not reach it.
fn edge_contact(sphere: &Sphere, polyhedron: &Polyhedron, index: usize) -> Option<Interference> {
    let edge = &polyhedron.edges[index];
    let [first, second] = edge.vertices.map(|v| polyhedron.vertices[v as usize].position);
    let along = second - first;
    let foot = first + along * ((sphere.center - first).dot(&along) / along.norm_squared());
    let normals = edge.push.as_ref()?.normals;
    ball_over_point(sphere, &foot, Feature::edge(index), || normals[0] + normals[1])
}

/// Returns the contact with a vertex; `None` if the centre is outside the vertex's normal cone, or the sphere
/// does not reach the vertex.
fn vertex_contact(sphere: &Sphere, polyhedron: &Polyhedron, index: usize) -> Option<Interference> {
    // Tolerance for the product of a unit direction and a unit edge. Without it, a centre straight above a
    // vertex in the middle of a straight edge could fall between the two halves of that edge.
    const CONE_COSINE_SLACK: f64 = 1e-12;
    let vertex = &polyhedron.vertices[index];
    let direction = sphere.center - vertex.position;
    let slack = CONE_COSINE_SLACK * direction.norm();
    let cone = polyhedron.cone(index);
    let is_inside = cone.iter().all(|edge| edge.dot(&direction) <= slack);
    if !is_inside {
        return None;
    }
    ball_over_point(sphere, &vertex.position, Feature::vertex(index), || -cone.iter().sum::<Vec3>())
}

/// Returns the deeper of two contacts; at equal depth, the contact of the lower feature.
fn deeper(best: Option<Interference>, candidate: Option<Interference>) -> Option<Interference> {
    let (Some(a), Some(b)) = (best, candidate) else { return best.or(candidate) };
    let replaces = b.depth > a.depth || (b.depth == a.depth && b.feature < a.feature);
    Some(if replaces { b } else { a })
}
