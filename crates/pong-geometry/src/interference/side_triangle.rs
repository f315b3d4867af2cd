//! Side of a cylinder or a cone (A) in front of a triangle (B): places between the end discs where the triangle may
//! push (docs/theory.md, 2.8).
//!
//! A face pushes at the two ends of the part of the lowest generator that is over it: in between its depth is linear. A
//! convex or free edge, or a convex vertex, pushes along the normal n of the plane through it on which the body stores
//! least, with ℓ₀² + ℓ₁² of the depths of the lowest places of the two discs. The load is at ℓ₁/(ℓ₀ + ℓ₁) of the
//! generator then, right above the edge or the vertex.

use super::Feature;
use super::axis_triangle::{Axis, AxisPlace, Beside, REGION_SLACK, Reached, part_over_face, visit_ends};
use super::end_disc::down;
use super::triangle_features::{EdgeClass, TriangleView, vertex_pushes};
use super::two_capsules::non_positive;
use crate::Vec3;
use crate::primitive::{Capsule, Frustum, TriangleSet};

/// Calls `visit` with the places at which a triangle may push the side of a body that is in front of it. `is_back` is
/// true for the back of a two-sided triangle: the front has what both sides share. Faces give places at the end discs,
/// too; edges and vertices give none there, because they touch the discs alone.
///
/// # Errors
/// [`Reached`] if the axis has reached the surface.
pub fn side_triangle(
    frustum: &Frustum,
    set: &TriangleSet,
    triangle: u32,
    is_back: bool,
    visit: &mut dyn FnMut(&AxisPlace),
) -> Result<(), Reached> {
    let view = TriangleView::new(set, triangle);
    let heights = frustum.ends.each_ref().map(|end| view.height(end));
    let most = frustum.radii[0].max(frustum.radii[1]);
    if heights[0].min(heights[1]) >= most || heights[0].max(heights[1]) <= -most {
        return Ok(());
    }
    let lowest = Lowest::new(frustum, &view.normal);
    let is_apart = |side: f64| (0..2).all(|end| side * heights[end] >= lowest.thickness[end]);
    if is_apart(1.0) || is_apart(-1.0) {
        return Ok(());
    }
    let capsule = Capsule { ends: frustum.ends, radius: most };
    let axis = Axis::new(&capsule, &view.corners[0]);
    if heights[0].max(heights[1]) > axis.slack {
        over_face(&axis, (set, &view), &lowest, heights, visit)?;
    }
    let may_push = set.triangles[triangle as usize].may_push;
    let least = if is_back { REGION_SLACK } else { -REGION_SLACK };
    for k in (0..3).filter(|&k| may_push.edge(k) && view.owns_edge(set, k)) {
        let [start, end] = view.edge_ends(k);
        let rest = end - start;
        let length = rest.norm();
        let edge = rest / length;
        let beside = |v: &Vec3| v - edge * edge.dot(v);
        let Some(near) = axis.near(beside(&(axis.start_b - start)), beside(&axis.along_b)) else { continue };
        let across = view.outward(k);
        let other = match view.classify_edge(set, k) {
            EdgeClass::Free => view.normal,
            EdgeClass::Convex { outward, .. } => outward,
            EdgeClass::Silent { .. } => continue,
        };
        let away = near.away(near.nearest);
        if away.dot(&(across + other)) <= 0.0 {
            continue;
        }
        let planes = Planes { frustum, arms: frustum.ends.map(|end| end - start), pivot: edge };
        let Some(best) = planes.least(&away, &near) else { continue };
        let lowest = Lowest::new(frustum, &best.normal_b);
        let place = edge.dot(&(lowest.point(best.along) - start));
        if place < -axis.beyond || place > length + axis.beyond {
            continue;
        }
        if across.dot(&best.normal_b) >= -REGION_SLACK && other.dot(&best.normal_b) >= least {
            lowest.check(&best, &axis)?;
            visit(&AxisPlace { feature: Feature::edge(3 * triangle as usize + k), ..best });
        }
    }
    for corner in (0..3).filter(|&corner| view.may_own_vertex(set, corner)) {
        let apex = view.corners[corner];
        let Some(near) = axis.near(axis.start_b - apex, axis.along_b) else { continue };
        let arm = apex - frustum.ends[0];
        let Some(side) = (arm - frustum.axis * frustum.axis.dot(&arm)).try_normalize(axis.slack) else {
            return Err(Reached);
        };
        let arms = frustum.ends.map(|end| end - apex);
        let planes = Planes { frustum, arms, pivot: side.cross(&frustum.axis) };
        let Some(best) = planes.least(&-frustum.wall_toward(&side), &near) else { continue };
        let place = axis.start_b + axis.along_b * best.along;
        let mut in_front = |face: &TriangleView| face.height(&place) >= least * axis.radius;
        if vertex_pushes(set, triangle, corner, &best.normal_b, &mut in_front).is_some() {
            Lowest::new(frustum, &best.normal_b).check(&best, &axis)?;
            let vertex = set.triangles[triangle as usize].vertices[corner];
            visit(&AxisPlace { feature: Feature::vertex(vertex as usize), ..best });
        }
    }
    Ok(())
}

/// Lowest places of the two discs of a frustum above a plane.
#[derive(Clone, Copy, Debug)]
pub struct Lowest {
    /// The places, m.
    pub points_b: [Vec3; 2],
    /// Heights of the centres of the discs above them, along the normal of the plane, m.
    pub thickness: [f64; 2],
}

impl Lowest {
    /// Finds the places for a unit normal.
    pub fn new(frustum: &Frustum, normal: &Vec3) -> Self {
        let (down, sine) = (down(frustum, normal), normal.cross(&frustum.axis).norm());
        Self {
            points_b: [0, 1].map(|end| frustum.ends[end] + down * frustum.radii[end]),
            thickness: frustum.radii.map(|radius| radius * sine),
        }
    }

    /// Returns the place at a fraction of the generator between the two, m.
    pub fn point(&self, along: f64) -> Vec3 {
        self.points_b[0] * (1.0 - along) + self.points_b[1] * along
    }

    /// Returns the height of the axis above that place, along the normal, m.
    pub fn thickness(&self, along: f64) -> f64 {
        self.thickness[0] * (1.0 - along) + self.thickness[1] * along
    }

    /// Returns [`Reached`] if the axis has sunk to the edge or vertex of a place.
    fn check(&self, place: &AxisPlace, axis: &Axis) -> Result<(), Reached> {
        if self.thickness(place.along) - place.depth <= axis.slack { Err(Reached) } else { Ok(()) }
    }
}

/// Visits the two ends of the part of the lowest generator over a face, with the axis in front of it.
fn over_face(
    axis: &Axis,
    (set, view): (&TriangleSet, &TriangleView),
    lowest: &Lowest,
    heights: [f64; 2],
    visit: &mut dyn FnMut(&AxisPlace),
) -> Result<(), Reached> {
    if heights[0].min(heights[1]) < -axis.slack {
        let crossing = axis.start_b + axis.along_b * (heights[0] / (heights[0] - heights[1]));
        let is_inside = |k: usize| view.outward(k).dot(&(crossing - view.corners[k])) <= axis.slack;
        if (0..3).all(is_inside) {
            return Err(Reached);
        }
    }
    let [first, last] = lowest.points_b;
    let Some((part, at_edge)) = part_over_face(view, (&first, &(last - first)), axis.slack) else {
        return Ok(());
    };
    let height_at = |along: f64| heights[0] * (1.0 - along) + heights[1] * along;
    let over = part.map(height_at);
    if over[0].min(over[1]) < -axis.slack {
        return Ok(());
    }
    let depths = [0, 1].map(|end| lowest.thickness(part[end]) - over[end]);
    visit_ends((set, view), (part, at_edge), depths, visit);
    Ok(())
}

/// Planes through an edge or a vertex, which turn about a line.
struct Planes<'a> {
    frustum: &'a Frustum,
    /// Ways from a place on the line to the two ends of the axis, m.
    arms: [Vec3; 2],
    /// Direction of the line; the normals are square to it.
    pivot: Vec3,
}

impl Planes<'_> {
    /// Returns the place of the load on the plane on which both discs store least; the feature is not set. The search
    /// starts from a normal along `start`. `None` if one disc alone touches that plane, or none. On the way a depth may be
    /// negative: the squares have the same least where none is.
    fn least(&self, start: &Vec3, near: &Beside) -> Option<AxisPlace> {
        /// Newton's method needs three or four, and more where the curvature ends.
        const STEPS: usize = 20;
        const ENOUGH: f64 = 1e-15;
        /// Longest step, rad.
        const LONGEST: f64 = 0.5;
        let axis = &self.frustum.axis;
        let mut normal = start / start.norm().max(f64::MIN_POSITIVE);
        let mut depths = [0.0; 2];
        for _ in 0..STEPS {
            let turned = self.pivot.cross(&normal);
            let (lean, leans) = (normal.dot(axis), turned.dot(axis));
            // Sine of the angle between the axis and the normal, and its derivatives.
            let sine = normal.cross(axis).norm().max(f64::MIN_POSITIVE);
            let first = -lean * leans / sine;
            let second = (lean * lean - leans * leans - first * first) / sine;
            let (mut slope, mut curvature) = (0.0, 0.0);
            for (end, depth) in depths.iter_mut().enumerate() {
                let (arm, radius) = (&self.arms[end], self.frustum.radii[end]);
                let height = normal.dot(arm);
                *depth = radius * sine - height;
                let rises = radius * first - turned.dot(arm);
                slope += *depth * rises;
                curvature += rises * rises + *depth * (height + radius * second);
            }
            if curvature <= 0.0 {
                return None;
            }
            let step = (-slope / curvature.max(f64::MIN_POSITIVE)).clamp(-LONGEST, LONGEST);
            let next = normal + turned * step;
            if step.abs() <= ENOUGH {
                break;
            }
            normal = next / next.norm();
        }
        if depths[0] <= 0.0 || depths[1] <= 0.0 {
            return None;
        }
        let sum = depths[0] + depths[1];
        let along = depths[1] / sum;
        let [from, to] = self.part(near);
        Some(AxisPlace {
            normal_b: normal,
            along,
            depth: (depths[0] * depths[0] + depths[1] * depths[1]) / sum,
            part: [from.clamp(0.0, along), to.clamp(along, 1.0)],
            feature: Feature::WHOLE,
        })
    }

    /// Returns the part of the axis that is less than the radius there away from the edge or vertex.
    fn part(&self, near: &Beside) -> [f64; 2] {
        let [first, last] = self.frustum.radii;
        let widens = last - first;
        let square = near.rate - widens * widens;
        let part = match near.rate > 0.0 && square > 0.0 {
            true => {
                non_positive(square, near.lean - first * widens, near.arm_b.norm_squared() - first * first)
            }
            false => None,
        };
        part.unwrap_or([0.0, 1.0])
    }
}
