//! Cylinder and cone (A) – convex solid of planar faces (B): the plane on which A stores least (docs/theory.md, 2.8).
//!
//! On a plane with the unit normal n and B behind it, A stands with half a spring at the lowest and the highest place of
//! each of its discs. With h the support function of B, and p the four places,
//!
//! ```text
//! U = min over n of ¼k·F      F = Σ max(0, h(n) − n·p)²
//! ```
//!
//! h is the largest n·v of the vertices v of B. Let L be the middle of the load, that is of the places with the depths
//! as weights. F cannot be lowered by turning n
//!
//! * at the normal of a face, if L is over the face,
//! * between the normals of two faces, if the edge passes below L and goes on to both sides of it,
//! * at a normal along which one vertex is farthest, if L is above this vertex.
//!
//! A walk from feature to feature, on which F falls, ends at one of these.

use super::end_disc::UPRIGHT;
use super::least_translation::Local;
use super::{Feature, FeatureKind, Interference};
use crate::distance::Solid;
use crate::primitive::{EdgePush, EightBoxes, Frustum, PlaneBlock, Polyhedron, PolyhedronEdge};
use crate::simd::{LANES, LaneBits, Simd, Splat, run_at_level};
use crate::{Transform, Vec3, any_perpendicular, divisor};

/// Contacts at the lowest places of discs 0 and 1, then at the highest ones.
pub type PlaceContacts = [Option<Interference>; 4];

/// Tests a cylinder or a cone against a convex solid all of whose faces push.
pub fn frustum_solid(frustum: &Frustum, polyhedron: &Polyhedron) -> PlaceContacts {
    let body = Body::new(frustum, polyhedron);
    let Some(Stand { normal_b, feature, at }) = body.least() else { return [None; 4] };
    if !polyhedron.contains(&body.middle_of_load(&at)) {
        // The plane may have missed that the two are apart.
        let other = Solid::polyhedron(polyhedron, &Transform::identity());
        if Solid::frustum(frustum).to_within(&other, 0.0).is_none() {
            return [None; 4];
        }
    }
    let [_, up] = body.directions(&at);
    [0, 1, 2, 3].map(|index| {
        let (depth, deepest_b) = (at.depths[index], body.place(&up, index));
        (depth > 0.0).then_some(Interference { depth, normal_b, deepest_b, feature })
    })
}

/// A on a plane.
#[derive(Clone, Copy)]
struct OnPlane {
    /// F, m².
    energy: f64,
    /// Depths of the four places below the plane, m; 0 above it.
    depths: [f64; 4],
    /// Product of the normal and the axis, across both, and its length, the sine of the angle between them.
    level: Vec3,
    sine: f64,
}

/// A plane that touches B.
#[derive(Clone, Copy)]
struct Stand {
    normal_b: Vec3,
    feature: Feature,
    at: OnPlane,
}

/// A in B's frame, and B.
struct Body<'a> {
    frustum: &'a Frustum,
    polyhedron: &'a Polyhedron,
    /// Largest coordinate of A, m: rounding of places is relative to it.
    size: f64,
}

/// Longest turn in one step, rad.
const FARTHEST: f64 = 0.3;

/// Rounding of F, relative to its terms.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Step of a search times the arm of the load, relative to the depth, from which a step by Newton's method is the last.
const CLOSE: f64 = 1e-8;

/// Part of F, far above rounding, by which one plane must be better than another.
const TIE: f64 = 1.0 - 1e-12;

impl<'a> Body<'a> {
    fn new(frustum: &'a Frustum, polyhedron: &'a Polyhedron) -> Self {
        let Frustum { ends, radii, .. } = frustum;
        let size = ends[0].amax().max(ends[1].amax()) + radii[0].max(radii[1]);
        Self { frustum, polyhedron, size }
    }

    /// Returns A on the plane with a normal that is `top` from the origin, m.
    #[inline]
    fn on_plane(&self, normal: &Vec3, top: f64) -> OnPlane {
        let Frustum { ends, radii, axis, .. } = self.frustum;
        let level = normal.cross(axis);
        let sine = level.norm();
        let middles = [top - normal.dot(&ends[0]), top - normal.dot(&ends[1])];
        let low = |end: usize| (middles[end] + radii[end] * sine).max(0.0);
        // An apex is one place.
        let high =
            |end: usize| if radii[end] > 0.0 { (middles[end] - radii[end] * sine).max(0.0) } else { 0.0 };
        let depths = [low(0), low(1), high(0), high(1)];
        let square = |index: usize| depths[index] * depths[index];
        OnPlane { energy: (square(0) + square(1)) + (square(2) + square(3)), depths, level, sine }
    }

    /// Returns the unit vectors across the axis that are level, and towards the normal.
    #[inline]
    fn directions(&self, at: &OnPlane) -> [Vec3; 2] {
        let axis = &self.frustum.axis;
        let around = match at.sine > UPRIGHT {
            true => at.level / at.sine.max(f64::MIN_POSITIVE),
            false => any_perpendicular(axis),
        };
        [around, axis.cross(&around)]
    }

    /// Returns a place of A, the lowest ones of discs 0 and 1, then the highest.
    #[inline]
    fn place(&self, up: &Vec3, index: usize) -> Vec3 {
        let radius = self.frustum.radii[index % 2];
        self.frustum.ends[index % 2] + up * if index < 2 { -radius } else { radius }
    }

    /// Rounding of a place, m.
    fn rounding(&self) -> f64 {
        16.0 * f64::EPSILON * self.size
    }

    fn on_face(&self, face: usize) -> Stand {
        let normal_b = self.polyhedron.faces[face].normal;
        let at = self.on_plane(&normal_b, self.polyhedron.faces[face].offset);
        Stand { normal_b, feature: Feature::face(face), at }
    }

    fn vertex(&self, index: u32) -> Vec3 {
        self.polyhedron.vertices[index as usize].position
    }

    fn middle_of_load(&self, at: &OnPlane) -> Vec3 {
        let [_, up] = self.directions(at);
        let load: f64 = at.depths.iter().sum();
        let sum: Vec3 = (0..4).map(|index| self.place(&up, index) * at.depths[index]).sum();
        sum / load.max(f64::MIN_POSITIVE)
    }

    /// Returns F, and the derivatives of half of it when the plane turns about a vertex.
    fn about(&self, vertex: &Vec3, normal: &Vec3, at: &OnPlane) -> Local {
        let [around, up] = self.directions(at);
        let mut slope = Vec3::zeros();
        let mut bend = around * around.transpose() * (self.turning(at, 0) + self.turning(at, 1));
        for index in (0..4).filter(|&index| at.depths[index] > 0.0) {
            let arm = vertex - self.place(&up, index);
            slope += arm * at.depths[index];
            bend += arm * arm.transpose();
        }
        let slope_b = slope - normal * normal.dot(&slope);
        Local { value: at.energy, slope_b, bend, less: at.energy, size: at.energy.sqrt() * self.size }
    }

    /// Returns the same when the plane turns about an edge: the slope, the curvature, and the size of the terms. `across` is
    /// the direction in which the normal turns. Where √F bends upward, its curvature counts, times √F: with it Newton's
    /// steps are right from farther away.
    fn beside(&self, vertex: &Vec3, across: &Vec3, at: &OnPlane) -> (f64, f64, f64) {
        let [around, up] = self.directions(at);
        let turns = across.dot(&around);
        let mut slope = 0.0;
        let mut bend = turns * turns * (self.turning(at, 0) + self.turning(at, 1));
        for index in (0..4).filter(|&index| at.depths[index] > 0.0) {
            let arm = across.dot(&(vertex - self.place(&up, index)));
            slope += arm * at.depths[index];
            bend += arm * arm;
        }
        bend -= at.energy;
        let of_root = bend - slope * slope / at.energy.max(f64::MIN_POSITIVE);
        (slope, if of_root > 0.25 * bend { of_root } else { bend }, at.energy.sqrt() * self.size)
    }

    /// Returns the sum of depth times second derivative of the height, m², of the places of a disc, if the plane turns
    /// about the direction that is level. The height of the lowest place bends by R/s, with s the sine of the tilt, that of
    /// the highest by −R/s, and while both push, their depths differ by 2R·s.
    #[inline]
    fn turning(&self, at: &OnPlane, disc: usize) -> f64 {
        let radius = self.frustum.radii[disc];
        match at.depths[disc + 2] > 0.0 {
            true => 2.0 * radius * radius,
            false => (at.depths[disc] * radius / at.sine.max(UPRIGHT)).min(2.0 * radius * radius),
        }
    }

    /// Returns the plane of the least energy; `None` if one stores none.
    ///
    /// F is at least D², with D the overlap of A and B along n. The feature of a minimum lies on the line of the load, D or
    /// less from it. So with one plane known, only features within √F of A count, of these only those among whose normals F
    /// can be less. No other face is better than the first one.
    fn least(&self) -> Option<Stand> {
        /// Depth, relative to the smaller of radius and length, above which a feature may have several minima.
        const DEEP: f64 = 0.02;
        /// Cosines of the angles between normals from the middle of which one walk begins, shallow and deep.
        const NARROW: [f64; 2] = [0.7, 0.995];
        let solid = self.polyhedron;
        let first = least_face_of(self.frustum, solid)?;
        let mut best = self.descend(self.on_face(first), true);
        let reach = best.at.energy.sqrt();
        let radius = self.frustum.radii[0].max(self.frustum.radii[1]);
        let is_deep = reach > DEEP * radius.min(self.frustum.length);
        let narrow = NARROW[usize::from(is_deep)];
        let mut is_edge_near = false;
        each_edge_within(self.frustum, solid, reach, &mut |index| {
            let edge = &solid.edges[index];
            let Some(push) = &edge.push else { return };
            is_edge_near = true;
            let point = self.vertex(edge.vertices[0]);
            self.cover_arc(push.normals, (&point, Feature::edge(index)), narrow, &mut best);
        });
        let corners = solid.vertices.iter().map(|vertex| vertex.position).enumerate();
        for (vertex, corner) in
            corners.filter(|(_, corner)| is_edge_near && is_within(self.frustum, [corner; 2], reach))
        {
            let meets = |edge: &&PolyhedronEdge| edge.vertices.contains(&(vertex as u32));
            let pushes = solid.edges.iter().filter(meets).filter_map(|edge| edge.push);
            let sum: Vec3 = pushes.clone().map(|push| (push.normals[0] + push.normals[1]).normalize()).sum();
            let Some(between) = sum.try_normalize(f64::MIN_POSITIVE) else { continue };
            for EdgePush { normals: [from, to], .. } in pushes {
                self.cover([between, from, to], (&corner, Feature::vertex(vertex)), narrow, &mut best);
            }
        }
        (best.at.energy > 0.0).then_some(best)
    }

    /// Walks from the middle of the normals between two, or of parts of them, where F may be less than at `best`.
    fn cover_arc(&self, ends: [Vec3; 2], (point, feature): (&Vec3, Feature), narrow: f64, best: &mut Stand) {
        let least = ends[0].dot(&ends[1]);
        if self.bound(&ends, least, point) >= best.at.energy * TIE {
            return;
        }
        let [from, to] = ends;
        let middle = (from + to).normalize();
        if least > narrow || least.is_nan() {
            return self.offer(middle, (point, feature), best);
        }
        for part in [[from, middle], [middle, to]] {
            self.cover_arc(part, (point, feature), narrow, best);
        }
    }

    /// Walks from the middle of the normals between three of a vertex, or of parts of them, where F may be less than at `best`.
    fn cover(&self, corners: [Vec3; 3], (point, feature): (&Vec3, Feature), narrow: f64, best: &mut Stand) {
        let [a, b, c] = corners;
        let least = a.dot(&b).min(b.dot(&c)).min(c.dot(&a));
        if self.bound(&corners, least, point) >= best.at.energy * TIE {
            return;
        }
        if least > narrow || least.is_nan() {
            return self.offer((a + b + c).normalize(), (point, feature), best);
        }
        let [ab, bc, ca] = [a + b, b + c, c + a].map(|sum| sum.normalize());
        for part in [[ab, bc, ca], [a, ab, ca], [ab, b, bc], [ca, bc, c]] {
            self.cover(part, (point, feature), narrow, best);
        }
    }

    /// Walks from a plane that touches B at a point, and keeps the better one.
    fn offer(&self, normal_b: Vec3, (point, feature): (&Vec3, Feature), best: &mut Stand) {
        let at = self.on_plane(&normal_b, normal_b.dot(point));
        let found = self.descend(Stand { normal_b, feature, at }, false);
        if found.at.energy < best.at.energy * TIE {
            *best = found;
        }
    }

    /// Returns a lower bound of F over the normals between two or three, along which a vertex is farthest, with the least
    /// cosine between two of them. A unit vector between them is their sum with weights that add up to 1 to `most`.
    fn bound(&self, normals: &[Vec3], least: f64, vertex: &Vec3) -> f64 {
        let Frustum { ends, radii, axis, .. } = self.frustum;
        let share = if normals.len() == 2 { 0.5 } else { 2.0 / 3.0 };
        // Of the shortest sum with weights that add up to 1.
        let shortest = 1.0 - share * (1.0 - least);
        if shortest < 0.1 {
            return 0.0;
        }
        let most = 1.0 / shortest.max(0.1).sqrt();
        let range = |along: &Vec3| {
            let heights = normals.iter().map(|normal| normal.dot(along));
            let [low, high] = heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], height| {
                [low.min(height), high.max(height)]
            });
            [low.min(low * most), high.max(high * most)]
        };
        let [low, high] = range(axis);
        let steepest = low.abs().max(high.abs()).min(1.0);
        let flattest = if low * high <= 0.0 { 0.0 } else { low.abs().min(high.abs()) };
        let sines = [steepest, flattest].map(|cosine| (1.0 - cosine * cosine).max(0.0).sqrt());
        let mut sum = 0.0;
        for end in 0..2 {
            let [middle, _] = range(&(vertex - ends[end]));
            let low = (middle + radii[end] * sines[0]).max(0.0);
            let high = if radii[end] > 0.0 { (middle - radii[end] * sines[1]).max(0.0) } else { 0.0 };
            sum += low * low + high * high;
        }
        sum
    }

    /// Walks from feature to feature to a plane that no small turn betters, or that stores nothing, or to a face from which
    /// no walk need begin.
    fn descend(&self, mut stand: Stand, from_faces: bool) -> Stand {
        /// More than the features on any way.
        const STEPS: usize = 200;
        for _ in 0..STEPS {
            if stand.at.energy <= 0.0 {
                break;
            }
            let next = match stand.feature.kind() {
                FeatureKind::Face => self.off_face(&stand),
                FeatureKind::Edge => self.along_edge(&mut stand),
                FeatureKind::Vertex => self.about_vertex(&mut stand),
            };
            match next {
                Some(feature) if from_faces || feature.kind() != FeatureKind::Face => stand.feature = feature,
                _ => break,
            }
        }
        stand
    }

    /// Returns the edge past which the load of a face hangs over most.
    fn off_face(&self, stand: &Stand) -> Option<Feature> {
        let middle = self.middle_of_load(&stand.at);
        let mut most = (self.rounding(), None);
        for rim in self.polyhedron.rim(stand.feature.index()) {
            let over = rim.outward.dot(&(middle - rim.anchor));
            if over > most.0 {
                // Beyond a flat edge the face goes on.
                let is_flat = self.polyhedron.edges[rim.edge as usize].push.is_none();
                let next = if is_flat {
                    Feature::face(rim.neighbor as usize)
                } else {
                    Feature::edge(rim.edge as usize)
                };
                most = (over, Some(next));
            }
        }
        most.1
    }

    /// Turns the plane about an edge to where it stores least; returns the feature that the walk comes to then.
    fn along_edge(&self, stand: &mut Stand) -> Option<Feature> {
        const STEPS: usize = 100;
        let edge = &self.polyhedron.edges[stand.feature.index()];
        let push = edge.push?;
        let point = self.vertex(edge.vertices[0]);
        // Unit vector across the edge along which the normal turns to that of the second face.
        let sign = push.outwards[0].dot(&edge.direction.cross(&push.normals[0])).signum();
        let toward = |normal: &Vec3| edge.direction.cross(normal) * sign;
        let turned = |normal: &Vec3, at: &OnPlane| self.beside(&point, &toward(normal), at);
        let mut here = turned(&stand.normal_b, &stand.at);
        let (way, last) = if here.0 < 0.0 { (1.0, 1) } else { (-1.0, 0) };
        // The minimum is between these normals. Until one beyond it is known, the second is that of the face.
        let (mut before, mut beyond, mut is_known) = (stand.normal_b, push.normals[last], false);
        // The last step did not come lower; the plane is beyond the minimum.
        let (mut halves, mut is_past) = (false, false);
        for _ in 0..STEPS {
            let (slope, bend, size) = here;
            if slope.abs() <= f64::EPSILON * size || stand.at.energy <= 0.0 {
                break;
            }
            let downhill = FARTHEST * -slope.signum();
            let step = if bend > 0.0 { -slope / bend.max(f64::MIN_POSITIVE) } else { downhill };
            let step = step.clamp(-FARTHEST, FARTHEST);
            let mut next = (stand.normal_b + toward(&stand.normal_b) * step).normalize();
            // Newton's next step from here would be rounding.
            let is_between =
                toward(&push.normals[0]).dot(&next) > 0.0 && toward(&push.normals[1]).dot(&next) < 0.0;
            if is_between && bend > 0.0 && step.abs() * size <= CLOSE * stand.at.energy {
                (stand.normal_b, stand.at) = (next, self.on_plane(&next, next.dot(&point)));
                break;
            }
            let is_short = toward(&beyond).dot(&next) * way < 0.0;
            let is_at_end = !is_short && !is_known && !halves;
            if is_at_end {
                next = beyond;
            } else if halves || !is_short || toward(&before).dot(&next) * way <= 0.0 {
                next = (before + beyond).normalize();
            }
            if next == stand.normal_b || next == before || (is_known && next == beyond) {
                break;
            }
            let at = self.on_plane(&next, next.dot(&point));
            let there = turned(&next, &at);
            let is_lower = at.energy <= stand.at.energy + ROUNDING * size;
            let falls = there.0 * way < 0.0;
            if is_at_end && falls && is_lower {
                *stand = self.on_face(edge.faces[last] as usize);
                return Some(stand.feature);
            }
            let is_before = falls && (is_lower || is_past);
            if is_before {
                before = next;
            } else {
                (beyond, is_known) = (next, true);
            }
            halves = !is_lower;
            if is_lower {
                is_past = !is_before;
                (stand.normal_b, stand.at, here) = (next, at, there);
            }
        }
        let at = edge.direction.dot(&(self.middle_of_load(&stand.at) - point));
        let length = edge.direction.dot(&(self.vertex(edge.vertices[1]) - point));
        match () {
            () if at < -self.rounding() => Some(Feature::vertex(edge.vertices[0] as usize)),
            () if at > length + self.rounding() => Some(Feature::vertex(edge.vertices[1] as usize)),
            () => None,
        }
    }

    /// Turns the plane about a vertex to where it stores least, or to the normal at which an edge comes to lie on it, which
    /// is returned.
    fn about_vertex(&self, stand: &mut Stand) -> Option<Feature> {
        const STEPS: usize = 100;
        let vertex = stand.feature.index();
        let point = self.vertex(vertex as u32);
        let (mut damping, mut last) = (0.0, Vec3::zeros());
        let mut here = self.about(&point, &stand.normal_b, &stand.at);
        for _ in 0..STEPS {
            let size = here.size;
            if here.value <= 0.0 || here.slope_b.norm() <= f64::EPSILON * size {
                break;
            }
            let (step, curvature) = here.downhill(&stand.normal_b, damping);
            // Upright, F bends from one place of a disc to two: Newton's steps may go back and forth across.
            let turns_back = step.dot(&last) < -0.5 * last.norm_squared();
            let step = if turns_back { step * 0.5 } else { step };
            let length = step.norm();
            let step = step * (FARTHEST / length.max(FARTHEST));
            last = step;
            // The part of the way on which the vertex remains the farthest one.
            let (mut part, mut crossed) = (1.0, None);
            for edge in self.polyhedron.cone(vertex) {
                let (from, by) = (edge.dot(&stand.normal_b), edge.dot(&step));
                if from + by > 0.0 && by > 0.0 {
                    let until = (-from).max(0.0) / by.max(f64::MIN_POSITIVE);
                    if until < part {
                        (part, crossed) = (until, Some(edge));
                    }
                }
            }
            let next = (stand.normal_b + step * part).normalize();
            let at = self.on_plane(&next, next.dot(&point));
            let there = self.about(&point, &next, &at);
            let noise = ROUNDING * size;
            // Newton's next step from here would be rounding.
            if crossed.is_none() && length * size <= CLOSE * here.value {
                (stand.normal_b, stand.at) = (next, at);
                break;
            }
            let flatter = there.value <= here.value + noise && there.slope_b.norm() < here.slope_b.norm();
            if there.value < here.value - noise
                || flatter
                || part * length <= f64::EPSILON && crossed.is_some()
            {
                (stand.normal_b, stand.at, here) = (next, at, there);
                damping *= 0.1;
                if let Some(crossed) = crossed {
                    return self.edge_along(vertex, crossed);
                }
            } else if length <= f64::EPSILON {
                break;
            } else {
                damping = (4.0 * damping).max(0.1 * curvature);
            }
        }
        None
    }

    /// Returns the edge that leaves a vertex along a direction.
    fn edge_along(&self, vertex: usize, direction: &Vec3) -> Option<Feature> {
        let away = |edge: &PolyhedronEdge| match edge.vertices.map(|end| end as usize == vertex) {
            [true, _] => edge.direction.dot(direction),
            [_, true] => -edge.direction.dot(direction),
            _ => f64::NEG_INFINITY,
        };
        let edges = self.polyhedron.edges.iter().map(away).enumerate();
        edges.reduce(|a, b| if b.1 > a.1 { b } else { a }).map(|(index, _)| Feature::edge(index))
    }
}

/// Calls `visit` with the edges that come within `reach`, m, of a cylinder or a cone, and perhaps some others.
fn each_edge_within(frustum: &Frustum, polyhedron: &Polyhedron, reach: f64, visit: &mut dyn FnMut(usize)) {
    let (low, high) = frustum.region(false);
    let around = [low.add_scalar(-reach), high.add_scalar(reach)];
    let edges = polyhedron.edge_blocks();
    for (boxes, blocks) in edges.boxes.iter().zip(edges.blocks.chunks(LANES)) {
        let mut met = boxes_met(boxes, &around);
        while met != 0 {
            // Unused lanes of `boxes` repeat the last box and have no block, those of a block its last edge.
            let Some(block) = blocks.get(met.trailing_zeros() as usize) else { break };
            for (lane, &index) in block.index.iter().enumerate() {
                let is_new = lane == 0 || index != block.index[lane - 1];
                let ends = polyhedron.edges[index as usize].vertices;
                let [from, to] = ends.map(|vertex| &polyhedron.vertices[vertex as usize].position);
                if is_new && is_within(frustum, [from, to], reach) {
                    visit(index as usize);
                }
            }
            met &= met - 1;
        }
    }
}

fn boxes_met(boxes: &EightBoxes, around: &[Vec3; 2]) -> LaneBits {
    run_at_level!(meet(boxes: EightBoxes, around: [Vec3; 2]) -> LaneBits)
}

#[inline(always)]
fn meet<S: Simd>(simd: S, boxes: &EightBoxes, around: &[Vec3; 2]) -> LaneBits {
    boxes.meet(simd, around)
}

/// Returns `true` if the straight line between two points comes within `reach`, m, of the cylinder around A.
fn is_within(frustum: &Frustum, ends: [&Vec3; 2], reach: f64) -> bool {
    let [from, to] = ends.map(|end| end - frustum.ends[0]);
    let along = to - from;
    let (start, by) = (frustum.axis.dot(&from), frustum.axis.dot(&along));
    // Its part between the planes of the ends.
    let at = [-reach, frustum.length + reach].map(|end| (end - start) / divisor(by));
    let [first, last] = match by == 0.0 {
        true if start < -reach || start > frustum.length + reach => return false,
        true => [0.0, 1.0],
        false => [at[0].min(at[1]).max(0.0), at[0].max(at[1]).min(1.0)],
    };
    if first > last {
        return false;
    }
    let (across, beside) = (along - frustum.axis * by, from - frustum.axis * start);
    let nearest = -across.dot(&beside) / across.norm_squared().max(f64::MIN_POSITIVE);
    let radius = frustum.radii[0].max(frustum.radii[1]) + reach;
    (beside + across * nearest.clamp(first, last)).norm_squared() <= radius * radius
}

/// Returns the face on which a body stores least, the first of equal ones; `None` if it is above one.
fn least_face_of(frustum: &Frustum, polyhedron: &Polyhedron) -> Option<usize> {
    run_at_level!(least_face(frustum: Frustum, polyhedron: Polyhedron) -> Option<usize>)
}

#[inline(always)]
fn least_face<S: Simd>(simd: S, frustum: &Frustum, polyhedron: &Polyhedron) -> Option<usize> {
    let body = Eight::new(simd, frustum);
    let mut most = simd.splat(f64::NEG_INFINITY);
    for block in &polyhedron.planes().blocks {
        most = simd.larger(simd.sub(simd.splat(0.0), body.energies(simd, block)), most);
    }
    let least = -simd.largest(most);
    if !(least > 0.0 && least.is_finite()) {
        return None;
    }
    let limit = simd.splat(least / TIE);
    for (index, block) in polyhedron.planes().blocks.iter().enumerate() {
        let faces = simd.bits(simd.at_least(limit, body.energies(simd, block)));
        if faces != 0 {
            return Some(index * LANES + faces.trailing_zeros() as usize);
        }
    }
    None
}

/// A body, in all lanes.
struct Eight<S: Simd> {
    ends: [Splat<S>; 2],
    axis: [S::Eight; 3],
    radii: [S::Eight; 2],
    /// Number of the highest places: 0 or 1.
    places: [S::Eight; 2],
}

impl<S: Simd> Eight<S> {
    #[inline(always)]
    fn new(simd: S, frustum: &Frustum) -> Self {
        let [first, last] = frustum.radii;
        // An apex is one place.
        let places = [simd.splat(f64::from(first > 0.0)), simd.splat(f64::from(last > 0.0))];
        Self {
            ends: [Splat::new(simd, &frustum.ends[0]), Splat::new(simd, &frustum.ends[1])],
            axis: [simd.splat(frustum.axis.x), simd.splat(frustum.axis.y), simd.splat(frustum.axis.z)],
            radii: [simd.splat(first), simd.splat(last)],
            places,
        }
    }

    /// Returns the depths of the middles of the discs below the planes of eight faces, m, and how much deeper the lowest
    /// places are.
    #[inline(always)]
    fn depths(&self, simd: S, block: &PlaneBlock) -> [[S::Eight; 2]; 2] {
        let ([x, y, z], [u, v, w]) = (&block.normal, self.axis);
        let [x, y, z] = [simd.load(x), simd.load(y), simd.load(z)];
        let across = [
            simd.sub(simd.mul(y, w), simd.mul(z, v)),
            simd.sub(simd.mul(z, u), simd.mul(x, w)),
            simd.sub(simd.mul(x, v), simd.mul(y, u)),
        ];
        let sum = simd.add(simd.mul(across[0], across[0]), simd.mul(across[1], across[1]));
        let sine = simd.sqrt(simd.add(sum, simd.mul(across[2], across[2])));
        let zero = simd.splat(0.0);
        let [first, last] = [block.heights(simd, &self.ends[0]), block.heights(simd, &self.ends[1])];
        let middles = [simd.sub(zero, first), simd.sub(zero, last)];
        [middles, [simd.mul(sine, self.radii[0]), simd.mul(sine, self.radii[1])]]
    }

    /// Returns F on the planes of eight faces, m².
    #[inline(always)]
    fn energies(&self, simd: S, block: &PlaneBlock) -> S::Eight {
        let [[first, last], [of_first, of_last]] = self.depths(simd, block);
        let zero = simd.splat(0.0);
        let low = [simd.larger(simd.add(first, of_first), zero), simd.larger(simd.add(last, of_last), zero)];
        let high = [simd.larger(simd.sub(first, of_first), zero), simd.larger(simd.sub(last, of_last), zero)];
        let low = simd.add(simd.mul(low[0], low[0]), simd.mul(low[1], low[1]));
        let high = [simd.mul(high[0], high[0]), simd.mul(high[1], high[1])];
        let high = simd.add(simd.mul(high[0], self.places[0]), simd.mul(high[1], self.places[1]));
        simd.add(low, high)
    }
}
