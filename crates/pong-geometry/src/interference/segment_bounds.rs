//! Part of a line segment inside a polyhedron, and lower bounds of the energies of the polyhedron's faces,
//! eight faces at a time. The energy of a face is the sum of the squared depths of the part's two ends below
//! the face, m². The face of least energy pushes (docs/theory.md, 2.3).

use super::segment_ends::InsideEnd;
use crate::Vec3;
use crate::primitive::{FacePlanes, LineSegment, PlaneBlock, Polyhedron};
use crate::simd::{Finder, LANES, LaneBits, Simd, Splat};

/// Line segment and the face planes of a polyhedron, ready for tests of eight faces at a time.
#[derive(Clone, Copy)]
pub(super) struct SegmentPlanes<'a, S: Simd> {
    simd: S,
    polyhedron: &'a Polyhedron,
    segment: &'a LineSegment,
    ends: [Splat<S>; 2],
}

/// Part of a segment inside a polyhedron.
#[derive(Clone, Copy)]
pub(super) struct InsidePart {
    pub ends: [InsideEnd; 2],
    /// For each end of the segment, its greatest height above any plane, m; negative if the end is inside.
    tops: [f64; 2],
}

/// Tip of the segment that is inside the polyhedron, and the active face nearest to that tip.
#[derive(Clone, Copy)]
pub(super) struct Nearest {
    /// End of the segment that is inside.
    pub end: usize,
    pub face: usize,
}

/// Face blocks that may contain the face of least energy.
#[derive(Clone, Copy)]
pub(super) struct Likely {
    /// Bit mask of the blocks.
    pub blocks: u64,
    /// Number of faces that may have the least energy.
    pub faces: u32,
}

impl Likely {
    /// Returns the mask of all faces in `blocks` blocks.
    pub fn anywhere(blocks: usize) -> Self {
        Self { blocks: u64::MAX >> (u64::BITS as usize - blocks), faces: u32::MAX }
    }
}

/// Reason why a segment does not intersect a polyhedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Missed {
    /// Entirely outside one plane; for an internal face, by more than its tolerance.
    ByFar,
    /// Possibly within the tolerance of internal faces.
    Perhaps,
}

impl<'a, S: Simd> SegmentPlanes<'a, S> {
    #[inline(always)]
    pub fn new(simd: S, segment: &'a LineSegment, polyhedron: &'a Polyhedron) -> Self {
        let ends = [Splat::new(simd, &segment.ends[0]), Splat::new(simd, &segment.ends[1])];
        Self { simd, polyhedron, segment, ends }
    }

    /// Returns the part of the segment inside the solid.
    ///
    /// # Errors
    /// [`Missed`] if no point of the segment lies inside.
    #[inline(always)]
    pub fn inside_part<F: Finder<S>, const N: usize>(&self) -> Result<InsidePart, Missed> {
        let simd = self.simd;
        let mut crossed = 0;
        let mut tops = [simd.splat(f64::NEG_INFINITY); 2];
        let mut ends = InsideEnds::<S, F>::new(simd);
        for index in 0..self.polyhedron.planes().count::<N>() {
            let block = self.polyhedron.planes().block(index);
            let heights = [block.heights(simd, &self.ends[0]), block.heights(simd, &self.ends[1])];
            let outside = self.outside(block, heights);
            if outside != 0 {
                return Err(self.missed_by(block, heights, outside));
            }
            tops = [simd.larger(heights[0], tops[0]), simd.larger(heights[1], tops[1])];
            if N <= FacePlanes::IN_REGISTERS {
                ends.clip(index, heights);
            } else if index < u64::BITS as usize {
                crossed |= u64::from(self.is_crossed(heights)) << index;
            }
        }
        // Only blocks in which an end of the segment is above a plane need the division.
        while crossed != 0 {
            let index = crossed.trailing_zeros() as usize;
            let block = self.polyhedron.planes().block(index);
            ends.clip(index, [block.heights(simd, &self.ends[0]), block.heights(simd, &self.ends[1])]);
            crossed &= crossed - 1;
        }
        for index in u64::BITS as usize..self.polyhedron.planes().count::<N>() {
            let block = self.polyhedron.planes().block(index);
            ends.clip(index, [block.heights(simd, &self.ends[0]), block.heights(simd, &self.ends[1])]);
        }
        let ends = ends.found();
        if ends[0].at < ends[1].at {
            Ok(InsidePart { ends, tops: [simd.largest(tops[0]), simd.largest(tops[1])] })
        } else {
            Err(Missed::Perhaps)
        }
    }

    /// Returns the first tip that is inside the solid, and the active face below which it is least deep.
    /// `None` if no tip is inside, or if an internal face is nearer to the tip.
    #[inline(always)]
    pub fn nearest_face<const N: usize>(&self, inside: &InsidePart) -> Option<Nearest> {
        let end = if inside.ends[0].leaves_by.is_none() { 0 } else { 1 };
        if inside.ends[end].leaves_by.is_some() {
            return None;
        }
        let (simd, top) = (self.simd, self.simd.splat(inside.tops[end]));
        for index in 0..self.polyhedron.planes().count::<N>() {
            let block = self.polyhedron.planes().block(index);
            let faces = simd.bits(simd.equal(block.heights(simd, &self.ends[end]), top)) & block.active;
            if faces != 0 {
                return Some(Nearest { end, face: index * LANES + faces.trailing_zeros() as usize });
            }
        }
        None
    }

    /// Returns the faces whose energy may be at most `limit`, m². The energy of every other face exceeds
    /// `limit`, because the squared depth of the tip of `nearest` alone does.
    #[inline(always)]
    pub fn likely<const N: usize>(&self, nearest: &Nearest, limit: f64) -> Likely {
        let (simd, limit) = (self.simd, self.simd.splat(limit));
        let mut likely = Likely { blocks: 0, faces: 0 };
        for index in 0..self.polyhedron.planes().count::<N>() {
            let block = self.polyhedron.planes().block(index);
            let height = block.heights(simd, &self.ends[nearest.end]);
            let near = simd.bits(simd.at_least(limit, simd.mul(height, height))) & block.active & block.own;
            likely.blocks |= u64::from(near != 0) << index;
            likely.faces += near.count_ones();
        }
        likely
    }

    /// Returns `true` if an end is above one of the planes.
    #[inline(always)]
    fn is_crossed(&self, [first, second]: [S::Eight; 2]) -> bool {
        let simd = self.simd;
        simd.bits(simd.below(simd.splat(0.0), simd.larger(first, second))) != 0
    }

    /// Returns the planes that exclude the segment: neither end of the segment is below the plane. The plane
    /// of a closed face does not exclude a segment that lies in it.
    #[inline(always)]
    fn outside(&self, block: &PlaneBlock, [first, second]: [S::Eight; 2]) -> LaneBits {
        let (simd, zero) = (self.simd, self.simd.splat(0.0));
        let outside = simd.bits(simd.and(simd.at_least(first, zero), simd.at_least(second, zero)));
        let along_closed = match block.closed {
            0 => 0,
            closed => closed & simd.bits(simd.and(simd.equal(first, zero), simd.equal(second, zero))),
        };
        outside & !along_closed
    }

    /// Returns the reason for the miss. `outside` are the planes of the block that exclude the segment. If
    /// all of these belong to internal faces, the segment may miss only by the tolerance of internal faces.
    #[inline(always)]
    fn missed_by(&self, block: &PlaneBlock, [first, second]: [S::Eight; 2], outside: LaneBits) -> Missed {
        if outside & block.active != 0 {
            return Missed::ByFar;
        }
        let (simd, slack) = (self.simd, self.simd.splat(self.polyhedron.planes().wall_slack));
        let beyond = simd.bits(simd.and(simd.at_least(first, slack), simd.at_least(second, slack)));
        if beyond != 0 { Missed::ByFar } else { Missed::Perhaps }
    }

    /// Returns `true` if no point of the segment would be inside even if the internal faces were raised by
    /// their tolerance. The numbers are bit-identical to those of
    /// [`inside_of_wide_walls`](super::segment_at_walls::inside_of_wide_walls), so the two functions never
    /// disagree.
    #[inline(always)]
    pub fn misses_wide_walls<const N: usize>(&self) -> bool {
        let (simd, zero) = (self.simd, self.simd.splat(0.0));
        let slack = simd.splat(self.polyhedron.planes().wall_slack);
        let nowhere = simd.splat(f64::NEG_INFINITY);
        // Parameters of entry, and of exit with the sign reversed: of each, the largest counts.
        let (mut entering, mut leaving) = (zero, simd.splat(-1.0));
        for index in 0..self.polyhedron.planes().count::<N>() {
            let block = self.polyhedron.planes().block(index);
            let room = simd.select(simd.mask(block.active), zero, slack);
            let first = simd.sub(block.heights(simd, &self.ends[0]), room);
            let second = simd.sub(block.heights(simd, &self.ends[1]), room);
            if simd.bits(simd.and(simd.at_least(first, zero), simd.at_least(second, zero))) != 0 {
                return true;
            }
            let at = simd.ratio(first, simd.sub(first, second));
            entering = simd.larger(simd.select(simd.below(second, first), at, nowhere), entering);
            let back = simd.sub(zero, at);
            leaving = simd.larger(simd.select(simd.below(first, second), back, nowhere), leaving);
        }
        simd.largest(entering) >= -simd.largest(leaving)
    }

    /// Returns lower bounds of the energies of the faces, for at most `N` blocks. If `N` blocks do not fit
    /// into registers, only the blocks of the bit mask `blocks` are evaluated.
    #[inline(always)]
    pub fn bounds<const N: usize>(&self, inside: &InsidePart, mut blocks: u64) -> Bounds<S, N> {
        let simd = self.simd;
        let ends = [self.end(inside, 0), self.end(inside, 1)];
        let none = simd.splat(f64::NAN);
        let mut bounds = Bounds { simd, of_block: [none; N], top: simd.splat(f64::NEG_INFINITY) };
        for step in 0..N {
            let index = if N <= FacePlanes::IN_REGISTERS { step } else { blocks.trailing_zeros() as usize };
            if N > FacePlanes::IN_REGISTERS && blocks == 0 {
                break;
            }
            blocks &= blocks.wrapping_sub(1);
            let block = self.polyhedron.planes().block(index);
            let own = simd.mask(block.active & block.own);
            let [first, second] = [ends[0].least_square(index, block), ends[1].least_square(index, block)];
            bounds.set(index, own, simd.add(first, second));
        }
        bounds
    }

    // A method, because a closure would not be compiled for the instruction-set level.
    #[allow(clippy::manual_map)]
    #[inline(always)]
    fn end(&self, inside: &InsidePart, end: usize) -> End<S> {
        let leaves = inside.ends[end]
            .leaves_by
            .map(|face| self.leaving(face, inside.ends[end].at, inside.tops[end], end));
        End { simd: self.simd, tip: self.ends[end], leaves }
    }

    #[inline(always)]
    fn leaving(&self, face: usize, at: f64, top: f64, end: usize) -> Leaving<S> {
        let simd = self.simd;
        let along = self.segment.ends[1] - self.segment.ends[0];
        let exit = &self.polyhedron.faces[face];
        Leaving {
            face,
            place: Splat::new(simd, &(self.segment.ends[0] + along * at)),
            along: Splat::new(simd, &along),
            normal: exit.normal,
            slope: exit.normal.dot(&along),
            lowest: simd.splat(self.polyhedron.least_height_over_face(&self.segment.ends[end], top)),
        }
    }
}

/// Search for the interval of the segment inside the solid.
struct InsideEnds<S: Simd, F: Finder<S>> {
    simd: S,
    entering: F,
    /// Search for the first exit, as the maximum of the exit's parameter with the sign reversed.
    leaving: F,
}

impl<S: Simd, F: Finder<S>> InsideEnds<S, F> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        Self { simd, entering: F::above(simd, 0.0), leaving: F::above(simd, -1.0) }
    }

    /// Clips the interval to the planes of a block, given the heights of the two ends of the segment above
    /// them.
    #[inline(always)]
    fn clip(&mut self, index: usize, [first, second]: [S::Eight; 2]) {
        let simd = self.simd;
        let (zero, nowhere) = (simd.splat(0.0), simd.splat(f64::NEG_INFINITY));
        let at = simd.ratio(first, simd.sub(first, second));
        self.entering.offer(index, simd.select(simd.below(second, first), at, nowhere));
        self.leaving.offer(index, simd.select(simd.below(first, second), simd.sub(zero, at), nowhere));
    }

    #[inline(always)]
    fn found(self) -> [InsideEnd; 2] {
        let first = match self.entering.found() {
            Some(found) => InsideEnd { at: found.number, leaves_by: Some(found.place()) },
            None => InsideEnd { at: 0.0, leaves_by: None },
        };
        let second = match self.leaving.found() {
            Some(found) => InsideEnd { at: -found.number, leaves_by: Some(found.place()) },
            None => InsideEnd { at: 1.0, leaves_by: None },
        };
        [first, second]
    }
}

/// Lower bounds of the energies of faces, m². NaN for an inactive face, an unused lane or a block left out.
pub(super) struct Bounds<S: Simd, const N: usize> {
    simd: S,
    of_block: [S::Eight; N],
    /// Minus the least bound in each lane.
    top: S::Eight,
}

impl<S: Simd, const N: usize> Bounds<S, N> {
    #[inline(always)]
    fn set(&mut self, block: usize, own: S::Mask, bounds: S::Eight) {
        let simd = self.simd;
        let nowhere = simd.splat(f64::NEG_INFINITY);
        self.of_block[block] = simd.select(own, bounds, simd.splat(f64::NAN));
        // Lanes outside `own` may be NaN in `bounds`, and `larger` raises the invalid-operation exception for
        // NaN. So they become −∞ first. (`at_least` in `up_to` accepts NaN.)
        self.top = simd.larger(simd.select(own, simd.sub(simd.splat(0.0), bounds), nowhere), self.top);
    }

    /// Returns the face with the least bound, the first of equal ones; `None` if no face has a bound.
    #[inline(always)]
    pub fn least(&self) -> Option<usize> {
        let least = -self.simd.largest(self.top);
        for block in 0..N {
            let faces = self.up_to(least, block);
            if faces != 0 {
                return Some(block * LANES + faces.trailing_zeros() as usize);
            }
        }
        None
    }

    /// Returns the faces of a block whose bound is at most `energy`, m².
    #[inline(always)]
    pub fn up_to(&self, energy: f64, block: usize) -> LaneBits {
        let simd = self.simd;
        simd.bits(simd.at_least(simd.splat(energy), self.of_block[block]))
    }
}

/// One end of the part of the segment inside the solid.
#[derive(Clone, Copy)]
struct End<S: Simd> {
    simd: S,
    tip: Splat<S>,
    leaves: Option<Leaving<S>>,
}

/// Exit of the segment through a face.
#[derive(Clone, Copy)]
struct Leaving<S: Simd> {
    face: usize,
    place: Splat<S>,
    along: Splat<S>,
    normal: Vec3,
    slope: f64,
    /// Height of the tip above the plane of another face, m, below which the tip cannot project into that
    /// face.
    lowest: S::Eight,
}

impl<S: Simd> End<S> {
    /// Returns a lower bound of the squared depth of this end below each face, m²; infinite for a face that
    /// certainly takes no part.
    #[inline(always)]
    fn least_square(&self, index: usize, block: &PlaneBlock) -> S::Eight {
        let (simd, zero) = (self.simd, self.simd.splat(0.0));
        let height = block.heights(simd, &self.tip);
        let Some(leaving) = &self.leaves else { return self.square_below(height) };
        let crossing = leaving.crossing_square(simd, block);
        // If the tip projects into the face, its own depth counts (0 above the face), otherwise that of the
        // crossing. The smaller one is a lower bound. A tip above the face by less than `lowest` does not
        // project into it.
        let over = self.square_below(height);
        let least = simd.select(simd.below(crossing, over), crossing, over);
        let is_beside = simd.and(simd.at_least(height, zero), simd.below(height, leaving.lowest));
        let least = simd.select(is_beside, crossing, least);
        if leaving.face / LANES != index {
            return least;
        }
        simd.select(simd.mask(1 << (leaving.face % LANES)), zero, least)
    }

    /// Returns the squared depth for a height above a plane; 0 above the plane.
    #[inline(always)]
    fn square_below(&self, height: S::Eight) -> S::Eight {
        let (simd, zero) = (self.simd, self.simd.splat(0.0));
        simd.select(simd.below(height, zero), simd.mul(height, height), zero)
    }
}

impl<S: Simd> Leaving<S> {
    /// Returns the squared depth of the crossing (see
    /// [`line_segment_polyhedron`](super::line_segment_polyhedron)) with each face, m². It is 0 if the exit
    /// point is above the face, and infinite if the planes of the face and of the exit face are parallel.
    #[inline(always)]
    fn crossing_square(&self, simd: S, block: &PlaneBlock) -> S::Eight {
        let zero = simd.splat(0.0);
        let height = block.heights(simd, &self.place);
        let slope = self.along.dot(&block.normal);
        let exit_slope = simd.splat(self.slope);
        let mut length_square = zero;
        for axis in 0..3 {
            let own = simd.mul(simd.load(&block.normal[axis]), exit_slope);
            let across = simd.sub(own, simd.mul(simd.splat(self.normal[axis]), slope));
            length_square = simd.add(length_square, simd.mul(across, across));
        }
        let numerator = simd.mul(height, exit_slope);
        let square = simd.ratio(simd.mul(numerator, numerator), length_square);
        // The infinity is applied by `larger`: with a selection, a compiler could drop the guard against 0/0
        // in `ratio`.
        let least = simd.select(simd.equal(length_square, zero), simd.splat(f64::INFINITY), zero);
        let square = simd.larger(square, least);
        simd.select(simd.below(zero, height), zero, square)
    }
}
