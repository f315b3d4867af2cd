//! The docking ring by hand: eight tips a step are carried and asked whether they lie in the slab between the lowest and
//! the highest of the wedges; those that do are looked up in a grid of 64 × 64 cells seen along the axis, and tested
//! against the six planes of each wedge in their cell. Depths out, and nothing else.

use super::Level;
use super::planes::{Block, blocks, greatest_portable};
#[cfg(target_arch = "x86_64")]
use super::planes::{greatest_avx2, greatest_avx512};
use crate::peer::Peer;
use crate::ring::{Ring, Tip, WEDGE_FACES};
use pong_engine::State;
use pong_geometry::{Pose, Transform, Vec3};

const CELLS: usize = 64;
/// Half the side of the grid, m: beyond every wedge and tip that can touch.
const HALF_SIDE: f64 = 0.72;
const CELL: f64 = 2.0 * HALF_SIDE / CELLS as f64;
const LANES: usize = 8;

/// Eight tips: their coordinates along x, y and z, m.
type Eight = [[f64; LANES]; 3];

/// The ring, its grid and what the last frame found.
pub struct ByHand {
    level: Level,
    wedges: Vec<[Vec3; 8]>,
    planes: Vec<Vec<(Vec3, f64)>>,
    /// The same planes, ready for wide registers.
    blocks: Vec<Block>,
    /// Per cell, where its wedges begin in the list; one more at the end.
    starts: Vec<u32>,
    list: Vec<u32>,
    /// What is left of the last eight repeats the last tip.
    tips: Vec<Eight>,
    tip_count: usize,
    radius: f64,
    /// Between which heights a tip's centre may touch, m.
    slab: [f64; 2],
    /// Tip, wedge, depth.
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

    /// One step: plain loops over eight, which the compiler turns into the widest registers that its caller allows.
    #[inline(always)]
    fn test_eight(&mut self, step: usize, x: &Transform, greatest: impl Fn(&[Block], &Vec3) -> f64) {
        let (r, t, from) = (&x.rotation, &x.translation, &self.tips[step]);
        let mut p: Eight = [[0.0; LANES]; 3];
        for (axis, row) in p.iter_mut().enumerate() {
            for lane in 0..LANES {
                let along_z = r[(axis, 2)].mul_add(from[2][lane], t[axis]);
                row[lane] = r[(axis, 0)].mul_add(from[0][lane], r[(axis, 1)].mul_add(from[1][lane], along_z));
            }
        }
        let mut inside = [false; LANES];
        for lane in 0..LANES {
            let in_slab = (p[2][lane] > self.slab[0]) & (p[2][lane] < self.slab[1]);
            inside[lane] = in_slab & (p[0][lane].abs() < HALF_SIDE) & (p[1][lane].abs() < HALF_SIDE);
        }
        for lane in 0..LANES {
            if inside[lane] {
                let tip = LANES * step + lane;
                self.test_tip(tip, Vec3::new(p[0][lane], p[1][lane], p[2][lane]), &greatest);
            }
        }
    }

    /// A tip over the grid.
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

    /// Below all planes or within a radius of them: of a sphere above a plane the true distance counts.
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
            self.test_eight(step, x, |blocks, p| greatest_avx512(blocks, p));
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn test_avx2(&mut self, x: &Transform) {
        for step in 0..self.tips.len() {
            self.test_eight(step, x, |blocks, p| greatest_avx2(blocks, p));
        }
    }

    fn test_portable(&mut self, x: &Transform) {
        for step in 0..self.tips.len() {
            self.test_eight(step, x, greatest_portable);
        }
    }
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

/// The faces' planes: unit normals and offsets.
pub fn planes(wedge: &[Vec3; 8]) -> Vec<(Vec3, f64)> {
    let plane = |face: &[u32; 4]| {
        let [a, b, _, d] = face.map(|v| wedge[v as usize]);
        let normal = (b - a).cross(&(d - a)).normalize();
        (normal, normal.dot(&a))
    };
    WEDGE_FACES.iter().map(plane).collect()
}

/// Whether a wedge, seen along the axis and grown by a radius, may reach into the cell around `middle`: along x, y,
/// and the two directions that it is built on.
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

/// Distance of a point outside from a wedge, m: only faces that it lies above can be nearest.
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
