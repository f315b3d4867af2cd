//! Line segment, capsule and cylinder (A) – bore (B): half a spring at each end of the part in the hole
//! (docs/theory.md, 2.8).
//!
//! At an end in the hole the tip or rim contacts the wall. At an end outside the hole the side of the shape
//! contacts the circle of the mouth. All three shapes are treated as rods: a segment is a rod of radius 0, a
//! capsule a segment with a skin.

use super::ball_bore::{BallContacts, ball_bore, ball_mouth};
use super::circles::{Across, Circle, Depths, Loaded, Reach, SHRINKS, Wall, shares};
use super::two_capsules::EndContact;
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Bore, Capsule, Frustum, LineSegment, Sphere};

/// Contacts of one end of a rod, with their shares of its half spring.
pub type RodContacts = [Option<EndContact>; 2];

/// Contacts of a rod in a hole at end 0 and end 1 of the rod. Each end has half a spring and up to two
/// contacts: at its deepest place, or at two places that share the load.
pub type EndsInBore = [RodContacts; 2];

/// Tests a segment against a bore.
pub fn segment_bore(segment: &LineSegment, bore: &Bore) -> EndsInBore {
    Rod::new(segment.ends, 0.0, 0.0).ends_in(bore)
}

/// Tests a capsule against a bore.
pub fn capsule_bore(capsule: &Capsule, bore: &Bore) -> EndsInBore {
    Rod::new(capsule.ends, 0.0, capsule.radius).ends_in(bore)
}

/// Tests a cylinder against a bore: a pin in a hole.
pub fn cylinder_bore(cylinder: &Frustum, bore: &Bore) -> EndsInBore {
    Rod::new(cylinder.ends, cylinder.radii[0], 0.0).ends_in(bore)
}

const NOTHING: RodContacts = [None; 2];

struct Rod {
    ends: [Vec3; 2],
    axis_b: Vec3,
    length: f64,
    /// Radius of the flat ends, m.
    rim: f64,
    /// Thickness of the skin around the rod, m.
    skin: f64,
}

impl Rod {
    fn new(ends: [Vec3; 2], rim: f64, skin: f64) -> Self {
        let between = ends[1] - ends[0];
        let length = between.norm();
        Self { ends, axis_b: between / length, length, rim, skin }
    }

    fn ends_in(&self, bore: &Bore) -> EndsInBore {
        let same_way = self.axis_b.dot(&bore.hole.axis) >= 0.0;
        [0, 1].map(|end| {
            let mouth = if same_way { end } else { 1 - end };
            RodEnd { rod: self, bore, wall: Wall(bore), end, mouth }.touched()
        })
    }

    fn side(&self) -> f64 {
        self.rim + self.skin
    }

    fn circle(&self, end: usize) -> Circle {
        Circle { center_b: self.ends[end], axis_b: self.axis_b, radius: self.rim }
    }
}

/// One end of a rod, and the mouth of the hole towards which it points.
struct RodEnd<'a> {
    rod: &'a Rod,
    bore: &'a Bore,
    wall: Wall<'a>,
    end: usize,
    mouth: usize,
}

/// Contacts and position of the point at which a tip or a rim extends farthest beyond the wall. The wall is
/// extended past the mouths.
struct AtWall {
    contacts: RodContacts,
    /// Depth of that point without the skin, m; negative in the hole.
    depth: f64,
    /// Distances of that point from the mouth of this end and from the other mouth, m; positive in the hole.
    inside: [f64; 2],
    /// True if the rod leans outward: towards this end it approaches the wall, or goes deeper behind it.
    outward: bool,
}

impl RodEnd<'_> {
    fn touched(&self) -> RodContacts {
        let is_out = |mouth: usize| {
            let distance = self.exit_distance(mouth);
            distance < 0.0 || (distance == 0.0 && self.bore.mouths[mouth])
        };
        if self.rod.skin == 0.0 && (is_out(0) || is_out(1)) {
            return NOTHING;
        }
        let wall = self.at_wall();
        if self.rod.skin > 0.0 && wall.depth <= 0.0 {
            let tip = Sphere { center: self.rod.ends[self.end], radius: self.rod.skin };
            return self.deeper(of_ball(ball_bore(&tip, self.bore)), self.side_at_mouth());
        }
        self.limited(self.with_corner(&wall))
    }

    /// Returns the contacts of this end, combined from those at the wall and at the mouth so that the energy
    /// is continuous. Which of them count depends on the point of this end that is farthest beyond the wall.
    /// Its depth is its distance beyond the wall:
    ///
    /// * If it is past the mouth of the other end, there is no contact.
    /// * If it is in the hole, the contacts at the wall count. Exception: if the rod leans outward, the point
    ///   is nearer to the mouth than its depth, and the mouth has a contact, the less deep of wall and mouth
    ///   counts.
    /// * If it is past the mouth of this end, the contacts at the mouth count. Exception: if the rod does not
    ///   lean outward, the point is no farther from the mouth than its depth, and the mouth has a contact,
    ///   the deeper of wall and mouth counts.
    fn with_corner(&self, wall: &AtWall) -> RodContacts {
        let [own, other] = wall.inside;
        if self.bore.is_past(1 - self.mouth, other) {
            return NOTHING;
        }
        let is_inside = !self.bore.is_past(self.mouth, own);
        if is_inside && !(wall.outward && own < wall.depth) {
            return wall.contacts;
        }
        let line = self.line_at_mouth();
        if is_inside {
            return if line == NOTHING { wall.contacts } else { self.shallower(wall.contacts, line) };
        }
        if line == NOTHING || wall.outward || -own > wall.depth {
            line
        } else {
            self.deeper(line, wall.contacts)
        }
    }

    fn at_wall(&self) -> AtWall {
        let (rod, hole) = (self.rod, &self.bore.hole);
        let circle = rod.circle(self.end);
        let arm = circle.center_b - hole.ends[0];
        let toward_end = rod.axis_b * if self.end == 0 { -1.0 } else { 1.0 };
        let across = Across::new(&hole.axis, &[arm, toward_end]);
        let pushed =
            |side: &Vec3| self.wall.pushed(side, &circle.farthest(&self.wall.outward(side)), rod.skin);
        let is_clear = self.is_clear(&circle, &across.first_b);
        let depths = || self.wall.depths(&circle, rod.skin, &across);
        let shared = if is_clear { None } else { depths().shared(self.wall.shrinks()) };
        let (deepest, contacts) = if let Some(sides) = shared {
            (sides[0].0, pushed_on(sides, pushed))
        } else {
            let deepest = match is_clear || circle.radius == 0.0 {
                true => across.first_b,
                false => across.deepest(|side| self.wall.reach(&circle, side)),
            };
            (deepest, [pushed(&deepest).map(whole), None])
        };
        let place = circle.farthest(&self.wall.outward(&deepest));
        AtWall {
            contacts,
            depth: self.wall.height(&deepest, &place),
            inside: [self.mouth, 1 - self.mouth].map(|mouth| self.wall.inside(&deepest, &place, mouth)),
            outward: toward_end.dot(&self.wall.outward(&deepest)) > 0.0,
        }
    }

    /// Returns `true` if a tip or rim is so far from the wall that it cannot touch it, however
    /// the rod is tilted. `side` is any side.
    fn is_clear(&self, circle: &Circle, side: &Vec3) -> bool {
        let Frustum { ends, axis, .. } = self.bore.hole;
        // Projection of the circle's centre onto the axis of the hole. From there the wall is equally far on
        // all sides.
        let beside = ends[0] + axis * axis.dot(&(circle.center_b - ends[0]));
        let room = -self.wall.height(side, &beside);
        circle.radius + self.rod.skin + (circle.center_b - beside).norm() <= room
    }

    fn mouth_circle(&self) -> Circle {
        let Frustum { ends, axis, radii, .. } = self.bore.hole;
        Circle { center_b: ends[self.mouth], axis_b: axis, radius: radii[self.mouth] }
    }

    /// Returns the deepest of the contacts with the mouth that a capsule has: those of its side between the
    /// ends, and those of its end spheres.
    fn side_at_mouth(&self) -> RodContacts {
        if !self.is_convex() {
            return NOTHING;
        }
        let is_on_rod = |along: f64| (0.0..=self.rod.length).contains(&along);
        let side = self.at_circle(is_on_rod);
        let tips = [0, 1].map(|end| {
            let tip = Sphere { center: self.rod.ends[end], radius: self.rod.skin };
            [ball_mouth(&tip, self.bore, self.mouth).map(whole), None]
        });
        tips.into_iter().fold(side, |one, other| self.deeper(one, other))
    }

    /// Returns the contacts of the rod's side with the mouth. The side is extended past this end by the
    /// thickness of the wall.
    fn line_at_mouth(&self) -> RodContacts {
        if !self.is_convex() {
            return NOTHING;
        }
        let (length, past) = (self.rod.length, self.bore.thickness);
        let [first, last] = if self.end == 0 { [-past, length] } else { [0.0, length + past] };
        self.at_circle(|along| (first..=last).contains(&along))
    }

    fn is_convex(&self) -> bool {
        self.bore.mouths[self.mouth] && self.bore.hole.radii[self.mouth] > 0.0
    }

    /// Returns the contacts of the rod's side with the circle of the mouth, at positions along the rod (m)
    /// that `counts` accepts. Seen along the rod, the circle is an ellipse and the rod's axis a point.
    fn at_circle(&self, counts: impl Fn(f64) -> bool) -> RodContacts {
        let (rod, circle) = (self.rod, self.mouth_circle());
        let arm = rod.ends[0] - circle.center_b;
        let across = Across::new(&rod.axis_b, &[arm, circle.axis_b]);
        let reach = |side: &Vec3| {
            let apart = rod.ends[0] - circle.farthest(side);
            let turning = rod.axis_b.cross(side);
            Reach { depth: rod.side() + side.dot(&apart), slope: turning.dot(&apart) }
        };
        let beside = arm - rod.axis_b * rod.axis_b.dot(&arm);
        if rod.side() + beside.norm() <= circle.radius * rod.axis_b.dot(&circle.axis_b).abs() {
            return NOTHING;
        }
        let is_on = |place: &Vec3| counts(rod.axis_b.dot(&(place - rod.ends[0])));
        // A rod that lies flat across the mouth touches it at two points; one contact acts midway between the
        // two.
        let place_on = |side: &Vec3| match circle.chord(side, &rod.axis_b, &beside) {
            None => Some(circle.farthest(side)).filter(is_on),
            Some([one, other]) => match (is_on(&one), is_on(&other)) {
                (true, true) => Some(0.5 * (one + other)),
                (true, false) => Some(one),
                (false, true) => Some(other),
                (false, false) => None,
            },
        };
        let touched = |side: &Vec3| {
            let side = side.normalize();
            let (place, depth) = (place_on(&side)?, reach(&side).depth);
            let holds = depth > 0.0 && (depth <= rod.side() || self.is_crossed_behind(&counts));
            holds.then(|| Interference {
                depth,
                normal_b: -side,
                deepest_b: place + side * depth,
                feature: Feature::edge(self.mouth),
            })
        };
        let level = rod.axis_b.dot(&circle.axis_b);
        let slant = rod.axis_b.cross(&circle.axis_b);
        let mirror_b = Depths::mirror(&across, &slant);
        let depths = Depths {
            mirror_b,
            base: rod.side(),
            offset: mirror_b.map(|v| v.dot(&beside)),
            radius: -circle.radius,
            square: [level * level, 0.0, slant.norm_squared()],
        };
        let shared = depths.shared(SHRINKS).map(|sides| pushed_on(sides, touched));
        match shared {
            Some(both @ [Some(_), Some(_)]) => both,
            _ => [touched(&across.deepest(reach)).map(whole), None],
        }
    }

    /// Returns `true` if the rod's axis crosses the plane of the mouth near the mouth. Two conditions must
    /// hold. First, `counts` accepts the position of the crossing along the rod. Second, the point of the rod
    /// nearest to the crossing is less than the thickness of the wall from the disc of the mouth.
    fn is_crossed_behind(&self, counts: impl Fn(f64) -> bool) -> bool {
        /// Cosine below which a rod counts as perpendicular to the hole and crosses no mouth.
        const SQUARE: f64 = 1e-9;
        let (rod, circle) = (self.rod, self.mouth_circle());
        let rate = rod.axis_b.dot(&circle.axis_b);
        if rate.abs() < SQUARE {
            return false;
        }
        let along = circle.axis_b.dot(&(circle.center_b - rod.ends[0])) / rate;
        let nearest = rod.ends[0] + rod.axis_b * along.clamp(0.0, rod.length) - circle.center_b;
        let above = circle.axis_b.dot(&nearest);
        let off = ((nearest - circle.axis_b * above).norm() - circle.radius).max(0.0);
        counts(along) && (above * above + off * off).sqrt() < self.bore.thickness
    }

    /// Returns the distance by which the rod must move along the hole's axis to leave the hole by a mouth, m;
    /// negative if it is outside that mouth already.
    fn exit_distance(&self, mouth: usize) -> f64 {
        let outward = self.outward(mouth);
        let depth = |end: usize| {
            outward.dot(&(self.bore.hole.ends[mouth] - self.rod.circle(end).farthest(&-outward)))
        };
        depth(0).max(depth(1))
    }

    fn outward(&self, mouth: usize) -> Vec3 {
        self.bore.hole.axis * if mouth == 0 { -1.0 } else { 1.0 }
    }

    /// Returns the contacts of least energy: `contacts`, or a single contact that pushes the whole rod out of
    /// the hole by a convex mouth. So the energy goes to zero as a rod leaves the hole. The contacts of a
    /// capsule stay as they are.
    fn limited(&self, contacts: RodContacts) -> RodContacts {
        if self.rod.skin > 0.0 || contacts == NOTHING {
            return contacts;
        }
        let leaves = |mouth: usize| {
            let depth = self.exit_distance(mouth);
            let outward = self.outward(mouth);
            let places = [0, 1].map(|end| self.rod.circle(end).farthest(&-outward));
            let is_first = outward.dot(&places[0]) <= outward.dot(&places[1]);
            let contact = Interference {
                depth,
                normal_b: outward,
                deepest_b: places[usize::from(!is_first)],
                feature: Feature::edge(mouth),
            };
            self.bore.mouths[mouth].then_some([Some(whole(contact)), None])
        };
        [0, 1].into_iter().filter_map(leaves).fold(contacts, |one, other| self.shallower(one, other))
    }

    /// Returns the contacts of greater energy: `other` if its energy is greater by more than rounding, else
    /// `one`. (For a rod along the wall both energies are equal.)
    fn deeper(&self, one: RodContacts, other: RodContacts) -> RodContacts {
        if energy(&other) > energy(&one) + self.rounding_of(&one) { other } else { one }
    }

    /// Returns the contacts of less energy: `other` if its energy is less by more than rounding, else `one`.
    fn shallower(&self, one: RodContacts, other: RodContacts) -> RodContacts {
        if energy(&other) < energy(&one) - self.rounding_of(&one) { other } else { one }
    }

    /// Returns the rounding error of the energy of these contacts, m².
    fn rounding_of(&self, contacts: &RodContacts) -> f64 {
        /// Error, rad, of a direction that was found where the slope is discontinuous.
        const DIRECTION: f64 = 4e-12;
        let places = [&self.rod.ends, &self.bore.hole.ends].into_iter().flatten().map(|place| place.amax());
        let reach = places.fold(self.rod.length, f64::max);
        let depth = contacts.iter().flatten().map(|contact| contact.interference.depth).fold(0.0, f64::max);
        2.0 * depth * DIRECTION * reach
    }
}

/// Returns the contacts on two sides that share the load. If what is on the first, the deeper, is too far
/// behind the wall to be pushed, the other has no contact either.
fn pushed_on(sides: [Loaded; 2], pushed: impl Fn(&Vec3) -> Option<Interference>) -> RodContacts {
    let [first, second] = sides.map(|(side, load)| pushed(&side).map(|found| (found, load)));
    let shared =
        |(found, load): (Interference, f64)| EndContact { interference: found, share: load / found.depth };
    match (first, second) {
        (Some(first), Some(second)) => [Some(shared(first)), Some(shared(second))],
        (first, _) => [first.map(|(found, _)| whole(found)), None],
    }
}

/// Contact that carries the load of its end alone.
fn whole(interference: Interference) -> EndContact {
    EndContact { interference, share: 1.0 }
}

/// Returns the contacts of the ball at a tip, with their shares.
fn of_ball(contacts: BallContacts) -> RodContacts {
    match contacts {
        [Some(one), Some(two)] => {
            let loads = shares([one.depth, two.depth], one.normal_b.dot(&two.normal_b));
            let shared = |interference: Interference, load: f64| {
                (load > 0.0).then(|| EndContact { interference, share: load / interference.depth })
            };
            [shared(one, loads[0]), shared(two, loads[1])]
        }
        alone => alone.map(|contact| contact.map(whole)),
    }
}

/// Returns Σ λ·depth over the contacts of one end, m² (docs/theory.md, 2.8). The stored energy is a quarter
/// of the stiffness times this sum.
fn energy(contacts: &RodContacts) -> f64 {
    contacts
        .iter()
        .flatten()
        .map(|contact| contact.share * contact.interference.depth * contact.interference.depth)
        .sum()
}
