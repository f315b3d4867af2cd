//! Chunks: up to eight elements of one kind of A, transformed into B's frame together, and the boxes around
//! them in B's frame.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use pong_arena::Table;
use pong_geometry::bounding::RELATIVE_MARGIN;
use pong_geometry::lanes::Lanes;
use pong_geometry::primitive::{Capsule, Ellipsoid, LineSegment, Point, PrimitiveKind, Sphere};
use pong_geometry::simd::{LANES, LaneBits, Numbers, Simd};
use pong_geometry::{Transform, Vec3};
use pong_model::box_tree::{BoxTree, NarrowBall, NarrowBox, NarrowBoxes};
use pong_model::{Batch, ChunkBoxes, Item, MovableGroup};

/// Up to eight elements of A in B's frame.
#[derive(Clone, Copy)]
pub(crate) struct Chunk<'a> {
    pub kind: PrimitiveKind,
    pub items: &'a [Item],
    /// Points and spheres: centres in A's frame.
    pub own_centers: Option<&'a Lanes>,
    /// Points and spheres: centres in B's frame.
    pub centers: &'a Lanes,
    /// Line segments and capsules: first and second ends of their axes, in B's frame.
    pub ends: &'a [Lanes; 2],
    /// Points, spheres, line segments and capsules: radii, m.
    pub radii: &'a [f64; LANES],
    /// Elements of all other kinds that the tester table has as A, in B's frame. Empty for kinds that are A
    /// only in testers registered by the host.
    carried: &'a [TransformedPrimitive],
    boxes: &'a LaneBoxes,
    /// Bounding spheres of spheres and ellipsoids that may meet triangles.
    spheres: Option<&'a SphereLaneSpace>,
}

/// Elements of a batch of A, and what their transformation into chunks in B's frame needs.
#[derive(Clone, Copy)]
pub(crate) struct ChunksOfA<'a> {
    kind: PrimitiveKind,
    body: &'a MovableGroup,
    batch: &'a Batch,
    items: &'a [Item],
    x_ba: &'a Transform,
    /// True if B has triangles that may be near. Many triangles reach only into the corners of a sphere's
    /// box, so bounding spheres are then stored beside the boxes.
    meets_triangles: bool,
}

/// Memory for one chunk, written in place because moving it costs more than computing it.
#[derive(Debug)]
pub(crate) struct ChunkSpace {
    centers: Lanes,
    ends: [Lanes; 2],
    boxes: LaneBoxes,
    spheres: SphereLaneSpace,
    /// Elements of the kinds that are transformed one by one.
    carried: Table<TransformedPrimitive>,
}

impl ChunkSpace {
    /// Heap memory beside the structure itself, bytes.
    pub const BYTES: usize = LANES * size_of::<TransformedPrimitive>();

    pub fn new() -> Self {
        Self {
            centers: Lanes::ORIGIN,
            ends: [Lanes::ORIGIN; 2],
            boxes: LaneBoxes { low: [[0.0; LANES]; 3], high: [[0.0; LANES]; 3] },
            spheres: SphereLaneSpace { centers: [[0.0; LANES]; 3], squares: [0.0; LANES], first_radius: 0.0 },
            carried: Table::with_capacity(LANES, TransformedPrimitive::NOTHING),
        }
    }
}

impl<'a> ChunksOfA<'a> {
    /// Chunks of one batch.
    pub fn new(body: &'a MovableGroup, batch: &'a Batch, x_ba: &'a Transform, meets_triangles: bool) -> Self {
        let items = &body.tree.items[batch.items.start as usize..batch.items.end as usize];
        Self { kind: batch.kind, body, batch, items, x_ba, meets_triangles }
    }

    /// Transforms the chunk that begins with element `first` of the batch, a multiple of eight, into B's
    /// frame. A point or a sphere that is the only element of its batch gets no box, because its search uses
    /// the sphere itself.
    #[inline(always)]
    pub fn carry<'l, S: Simd>(&self, simd: S, first: u32, space: &'l mut ChunkSpace) -> Chunk<'l>
    where
        'a: 'l,
    {
        let Self { kind, body, batch, items, x_ba, meets_triangles } = *self;
        let is_single = items.len() == 1;
        let items = &items[first as usize..];
        let items = &items[..items.len().min(LANES)];
        let ChunkSpace { centers, ends, boxes, spheres, carried } = space;
        let mut radii = &[0.0; LANES];
        let mut own_centers = None;
        let chunk = first as usize / LANES;
        // Stays empty for elements stored in lanes: `carried` then still holds an earlier chunk.
        let mut each: &[TransformedPrimitive] = &[];
        match (batch.spheres.get(chunk), batch.segments.get(chunk)) {
            (Some(spheres), _) => {
                spheres.centers.carry_in(simd, x_ba, centers);
                radii = &spheres.radii;
                own_centers = Some(&spheres.centers);
                if !is_single {
                    boxes.set_to_balls(simd, centers, radii);
                }
            }
            (None, Some(segments)) => {
                segments.ends[0].carry_in(simd, x_ba, &mut ends[0]);
                segments.ends[1].carry_in(simd, x_ba, &mut ends[1]);
                radii = &segments.radii;
                boxes.set_to_rods(simd, ends, radii);
            }
            (None, None) => {
                carry_each((body, kind), items, x_ba, carried);
                if carried.len() == items.len() {
                    boxes.set_to_each(carried.iter().map(|one| one.bounds(meets_triangles)));
                } else {
                    let lanes = 0..items.len() as u32;
                    boxes.set_to_each(lanes.map(|lane| carried_box(&batch.boxes, first + lane, x_ba)));
                }
                each = carried;
            }
        }
        let spheres = match kind {
            PrimitiveKind::Sphere if meets_triangles && !is_single => Some(spheres.set(centers, radii)),
            PrimitiveKind::Ellipsoid if meets_triangles => Some(spheres.set_around(each)),
            _ => None,
        };
        Chunk { kind, items, own_centers, centers, ends, radii, carried: each, boxes, spheres }
    }
}

/// Box of an element of B in B's frame, m, in double precision; infinite where it is unbounded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WideBox {
    low: [f64; 3],
    high: [f64; 3],
}

/// One bounding sphere per lane in B's frame: centres, m, and radii with a rounding margin.
// Aligned, because eight f64 fill one cache line: a load from an unaligned array would touch two lines.
#[derive(Debug)]
#[repr(align(64))]
struct SphereLaneSpace {
    centers: [[f64; LANES]; 3],
    /// Squared radii, m². Stored rather than computed when used: a compiler may move the squaring in front of
    /// the branch that it belongs to, and the values left by a chunk without spheres could then overflow.
    squares: [f64; LANES],
    /// Radius of the first sphere, m.
    first_radius: f64,
}

/// One box per lane in B's frame, m. Unused lanes hold an empty box or repeat another box, so that they never
/// widen a union; test results of unused lanes are masked.
// Aligned for the same reason as `SphereLaneSpace`.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct LaneBoxes {
    low: [[f64; LANES]; 3],
    high: [[f64; LANES]; 3],
}

impl Chunk<'_> {
    /// Returns the lanes whose boxes reach the box of an element of B and, if the chunk has bounding spheres,
    /// whose spheres reach it too.
    #[inline(always)]
    pub fn reach<S: Simd>(&self, simd: S, box_b: &WideBox) -> LaneBits {
        let near = self.boxes.met_by(simd, box_b) & self.used();
        match &self.spheres {
            Some(spheres) if near != 0 => near & spheres.reach(simd, box_b),
            _ => near,
        }
    }

    /// Returns true if the elements are points or spheres.
    #[inline(always)]
    pub fn is_of_balls(&self) -> bool {
        self.own_centers.is_some()
    }

    /// Box around the only element of a chunk, in the precision of the tree.
    #[inline(always)]
    pub fn single_box(&self, tree: &BoxTree) -> NarrowBox {
        if self.is_of_balls() {
            let (center, radius) = self.single_sphere();
            return tree.narrowed(&center.add_scalar(-radius), &center.add_scalar(radius));
        }
        let LaneBoxes { low: [x, y, z], high: [u, v, w] } = self.boxes;
        tree.narrowed(&Vec3::new(x[0], y[0], z[0]), &Vec3::new(u[0], v[0], w[0]))
    }

    /// Bounding sphere of a single element, in the precision of the tree. `None` except for points, spheres,
    /// and ellipsoids that may meet triangles.
    #[inline(always)]
    pub fn single_ball(&self, tree: &BoxTree) -> Option<NarrowBall> {
        if self.is_of_balls() {
            let (center, radius) = self.single_sphere();
            return Some(tree.narrowed_ball(&center, radius));
        }
        self.spheres.map(|spheres| spheres.first_narrowed(tree))
    }

    /// Centre of the first point or sphere, and its radius with a rounding margin, m.
    #[inline(always)]
    fn single_sphere(&self) -> (Vec3, f64) {
        let Sphere { center, radius } = self.sphere(0);
        (center, radius_with_room(&center, radius))
    }

    /// Lanes that hold elements.
    #[inline]
    pub fn used(&self) -> LaneBits {
        LaneBits::MAX >> (LANES - self.items.len())
    }

    /// One sphere of a chunk of spheres.
    #[inline]
    pub fn sphere(&self, lane: usize) -> Sphere {
        Sphere { center: self.centers.get(lane), radius: self.radii[lane] }
    }

    /// One element of a kind that is stored in lanes (point, sphere, line segment, capsule).
    #[inline(always)]
    pub fn of_lane(&self, lane: usize) -> Option<TransformedPrimitive> {
        Some(match self.kind {
            PrimitiveKind::Point => TransformedPrimitive::Point(Point { position: self.centers.get(lane) }),
            PrimitiveKind::Sphere => TransformedPrimitive::Sphere(self.sphere(lane)),
            PrimitiveKind::LineSegment => {
                TransformedPrimitive::Segment(LineSegment { ends: self.ends_of(lane) })
            }
            PrimitiveKind::Capsule => {
                TransformedPrimitive::Capsule(Capsule { ends: self.ends_of(lane), radius: self.radii[lane] })
            }
            _ => return None,
        })
    }

    #[inline(always)]
    fn ends_of(&self, lane: usize) -> [Vec3; 2] {
        [self.ends[0].get(lane), self.ends[1].get(lane)]
    }

    /// One ellipsoid of a chunk of ellipsoids; `None` in chunks of other kinds.
    #[inline(always)]
    pub fn ellipsoid(&self, lane: usize) -> Option<&Ellipsoid> {
        match self.carried.get(lane) {
            Some(TransformedPrimitive::Ellipsoid(ellipsoid)) => Some(ellipsoid),
            _ => None,
        }
    }

    /// One element of a kind that is not stored in lanes; `None` for all others, and for kinds that are never
    /// A in the tester table.
    #[inline(always)]
    pub fn carried(&self, lane: usize) -> Option<&TransformedPrimitive> {
        self.carried.get(lane)
    }
}

/// Sphere or ellipsoid of A, whose pairs with triangles are filtered eight at a time.
#[derive(Clone, Copy)]
pub(crate) enum Ellipsoidal<'a> {
    Sphere(Sphere),
    Ellipsoid(&'a Ellipsoid),
}

impl<'a> Ellipsoidal<'a> {
    /// Element of a chunk of spheres or ellipsoids.
    #[inline(always)]
    pub fn of(chunk: &'a Chunk<'_>, lane: usize) -> Self {
        match chunk.ellipsoid(lane) {
            Some(ellipsoid) => Self::Ellipsoid(ellipsoid),
            None => Self::Sphere(chunk.sphere(lane)),
        }
    }
}

fn carry_each(
    (body, kind): (&MovableGroup, PrimitiveKind),
    items: &[Item],
    x_ba: &Transform,
    carried: &mut Table<TransformedPrimitive>,
) {
    carried.clear();
    for item in items {
        let Some(one) = TransformedPrimitive::new(body, kind, item.element, x_ba) else { return };
        carried.push(one).expect("the list has room for all lanes");
    }
}

/// Box in B's frame around the box that A's tree has for an element; infinite if that box is unbounded.
fn carried_box(boxes: &BoxTree, element: u32, x_ba: &Transform) -> (Vec3, Vec3) {
    let (low, high) = boxes.bounds(element);
    if !low.iter().chain(high.iter()).all(|x| x.is_finite()) {
        return (Vec3::repeat(f64::NEG_INFINITY), Vec3::repeat(f64::INFINITY));
    }
    let center = x_ba.point(&(0.5 * (low + high)));
    let half = x_ba.rotation.abs() * (0.5 * (high - low));
    (center - half, center + half)
}

impl WideBox {
    /// Empty box, to fill memory.
    pub const NOTHING: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// Sets this box from lane `lane` of a tree node.
    #[inline(always)]
    pub fn set(&mut self, tree: &BoxTree, boxes: &NarrowBoxes, lane: usize) {
        let [low, high] = &boxes.bounds;
        for axis in 0..3 {
            self.low[axis] = tree.origin[axis] + widened(low[axis][lane], tree.is_bounded);
            self.high[axis] = tree.origin[axis] + widened(high[axis][lane], tree.is_bounded);
        }
    }
}

impl LaneBoxes {
    /// Sets the boxes of points and spheres. Only the radius gets a rounding margin: a tree box has a margin
    /// for rounding at its own coordinates, and the coordinates of a centre that touches it exceed those by
    /// at most the radius.
    #[inline(always)]
    fn set_to_balls<S: Simd>(&mut self, simd: S, centers: &Lanes, radii: &[f64; LANES]) {
        let radius = Numbers::load(simd, radii);
        let radius = radius + radius * radius.all(ROUNDING);
        for (axis, center) in [&centers.x, &centers.y, &centers.z].into_iter().enumerate() {
            let center = Numbers::load(simd, center);
            self.low[axis] = (center - radius).store();
            self.high[axis] = (center + radius).store();
        }
    }

    /// Sets the boxes of capsules or line segments to the values that [`set_to_each`](Self::set_to_each)
    /// gives for [`TransformedPrimitive::bounds`].
    #[inline(always)]
    fn set_to_rods<S: Simd>(&mut self, simd: S, ends: &[Lanes; 2], radii: &[f64; LANES]) {
        let radius = Numbers::load(simd, radii);
        let [a, b] = ends;
        for (axis, (a, b)) in [(&a.x, &b.x), (&a.y, &b.y), (&a.z, &b.z)].into_iter().enumerate() {
            let (a, b) = (Numbers::load(simd, a), Numbers::load(simd, b));
            let (low, high) = (a.smaller(b) - radius, a.larger(b) + radius);
            let extra = low.abs().larger(high.abs()) * radius.all(ROUNDING);
            self.low[axis] = (low - extra).store();
            self.high[axis] = (high + extra).store();
        }
    }

    /// Sets the extent along one axis from centres and half widths, m, with a rounding margin.
    #[inline(always)]
    fn set_along<S: Simd>(&mut self, axis: usize, center: Numbers<S>, half: Numbers<S>) {
        let half = half + (center.abs() + half) * half.all(ROUNDING);
        self.low[axis] = (center - half).store();
        self.high[axis] = (center + half).store();
    }

    /// Boxes in B's frame around the eight boxes of a superchunk of A, which are rotated there.
    #[inline(always)]
    pub fn of_chunks<S: Simd>(simd: S, chunks: &ChunkBoxes, x_ba: &Transform) -> Self {
        let center = chunks.center.carried_in(simd, x_ba);
        let turn = Transform { rotation: x_ba.rotation.abs(), translation: Vec3::zeros() };
        let half = chunks.half.carried_in(simd, &turn);
        let mut boxes = Self { low: [[0.0; LANES]; 3], high: [[0.0; LANES]; 3] };
        let axes = [(&center.x, &half.x), (&center.y, &half.y), (&center.z, &half.z)];
        for (axis, (center, half)) in axes.into_iter().enumerate() {
            boxes.set_along(axis, Numbers::load(simd, center), Numbers::load(simd, half));
        }
        boxes
    }

    fn set_to_each(&mut self, bounds: impl Iterator<Item = (Vec3, Vec3)>) {
        *self = Self { low: [[f64::MAX; LANES]; 3], high: [[-f64::MAX; LANES]; 3] };
        for (lane, (low, high)) in bounds.enumerate() {
            for axis in 0..3 {
                let extra = margin(low[axis].abs().max(high[axis].abs()));
                self.low[axis][lane] = low[axis] - extra;
                self.high[axis][lane] = high[axis] + extra;
            }
        }
    }

    /// Returns the lanes whose boxes overlap a tree box.
    #[inline(always)]
    fn met_by<S: Simd>(&self, simd: S, one: &WideBox) -> LaneBits {
        let mut met = simd.mask(LaneBits::MAX);
        for axis in 0..3 {
            let (low, high) = (simd.load(&self.low[axis]), simd.load(&self.high[axis]));
            met = simd.and(met, simd.at_least(high, simd.splat(one.low[axis])));
            met = simd.and(met, simd.at_least(simd.splat(one.high[axis]), low));
        }
        simd.bits(met)
    }

    /// All eight boxes in the precision of the tree, rounded outward as [`BoxTree::narrowed`] does. A lower
    /// bound that is NaN becomes the least finite number, and an upper bound the greatest, so that the box
    /// rejects nothing.
    #[inline(always)]
    #[allow(clippy::manual_clamp, reason = "what is no number has to become one")]
    pub fn narrowed<S: Simd>(&self, simd: S, tree: &BoxTree) -> NarrowBoxes {
        let mut narrow = NarrowBoxes::NOTHING;
        let relative = simd.splat(1.01 * f64::from(f32::EPSILON));
        let absolute = simd.splat(f64::from(f32::MIN_POSITIVE));
        for axis in 0..3 {
            let origin = simd.splat(tree.origin[axis]);
            let low = simd.sub(simd.load(&self.low[axis]), origin);
            let room = simd.add(simd.mul(simd.abs(low), relative), absolute);
            let below = simd.store(simd.sub(low, room));
            let high = simd.sub(simd.load(&self.high[axis]), origin);
            let room = simd.add(simd.mul(simd.abs(high), relative), absolute);
            let above = simd.store(simd.add(high, room));
            for (narrow, below) in narrow.bounds[0][axis].iter_mut().zip(below) {
                *narrow = (below as f32).max(-f32::MAX).min(f32::MAX);
            }
            for (narrow, above) in narrow.bounds[1][axis].iter_mut().zip(above) {
                *narrow = (above as f32).min(f32::MAX).max(-f32::MAX);
            }
        }
        narrow
    }
}

impl SphereLaneSpace {
    #[inline(always)]
    fn set(&mut self, centers: &Lanes, radii: &[f64; LANES]) -> &Self {
        let with_room = |lane: usize| radius_with_room(&centers.get(lane), radii[lane]);
        self.centers = [centers.x, centers.y, centers.z];
        self.first_radius = with_room(0);
        for (lane, square) in self.squares.iter_mut().enumerate() {
            let radius = with_room(lane);
            *square = radius * radius;
        }
        self
    }

    fn set_around(&mut self, carried: &[TransformedPrimitive]) -> &Self {
        let (mut centers, mut radii) = (Lanes::ORIGIN, [0.0; LANES]);
        for (lane, one) in carried.iter().enumerate() {
            if let TransformedPrimitive::Ellipsoid(ellipsoid) = one {
                centers.set(lane, &ellipsoid.center);
                radii[lane] = ellipsoid.semi_axes.max();
            }
        }
        self.set(&centers, &radii)
    }

    /// Returns the lanes whose spheres reach a tree box.
    #[inline(always)]
    fn reach<S: Simd>(&self, simd: S, one: &WideBox) -> LaneBits {
        let mut distance = simd.splat(0.0);
        for axis in 0..3 {
            let center = simd.load(&self.centers[axis]);
            let (low, high) = (simd.splat(one.low[axis]), simd.splat(one.high[axis]));
            distance = simd.add(distance, square_outside(simd, center, low, high));
        }
        simd.bits(simd.at_least(simd.load(&self.squares), distance))
    }

    /// First sphere, in the precision of the tree.
    #[inline(always)]
    fn first_narrowed(&self, tree: &BoxTree) -> NarrowBall {
        let [x, y, z] = &self.centers;
        tree.narrowed_ball(&Vec3::new(x[0], y[0], z[0]), self.first_radius)
    }
}

/// Bound of a tree box in double precision. ±`f32::MAX` means unbounded and becomes ±∞, unless all boxes of
/// the tree are bounded.
#[inline(always)]
fn widened(bound: f32, all_bounded: bool) -> f64 {
    if all_bounded || bound.abs() < f32::MAX {
        f64::from(bound)
    } else {
        f64::INFINITY.copysign(f64::from(bound))
    }
}

/// Square of the distance by which `x` lies outside `low`…`high`.
#[inline(always)]
fn square_outside<S: Simd>(simd: S, x: S::Eight, low: S::Eight, high: S::Eight) -> S::Eight {
    let zero = simd.splat(0.0);
    let (below, above) = (simd.sub(low, x), simd.sub(x, high));
    let outside = simd.select(simd.below(zero, below), below, zero);
    let outside = simd.select(simd.below(outside, above), above, outside);
    simd.mul(outside, outside)
}

/// Radius of a sphere with a rounding margin, m.
#[inline(always)]
fn radius_with_room(center: &Vec3, radius: f64) -> f64 {
    radius + margin(center.x.abs() + center.y.abs() + center.z.abs() + radius)
}

/// Relative rounding margin.
const ROUNDING: f64 = 4.0 * RELATIVE_MARGIN;

/// Rounding margin for coordinates of this size, m.
#[inline(always)]
fn margin(size: f64) -> f64 {
    ROUNDING * size
}

#[cfg(test)]
mod tests {
    use super::*;
    use pong_geometry::Pose;
    use pong_geometry::simd::{self, Kernel};
    use pong_testkit::Random;

    enum Axes<'a> {
        OfBalls(&'a Lanes),
        OfRods(&'a [Lanes; 2]),
    }

    struct BoxesAround<'a>(Axes<'a>, &'a [f64; LANES]);

    impl Kernel for BoxesAround<'_> {
        type Output = LaneBoxes;

        fn run<S: Simd>(self, simd: S) -> LaneBoxes {
            let Self(axes, radii) = self;
            let mut boxes = ChunkSpace::new().boxes;
            match axes {
                Axes::OfBalls(centers) => boxes.set_to_balls(simd, centers, radii),
                Axes::OfRods(ends) => boxes.set_to_rods(simd, ends, radii),
            }
            boxes
        }
    }

    /// A sphere that touches a point always reaches the point's box, whatever its size. Without a margin of
    /// its own, rounding could move the surface of a large sphere off the point by more than the margin of
    /// the point's box.
    #[test]
    fn a_ball_of_any_size_reaches_the_box_of_what_it_touches() {
        let mut random = Random::new(13, 0, 0);
        for case in 0..2000 {
            let place: f64 = random.between(-1.0, 1.0);
            let radii = [0; LANES].map(|_| 10.0_f64.powi(case % 19 - 6) * random.between(1.0, 10.0));
            let room = RELATIVE_MARGIN * place.abs();
            let above = Lanes { x: radii.map(|radius| place + radius), ..Lanes::ORIGIN };
            let below = Lanes { x: radii.map(|radius| place - radius), ..Lanes::ORIGIN };
            let low = simd::run(BoxesAround(Axes::OfBalls(&above), &radii)).low[0];
            let high = simd::run(BoxesAround(Axes::OfBalls(&below), &radii)).high[0];
            for (lane, radius) in radii.iter().enumerate() {
                assert!(low[lane] <= place + room, "{place} {radius}: {}", low[lane] - place);
                assert!(high[lane] >= place - room, "{place} {radius}: {}", high[lane] - place);
                let size = 10.0 * RELATIVE_MARGIN * (place.abs() + radius);
                assert!(low[lane] >= place - size && high[lane] <= place + size, "{place} {radius}");
            }
        }
    }

    /// Boxes of random capsules and line segments are the same, computed eight at a time and one by one.
    #[test]
    fn boxes_of_eight_rods_are_those_of_each() {
        let mut random = Random::new(11, 0, 0);
        for case in 0..200 {
            let size = 10.0_f64.powi(case % 9 - 4);
            let x_ba = Pose::new(random.vector(100.0 * size), [0.3, -0.7, 0.5, 0.4]).transform();
            let mut ends = [Lanes::ORIGIN; 2];
            let mut radii = [0.0; LANES];
            let segments = [0; LANES].map(|_| [random.vector(size), random.vector(size)]);
            for (lane, rod) in segments.iter().enumerate() {
                radii[lane] = if case % 2 == 0 { 0.0 } else { random.between(0.0, size) };
                (0..2).for_each(|end| ends[end].set(lane, &x_ba.point(&rod[end])));
            }
            let of_eight = simd::run(BoxesAround(Axes::OfRods(&ends), &radii));
            let mut of_each = ChunkSpace::new().boxes;
            of_each.set_to_each((0..LANES).map(|lane| {
                let ends = [ends[0].get(lane), ends[1].get(lane)];
                TransformedPrimitive::Capsule(Capsule { ends, radius: radii[lane] }).bounds(false)
            }));
            assert_eq!((of_eight.low, of_eight.high), (of_each.low, of_each.high), "case {case}");
        }
    }
}
