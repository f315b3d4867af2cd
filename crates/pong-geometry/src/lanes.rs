//! Tests of eight points at a time against a polyhedron.

use crate::primitive::{Polyhedron, PolyhedronFace};
use crate::simd::{self, Kernel, LANES, LaneBits, Simd};
use crate::{Transform, Vec3};

/// Eight points as coordinate arrays, m. If there are fewer points, the results of the unused lanes must be
/// ignored.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes {
    /// The x coordinates.
    pub x: [f64; LANES],
    /// The y coordinates.
    pub y: [f64; LANES],
    /// The z coordinates.
    pub z: [f64; LANES],
}

impl Lanes {
    /// All eight points at the origin.
    pub const ORIGIN: Self = Self { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };

    /// Returns the point in a lane, m.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    /// Puts a point, m, into a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, p: &Vec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = (p.x, p.y, p.z);
    }

    /// Returns the points transformed to another frame, bit-identical to [`Transform::point`].
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        simd::run(Carry { points: self, x })
    }

    /// Same as [`carried`](Self::carried), for a caller that already runs at the SIMD level `S`.
    #[inline(always)]
    pub fn carried_in<S: Simd>(&self, simd: S, x: &Transform) -> Self {
        let mut out = Self::ORIGIN;
        self.carry_in(simd, x, &mut out);
        out
    }

    /// Same as [`carried_in`](Self::carried_in), with the result written to `out`.
    #[inline(always)]
    pub fn carry_in<S: Simd>(&self, simd: S, x: &Transform, out: &mut Self) {
        let points = Loaded::new(simd, self);
        out.x = points.coordinate(x, 0);
        out.y = points.coordinate(x, 1);
        out.z = points.coordinate(x, 2);
    }
}

struct Carry<'a> {
    points: &'a Lanes,
    x: &'a Transform,
}

impl Kernel for Carry<'_> {
    type Output = Lanes;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Lanes {
        self.points.carried_in(simd, self.x)
    }
}

impl Polyhedron {
    /// Returns the lanes whose point lies at least `reach` (m, one per lane) above some face. Bit `i` is set
    /// exactly if `face.height(&points[i]) >= reach[i]` for a face.
    ///
    /// A sphere of radius `reach[i]` about such a point has no contact.
    #[inline]
    pub fn lanes_outside(&self, points: &Lanes, reach: &[f64; LANES]) -> LaneBits {
        simd::run(Outside { polyhedron: self, points, reach })
    }

    /// Same as [`lanes_outside`](Self::lanes_outside), for a caller that already runs at the SIMD level `S`.
    #[inline(always)]
    pub fn lanes_outside_in<S: Simd>(&self, simd: S, points: &Lanes, reach: &[f64; LANES]) -> LaneBits {
        let reach = simd.load(reach);
        let points = Loaded::new(simd, points);
        let mut outside = 0;
        for face in &self.faces {
            outside |= simd.bits(simd.at_least(points.heights_above(face), reach));
            if outside == LaneBits::MAX {
                break;
            }
        }
        outside
    }

    /// Returns the lanes whose line segment, given by its two ends, is excluded by one of the first 32 faces.
    /// Bit `i` is set exactly if, for one such face, both ends are on or above its plane. An internal face is
    /// raised by `wall_slack` for this comparison.
    ///
    /// An excluded segment has no contact with this piece. A segment that is not excluded may have none
    /// either: to test all faces for eight segments would cost more than to test the remaining segments one
    /// by one.
    #[inline]
    pub fn lanes_kept_out(&self, ends: &[Lanes; 2]) -> LaneBits {
        simd::run(KeptOut { polyhedron: self, ends })
    }

    /// Same as [`lanes_kept_out`](Self::lanes_kept_out), for a caller that already runs at the SIMD level
    /// `S`.
    #[inline(always)]
    pub fn lanes_kept_out_in<S: Simd>(&self, simd: S, ends: &[Lanes; 2]) -> LaneBits {
        const FACES: usize = 32;
        let ends = [Loaded::new(simd, &ends[0]), Loaded::new(simd, &ends[1])];
        // Positive even if the tolerance is zero, because a piece contains the points of its closed faces. So
        // it may contain a segment in the plane of a closed face.
        let slack = self.planes().wall_slack.max(f64::MIN_POSITIVE);
        let mut kept_out = 0;
        for face in self.faces.iter().take(FACES) {
            let limit = simd.splat(if face.active && !face.closed { 0.0 } else { slack });
            let first = simd.at_least(ends[0].heights_above(face), limit);
            let second = simd.at_least(ends[1].heights_above(face), limit);
            kept_out |= simd.bits(simd.and(first, second));
            if kept_out == LaneBits::MAX {
                break;
            }
        }
        kept_out
    }

    /// Returns the lanes whose point lies inside this piece, with the same result as
    /// [`contains`](Polyhedron::contains).
    #[inline]
    pub fn lanes_contain(&self, points: &Lanes) -> LaneBits {
        simd::run(Contain { polyhedron: self, points })
    }

    /// Same as [`lanes_contain`](Self::lanes_contain), for a caller that already runs at the SIMD level `S`.
    #[inline(always)]
    pub fn lanes_contain_in<S: Simd>(&self, simd: S, points: &Lanes) -> LaneBits {
        let zero = simd.splat(0.0);
        let points = Loaded::new(simd, points);
        let mut inside = LaneBits::MAX;
        for face in &self.faces {
            let height = points.heights_above(face);
            let mut held = simd.bits(simd.below(height, zero));
            if face.closed {
                held |= simd.bits(simd.equal(height, zero));
            }
            inside &= held;
            if inside == 0 {
                break;
            }
        }
        inside
    }

    /// Returns the lanes whose point is not [outside](crate::primitive::Containment::Outside) this piece.
    #[inline(always)]
    pub fn lanes_inside_or_at_wall_in<S: Simd>(&self, simd: S, points: &Lanes) -> LaneBits {
        let (zero, slack) = (simd.splat(0.0), simd.splat(self.planes().wall_slack));
        let points = Loaded::new(simd, points);
        let mut inside = LaneBits::MAX;
        for face in &self.faces {
            let limit = if face.active { zero } else { slack };
            inside &= simd.bits(simd.below(points.heights_above(face), limit));
            if inside == 0 {
                break;
            }
        }
        inside
    }
}

/// Eight points in registers.
#[derive(Clone, Copy)]
struct Loaded<S: Simd> {
    simd: S,
    x: S::Eight,
    y: S::Eight,
    z: S::Eight,
}

impl<S: Simd> Loaded<S> {
    #[inline(always)]
    fn new(simd: S, points: &Lanes) -> Self {
        Self { simd, x: simd.load(&points.x), y: simd.load(&points.y), z: simd.load(&points.z) }
    }

    /// Returns one coordinate of the transformed points.
    #[inline(always)]
    fn coordinate(&self, x: &Transform, row: usize) -> [f64; LANES] {
        let simd = self.simd;
        let entry = |column: usize| simd.splat(x.rotation[(row, column)]);
        let turned = simd.add(simd.mul(entry(0), self.x), simd.mul(entry(1), self.y));
        let turned = simd.add(turned, simd.mul(entry(2), self.z));
        simd.store(simd.add(turned, simd.splat(x.translation[row])))
    }

    /// Returns the heights of the points above a face's plane, bit-identical to [`PolyhedronFace::height`].
    #[inline(always)]
    fn heights_above(&self, face: &PolyhedronFace) -> S::Eight {
        let (simd, normal) = (self.simd, &face.normal);
        let along = simd.add(simd.mul(simd.splat(normal.x), self.x), simd.mul(simd.splat(normal.y), self.y));
        let along = simd.add(along, simd.mul(simd.splat(normal.z), self.z));
        simd.sub(along, simd.splat(face.offset))
    }
}

struct Outside<'a> {
    polyhedron: &'a Polyhedron,
    points: &'a Lanes,
    reach: &'a [f64; LANES],
}

impl Kernel for Outside<'_> {
    type Output = LaneBits;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> LaneBits {
        self.polyhedron.lanes_outside_in(simd, self.points, self.reach)
    }
}

struct KeptOut<'a> {
    polyhedron: &'a Polyhedron,
    ends: &'a [Lanes; 2],
}

impl Kernel for KeptOut<'_> {
    type Output = LaneBits;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> LaneBits {
        self.polyhedron.lanes_kept_out_in(simd, self.ends)
    }
}

struct Contain<'a> {
    polyhedron: &'a Polyhedron,
    points: &'a Lanes,
}

impl Kernel for Contain<'_> {
    type Output = LaneBits;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> LaneBits {
        self.polyhedron.lanes_contain_in(simd, self.points)
    }
}
