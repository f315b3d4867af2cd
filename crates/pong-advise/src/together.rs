//! Contacts that can act together on a movable group: an upper bound of their stiffness.
//!
//! A group on springs oscillates with ω² = λ, the largest eigenvalue of M⁻¹·Σ k·JᵀJ, J = (n, r × n) for a
//! contact along n at the lever r. The actual contacts and normals are not known before the run. The bound
//! takes:
//!
//! * **contacts**: every point, segment, ray, ball and ellipsoid of one group that the other's surfaces can
//!   touch, as far as they can at once: on a plane those that lie within 2 % of the group's size of one
//!   supporting plane; on other surfaces those that fit into the surfaces' diameter. A primitive that can
//!   touch several surfaces at once counts for each.
//! * **direction**: on a plane its normal; elsewhere k·nnᵀ ≤ k·1, an isotropic spring.
//! * **friction** that sticks at all of them, at the lever of the ball's surface.
//! * **both bodies**: the other body's share is that of its farthest point, under an axis that may overhang it that of the
//!   farthest place of the axis, and the λ of two bodies add.
//! * **all partners**: the effects of different partners on one group add.
//!
//! Each of these can only raise λ, except for levers of friction on balls and for the directions of
//! supporting planes, which are sampled on a grid.

use crate::mass::StepPlan;
use crate::mobility::{Mat6, Mobility, largest_eigenvalue};
use crate::places::{overhangs, yield_at_ends};
use crate::setting::Setting;
use crate::spring::{ContactSprings, Spring, springs};
use crate::term::Term;
use nalgebra::DMatrix;
use pong_engine::has_tester;
use pong_engine::inspect::GroupPair;
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Element, Item, MovableGroup, PrimitiveInfo};

/// Upper bound of the contacts that act on one movable group at once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Load {
    /// Contacts.
    pub contacts: usize,
    /// Largest k/m of a mode, 1/s².
    pub stiffness_rate: f64,
    /// Largest c/m of a mode, 1/s.
    pub damping_rate: f64,
}

impl Load {
    /// Sum of two loads that act at once.
    pub fn plus(self, other: Self) -> Self {
        Self {
            contacts: self.contacts + other.contacts,
            stiffness_rate: self.stiffness_rate + other.stiffness_rate,
            damping_rate: self.damping_rate + other.damping_rate,
        }
    }

    fn times(self, count: usize) -> Self {
        let share = count as f64;
        Self {
            contacts: self.contacts * count,
            stiffness_rate: self.stiffness_rate * share,
            damping_rate: self.damping_rate * share,
        }
    }

    fn or_larger(self, other: Self) -> Self {
        Self {
            contacts: self.contacts.max(other.contacts),
            stiffness_rate: self.stiffness_rate.max(other.stiffness_rate),
            damping_rate: self.damping_rate.max(other.damping_rate),
        }
    }
}

/// A primitive that can be in contact.
struct ContactSite {
    /// Point through which its normals pass, in its group's frame; for a segment or capsule the middle of its
    /// axis.
    center: Vec3,
    /// Vector from there to an end of the axis; zero without one.
    half_axis: Vec3,
    /// Distance from there to its surface, m.
    radius: f64,
    /// True if its normals pass anywhere within the radius.
    is_loose: bool,
    /// The stiffest values over all surfaces that it can meet.
    springs: ContactSprings,
}

impl ContactSite {
    /// Height of its lowest point along a direction, m.
    fn height(&self, up: &Vec3) -> f64 {
        up.dot(&self.center) - up.dot(&self.half_axis).abs() - self.radius
    }

    /// Distance from the centre to its farthest point, m.
    fn reach(&self) -> f64 {
        self.half_axis.norm() + self.radius
    }

    fn friction(&self) -> (f64, f64) {
        self.springs.friction.map_or((0.0, 0.0), |friction| (friction.stiffness, friction.damping))
    }
}

/// The sites of A and their partners on B.
struct Direction {
    sites: Vec<ContactSite>,
    mobility_a: Option<Mobility>,
    /// Largest 1/m of B at a point where it can be touched.
    softness_b: f64,
    /// Boxes around B's surfaces other than planes.
    boxes: Vec<(Vec3, Vec3)>,
    planes: usize,
}

/// Load of all contacts of a pair at once, in both directions, without some of their terms.
pub(crate) fn pair_load(
    setting: &Setting<'_>,
    pair: &GroupPair,
    mass: f64,
    plan: &StepPlan,
    without: &[Term],
) -> Load {
    let directions = [(pair.first, pair.second, 0), (pair.second, pair.first, 1)];
    let loads = directions.map(|(a, b, flipped)| {
        let direction = Direction::new(setting, pair, (a, b, flipped), mass, plan, without);
        direction.on_planes().plus(direction.on_others())
    });
    loads[0].plus(loads[1])
}

impl Direction {
    fn new(
        setting: &Setting<'_>,
        pair: &GroupPair,
        (a, b, flipped): (usize, usize, usize),
        mass: f64,
        plan: &StepPlan,
        without: &[Term],
    ) -> Self {
        let (body_a, body_b) = (setting.scene.body(a), setting.scene.body(b));
        let mobility_a = setting.mobilities[a];
        let in_order = (flipped == 0) == pair.first_named_first;
        let table = pair.tables[flipped];
        let meets = |info_a: &PrimitiveInfo, info_b: &PrimitiveInfo| {
            // For two equal kinds A is the one that was named first.
            (in_order || info_a.kind != info_b.kind || info_a.kind == PrimitiveKind::Custom)
                && setting.scene.can_be_tested((a, info_a), (b, info_b))
        };
        let partners = distinct(body_b, |info| setting.scene.filters_that_hold((b, info), a));
        let mut sites = Vec::new();
        // Longest part of A that holds B at places beside it, m.
        let mut overhang = 0.0_f64;
        let mut cached: Vec<(Alike, Option<ContactSprings>)> = Vec::new();
        for (index, info) in body_a.primitives.iter().enumerate() {
            let of = (info.kind, info.surface, setting.scene.filters_that_hold((a, info), b));
            let known = cached.iter().find(|(other, _)| *other == of);
            let made = match known {
                Some((_, made)) => *made,
                None => {
                    let met = partners.iter().filter(|partner| meets(info, partner));
                    let values = met.filter_map(|partner| {
                        let props = setting.scene.surface_values(table, (info.surface, partner.surface));
                        let mut made = springs(props, mass, plan.closing_speed).ok()?;
                        if yield_at_ends(info.kind, partner.kind) {
                            made.normal.stiffness *= 2.0;
                        }
                        Some(made)
                    });
                    let made = values.reduce(stiffest).map(|made| made.without(without));
                    cached.push((of, made));
                    made
                }
            };
            let Some(site) = made.and_then(|springs| site(body_a, index, springs)) else { continue };
            if partners.iter().any(|partner| meets(info, partner) && overhangs(info.kind, partner.kind)) {
                overhang = overhang.max(2.0 * site.reach());
            }
            sites.push(site);
        }
        let kinds: Vec<_> = body_a.primitives.iter().map(|info| info.kind).collect();
        let touched =
            |info: &&PrimitiveInfo| kinds.iter().any(|kind| pong_engine::has_tester(*kind, info.kind));
        let planes =
            body_b.primitives.iter().filter(touched).filter(|info| info.kind == PrimitiveKind::Plane).count();
        let boxes = boxes(body_b, touched);
        let softness_b = setting.mobilities[b].map_or(0.0, |mobility| {
            let at_center = mobility.compliance(mobility.center());
            // Half of the spring is at each end of A's axis, and one of the ends is above B.
            let softness = |(low, high): &(Vec3, Vec3)| {
                let wider = (low.add_scalar(-overhang), high.add_scalar(overhang));
                0.5 * (mobility.compliance_in(&(*low, *high)) + mobility.compliance_in(&wider))
            };
            boxes.iter().map(softness).fold(at_center, f64::max)
        });
        Self { sites, mobility_a, softness_b, boxes, planes }
    }

    /// Load on planes: for one plane the sites near a supporting plane, times the number of planes, at most
    /// the three of a corner.
    fn on_planes(&self) -> Load {
        /// Number of planes that meet in a corner.
        const CORNER: usize = 3;
        if self.planes == 0 || self.sites.is_empty() {
            return Load::default();
        }
        let depth = SHALLOW * self.spread();
        let mut worst = Load::default();
        for normal in supports(&self.sites) {
            let lowest = self.sites.iter().map(|site| site.height(&normal)).fold(f64::INFINITY, f64::min);
            let active = self.sites.iter().filter(|site| site.height(&normal) <= lowest + depth);
            worst = worst.or_larger(self.load(&active.collect::<Vec<_>>(), Some(&normal), &-normal));
        }
        worst.times(self.planes.min(CORNER))
    }

    /// Load on other surfaces: the sites that fit into their diameter.
    fn on_others(&self) -> Load {
        /// Number of groups of sites tried.
        const WINDOWS: usize = 16;
        let Some((low, high)) = self.boxes.iter().copied().reduce(around) else { return Load::default() };
        if self.sites.is_empty() {
            return Load::default();
        }
        let diameter = (high - low).norm();
        let near = |at: &ContactSite| -> Vec<&ContactSite> {
            let reach = |other: &ContactSite| diameter + at.reach() + other.reach();
            let within = |other: &&ContactSite| (other.center - at.center).norm() <= reach(other);
            self.sites.iter().filter(within).collect()
        };
        let mut windows: Vec<Vec<&ContactSite>> = if self.spread() <= diameter {
            vec![self.sites.iter().collect()]
        } else {
            self.sites.iter().step_by(1 + self.sites.len() / 4096).map(near).collect()
        };
        windows.sort_by(|x, y| total(y).total_cmp(&total(x)));
        let widest = self.sites.iter().map(|site| site.radius).fold(0.0, f64::max);
        let max_simultaneous_contacts = max_simultaneous_contacts(&self.boxes, 2.0 * widest);
        let mut worst = Load::default();
        for active in windows.iter().take(WINDOWS) {
            // A point has its surface at its centre, in every direction.
            let ways = if widest > 0.0 { grid().collect() } else { vec![Vec3::x()] };
            for toward in ways {
                worst = worst.or_larger(self.load(active, None, &toward));
            }
        }
        worst.times(max_simultaneous_contacts)
    }

    /// Load of these sites at once: along a normal, or along any direction; friction acts at the surface
    /// towards `toward`.
    fn load(&self, active: &[&ContactSite], normal: Option<&Vec3>, toward: &Vec3) -> Load {
        let rate = |values: fn(&ContactSite) -> (f64, f64)| {
            let whole: f64 =
                active.iter().map(|site| values(site)).map(|(along, across)| along.max(across)).sum();
            let at = |mobility| largest_of_ends(mobility, active, values, (normal, toward));
            self.mobility_a.as_ref().map_or(0.0, at) + whole * self.softness_b
        };
        Load {
            contacts: active.len(),
            stiffness_rate: rate(|site| (site.springs.normal.stiffness, site.friction().0)),
            damping_rate: rate(|site| (site.springs.normal.damping, site.friction().1)),
        }
    }

    /// Diameter of the box around all sites, m.
    fn spread(&self) -> f64 {
        let own = self.sites.iter().map(|site| {
            let around = Vec3::repeat(site.radius) + site.half_axis.abs();
            (site.center - around, site.center + around)
        });
        own.reduce(around).map_or(0.0, |(low, high)| (high - low).norm())
    }
}

/// Values of a site along its normal, and across it.
type Values = fn(&ContactSite) -> (f64, f64);

/// The largest eigenvalue of the sum of all sites, for any point of contact along their axes. An eigenvalue
/// is convex in the shares of the two ends, so the whole spring at one end is the maximum; with many axes
/// both ends get a whole spring.
fn largest_of_ends(
    mobility: &Mobility,
    active: &[&ContactSite],
    values: Values,
    direction: (Option<&Vec3>, &Vec3),
) -> f64 {
    /// Most axes whose ends are tried one by one.
    const TRIED: usize = 4;
    let (long, short): (Vec<&ContactSite>, Vec<&ContactSite>) =
        active.iter().partition(|site| site.half_axis != Vec3::zeros());
    let mut fixed = Mat6::zeros();
    for site in short {
        add_site(&mut fixed, mobility, site, values(site), &site.center, direction);
    }
    let ends = |site: &ContactSite| [site.center + site.half_axis, site.center - site.half_axis];
    if long.len() > TRIED {
        for site in &long {
            for end in ends(site) {
                add_site(&mut fixed, mobility, site, values(site), &end, direction);
            }
        }
        return largest_eigenvalue(DMatrix::from_column_slice(6, 6, fixed.as_slice()));
    }
    let choice = |code: usize| {
        let mut sum = fixed;
        for (i, site) in long.iter().enumerate() {
            add_site(&mut sum, mobility, site, values(site), &ends(site)[code >> i & 1], direction);
        }
        largest_eigenvalue(DMatrix::from_column_slice(6, 6, sum.as_slice()))
    };
    (0..1 << long.len()).map(choice).fold(0.0, f64::max)
}

/// Adds the springs of one site touched at a point.
fn add_site(
    sum: &mut Mat6,
    mobility: &Mobility,
    site: &ContactSite,
    (along, across): (f64, f64),
    at: &Vec3,
    (normal, toward): (Option<&Vec3>, &Vec3),
) {
    if site.is_loose {
        return mobility.add_bushing_around(sum, along.max(across), at, site.radius);
    }
    let skin = at + site.radius * toward;
    mobility.add_bushing(sum, across, &skin);
    match normal {
        // The bushing above already has part of the normal spring; an excess across stays, for an upper
        // bound.
        Some(normal) => mobility.add(sum, (along - across).max(0.0), normal, &skin),
        None => mobility.add_bushing(sum, (along - across).max(0.0), at),
    }
}

/// Depth behind a supporting plane at which a group still touches, relative to its size.
const SHALLOW: f64 = 0.02;

fn total(active: &[&ContactSite]) -> f64 {
    active.iter().map(|site| site.springs.normal.stiffness).sum()
}

fn around(a: (Vec3, Vec3), b: (Vec3, Vec3)) -> (Vec3, Vec3) {
    (a.0.inf(&b.0), a.1.sup(&b.1))
}

/// The larger of every value of two contacts.
fn stiffest(a: ContactSprings, b: ContactSprings) -> ContactSprings {
    let larger = |a: Spring, b: Spring| Spring {
        stiffness: a.stiffness.max(b.stiffness),
        damping: a.damping.max(b.damping),
    };
    let friction = match (a.friction, b.friction) {
        (Some(a), Some(b)) => Some(larger(a, b)),
        (a, b) => a.or(b),
    };
    ContactSprings {
        normal: larger(a.normal, b.normal),
        friction,
        bounces_by_formula: a.bounces_by_formula && b.bounces_by_formula,
    }
}

/// Kind, surface and filters: primitives that share them meet the same partners with the same values.
type Alike = (PrimitiveKind, u32, Vec<usize>);

/// One primitive for each kind and surface, but every primitive of kinds registered by the host.
fn distinct(body: &MovableGroup, filters: impl Fn(&PrimitiveInfo) -> Vec<usize>) -> Vec<&PrimitiveInfo> {
    let mut seen = std::collections::BTreeSet::new();
    let new = |info: &&PrimitiveInfo| {
        info.kind == PrimitiveKind::Custom || seen.insert((info.kind, info.surface, filters(info)))
    };
    body.primitives.iter().filter(new).collect()
}

fn site(body: &MovableGroup, primitive: usize, springs: ContactSprings) -> Option<ContactSite> {
    let info = &body.primitives[primitive];
    let element = info.elements.start;
    let is_custom = info.kind == PrimitiveKind::Custom;
    if !is_custom && !PrimitiveKind::ALL.into_iter().any(|kind_b| has_tester(info.kind, kind_b)) {
        return None;
    }
    // A ray touches with its tip, not with the origin on which its core is.
    let facts = body.element(info.kind, element).facts().filter(|_| info.kind != PrimitiveKind::Ray);
    let core = facts.and_then(|facts| facts.core());
    let is_loose = core.is_none();
    let ([one, other], radius) = core.unwrap_or_else(|| {
        let (low, high) = Element::new(body, Item { primitive: primitive as u32, element }).extent();
        ([0.5 * (low + high); 2], 0.5 * (high - low).norm())
    });
    let (center, half_axis) = (0.5 * (one + other), 0.5 * (other - one));
    let numbers = center.iter().chain(&half_axis).chain([&radius]);
    numbers.into_iter().all(|x| x.is_finite()).then_some(ContactSite {
        center,
        half_axis,
        radius,
        is_loose,
        springs,
    })
}

/// Boxes around the surfaces of a body that can be touched, without planes: convex pieces of one shell are
/// one surface, and so is a mesh.
fn boxes(body: &MovableGroup, touched: impl Fn(&&PrimitiveInfo) -> bool) -> Vec<(Vec3, Vec3)> {
    let mut by_surface = std::collections::BTreeMap::new();
    for (index, info) in body.primitives.iter().enumerate() {
        if info.kind == PrimitiveKind::Plane || !touched(&info) {
            continue;
        }
        let key = if info.kind == PrimitiveKind::Triangle { (1, index as u32) } else { (0, info.shell) };
        let of = |element| Element::new(body, Item { primitive: index as u32, element }).extent();
        let whole = info.elements.clone().map(of).reduce(around);
        if let Some(part) = whole {
            by_surface.entry(key).and_modify(|sum| *sum = around(*sum, part)).or_insert(part);
        }
    }
    by_surface.into_values().collect()
}

/// Upper bound of the surfaces that a body of a diameter can touch at once: all surfaces near the smallest of
/// them that are no smaller.
fn max_simultaneous_contacts(boxes: &[(Vec3, Vec3)], diameter: f64) -> usize {
    /// Above this number all surfaces count, without comparing them.
    const COMPARED: usize = 4096;
    if boxes.len() > COMPARED {
        return boxes.len();
    }
    let size = |a: &(Vec3, Vec3)| (a.1 - a.0).norm();
    let near = |a: &(Vec3, Vec3), b: &(Vec3, Vec3)| {
        (0..3).all(|i| a.0[i] <= b.1[i] + diameter && b.0[i] <= a.1[i] + diameter)
    };
    let with = |a: &(Vec3, Vec3)| boxes.iter().filter(|b| size(b) >= size(a) && near(a, b)).count();
    boxes.iter().map(with).max().unwrap_or(0)
}

/// The 26 directions to the neighbours of a cell.
fn grid() -> impl Iterator<Item = Vec3> {
    let steps = (0..27_u32).map(|code| {
        let sign = |place: u32| f64::from(code / place % 3) - 1.0;
        Vec3::new(sign(1), sign(3), sign(9))
    });
    steps.filter_map(|step| unit(&step))
}

/// The direction of a vector; `None` if it has no length. The divisor is never zero, because a compiler may
/// divide before the branch.
fn unit(v: &Vec3) -> Option<Vec3> {
    let length = v.norm();
    (length > 0.0).then(|| v / length.max(f64::MIN_POSITIVE))
}

/// Normals of supporting planes: the grid, the direction to every site from their centre, and, for few sites,
/// the plane through every three.
fn supports(sites: &[ContactSite]) -> Vec<Vec3> {
    /// Most sites for which every three are tried.
    const FEW: usize = 16;
    /// Most sites whose directions are tried.
    const MANY: usize = 256;
    let middle = sites.iter().map(|site| site.center).sum::<Vec3>() / sites.len() as f64;
    let mut normals: Vec<Vec3> = grid().collect();
    let shown = sites.iter().step_by(1 + sites.len() / MANY);
    normals.extend(shown.filter_map(|site| unit(&(middle - site.center))));
    if sites.len() <= FEW {
        for (i, a) in sites.iter().enumerate() {
            for (j, b) in sites.iter().enumerate().skip(i + 1) {
                for c in &sites[j + 1..] {
                    let across = (b.center - a.center).cross(&(c.center - a.center));
                    normals.extend(unit(&across).into_iter().flat_map(|n| [n, -n]));
                }
            }
        }
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three stones far apart on one sheet: a ball touches the sheet and one of them.
    #[test]
    fn a_ball_touches_the_sheet_and_one_stone() {
        let cube = |x: f64, half: f64| (Vec3::new(x - half, -half, -half), Vec3::new(x + half, half, half));
        let boxes = [cube(0.0, 50.0), cube(-20.0, 1.0), cube(0.0, 1.0), cube(20.0, 1.0)];
        assert_eq!(max_simultaneous_contacts(&boxes, 1.0), 2);
        assert_eq!(max_simultaneous_contacts(&boxes, 19.0), 4);
    }
}
