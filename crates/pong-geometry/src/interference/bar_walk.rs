//! Walk along the axis of a bar beside a convex solid, from the feature that is nearest at one place to those that are
//! nearest farther on (docs/theory.md, 2.8).
//!
//! The region of a feature, the places to which it is nearest, is bounded by planes: for a face those through its
//! outline and square to it; for an edge those through its ends, square to it, and those it has in common with its
//! faces; for a vertex those square to its edges. So the place where the axis leaves a region has a closed form. Two
//! regions compute the plane between them from the same numbers, so that rounding leads to no way back.

use super::bar_polyhedron::{Bar, Whereabouts};
use super::{Feature, FeatureKind};
use crate::{Vec3, divisor};

/// Nearest way along the axis to a plane, and what is beyond.
struct Exit {
    /// Distance in the places of the axis, 0 or more.
    away: f64,
    beyond: Whereabouts,
}

impl Exit {
    /// Takes a plane if it is nearer: a place is `height` (m, negative in the region) above it, and rises by `rate`.
    fn nearer(&mut self, height: f64, rate: f64, beyond: Whereabouts) {
        if rate > 0.0 {
            let away = (-height).max(0.0) / divisor(rate);
            if away < self.away {
                *self = Self { away, beyond };
            }
        }
    }
}

impl Bar<'_> {
    /// Walks from a place towards end 1 (`way` 1) or end 0 (−1). In each region `goal` returns the place at which the
    /// walk ends if the region reaches so far. Returns the last place.
    pub(super) fn walk(
        &self,
        start: (f64, Whereabouts),
        way: f64,
        goal: impl Fn(Whereabouts) -> f64,
    ) -> (f64, Whereabouts) {
        // Far more than the regions along any axis.
        const STEPS: usize = 10_000;
        const NEAR: f64 = 8.0 * f64::EPSILON;
        let (mut at, mut here) = start;
        for _ in 0..STEPS {
            let ahead = ((goal(here) - at) * way).max(0.0).min(0.5 - at * way);
            let exit = self.exit(here, at, way);
            // At an edge through which the axis passes, both are rounding: the region beyond decides.
            if ahead + NEAR < exit.away {
                let end = at + way * ahead;
                return (if ahead == 0.5 - at * way { 0.5 * way } else { end }, here);
            }
            at += way * exit.away;
            here = exit.beyond;
        }
        (at, here)
    }

    /// Returns where the axis leaves the region in which a place is.
    fn exit(&self, here: Whereabouts, at: f64, way: f64) -> Exit {
        let (solid, place, along) = (self.polyhedron, self.place(at), self.along_b * way);
        let mut exit = Exit { away: f64::INFINITY, beyond: None };
        let Some(feature) = here else {
            for (index, face) in solid.faces.iter().enumerate() {
                exit.nearer(face.height(&place), face.normal.dot(&along), Some(Feature::face(index)));
            }
            return exit;
        };
        let mut past = |plane: &Vec3, from: &Vec3, beyond| {
            exit.nearer(plane.dot(&(place - from)), plane.dot(&along), beyond);
        };
        let index = feature.index();
        match feature.kind() {
            FeatureKind::Face => {
                for rim in solid.rim(index) {
                    // A flat edge is nearest to no place.
                    let beyond = match solid.edges[rim.edge as usize].push {
                        Some(_) => Feature::edge(rim.edge as usize),
                        None => Feature::face(rim.neighbor as usize),
                    };
                    past(&rim.outward, &rim.anchor, Some(beyond));
                }
                let face = &solid.faces[index];
                exit.nearer(-face.height(&place), -face.normal.dot(&along), None);
            }
            FeatureKind::Edge => {
                let edge = &solid.edges[index];
                let ends = edge.vertices.map(|vertex| solid.vertices[vertex as usize].position);
                let [low, high] = edge.vertices.map(|vertex| Feature::vertex(vertex as usize));
                past(&-edge.direction, &ends[0], Some(low));
                past(&edge.direction, &ends[1], Some(high));
                for (face, outward) in edge.faces.iter().zip(edge.push.iter().flat_map(|push| &push.outwards))
                {
                    past(&-outward, &ends[0], Some(Feature::face(*face as usize)));
                }
            }
            FeatureKind::Vertex => {
                let tip = solid.vertices[index].position;
                for edge in solid.edges.iter().enumerate().filter(|(_, edge)| edge.push.is_some()) {
                    let (number, edge) = edge;
                    if edge.vertices[0] as usize == index {
                        past(&edge.direction, &tip, Some(Feature::edge(number)));
                    } else if edge.vertices[1] as usize == index {
                        past(&-edge.direction, &tip, Some(Feature::edge(number)));
                    }
                }
            }
        }
        exit
    }

    /// Returns the distance of a place from a feature, m, and the direction from there to the place.
    pub(super) fn beside(&self, feature: Feature, at: f64) -> (f64, Vec3) {
        let (solid, place, index) = (self.polyhedron, self.place(at), feature.index());
        let away = match feature.kind() {
            FeatureKind::Face => return (solid.height(index, &place), solid.faces[index].normal),
            FeatureKind::Edge => {
                let edge = &solid.edges[index];
                let arm = place - solid.vertices[edge.vertices[0] as usize].position;
                arm - edge.direction * edge.direction.dot(&arm)
            }
            FeatureKind::Vertex => place - solid.vertices[index].position,
        };
        let distance = away.norm();
        (distance, away / divisor(distance))
    }
}
