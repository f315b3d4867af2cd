//! Up to eight elements of one kind as A, carried into B's frame together, and the boxes around them there.

use super::carried::Carried;
use pong_arena::List;
use pong_geometry::bounding::RELATIVE_MARGIN;
use pong_geometry::lanes::Lanes;
use pong_geometry::primitive::{Point, PrimitiveKind, Sphere};
use pong_geometry::simd::{LANES, Simd};
use pong_geometry::{Transform, Vec3};
use pong_model::box_tree::{BoxTree, NarrowBox, NarrowBoxes, round_down, round_up};
use pong_model::{Batch, Body, Item};

/// The elements and where they are.
pub(super) struct Chunk<'a, 'l, 'm> {
    pub kind: PrimitiveKind,
    pub items: &'a [Item],
    /// Points and spheres: their centres in B's frame.
    pub centers: Lanes,
    /// Points and spheres: their radii, m.
    pub radii: &'a [f64; LANES],
    /// All other kinds of the tester table, in B's frame. Empty for kinds that only registered tests know.
    carried: &'l List<'m, Carried>,
    pub boxes: LaneBoxes,
}

/// One box per lane in B's frame, m; unused lanes are empty.
pub(super) struct LaneBoxes {
    count: usize,
    low: [[f64; LANES]; 3],
    high: [[f64; LANES]; 3],
}

impl<'a, 'l, 'm> Chunk<'a, 'l, 'm> {
    /// The chunk of a batch that begins with its element `first`, a multiple of eight.
    #[inline(always)]
    pub fn new<S: Simd>(
        simd: S,
        (body, batch): (&'a Body, &'a Batch),
        first: u32,
        x_ba: &Transform,
        carried: &'l mut List<'m, Carried>,
    ) -> Self {
        let start = batch.items.start + first;
        let end = batch.items.end.min(start + LANES as u32);
        let items = &body.tree.items[start as usize..end as usize];
        let (mut centers, mut radii) = (Lanes::ORIGIN, &[0.0; LANES]);
        let boxes = match &batch.balls {
            Some(balls) => {
                let place = first as usize / LANES;
                centers = balls.centers[place].carried_in(simd, x_ba);
                radii = &balls.radii[place];
                LaneBoxes::of_balls(&centers, radii, items.len())
            }
            None => {
                carry_each(body, items, x_ba, carried);
                if carried.len() == items.len() {
                    LaneBoxes::of_each(carried.iter().map(Carried::bounds))
                } else {
                    let lanes = 0..items.len() as u32;
                    LaneBoxes::of_each(lanes.map(|lane| carried_box(&batch.boxes, first + lane, x_ba)))
                }
            }
        };
        Self { kind: batch.kind, items, centers, radii, carried, boxes }
    }

    /// One element; `None` for kinds that are never A in the table.
    pub fn carried(&self, lane: usize) -> Option<Carried> {
        let center = Vec3::new(self.centers.x[lane], self.centers.y[lane], self.centers.z[lane]);
        match self.kind {
            PrimitiveKind::Point => Some(Carried::Point(Point { position: center })),
            PrimitiveKind::Sphere => Some(Carried::Sphere(Sphere { center, radius: self.radii[lane] })),
            _ => self.carried.get(lane).copied(),
        }
    }
}

fn carry_each(body: &Body, items: &[Item], x_ba: &Transform, carried: &mut List<'_, Carried>) {
    carried.clear();
    for &item in items {
        let Some(one) = Carried::new(body, item, x_ba) else { return };
        carried.push(one).expect("the list has room for all lanes");
    }
}

/// The box in B's frame around the box that A's tree has for an element.
fn carried_box(boxes: &BoxTree, element: u32, x_ba: &Transform) -> (Vec3, Vec3) {
    let (low, high) = boxes.bounds(element);
    if !low.iter().chain(high.iter()).all(|x| x.is_finite()) {
        return (Vec3::repeat(f64::NEG_INFINITY), Vec3::repeat(f64::INFINITY));
    }
    let center = x_ba.point(&(0.5 * (low + high)));
    let half = x_ba.rotation.abs() * (0.5 * (high - low));
    (center - half, center + half)
}

impl LaneBoxes {
    /// Beyond every box, and beyond it on the other side.
    const NOTHING: Self = Self { count: 0, low: [[f64::MAX; LANES]; 3], high: [[-f64::MAX; LANES]; 3] };

    #[inline(always)]
    fn of_balls(centers: &Lanes, radii: &[f64; LANES], count: usize) -> Self {
        let mut boxes = Self { count, ..Self::NOTHING };
        for (axis, center) in [&centers.x, &centers.y, &centers.z].into_iter().enumerate() {
            for lane in 0..LANES {
                let half = radii[lane] + margin(center[lane].abs() + radii[lane]);
                let used = lane < count;
                boxes.low[axis][lane] = if used { center[lane] - half } else { f64::MAX };
                boxes.high[axis][lane] = if used { center[lane] + half } else { -f64::MAX };
            }
        }
        boxes
    }

    fn of_each(bounds: impl Iterator<Item = (Vec3, Vec3)>) -> Self {
        let mut boxes = Self::NOTHING;
        for (lane, (low, high)) in bounds.enumerate() {
            for axis in 0..3 {
                let extra = margin(low[axis].abs().max(high[axis].abs()));
                boxes.low[axis][lane] = low[axis] - extra;
                boxes.high[axis][lane] = high[axis] + extra;
            }
            boxes.count = lane + 1;
        }
        boxes
    }

    /// The box around all, as a tree sees it.
    #[inline(always)]
    pub fn around(&self, tree: &BoxTree) -> NarrowBox {
        let least = |x: &[f64; LANES]| x.iter().fold(f64::MAX, |least, &x| if x < least { x } else { least });
        let most = |x: &[f64; LANES]| x.iter().fold(-f64::MAX, |most, &x| if x > most { x } else { most });
        let low = Vec3::new(least(&self.low[0]), least(&self.low[1]), least(&self.low[2]));
        let high = Vec3::new(most(&self.high[0]), most(&self.high[1]), most(&self.high[2]));
        tree.narrowed(&low, &high)
    }

    /// All boxes, as a tree sees them.
    #[inline(always)]
    pub fn narrowed(&self, tree: &BoxTree) -> NarrowBoxes {
        let mut narrow = NarrowBoxes::NOTHING;
        for axis in 0..3 {
            for lane in 0..LANES {
                let low = round_down(self.low[axis][lane] - tree.origin[axis]);
                let high = round_up(self.high[axis][lane] - tree.origin[axis]);
                let used = lane < self.count;
                narrow.low[axis][lane] = if used { low } else { f32::INFINITY };
                narrow.high[axis][lane] = if used { high } else { f32::NEG_INFINITY };
            }
        }
        narrow
    }
}

/// Room for rounding in coordinates of this size, m.
#[inline(always)]
fn margin(size: f64) -> f64 {
    4.0 * RELATIVE_MARGIN * size
}
