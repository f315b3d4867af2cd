//! Places and axes of A that sweep through the round solids of B (docs/theory.md, 2.9).

use super::line::Met;
use pong_geometry::Vec3;
use pong_geometry::interference::round_gap::{Gap, Round};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Item, MovableGroup};

/// Evenly spaced times at which the gap is looked at before it is searched between them.
const TIMES: usize = 16;

/// The axis of an element of A, at the last commit and now, in B's frame, m. Of an element with one place both ends are that.
pub(super) struct Swept {
    pub from_b: [Vec3; 2],
    pub to_b: [Vec3; 2],
    /// Distance of the element's surface from its axis, m.
    pub radius: f64,
}

/// The axis of an element of A in A's frame, and its radius, m. `None` of kinds that touch no round solid.
pub(super) fn axis_of(body: &MovableGroup, kind: PrimitiveKind, item: Item) -> Option<([Vec3; 2], f64)> {
    let i = item.element as usize;
    match kind {
        PrimitiveKind::Point => Some(([body.points[i].position; 2], 0.0)),
        PrimitiveKind::Ray => Some(([body.rays[i].origin; 2], 0.0)),
        PrimitiveKind::Sphere => Some(([body.spheres[i].center; 2], body.spheres[i].radius)),
        PrimitiveKind::LineSegment => Some((body.segments[i].ends, 0.0)),
        PrimitiveKind::Capsule => Some((body.capsules[i].ends, body.capsules[i].radius)),
        _ => None,
    }
}

/// A round solid of B: `None` of other kinds.
pub(super) fn round(body: &MovableGroup, kind: PrimitiveKind, element: u32) -> Option<Round<'_>> {
    let i = element as usize;
    match kind {
        PrimitiveKind::Capsule => body.capsules.get(i).map(Round::Capsule),
        PrimitiveKind::Cylinder | PrimitiveKind::Cone => body.frusta.get(i).map(Round::Frustum),
        _ => None,
    }
}

pub(super) fn is_round(kind: PrimitiveKind) -> bool {
    matches!(kind, PrimitiveKind::Capsule | PrimitiveKind::Cylinder | PrimitiveKind::Cone)
}

impl Swept {
    /// The box that the element sweeps over.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let all = [self.from_b, self.to_b].concat();
        let low = all.iter().fold(all[0], |low, place| low.inf(place));
        let high = all.iter().fold(all[0], |high, place| high.sup(place));
        (low.add_scalar(-self.radius), high.add_scalar(self.radius))
    }

    /// Whether the element was beside a solid, is so now, and in between was deeper in it than half of the thinner one of the two.
    pub fn meet(&self, solid: Round<'_>) -> Option<Met> {
        let beside = self.beside(solid);
        let (first, last) = (beside.gap(0.0), beside.gap(1.0));
        let apart = first.distance >= 0.0 && last.distance >= 0.0;
        if !apart || first.distance + last.distance >= self.farthest() {
            return None;
        }
        let inside = beside.inside()?;
        Some(Met::Through(beside.crossing(0.0, inside).normal_b))
    }

    /// The direction in which an element leaves a solid in which it was at the last commit.
    pub fn way_out(&self, solid: Round<'_>) -> Option<Vec3> {
        let beside = self.beside(solid);
        let left = beside.gap(0.0).distance < 0.0 && beside.gap(1.0).distance >= 0.0;
        left.then(|| beside.crossing(1.0, 0.0).normal_b)
    }

    /// Longest way of any place of the axis, m.
    fn farthest(&self) -> f64 {
        let way = |end: usize| (self.to_b[end] - self.from_b[end]).norm();
        way(0).max(way(1))
    }

    fn beside<'a>(&'a self, solid: Round<'a>) -> Beside<'a> {
        // A ball goes through what is smaller where that passes its centre.
        let skin = (self.radius - 0.5 * solid.width_m()).max(0.0);
        Beside { swept: self, solid, skin }
    }
}

/// A swept axis beside one solid, whose surface is moved outward by a skin.
struct Beside<'a> {
    swept: &'a Swept,
    solid: Round<'a>,
    skin: f64,
}

impl Beside<'_> {
    /// At a time between the last commit (0) and now (1).
    fn gap(&self, time: f64) -> Gap {
        let Swept { from_b, to_b, .. } = self.swept;
        let gap = self.solid.gap(&[0, 1].map(|end| from_b[end] + (to_b[end] - from_b[end]) * time));
        Gap { distance: gap.distance - self.skin, ..gap }
    }

    /// A time at which the axis is inside. For a body that does not turn the gap is convex in time and has one minimum.
    fn inside(&self) -> Option<f64> {
        let time = |index: usize| index as f64 / TIMES as f64;
        let gaps: [f64; TIMES + 1] = std::array::from_fn(|index| self.gap(time(index)).distance);
        if let Some(inside) = gaps.iter().position(|&gap| gap < 0.0) {
            return Some(time(inside));
        }
        let is_least = |index: &usize| gaps[*index] <= gaps[index - 1] && gaps[*index] <= gaps[index + 1];
        let least = (1..TIMES).filter(is_least);
        least.map(|index| [time(index - 1), time(index + 1)]).find_map(|between| self.least(between))
    }

    /// A time between two at which the axis is inside, by golden sections towards the least gap.
    fn least(&self, [mut low, mut high]: [f64; 2]) -> Option<f64> {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        const STEPS: usize = 40;
        let time = |low: f64, high: f64, share: f64| low + (high - low) * share;
        let mut inner = [1.0 - GOLDEN, GOLDEN].map(|share| time(low, high, share));
        let mut gaps = inner.map(|time| self.gap(time).distance);
        for _ in 0..STEPS {
            let least = usize::from(gaps[1] < gaps[0]);
            if gaps[least] < 0.0 {
                return Some(inner[least]);
            }
            if least == 0 {
                high = inner[1];
                inner = [time(low, high, 1.0 - GOLDEN), inner[0]];
                gaps = [self.gap(inner[0]).distance, gaps[0]];
            } else {
                low = inner[0];
                inner = [inner[1], time(low, high, GOLDEN)];
                gaps = [gaps[1], self.gap(inner[1]).distance];
            }
        }
        None
    }

    /// Where the axis crosses the surface, between a time outside and one inside, by halving.
    fn crossing(&self, outside: f64, inside: f64) -> Gap {
        /// Half the bits of a number: the direction of a side needs no more.
        const STEPS: usize = 26;
        let (mut outside, mut inside) = (outside, inside);
        for _ in 0..STEPS {
            let middle = 0.5 * (outside + inside);
            *(if self.gap(middle).distance >= 0.0 { &mut outside } else { &mut inside }) = middle;
        }
        self.gap(outside)
    }
}
