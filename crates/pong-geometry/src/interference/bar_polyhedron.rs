//! Line segment and capsule (A) – convex solid of planar faces (B): the two ends of the axis yield
//! (docs/theory.md, 2.8).
//!
//! Let x be a place on the axis, −½ at end 0 and ½ at end 1, and W = 1 + 4x². On a plane that has B behind it,
//! the axis stores ¼k·(e₀² + e₁²), with e₀ and e₁ the depths of its ends, or 0 above the plane. The plane that
//! stores least pushes. Its load acts at one place x of the axis, at the depth δ: it stores ½k·δ²/W.
//!
//! * *Place of the load outside B.* Then δ is the radius minus the distance of the place from B, and no other place has
//!   more δ²/W. A place that has the most, and is outside, gives the least energy on planes.
//! * *Otherwise* the plane is that of a face, or touches B along an edge. Turned about a vertex, about the part of the
//!   axis across the normal, it would store less.

use super::capsule_polyhedron::{CapsuleAtPiece, each_edge_near};
use super::line_segment_polyhedron::part_in_solid;
use super::round_surface::ROUNDING;
use super::sphere_polyhedron::{Beside, sphere_beside_polyhedron};
use super::two_capsules::{OverlapContacts, lever_shares, load_of, place_on_axis, spread, zero_of_rising};
use super::two_ended_round::EndContact;
use super::{Feature, FeatureKind, Interference};
use crate::primitive::{Capsule, LineSegment, PlaneBlock, Polyhedron, Sphere};
use crate::simd::{LANES, Simd, Splat, run_at_level};
use crate::{Vec3, divisor};

/// Tests a segment against a convex solid all of whose faces push.
#[inline]
pub fn segment_solid(segment: &LineSegment, polyhedron: &Polyhedron) -> OverlapContacts {
    let Some(part) = part_in_solid(segment, polyhedron) else { return [None; 2] };
    let bar = Bar::new(&segment.ends, 0.0, polyhedron);
    match bar.sunk_in(&[]) {
        Some(load) => bar.contacts(&load, part.map(|at| at - 0.5)),
        None => [None; 2],
    }
}

/// Tests a capsule against a convex solid all of whose faces push. If the place of the load is inside the solid, and
/// `entered` is not empty, only these faces, their neighbours and the edges of these faces push.
#[inline]
pub fn capsule_solid(capsule: &Capsule, polyhedron: &Polyhedron, entered: &[usize]) -> OverlapContacts {
    if CapsuleAtPiece::new(capsule, polyhedron).is_none() {
        return [None; 2];
    }
    let bar = Bar::new(&capsule.ends, capsule.radius, polyhedron);
    let first = bar.nearest(-0.5, capsule.radius);
    if let Some(load) = bar.on_tip(-0.5, &first) {
        return bar.contacts(&load, [-0.5; 2]);
    }
    let second = bar.nearest(0.5, capsule.radius);
    if let Some(load) = bar.on_tip(0.5, &second) {
        return bar.contacts(&load, [0.5; 2]);
    }
    let at_ends = [first, second];
    let (load, from) = match bar.outside(&at_ends) {
        Outside::Apart => return [None; 2],
        Outside::Load(load) => (load, (load.at, Some(load.feature))),
        Outside::SunkIn => {
            let Some(load) = bar.sunk_in(entered) else { return [None; 2] };
            let part = part_in_solid(&LineSegment { ends: capsule.ends }, polyhedron);
            let inside = part.map_or(load.at, |[from, to]| load.at.clamp(from - 0.5, to - 0.5));
            (load, (inside, None))
        }
    };
    bar.contacts(&load, bar.overlap(&load, &at_ends, from))
}

/// Where a place is: nearest to a feature, or inside the solid (`None`).
pub(super) type Whereabouts = Option<Feature>;

/// A bar of two half springs in B's frame.
pub(super) struct Bar<'a> {
    ends: [Vec3; 2],
    /// Vector from end 0 to end 1, m.
    pub(super) along_b: Vec3,
    radius: f64,
    pub(super) polyhedron: &'a Polyhedron,
}

/// Load on the plane of least energy.
#[derive(Clone, Copy, Debug)]
struct Load {
    /// Its place on the axis, −½…½.
    at: f64,
    /// Depth δ at this place, m.
    depth: f64,
    normal_b: Vec3,
    feature: Feature,
}

/// Nearest point of the solid to a place of the axis.
#[derive(Clone, Copy, Debug)]
enum Nearest {
    /// The place is inside the solid.
    Inside,
    /// Distance, m, direction from there to the place, and feature.
    At(f64, Vec3, Feature),
    /// The distance exceeds the reach of the search.
    Far,
}

impl Nearest {
    fn whereabouts(&self) -> Whereabouts {
        match self {
            Self::At(_, _, feature) => Some(*feature),
            Self::Inside | Self::Far => None,
        }
    }
}

/// Outcome of the search for a load at a place outside.
enum Outside {
    Apart,
    Load(Load),
    /// The place of the load is inside the solid.
    SunkIn,
}

/// Axis of a bar as seen along an edge or from a vertex.
struct Line {
    /// Square of its length, m².
    square: f64,
    /// Place nearest to the edge or vertex; it may be beyond the ends.
    foot: f64,
    /// Square of the distance there, m².
    height: f64,
}

/// Factor on a distance, far above rounding.
const BEYOND_ROUNDING: f64 = 1.0 + 1e-9;

/// Energies within this factor count as equal, so that rounding does not choose between equal faces.
const TIE: f64 = 1.0 - 1e-12;

impl<'a> Bar<'a> {
    fn new(ends: &[Vec3; 2], radius: f64, polyhedron: &'a Polyhedron) -> Self {
        Self { ends: *ends, along_b: ends[1] - ends[0], radius, polyhedron }
    }

    /// Returns a place of the axis, m.
    pub(super) fn place(&self, at: f64) -> Vec3 {
        place_on_axis(&self.ends, &self.along_b, at)
    }

    /// Rounding error of a distance, m.
    fn rounding(&self) -> f64 {
        ROUNDING * self.ends[0].amax().max(self.ends[1].amax())
    }

    /// Returns the point of the solid nearest to a place of the axis, if it is nearer than `reach` (m).
    fn nearest(&self, at: f64, reach: f64) -> Nearest {
        let center = self.place(at);
        match sphere_beside_polyhedron(&Sphere { center, radius: reach }, self.polyhedron) {
            Beside::Inside => Nearest::Inside,
            Beside::At(found) => Nearest::At(reach - found.depth, found.normal_b, found.feature),
            // On an edge or a vertex, to rounding, no feature may count as the nearest one.
            Beside::Far
                if self.polyhedron.faces.iter().all(|face| face.height(&center) <= self.rounding()) =>
            {
                Nearest::Inside
            }
            Beside::Far => Nearest::Far,
        }
    }

    /// Returns the load at an end that touches, if δ²/W falls from there.
    fn on_tip(&self, at: f64, near: &Nearest) -> Option<Load> {
        let Nearest::At(distance, normal_b, feature) = *near else { return None };
        let depth = self.radius - distance;
        let falls = normal_b.dot(&self.along_b) * (2.0 * at) <= -depth;
        falls.then_some(Load { at, depth, normal_b, feature })
    }

    /// Searches the place of most δ²/W, given the nearest points at the two ends within the radius: walks there from an
    /// end that touches, or from the middle.
    fn outside(&self, at_ends: &[Nearest; 2]) -> Outside {
        let (start, way) = match at_ends {
            [Nearest::Inside, Nearest::Inside] => return Outside::SunkIn,
            [Nearest::Far, Nearest::Far] => match self.start_between() {
                Some(start) => start,
                None => return Outside::Apart,
            },
            [Nearest::Far, end] => ((0.5, end.whereabouts()), -1.0),
            [end, _] => ((-0.5, end.whereabouts()), 1.0),
        };
        // Inside, the place of least W.
        let goal = |here: Whereabouts| here.map_or(0.0, |feature| self.best_for(feature));
        let (at, Some(feature)) = self.walk(start, way, goal) else { return Outside::SunkIn };
        let (distance, normal_b) = self.beside(feature, at);
        if distance >= self.radius {
            Outside::Apart
        } else if distance <= self.rounding() {
            Outside::SunkIn
        } else {
            Outside::Load(Load { at, depth: self.radius - distance, normal_b, feature })
        }
    }

    /// Returns a place between the ends, where it is, and the way to the load (±1), if neither end touches; `None` if
    /// nothing touches.
    fn start_between(&self) -> Option<((f64, Whereabouts), f64)> {
        // What touches between the ends comes within the radius of an edge, or passes through the solid.
        let (mut start, mut is_near) = (None, false);
        each_edge_near(&self.ends, self.radius, self.polyhedron, &mut |index| {
            is_near = true;
            start = start.or_else(|| self.over_edge(index));
        });
        if let Some(at) = start {
            return Some((at, -at.0.signum()));
        }
        if !is_near && part_in_solid(&LineSegment { ends: self.ends }, self.polyhedron).is_none() {
            return None;
        }
        match self.nearest(0.0, (self.radius + 0.5 * self.along_b.norm()) * BEYOND_ROUNDING) {
            Nearest::Far => None,
            Nearest::Inside => Some(((0.0, None), 1.0)),
            Nearest::At(_, normal, feature) => {
                Some(((0.0, Some(feature)), if normal.dot(&self.along_b) > 0.0 { -1.0 } else { 1.0 }))
            }
        }
    }

    /// Returns the place nearest to the line of an edge, if the edge is what is nearest to it.
    fn over_edge(&self, index: usize) -> Option<(f64, Whereabouts)> {
        let (edge, feature) = (&self.polyhedron.edges[index], Feature::edge(index));
        let Line { foot, .. } = self.line(feature)?;
        let [from, to] = edge.vertices.map(|vertex| self.polyhedron.vertices[vertex as usize].position);
        let (arm, back) = (self.place(foot) - from, self.place(foot) - to);
        let is_beside = edge.push?.outwards.iter().all(|outward| outward.dot(&arm) >= 0.0);
        let is_along = edge.direction.dot(&arm) >= 0.0 && edge.direction.dot(&back) <= 0.0;
        (foot.abs() < 0.5 && is_beside && is_along).then_some((foot, Some(feature)))
    }

    /// Returns the place of most δ²/W for one feature alone, a plane, a line or a point; if none touches, the nearest one.
    fn best_for(&self, feature: Feature) -> f64 {
        let Some(Line { square, foot, height }) = self.line(feature) else {
            let depths = self.depths_below(feature.index());
            if depths[0] <= 0.0 && depths[1] <= 0.0 {
                return if depths[0] > depths[1] { -0.5 } else { 0.5 };
            }
            return self.on_plane(depths, Vec3::zeros(), feature).at;
        };
        let depth_at = |at: f64| {
            let beyond = at - foot;
            let distance = (height + square * beyond * beyond).sqrt();
            (beyond, distance, self.radius - distance)
        };
        // Shallow contacts have the load close to the nearest place.
        let nearest = foot.clamp(-0.5, 0.5);
        if depth_at(nearest).2 <= 0.0 {
            return nearest;
        }
        zero_of_rising(nearest, |at| {
            let (beyond, distance, depth) = depth_at(at);
            let lean = square * beyond / divisor(distance);
            let (spread, depth) = (spread(at), depth.max(0.0));
            let bend = (square - lean * lean).max(0.0) / divisor(distance);
            (lean + 4.0 * depth * at / spread, bend + 4.0 * depth / (spread * spread), at)
        })
    }

    /// Returns the axis as seen along an edge or from a vertex; `None` for a face.
    fn line(&self, feature: Feature) -> Option<Line> {
        let (place, across) = match feature.kind() {
            FeatureKind::Face => return None,
            FeatureKind::Edge => {
                let edge = &self.polyhedron.edges[feature.index()];
                (edge.vertices[0], Some(edge.direction))
            }
            FeatureKind::Vertex => (feature.index() as u32, None),
        };
        let flat = |v: Vec3| across.map_or(v, |edge| v - edge * edge.dot(&v));
        let along = flat(self.along_b);
        let from_middle = flat(self.polyhedron.vertices[place as usize].position - self.place(0.0));
        let square = along.norm_squared();
        let foot = from_middle.dot(&along) / divisor(square);
        Some(Line { square, foot, height: (from_middle - along * foot).norm_squared() })
    }

    /// Returns the load on a plane below which the ends have these depths, of which one at least is positive.
    fn on_plane(&self, depths: [f64; 2], normal_b: Vec3, feature: Feature) -> Load {
        let (at, depth) = load_of(depths);
        Load { at, depth, normal_b, feature }
    }

    /// Returns the load if its place is inside the solid; `None` if nothing pushes.
    fn sunk_in(&self, entered: &[usize]) -> Option<Load> {
        let polyhedron = self.polyhedron;
        let face = match entered {
            [] => least_face_of(self, polyhedron)?,
            _ => self.least_of_near(entered)?,
        };
        let depths = self.depths_below(face);
        let mut energy = depths.map(|depth| depth.max(0.0) * depth.max(0.0)).iter().sum::<f64>();
        let mut best = self.on_plane(depths, polyhedron.faces[face].normal, Feature::face(face));
        // The load is √(½·W·energy) deep, and W is 2 at most.
        let reach = energy.sqrt() - self.radius;
        let mut try_edge = |index: usize| {
            if let Some((stored, load)) = self.at_edge(index, energy * TIE) {
                (energy, best) = (stored, load);
            }
        };
        match entered {
            [] => each_edge_near(&self.ends, reach, polyhedron, &mut try_edge),
            _ => {
                let rims = entered.iter().flat_map(|&face| polyhedron.rim(face));
                rims.for_each(|rim| try_edge(rim.edge as usize));
            }
        }
        Some(best)
    }

    fn depths_below(&self, face: usize) -> [f64; 2] {
        self.ends.map(|end| self.radius - self.polyhedron.height(face, &end))
    }

    /// Returns the face of least energy among some faces and their neighbours; `None` if it stores none.
    fn least_of_near(&self, faces: &[usize]) -> Option<usize> {
        let beside =
            faces.iter().flat_map(|&face| self.polyhedron.rim(face)).map(|rim| rim.neighbor as usize);
        let energy = |face: usize| {
            self.depths_below(face).iter().map(|depth| depth.max(0.0) * depth.max(0.0)).sum::<f64>()
        };
        let least = faces.iter().copied().chain(beside).map(|face| (energy(face), face));
        let (energy, face) = least.reduce(|a, b| if b.0 < a.0 * TIE { b } else { a })?;
        (energy > 0.0).then_some(face)
    }

    /// Returns what the plane through an edge that the axis has sunk below stores, as e₀² + e₁², and its load; `None`
    /// if no such plane stores less than its neighbours, or if it stores `most` or more.
    ///
    /// Across the edge, let L be the length of the axis, f the place on it nearest to the edge, and H the distance
    /// there. At the place x the edge is d = √(H² + L²·(x − f)²) away, δ = r + d, and the plane is square to this
    /// direction. The energy is stationary where d'·W = 4x·δ. With x = f·y this is
    ///
    /// ```text
    /// ¼L²·(1 − 1/y + 4f²·(y − 1)) = H² + r·d
    /// ```
    ///
    /// The difference of the two sides is concave in y and negative at y = 1: Newton's steps from there rise to its
    /// first zero, which is the minimum. There is none on the other side of f.
    fn at_edge(&self, index: usize, most: f64) -> Option<(f64, Load)> {
        const STEPS: usize = 50;
        let edge = &self.polyhedron.edges[index];
        let push = edge.push.as_ref()?;
        let across = |v: Vec3| v - edge.direction * edge.direction.dot(&v);
        let along = across(self.along_b);
        let square = along.norm_squared();
        if square <= f64::EPSILON * self.along_b.norm_squared() {
            return None;
        }
        let from_middle = self.polyhedron.vertices[edge.vertices[0] as usize].position - self.place(0.0);
        let foot = from_middle.dot(&along) / square;
        // The normal leans towards the middle of the axis.
        let leans = |normal: &Vec3| normal.dot(&along) * foot <= 0.0;
        if foot.abs() >= 0.5 || !push.normals.iter().any(leans) {
            return None;
        }
        // From the axis to the edge; out of the solid if they meet, to rounding.
        let mut away = edge.direction.cross(&along).normalize();
        let height = away.dot(&from_middle);
        let is_back = match height.abs() <= self.rounding() {
            true => away.dot(&(push.normals[0] + push.normals[1])) < 0.0,
            false => height < 0.0,
        };
        if is_back {
            away = -away;
        }
        let height = height.abs();
        if (self.radius + height) * (self.radius + height) >= most {
            return None;
        }
        let (quarter, feet) = (0.25 * square, 4.0 * foot * foot);
        let mut ratio = 1.0;
        let mut distance = height;
        for _ in 0..STEPS {
            let beyond = foot * (ratio - 1.0);
            distance = (height * height + square * beyond * beyond).sqrt();
            let left = quarter * (1.0 - 1.0 / ratio + feet * (ratio - 1.0));
            let difference = left - height * height - self.radius * distance;
            let falls = self.radius * square * foot * beyond / distance.max(f64::MIN_POSITIVE);
            let slope = quarter * (1.0 / (ratio * ratio) + feet) - falls;
            if slope <= 0.0 {
                return None;
            }
            let next = ratio - difference / slope;
            // Beyond the end, or without a bound where the edge is at the middle of the axis: the square must not overflow.
            if next * foot.abs() >= 0.5 || next > 1e150 {
                return None;
            }
            let step = (next - ratio).abs();
            ratio = next;
            if step <= f64::EPSILON * ratio {
                break;
            }
        }
        let at = foot * ratio;
        let (depth, spread) = (self.radius + distance, spread(at));
        let energy = 2.0 * depth * depth / spread;
        let lean = -4.0 * at * depth / (spread * square.sqrt());
        let rest = 1.0 - lean * lean;
        if energy >= most || rest <= 0.0 {
            return None;
        }
        let normal_b = (along * (lean / square.sqrt()) + away * rest.sqrt()).normalize();
        let is_between = push.outwards.iter().all(|outward| outward.dot(&normal_b) > 0.0);
        is_between.then_some((energy, Load { at, depth, normal_b, feature: Feature::edge(index) }))
    }

    /// Returns the part of the axis that is less than the radius away from the solid, as places from −½ to ½. `from` is
    /// one of its places.
    fn overlap(&self, load: &Load, at_ends: &[Nearest; 2], from: (f64, Whereabouts)) -> [f64; 2] {
        [0, 1].map(|end| {
            let tip = [-0.5, 0.5][end];
            let leaves = |here: Whereabouts| match here {
                Some(feature) => self.leaves(feature, tip),
                None => f64::INFINITY.copysign(tip),
            };
            match at_ends[end] {
                Nearest::Inside => tip,
                Nearest::At(distance, ..) if distance < self.radius => tip,
                _ if load.at == tip || load.at == -tip => load.at,
                _ => self.walk(from, 2.0 * tip, leaves).0,
            }
        })
    }

    /// Returns the place at which a feature alone is the radius away, towards an end.
    fn leaves(&self, feature: Feature, tip: f64) -> f64 {
        match self.line(feature) {
            Some(Line { square, foot, height }) => {
                let half = (self.radius * self.radius - height).max(0.0) / divisor(square);
                foot + half.sqrt().copysign(tip)
            }
            None => {
                let [first, second] = self.depths_below(feature.index());
                match (second - first) * tip < 0.0 {
                    true => first / divisor(first - second) - 0.5,
                    false => f64::INFINITY.copysign(tip),
                }
            }
        }
    }

    /// Returns the contacts that carry a load, at the two ends of the overlap by the lever rule, each as deep as its
    /// place is below the plane. Where the whole axis overlaps, these are the two half springs at its ends. Below a
    /// sharp edge the load may be beside the overlap, which then reaches to it.
    fn contacts(&self, load: &Load, [from, to]: [f64; 2]) -> OverlapContacts {
        let lean = load.normal_b.dot(&self.along_b);
        let overlap = [from.min(load.at), to.max(load.at)];
        let levers = match load.at {
            -0.5 => [1.0, 0.0],
            0.5 => [0.0, 1.0],
            at => lever_shares(&overlap, at),
        };
        [0, 1].map(|end| {
            let at = overlap[end];
            let depth = load.depth - lean * (at - load.at);
            if depth <= 0.0 || levers[end] <= 0.0 {
                return None;
            }
            let is_whole = overlap == [-0.5, 0.5];
            let share = match is_whole {
                true => 1.0,
                false => 2.0 * levers[end] * load.depth / (spread(load.at) * depth),
            };
            let interference = Interference {
                depth,
                normal_b: load.normal_b,
                deepest_b: self.place(at) - load.normal_b * self.radius,
                feature: load.feature,
            };
            Some(EndContact { interference, share })
        })
    }
}

/// Returns the face that stores the least energy, the first of equal ones; `None` if it stores none.
fn least_face_of(bar: &Bar<'_>, polyhedron: &Polyhedron) -> Option<usize> {
    run_at_level!(least_face(bar: Bar<'a>, polyhedron: Polyhedron) -> Option<usize>)
}

#[inline(always)]
fn least_face<S: Simd>(simd: S, bar: &Bar<'_>, polyhedron: &Polyhedron) -> Option<usize> {
    let ends = [Splat::new(simd, &bar.ends[0]), Splat::new(simd, &bar.ends[1])];
    let radius = simd.splat(bar.radius);
    let mut most = simd.splat(f64::NEG_INFINITY);
    for block in &polyhedron.planes().blocks {
        most = simd.larger(simd.sub(simd.splat(0.0), energies(simd, block, &ends, radius)), most);
    }
    let least = -simd.largest(most);
    if !(least > 0.0 && least.is_finite()) {
        return None;
    }
    let limit = simd.splat(least / TIE);
    for (index, block) in polyhedron.planes().blocks.iter().enumerate() {
        let faces = simd.bits(simd.at_least(limit, energies(simd, block, &ends, radius)));
        if faces != 0 {
            return Some(index * LANES + faces.trailing_zeros() as usize);
        }
    }
    None
}

/// Returns e₀² + e₁² of eight faces, m².
#[inline(always)]
fn energies<S: Simd>(simd: S, block: &PlaneBlock, ends: &[Splat<S>; 2], radius: S::Eight) -> S::Eight {
    let zero = simd.splat(0.0);
    let first = simd.larger(simd.sub(radius, block.heights(simd, &ends[0])), zero);
    let second = simd.larger(simd.sub(radius, block.heights(simd, &ends[1])), zero);
    simd.add(simd.mul(first, first), simd.mul(second, second))
}
