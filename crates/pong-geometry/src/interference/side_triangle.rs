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
use super::frustum_stand::{Sector, Stand};
use super::triangle_features::{EdgeClass, TriangleView, vertex_pushes};
use super::two_capsules::non_positive;
use crate::Vec3;
use crate::primitive::{Capsule, Frustum, TriangleSet};

/// Place or plane that a triangle has for a body beside it.
#[derive(Clone, Copy, Debug)]
pub enum Push<'a> {
    /// Place between the discs at which it may push.
    Place(&'a AxisPlace),
    /// Plane that touches it, on which the body stores least beside others through the same feature, perhaps nothing.
    Stand(&'a Stand),
}

/// Calls `visit` with the planes of a triangle and of its convex and free edges and vertices on which a body stores least,
/// and with the places at which it may push the side of a body that is in front of it. `is_back` is true for the back of a
/// two-sided triangle: the front has what both sides share. Faces give places at the end discs, too; edges and vertices
/// give none there, because they touch the discs alone.
///
/// # Errors
/// [`Reached`] if the axis has reached the surface. Then some places are missing, but no planes.
pub fn side_triangle(
    frustum: &Frustum,
    set: &TriangleSet,
    triangle: u32,
    is_back: bool,
    visit: &mut dyn FnMut(Push<'_>),
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
    let mut outcome = Ok(());
    if heights[0].max(heights[1]) > axis.slack {
        let place = &mut |place: &AxisPlace| visit(Push::Place(place));
        outcome = over_face(&axis, (set, &view), &lowest, heights, place);
    }
    let face = Stand::new(frustum, &view.normal, &view.corners[0], Feature::face(triangle as usize));
    visit(Push::Stand(&face));
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
        let (other, second) = match view.classify_edge(set, k) {
            EdgeClass::Free => (view.normal, across),
            EdgeClass::Convex { outward, normal, .. } => (outward, normal),
            EdgeClass::Silent { .. } => continue,
        };
        let is_beside = |place: &Vec3| {
            let place = edge.dot(&(place - start));
            -axis.beyond <= place && place <= length + axis.beyond
        };
        let pushes = |normal: &Vec3| across.dot(normal) >= -REGION_SLACK && other.dot(normal) >= least;
        let feature = Feature::edge(3 * triangle as usize + k);
        let away = near.away(near.nearest);
        let is_before = away.dot(&(across + other)) > 0.0;
        let planes = Planes { frustum, arms: frustum.ends.map(|end| end - start), pivot: edge };
        let best = if is_before { planes.least(&away, &near) } else { None };
        if let Some(best) = &best {
            let lowest = Lowest::new(frustum, &best.normal_b);
            if is_beside(&lowest.point(best.along)) && pushes(&best.normal_b) {
                match lowest.is_before(best, &axis) {
                    true => visit(Push::Place(&AxisPlace { feature, ..*best })),
                    false => outcome = Err(Reached),
                }
            }
        }
        let sector = Sector::new(&view.normal, &across, &second);
        let on = |normal: &Vec3| Stand::new(frustum, normal, &start, feature);
        let upright = [frustum.axis, -frustum.axis].map(|axis| on(&sector.nearest(&axis)));
        let side = is_before.then(|| on(&sector.nearest(&away)));
        let lying = best.map(|best| on(&best.normal_b)).filter(Stand::lies);
        let lying = lying.map(|lying| (pushes(&lying.normal_b), lying));
        let least = |stand: &Stand| stand.least_about_edge(frustum, &sector);
        let found = least_stand((lying, side), upright, face.at.energy, least);
        for stand in found.into_iter().flatten() {
            let is_clear = stand.at.energy == 0.0;
            if pushes(&stand.normal_b) && (is_clear || is_beside(&stand.at.middle_of_load(frustum))) {
                visit(Push::Stand(&stand));
            }
        }
    }
    for corner in (0..3).filter(|&corner| view.may_own_vertex(set, corner)) {
        let apex = view.corners[corner];
        let Some(near) = axis.near(axis.start_b - apex, axis.along_b) else { continue };
        let feature = Feature::vertex(set.triangles[triangle as usize].vertices[corner] as usize);
        let pushes = |normal: &Vec3, place: &Vec3| {
            let mut in_front = |face: &TriangleView| face.height(place) >= least * axis.radius;
            vertex_pushes(set, triangle, corner, normal, &mut in_front).is_some()
        };
        let arm = apex - frustum.ends[0];
        let side = (arm - frustum.axis * frustum.axis.dot(&arm)).try_normalize(axis.slack);
        let best = side.and_then(|side| {
            let arms = frustum.ends.map(|end| end - apex);
            let planes = Planes { frustum, arms, pivot: side.cross(&frustum.axis) };
            planes.least(&-frustum.wall_toward(&side), &near)
        });
        if let Some(best) = &best {
            let place = axis.start_b + axis.along_b * best.along;
            if pushes(&best.normal_b, &place) {
                match Lowest::new(frustum, &best.normal_b).is_before(best, &axis) {
                    true => visit(Push::Place(&AxisPlace { feature, ..*best })),
                    false => outcome = Err(Reached),
                }
            }
        } else if side.is_none() {
            outcome = Err(Reached);
        }
        let on = |normal: &Vec3| Stand::new(frustum, normal, &apex, feature);
        let upright = [on(&frustum.axis), on(&-frustum.axis)];
        let lying = best.map(|best| on(&best.normal_b)).filter(Stand::lies);
        let side = side.map(|side| on(&-frustum.wall_toward(&side)));
        let middle = axis.start_b + axis.along_b * 0.5;
        let lying = lying.map(|lying| (pushes(&lying.normal_b, &middle), lying));
        let least = |stand: &Stand| stand.least_about_point(frustum);
        let found = least_stand((lying, side), upright, face.at.energy, least);
        for stand in found.into_iter().flatten() {
            if pushes(&stand.normal_b, &middle) {
                visit(Push::Stand(&stand));
            }
        }
    }
    outcome
}

/// Returns planes through an edge or a vertex on which a body stores less than on others beside them. `lying` is one that
/// is known, on which both discs lie, with true if the feature pushes along it; `side` is where the search for another
/// begins if there is none. `upright` are those on which the discs stand, from the lower of which another search begins,
/// unless a plane is known that is surely lower than all beside it: this `lying` one, or that of the face, with its energy.
/// Turned from there, a plane stores at least half as much as long as the middle of a disc is beside the feature.
fn least_stand(
    (lying, side): (Option<(bool, Stand)>, Option<Stand>),
    upright: [Stand; 2],
    on_face: f64,
    least: impl Fn(&Stand) -> Stand,
) -> [Option<Stand>; 2] {
    let [one, other] = upright;
    let upright = if other.at.energy < one.at.energy { other } else { one };
    let stands = |known: f64| (0.5 * upright.at.energy < known).then(|| least(&upright));
    match lying {
        Some((true, lying)) => [Some(lying), stands(lying.at.energy)],
        Some((false, _)) => [None, stands(on_face)],
        None => [side.map(|side| least(&side)), Some(least(&upright))],
    }
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

    /// Returns false if the axis has sunk to the edge or vertex of a place.
    fn is_before(&self, place: &AxisPlace, axis: &Axis) -> bool {
        self.thickness(place.along) - place.depth > axis.slack
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
