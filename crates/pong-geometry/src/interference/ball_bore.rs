//! Point and sphere (A) – bore (B) (docs/theory.md, 2.8): contact with the wall on the side of the centre. A
//! sphere too large for the hole touches the opposite wall as well.

use super::round_surface::{Meridian, ROUNDING};
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Bore, Frustum, Sphere};

/// Contacts of a sphere with the wall of a bore: on the side of its centre, and on the opposite side.
pub type BallContacts = [Option<Interference>; 2];

/// Tests a sphere, or with radius 0 a point, against a bore. If there are two contacts, they share one spring
/// (docs/theory.md, 2.2).
pub fn ball_bore(ball: &Sphere, bore: &Bore) -> BallContacts {
    let at = Meridian::new(&ball.center, &bore.hole);
    let beside = Beside { bore, along: at.along, aside: at.aside, away_b: at.away_b };
    let opposite = Beside { aside: -at.aside, away_b: -at.away_b, ..beside };
    [beside.touched(ball), opposite.touched(ball)]
}

/// Tests a sphere against the circular edge of one mouth, wherever along the axis the sphere's centre lies.
pub(super) fn ball_mouth(ball: &Sphere, bore: &Bore, mouth: usize) -> Option<Interference> {
    let at = Meridian::new(&ball.center, &bore.hole);
    Beside { bore, along: at.along, aside: at.aside, away_b: at.away_b }.touched_at_mouth(ball, mouth)
}

/// Returns `true` if a point (m) is behind the wall of a bore, and its foot point on the wall lies between
/// the ends of the wall. A shape that enters the hole from such a point comes through the wall from behind,
/// so the wall must not push it into the hole.
pub fn is_behind_wall(place: &Vec3, bore: &Bore) -> bool {
    let at = Meridian::new(place, &bore.hole);
    let beside = Beside { bore, along: at.along, aside: at.aside, away_b: at.away_b };
    beside.height() > ROUNDING * place.amax().max(bore.hole.ends[0].amax()) && beside.past_end().is_none()
}

/// Sphere's centre in the coordinates of a half plane that the bore's axis bounds. The half plane is the one
/// that contains the centre, or the opposite one.
#[derive(Clone, Copy)]
struct Beside<'a> {
    bore: &'a Bore,
    /// Distance from end 0 of the bore along its axis, m.
    along: f64,
    /// Distance from the axis, m; negative if the centre is in the opposite half plane.
    aside: f64,
    /// Unit vector from the axis into the half plane, perpendicular to the axis.
    away_b: Vec3,
}

impl Beside<'_> {
    fn hole(&self) -> &Frustum {
        &self.bore.hole
    }

    /// Returns the distance of the centre behind the wall, m; negative in the hole.
    fn height(&self) -> f64 {
        let [wall_along, wall_aside] = self.hole().wall;
        self.along * wall_along + (self.aside - self.hole().radii[0]) * wall_aside
    }

    /// Returns the end of the wall beyond which the centre's foot point lies; `None` if it lies between the
    /// ends.
    fn past_end(&self) -> Option<usize> {
        let [first, last] = self.hole().radii;
        let (length, widening) = (self.hole().length, last - first);
        let travelled = self.along * length + (self.aside - first) * widening;
        let inside = [travelled, length * length + widening * widening - travelled];
        [0, 1].into_iter().find(|&end| self.bore.is_past(end, inside[end]))
    }

    fn touched(&self, ball: &Sphere) -> Option<Interference> {
        match self.past_end() {
            Some(end) => self.touched_at_mouth(ball, end),
            None => self.touched_on_wall(ball),
        }
    }

    fn touched_on_wall(&self, ball: &Sphere) -> Option<Interference> {
        let [wall_along, wall_aside] = self.hole().wall;
        let height = self.height();
        let normal = || (self.in_space(wall_along, wall_aside) * -1.0).normalize();
        (height < self.bore.thickness)
            .then(|| pushed(ball, ball.radius + height, normal, Feature::face(0)))
            .flatten()
    }

    /// Returns the contact with the circular edge of a mouth. `None` in these cases:
    ///
    /// * the sphere does not reach the edge;
    /// * the mouth is not convex, or its radius is 0;
    /// * the centre is farther from the axis than the edge, so that the sphere touches the face around the
    ///   hole.
    fn touched_at_mouth(&self, ball: &Sphere, end: usize) -> Option<Interference> {
        let radius = self.hole().radii[end];
        let mouth_along = if end == 0 { 0.0 } else { self.hole().length };
        let (along, aside) = (self.along - mouth_along, self.aside - radius);
        if !self.bore.mouths[end] || radius == 0.0 || aside > 0.0 {
            return None;
        }
        let distance = (along * along + aside * aside).sqrt();
        let scale = self.along.abs().max(radius).max(self.hole().length);
        let normal = || {
            if distance > ROUNDING * scale {
                return (self.in_space(along, aside) / distance).normalize();
            }
            let [wall_along, wall_aside] = self.hole().wall;
            let outward = if end == 0 { -1.0 } else { 1.0 };
            self.in_space(outward - wall_along, -wall_aside).normalize()
        };
        pushed(ball, ball.radius - distance, normal, Feature::edge(end))
    }

    fn in_space(&self, along: f64, aside: f64) -> Vec3 {
        self.hole().axis * along + self.away_b * aside
    }
}

fn pushed(
    ball: &Sphere,
    depth: f64,
    normal: impl FnOnce() -> Vec3,
    feature: Feature,
) -> Option<Interference> {
    (depth > 0.0).then(|| {
        let normal_b = normal();
        Interference { depth, normal_b, deepest_b: ball.center - normal_b * ball.radius, feature }
    })
}
