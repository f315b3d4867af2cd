//! The docking ring by hand: eight tips at a time are transformed and tested against the slab between the
//! lowest and the highest point of the wedges; those inside are looked up in a grid of 64 × 64 cells across
//! the axis and tested against the six planes of each wedge in their cell. The result is depths only.

use super::Level;
use super::planes::{Block, blocks, greatest_portable};
#[cfg(target_arch = "x86_64")]
use super::planes::{greatest_avx2, greatest_avx512};
use crate::peer::Peer;
use crate::ring::{Ring, Tip, WEDGE_FACES};
use pong_engine::State;
use pong_geometry::{Pose, Transform, Vec3};
#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;

const CELLS: usize = 64;
/// Half the side of the grid, m: it contains every wedge and every tip that can touch.
const HALF_SIDE: f64 = 0.72;
const CELL: f64 = 2.0 * HALF_SIDE / CELLS as f64;
const LANES: usize = 8;

/// Eight tips: their coordinates along x, y and z, m.
type Eight = [[f64; LANES]; 3];

/// The ring, its grid and the results of the last frame.
pub struct ByHand {
    level: Level,
    wedges: Vec<[Vec3; 8]>,
    planes: Vec<Vec<(Vec3, f64)>>,
    /// Planes of the wedges, arranged for wide registers.
    blocks: Vec<Block>,
    /// Start of each cell's wedges in `list`, with one more entry at the end.
    starts: Vec<u32>,
    list: Vec<u32>,
    /// Tips in eights; the last eight are filled with copies of the last tip.
    tips: Vec<Eight>,
    tip_count: usize,
    radius: f64,
    /// Range of heights of a tip's centre that may touch, m.
    slab: [f64; 2],
    /// Contacts: tip, wedge, depth.
    found: Vec<(u32, u32, f64)>,
}

impl ByHand {
    /// The ring with its grid.
    pub fn new(ring: &Ring, tip: Tip) -> Self {
        let radius = tip.radius();
        let heights = || ring.wedges.iter().flatten().map(|corner| corner.z);
        let mut grid = Self {
            level: Level::detect(),
            wedges: ring.wedges.clone(),
            planes: ring.wedges.iter().map(planes).collect(),
            blocks: ring.wedges.iter().map(|wedge| blocks(&planes(wedge))[0]).collect(),
            starts: vec![0],
            list: Vec::new(),
            tips: ring.tips.chunks(LANES).map(eight).collect(),
            tip_count: ring.tips.len(),
            radius,
            slab: [
                heights().fold(f64::INFINITY, f64::min) - radius,
                heights().fold(f64::NEG_INFINITY, f64::max) + radius,
            ],
            found: Vec::with_capacity(ring.tips.len()),
        };
        for cell in 0..CELLS * CELLS {
            let middle = [cell % CELLS, cell / CELLS].map(|i| (i as f64 + 0.5) * CELL - HALF_SIDE);
            let reaches = |wedge: &[Vec3; 8]| reaches(wedge, middle, grid.radius);
            grid.list.extend((0..grid.wedges.len()).filter(|&w| reaches(&grid.wedges[w])).map(|w| w as u32));
            grid.starts.push(grid.list.len() as u32);
        }
        grid
    }

    /// Tests the tips of one eight that are inside the grid.
    #[inline(always)]
    fn test_those_inside(
        &mut self,
        step: usize,
        (p, mut inside): (Eight, u8),
        greatest: impl Fn(&[Block], &Vec3) -> f64,
    ) {
        while inside != 0 {
            let lane = inside.trailing_zeros() as usize;
            inside &= inside - 1;
            let tip = LANES * step + lane;
            self.test_tip(tip, Vec3::new(p[0][lane], p[1][lane], p[2][lane]), &greatest);
        }
    }

    /// Tests a tip over the grid.
    #[inline(always)]
    fn test_tip(&mut self, tip: usize, p: Vec3, greatest: impl Fn(&[Block], &Vec3) -> f64) {
        let [column, row] = [p.x, p.y].map(|x| ((x + HALF_SIDE) * (1.0 / CELL)) as usize);
        let cell = row.min(CELLS - 1) * CELLS + column.min(CELLS - 1);
        for i in self.starts[cell]..self.starts[cell + 1] {
            let wedge = self.list[i as usize] as usize;
            let height = greatest(&self.blocks[wedge..=wedge], &p);
            if height < self.radius && tip < self.tip_count {
                self.take(tip, wedge, height, &p);
            }
        }
    }

    /// Records a contact if the tip is below all planes or within a radius of them; for a sphere above a
    /// plane the true distance counts.
    fn take(&mut self, tip: usize, wedge: usize, height: f64, p: &Vec3) {
        let distance = match height < 0.0 {
            true => height,
            false => distance(p, &self.wedges[wedge], &self.planes[wedge]),
        };
        if distance < self.radius {
            self.found.push((tip as u32, wedge as u32, self.radius - distance));
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,fma")]
    fn test_avx512(&mut self, x: &Transform) {
        for step in 0..self.tips.len() {
            let inside = inside_avx512(&self.tips[step], x, self.slab);
            self.test_those_inside(step, inside, |blocks, p| greatest_avx512(blocks, p));
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn test_avx2(&mut self, x: &Transform) {
        for step in 0..self.tips.len() {
            let inside = inside_avx2(&self.tips[step], x, self.slab);
            self.test_those_inside(step, inside, |blocks, p| greatest_avx2(blocks, p));
        }
    }

    fn test_portable(&mut self, x: &Transform) {
        for step in 0..self.tips.len() {
            let inside = inside_portable(&self.tips[step], x, self.slab);
            self.test_those_inside(step, inside, greatest_portable);
        }
    }
}

/// Transforms eight tips, and returns a mask of those in the slab and over the grid.
#[inline]
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,fma")]
fn inside_avx512(tips: &Eight, x: &Transform, [low, high]: [f64; 2]) -> (Eight, u8) {
    let (r, t) = (&x.rotation, &x.translation);
    // SAFETY: each holds the eight numbers that are read.
    let from = tips.each_ref().map(|tips| unsafe { _mm512_loadu_pd(tips.as_ptr()) });
    let mut p: Eight = [[0.0; LANES]; 3];
    let mut carried = [_mm512_setzero_pd(); 3];
    for axis in 0..3 {
        let along_z = _mm512_fmadd_pd(_mm512_set1_pd(r[(axis, 2)]), from[2], _mm512_set1_pd(t[axis]));
        let along_yz = _mm512_fmadd_pd(_mm512_set1_pd(r[(axis, 1)]), from[1], along_z);
        carried[axis] = _mm512_fmadd_pd(_mm512_set1_pd(r[(axis, 0)]), from[0], along_yz);
        // SAFETY: there is room for the eight numbers that are written.
        unsafe { _mm512_storeu_pd(p[axis].as_mut_ptr(), carried[axis]) };
    }
    let half = _mm512_set1_pd(HALF_SIDE);
    let inside = _mm512_cmp_pd_mask::<_CMP_GT_OQ>(carried[2], _mm512_set1_pd(low))
        & _mm512_cmp_pd_mask::<_CMP_LT_OQ>(carried[2], _mm512_set1_pd(high))
        & _mm512_cmp_pd_mask::<_CMP_LT_OQ>(_mm512_abs_pd(carried[0]), half)
        & _mm512_cmp_pd_mask::<_CMP_LT_OQ>(_mm512_abs_pd(carried[1]), half);
    (p, inside)
}

/// Transforms eight tips, four at a time, and returns a mask of those in the slab and over the grid.
#[inline]
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn inside_avx2(tips: &Eight, x: &Transform, [low, high]: [f64; 2]) -> (Eight, u8) {
    let (r, t) = (&x.rotation, &x.translation);
    let (half, sign) = (_mm256_set1_pd(HALF_SIDE), _mm256_set1_pd(-0.0));
    let mut p: Eight = [[0.0; LANES]; 3];
    let mut all = 0;
    for first in [0, 4] {
        // SAFETY: each holds the four numbers that are read.
        let from = tips.each_ref().map(|tips| unsafe { _mm256_loadu_pd(tips[first..][..4].as_ptr()) });
        let mut carried = [_mm256_setzero_pd(); 3];
        for axis in 0..3 {
            let along_z = _mm256_fmadd_pd(_mm256_set1_pd(r[(axis, 2)]), from[2], _mm256_set1_pd(t[axis]));
            let along_yz = _mm256_fmadd_pd(_mm256_set1_pd(r[(axis, 1)]), from[1], along_z);
            carried[axis] = _mm256_fmadd_pd(_mm256_set1_pd(r[(axis, 0)]), from[0], along_yz);
            // SAFETY: there is room for the four numbers that are written.
            unsafe { _mm256_storeu_pd(p[axis][first..][..4].as_mut_ptr(), carried[axis]) };
        }
        let above = _mm256_cmp_pd::<_CMP_GT_OQ>(carried[2], _mm256_set1_pd(low));
        let below = _mm256_cmp_pd::<_CMP_LT_OQ>(carried[2], _mm256_set1_pd(high));
        let along_x = _mm256_cmp_pd::<_CMP_LT_OQ>(_mm256_andnot_pd(sign, carried[0]), half);
        let along_y = _mm256_cmp_pd::<_CMP_LT_OQ>(_mm256_andnot_pd(sign, carried[1]), half);
        let inside = _mm256_and_pd(_mm256_and_pd(above, below), _mm256_and_pd(along_x, along_y));
        all |= (_mm256_movemask_pd(inside) as u8) << first;
    }
    (p, all)
}

/// Transforms eight tips, and returns a mask of those in the slab and over the grid.
fn inside_portable(tips: &Eight, x: &Transform, [low, high]: [f64; 2]) -> (Eight, u8) {
    let mut p: Eight = [[0.0; LANES]; 3];
    let mut inside = 0;
    for lane in 0..LANES {
        let carried = x.point(&Vec3::new(tips[0][lane], tips[1][lane], tips[2][lane]));
        for axis in 0..3 {
            p[axis][lane] = carried[axis];
        }
        let in_slab = (carried.z > low) & (carried.z < high);
        let in_grid = (carried.x.abs() < HALF_SIDE) & (carried.y.abs() < HALF_SIDE);
        inside |= u8::from(in_slab & in_grid) << lane;
    }
    (p, inside)
}

fn eight(tips: &[Vec3]) -> Eight {
    std::array::from_fn(|axis| std::array::from_fn(|lane| tips[lane.min(tips.len() - 1)][axis]))
}

impl Peer for ByHand {
    fn frame(&mut self, states: &[State]) -> usize {
        let x = Pose::relative(&states[1].pose(), &states[0].pose()).transform();
        self.found.clear();
        match self.level {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `Level::detect` found the features.
            Level::Avx512 => unsafe { self.test_avx512(&x) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `Level::detect` found the features.
            Level::Avx2 => unsafe { self.test_avx2(&x) },
            _ => self.test_portable(&x),
        }
        self.found.len()
    }
}

/// Planes of the faces: unit normals and offsets.
pub fn planes(wedge: &[Vec3; 8]) -> Vec<(Vec3, f64)> {
    let plane = |face: &[u32; 4]| {
        let [a, b, _, d] = face.map(|v| wedge[v as usize]);
        let normal = (b - a).cross(&(d - a)).normalize();
        (normal, normal.dot(&a))
    };
    WEDGE_FACES.iter().map(plane).collect()
}

/// Tests whether a wedge, projected along the axis and grown by a radius, may reach into the cell around
/// `middle`: along x, y, and the two directions in which it is built.
fn reaches(wedge: &[Vec3; 8], middle: [f64; 2], radius: f64) -> bool {
    let outward = wedge.iter().sum::<Vec3>().xy().normalize();
    let (x, y) = (pong_geometry::Vec3::x().xy(), pong_geometry::Vec3::y().xy());
    let forward = x * -outward.y + y * outward.x;
    [x, y, outward, forward].iter().all(|direction| {
        let center = direction.x * middle[0] + direction.y * middle[1];
        let half = 0.5 * CELL * (direction.x.abs() + direction.y.abs()) + radius;
        let along = wedge.map(|corner| corner.xy().dot(direction) - center);
        along.iter().any(|&s| s >= -half) && along.iter().any(|&s| s <= half)
    })
}

/// Distance of an outer point from a wedge, m: only faces below the point can be nearest.
fn distance(p: &Vec3, wedge: &[Vec3; 8], planes: &[(Vec3, f64)]) -> f64 {
    let to_face = |(face, (normal, offset)): (&[u32; 4], &(Vec3, f64))| {
        let height = normal.dot(p) - offset;
        if height < 0.0 {
            return f64::INFINITY;
        }
        let corners = face.map(|v| wedge[v as usize]);
        let edges = || (0..4).map(|i| (corners[i], corners[(i + 1) % 4]));
        match edges().all(|(a, b)| (b - a).cross(&(p - a)).dot(normal) >= 0.0) {
            true => height,
            false => edges().map(|(a, b)| to_edge(p, &a, &b)).fold(f64::INFINITY, f64::min),
        }
    };
    WEDGE_FACES.iter().zip(planes).map(to_face).fold(f64::INFINITY, f64::min)
}

fn to_edge(p: &Vec3, a: &Vec3, b: &Vec3) -> f64 {
    let along = b - a;
    let share = ((p - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (p - (a + along * share)).norm()
}
