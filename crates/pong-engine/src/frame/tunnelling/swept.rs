//! Points and axes of A that sweep through the round solids of B (docs/theory.md, 2.9).

use super::golden_section::time_inside;
use super::solids::Met;
use pong_geometry::Vec3;
use pong_geometry::primitive::{Gap, PrimitiveKind, Round};
use pong_model::MovableGroup;

/// Number of equal time intervals at whose ends the gap is sampled, before the search within an interval.
const TIMES: usize = 16;

/// Axis of an element of A, at the last commit and now, in B's frame, m. For point-like elements both ends
/// coincide.
pub(super) struct Swept {
    pub from_b: [Vec3; 2],
    pub to_b: [Vec3; 2],
    /// Radius of the element about its axis, m.
    pub radius: f64,
}

/// Round solid of B; `None` for other kinds.
pub(super) fn round(body: &MovableGroup, kind: PrimitiveKind, element: u32) -> Option<&dyn Round> {
    body.element(kind, element).facts()?.round()
}

impl Swept {
    /// Box around the element at the last commit and now, m.
    pub fn bounds(&self) -> [Vec3; 2] {
        let all = [self.from_b, self.to_b].concat();
        let low = all.iter().fold(all[0], |low, place| low.inf(place));
        let high = all.iter().fold(all[0], |high, place| high.sup(place));
        [low.add_scalar(-self.radius), high.add_scalar(self.radius)]
    }

    /// Returns `Through` if the element was outside the solid at the last commit, is outside now, and in
    /// between the middle of the thinner of the two was inside the thicker one. Otherwise `None`.
    pub fn meet(&self, solid: &dyn Round) -> Option<Met> {
        let beside = self.beside(solid);
        let (first, last) = (beside.gap(0.0), beside.gap(1.0));
        let apart = first.distance >= 0.0 && last.distance >= 0.0;
        if !apart || first.distance + last.distance >= self.farthest() {
            return None;
        }
        let inside = beside.inside()?;
        Some(Met::Through(beside.crossing(0.0, inside).normal_b))
    }

    /// Normal at the exit if the element was in the solid at the last commit and has left it, otherwise
    /// `None`.
    pub fn way_out(&self, solid: &dyn Round) -> Option<Vec3> {
        let beside = self.beside(solid);
        let left = beside.gap(0.0).distance < 0.0 && beside.gap(1.0).distance >= 0.0;
        left.then(|| beside.crossing(1.0, 0.0).normal_b)
    }

    /// Longest displacement of any point of the axis, m.
    fn farthest(&self) -> f64 {
        let way = |end: usize| (self.to_b[end] - self.from_b[end]).norm();
        way(0).max(way(1))
    }

    fn beside<'a>(&'a self, solid: &'a dyn Round) -> Beside<'a> {
        // Something has passed through only if the middle of the thinner of the two was inside the thicker
        // one. If the element is the thinner one, its axis must have been inside the solid: no `skin`. If the
        // solid is thinner, its middle must have been inside the element. That is so if the axis was inside a
        // solid whose surface lies `skin` farther out.
        let skin = (self.radius - 0.5 * solid.width_m()).max(0.0);
        Beside { swept: self, solid, skin }
    }
}

/// A swept axis and a solid whose surface is moved outward by `skin`, m.
struct Beside<'a> {
    swept: &'a Swept,
    solid: &'a dyn Round,
    skin: f64,
}

impl Beside<'_> {
    /// Gap at a time between the last commit (0) and now (1).
    fn gap(&self, time: f64) -> Gap {
        let Swept { from_b, to_b, .. } = self.swept;
        let gap = self.solid.gap(&[0, 1].map(|end| from_b[end] + (to_b[end] - from_b[end]) * time));
        Gap { distance: gap.distance - self.skin, ..gap }
    }

    /// Searches for a time at which the axis is inside the solid: first at equally spaced times, then by
    /// [`time_inside`] around those at which the gap is a local minimum. Without rotation the gap is
    /// convex in time and has one minimum; with rotation the search may miss a short overlap.
    fn inside(&self) -> Option<f64> {
        let time = |index: usize| index as f64 / TIMES as f64;
        let gaps: [f64; TIMES + 1] = std::array::from_fn(|index| self.gap(time(index)).distance);
        if let Some(inside) = gaps.iter().position(|&gap| gap < 0.0) {
            return Some(time(inside));
        }
        let is_least = |index: &usize| gaps[*index] <= gaps[index - 1] && gaps[*index] <= gaps[index + 1];
        let least = (1..TIMES).filter(is_least);
        least
            .map(|index| [time(index - 1), time(index + 1)])
            .find_map(|between| time_inside(between, |time| self.gap(time).distance))
    }

    /// Gap where the axis crosses the surface, by bisection between an outside and an inside time.
    fn crossing(&self, outside: f64, inside: f64) -> Gap {
        /// Bisection finds the time to 2⁻²⁶, half the digits of an `f64`; the normal there needs no more.
        const STEPS: usize = 26;
        let (mut outside, mut inside) = (outside, inside);
        for _ in 0..STEPS {
            let middle = 0.5 * (outside + inside);
            *(if self.gap(middle).distance >= 0.0 { &mut outside } else { &mut inside }) = middle;
        }
        self.gap(outside)
    }
}
