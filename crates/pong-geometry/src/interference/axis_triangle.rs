//! Axis of a capsule (A) in front of a triangle (B): places where the triangle may push (docs/theory.md, 2.8).
//!
//! A face pushes at both ends of the part of the axis that is over it: in between its depth is linear. A convex or free
//! edge, or a convex vertex, pushes at the place of the axis where δ²/D is greatest, with the depth δ(s) and
//! D(s) = (1 − s)² + s².

use super::Feature;
use super::axis_approach::nearest_of_segments;
use super::capsule_edge::ConvexEdge;
use super::triangle_features::{EdgeClass, TriangleView, vertex_pushes};
use super::two_capsules::{lever_shares, non_positive, zero_of_rising};
use crate::primitive::{Capsule, TriangleSet};
use crate::{Vec3, any_perpendicular, divisor};

/// Place of the axis at which a feature pushes.
#[derive(Clone, Copy, Debug)]
pub struct AxisPlace {
    /// Unit normal, from the feature to the axis.
    pub normal_b: Vec3,
    /// Place on the axis, as a fraction of its length from end 0.
    pub along: f64,
    /// Depth δ > 0 there, m.
    pub depth: f64,
    /// Part of the axis over a face, or less than the radius away from the line of an edge or from a vertex, as fractions
    /// of its length.
    pub part: [f64; 2],
    /// The feature.
    pub feature: Feature,
}

impl AxisPlace {
    /// Returns the fractions of the load that the two ends of `part` carry by the lever rule.
    pub fn shares(&self) -> [f64; 2] {
        lever_shares(&self.part, self.along)
    }

    /// Returns the greatest δ²/D over the feature, m². `axis` is the axis, from end 0 to end 1.
    pub fn greatest_square(&self, axis: &Vec3) -> f64 {
        let at = |along: f64| {
            let depth = self.depth - self.normal_b.dot(axis) * (along - self.along);
            let (depth, from_middle) = (depth.max(0.0), along - 0.5);
            depth * depth / (0.5 + 2.0 * from_middle * from_middle)
        };
        if !self.feature.is_face() {
            return at(self.along);
        }
        // Over a face the depth is linear: δ₀ and δ₁ at the two ends of the axis give the greatest δ²/D at δ₁/(δ₀ + δ₁).
        let slope = -self.normal_b.dot(axis);
        let first = self.depth - slope * self.along;
        let best = (first + slope) / divisor(2.0 * first + slope);
        at(best.clamp(self.part[0], self.part[1])).max(at(self.part[0])).max(at(self.part[1]))
    }
}

/// Straight line of a capsule's axis, to tell what is beside it.
#[derive(Clone, Copy, Debug)]
pub struct AxisLine {
    start: Vec3,
    /// Unit vectors across the axis, square to each other.
    sides: [Vec3; 2],
    radius: f64,
}

impl AxisLine {
    /// Creates the line of a capsule.
    pub fn new(capsule: &Capsule) -> Self {
        let along = capsule.ends[1] - capsule.ends[0];
        let side = any_perpendicular(&(along / along.norm()));
        let other = along.cross(&side);
        Self { start: capsule.ends[0], sides: [side, other / other.norm()], radius: capsule.radius }
    }

    /// Returns true if a triangle is surely farther from the line than the radius.
    pub fn misses(&self, corners: &[Vec3; 3]) -> bool {
        let arms = corners.map(|corner| corner - self.start);
        self.sides.iter().any(|side| {
            let beside = arms.map(|arm| side.dot(&arm));
            beside.iter().all(|distance| *distance > self.radius)
                || beside.iter().all(|distance| *distance < -self.radius)
        })
    }
}

/// The axis has reached the surface: it touches an edge or a vertex, or goes through a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reached;

/// Distance, relative to the coordinates, within which a place counts as on the boundary of a feature.
const ROUNDING: f64 = 1e-12;
/// Sine of the angle by which a normal may be beyond the boundary of the region of an edge, and distance, relative to
/// the radius, by which a place may be beyond the end of an edge. What is on a boundary is found on both of its sides.
pub(super) const REGION_SLACK: f64 = 1e-9;
/// Square of the sine of an angle between axis and edge, below which they count as parallel.
const PARALLEL_SQUARE: f64 = 1e-24;

/// Calls `visit` with the places at which a triangle may push a capsule that is in front of it. `is_back` is true for
/// the back of a two-sided triangle: the front has what both sides share.
///
/// # Errors
/// [`Reached`] if the axis has reached the surface.
pub fn axis_triangle(
    capsule: &Capsule,
    set: &TriangleSet,
    triangle: u32,
    is_back: bool,
    visit: &mut dyn FnMut(&AxisPlace),
) -> Result<(), Reached> {
    let view = TriangleView::new(set, triangle);
    let axis = Axis::new(capsule, &view.corners[0]);
    let heights = [view.height(&capsule.ends[0]), view.height(&capsule.ends[1])];
    let [low, high] = [heights[0].min(heights[1]), heights[0].max(heights[1])];
    if low >= axis.radius || high <= -axis.radius {
        return Ok(());
    }
    let may_push = set.triangles[triangle as usize].may_push;
    if high > axis.slack {
        over_face(&axis, set, &view, heights, visit)?;
    }
    let least = if is_back { REGION_SLACK } else { -REGION_SLACK };
    for k in (0..3).filter(|&k| may_push.edge(k)) {
        let [start, end] = view.edge_ends(k);
        let rest = end - start;
        let length = rest.norm();
        let edge = rest / length;
        let beside = |v: &Vec3| v - edge * edge.dot(v);
        let arm = axis.start_b - start;
        let Some(near) = axis.near(beside(&arm), beside(&axis.along_b)) else { continue };
        let on_edge = |along: f64| edge.dot(&(arm + axis.along_b * along));
        let ends = near.bounds().map(on_edge);
        if ends[0].max(ends[1]) < -axis.beyond || ends[0].min(ends[1]) > length + axis.beyond {
            continue;
        }
        let across = view.outward(k);
        if near.is_behind(&across, axis.beyond) {
            continue;
        }
        let other = match view.classify_edge(set, k) {
            EdgeClass::Free => view.normal,
            EdgeClass::Convex { outward, .. } if view.owns_edge(set, k) => outward,
            EdgeClass::Convex { .. } | EdgeClass::Silent { .. } => continue,
        };
        if near.is_behind(&other, axis.beyond) {
            continue;
        }
        let best = near.best_place(axis.radius);
        let place = on_edge(best.along);
        if place < -axis.beyond || place > length + axis.beyond {
            continue;
        }
        axis.check(&best)?;
        if across.dot(&best.normal_b) >= -REGION_SLACK && other.dot(&best.normal_b) >= least {
            visit(&AxisPlace { feature: Feature::edge(3 * triangle as usize + k), ..best });
        }
    }
    for corner in (0..3).filter(|&corner| may_push.vertex(corner)) {
        let apex = view.corners[corner];
        let Some(near) = axis.near(axis.start_b - apex, axis.along_b) else { continue };
        let descends = |to: usize| {
            let edge = apex - view.corners[(corner + to) % 3];
            !near.is_behind(&edge, axis.beyond * edge.norm())
        };
        if !descends(1) || !descends(2) {
            continue;
        }
        let best = near.best_place(axis.radius);
        axis.check(&best)?;
        let place = axis.start_b + axis.along_b * best.along;
        let mut in_front = |face: &TriangleView| face.height(&place) >= least * axis.radius;
        if vertex_pushes(set, triangle, corner, &(place - apex), &mut in_front).is_some() {
            let vertex = set.triangles[triangle as usize].vertices[corner];
            visit(&AxisPlace { feature: Feature::vertex(vertex as usize), ..best });
        }
    }
    Ok(())
}

/// Returns true if an edge is less than the radius away from the axis of a capsule.
pub fn is_beside_edge(capsule: &Capsule, edge: &ConvexEdge) -> bool {
    let [on_axis, on_edge] = nearest_of_segments(&capsule.ends, &edge.ends_b);
    (on_axis - on_edge).norm_squared() < capsule.radius * capsule.radius
}

/// Visits the two ends of the part of an axis over a face.
fn over_face(
    axis: &Axis,
    set: &TriangleSet,
    view: &TriangleView,
    heights: [f64; 2],
    visit: &mut dyn FnMut(&AxisPlace),
) -> Result<(), Reached> {
    let Some((part, at_edge)) = part_over_face(view, (&axis.start_b, &axis.along_b), axis.slack) else {
        return Ok(());
    };
    let height_at = |along: f64| heights[0] * (1.0 - along) + heights[1] * along;
    let over = part.map(height_at);
    if over[0].min(over[1]) < -axis.slack {
        return if over[0].max(over[1]) > axis.slack { Err(Reached) } else { Ok(()) };
    }
    visit_ends((set, view), (part, at_edge), over.map(|height| axis.radius - height), visit);
    Ok(())
}

/// Visits the ends of the part of a body over a face that have a depth, m. An end at an edge that never pushes is left
/// out: the face across that edge is at least as deep there.
pub(super) fn visit_ends(
    (set, view): (&TriangleSet, &TriangleView),
    (part, at_edge): ([f64; 2], [Option<usize>; 2]),
    depths: [f64; 2],
    visit: &mut dyn FnMut(&AxisPlace),
) {
    let is_silent = |k: usize| matches!(view.classify_edge(set, k), EdgeClass::Silent { .. });
    for (end, edge) in at_edge.into_iter().enumerate() {
        let depth = depths[end];
        if depth > 0.0 && !edge.is_some_and(is_silent) {
            let feature = Feature::face(view.index as usize);
            visit(&AxisPlace { normal_b: view.normal, along: part[end], depth, part, feature });
        }
    }
}

/// Returns the part of a line over a face, given where it starts and the vector to its other end, as fractions of its
/// length, and the edges at which the part ends. `None` if it is nowhere over the face.
pub(super) fn part_over_face(
    view: &TriangleView,
    (start, along): (&Vec3, &Vec3),
    slack: f64,
) -> Option<([f64; 2], [Option<usize>; 2])> {
    let mut part = [0.0, 1.0];
    let mut at_edge = [None; 2];
    for k in 0..3 {
        let outward = view.outward(k);
        let (beyond, rate) = (outward.dot(&(start - view.corners[k])), outward.dot(along));
        if beyond.max(beyond + rate) <= slack {
            continue;
        }
        if beyond.min(beyond + rate) > slack {
            return None;
        }
        let crossing = (slack - beyond) / divisor(rate);
        if rate > 0.0 && crossing < part[1] {
            (part[1], at_edge[1]) = (crossing, Some(k));
        } else if rate < 0.0 && crossing > part[0] {
            (part[0], at_edge[0]) = (crossing, Some(k));
        }
    }
    (part[0] <= part[1]).then_some((part, at_edge))
}

/// Axis of a capsule, or of a cylinder or cone with its larger radius.
pub(super) struct Axis {
    /// End 0, m.
    pub start_b: Vec3,
    /// Vector from end 0 to end 1, m.
    pub along_b: Vec3,
    /// Radius, m.
    pub radius: f64,
    /// Distance by which rounding may put a place beyond a boundary, m.
    pub slack: f64,
    /// Distance by which a place may be beyond the end of an edge, m.
    pub beyond: f64,
}

impl Axis {
    pub fn new(capsule: &Capsule, corner: &Vec3) -> Self {
        let Capsule { ends, radius } = *capsule;
        let slack = ROUNDING * (corner.amax() + ends[0].amax() + ends[1].amax());
        Self { start_b: ends[0], along_b: ends[1] - ends[0], radius, slack, beyond: REGION_SLACK * radius }
    }

    /// Returns the axis beside a vertex or the line of an edge; `None` if it is nowhere less than the radius away. `arm`
    /// leads to end 0, `along` to end 1 from there, both without their parts along the edge.
    pub fn near(&self, arm: Vec3, along: Vec3) -> Option<Beside> {
        let square = along.norm_squared();
        let is_parallel = square <= PARALLEL_SQUARE * self.along_b.norm_squared();
        let along = if is_parallel { Vec3::zeros() } else { along };
        let (rate, lean) = (along.norm_squared(), arm.dot(&along));
        let nearest = if is_parallel { 0.5 } else { (-lean / rate).clamp(0.0, 1.0) };
        let near = Beside { arm_b: arm, along, rate, lean, nearest };
        (near.away(nearest).norm_squared() < self.radius * self.radius).then_some(near)
    }

    /// Returns [`Reached`] if the axis touches the edge or vertex of a place: there is no normal then.
    fn check(&self, place: &AxisPlace) -> Result<(), Reached> {
        if self.radius - place.depth <= self.slack { Err(Reached) } else { Ok(()) }
    }
}

/// Axis beside a vertex or the line of an edge.
pub(super) struct Beside {
    /// Way from the vertex or the line to end 0 of the axis, m.
    pub arm_b: Vec3,
    /// Change of that way along the axis, m.
    along: Vec3,
    /// along·along, m².
    pub rate: f64,
    /// arm·along, m².
    pub lean: f64,
    /// Nearest place of the axis, as a fraction of its length.
    pub nearest: f64,
}

impl Beside {
    /// Returns the way from the vertex or the line to a place of the axis.
    pub fn away(&self, along: f64) -> Vec3 {
        self.arm_b + self.along * along
    }

    /// Returns two places of the axis between which δ²/D is greatest.
    fn bounds(&self) -> [f64; 2] {
        [self.nearest, 0.5]
    }

    /// Returns true if the place of the greatest δ²/D is surely behind, by more than `slack`, as seen along `direction`.
    fn is_behind(&self, direction: &Vec3, slack: f64) -> bool {
        self.bounds().iter().all(|&along| direction.dot(&self.away(along)) < -slack)
    }

    /// Returns the place of the greatest δ²/D. The feature is not set.
    fn best_place(&self, radius: f64) -> AxisPlace {
        let Self { lean, rate, .. } = *self;
        // Zero of the derivative of −ln(δ/√D), times δ·D.
        let along = zero_of_rising(self.nearest - 0.5, |from_middle| {
            let along = from_middle + 0.5;
            let distance = self.away(along).norm().max(f64::MIN_POSITIVE);
            let depth = (radius - distance).max(0.0);
            let spread = 0.5 + 2.0 * from_middle * from_middle;
            let grows = (lean + rate * along) / distance;
            let value = grows * spread + 2.0 * depth * from_middle;
            let slope = (rate - grows * grows) / distance * spread + 2.0 * grows * from_middle + 2.0 * depth;
            (value, slope, along)
        });
        let away = self.away(along);
        let distance = away.norm();
        let part = match rate > 0.0 {
            true => non_positive(rate, lean, self.arm_b.norm_squared() - radius * radius),
            false => None,
        };
        let [from, to] = part.unwrap_or([0.0, 1.0]);
        AxisPlace {
            normal_b: away / distance.max(f64::MIN_POSITIVE),
            along,
            depth: radius - distance,
            part: [from.clamp(0.0, along), to.clamp(along, 1.0)],
            feature: Feature::WHOLE,
        }
    }
}
