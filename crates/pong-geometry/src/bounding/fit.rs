//! Fitting a volume of a given kind around things, and the margin that every fitted volume carries.

use super::bounded::largest;
use super::{BoundKind, Bounded, Volume, aabb, obb, sphere};
use crate::Vec3;
use crate::extension::Extensions;

/// Every fitted volume is grown by this share of (its extent + the distance of its centre from the frame's
/// origin).
///
/// Why this is enough for the pair tests to need no margin of their own for where things are: let the volumes have
/// centres `c` and extents `e`, and let the frames be `r` apart. Carrying a centre into the other frame, or the
/// contact test carrying the thing itself, rounds by a few units of 1.1e-16 of `r + |c_A| + |c_B|`, and fitting by
/// as much of `|c| + e`. If the two touch, `r ≤ |c_A| + e_A + |c_B| + e_B`. So all rounding is below some ten
/// units of 1.1e-16 of that sum, and the two volumes are grown by 1e-12 of it: a thousand times more.
pub const RELATIVE_MARGIN: f64 = 1e-12;

/// Fits a volume of the given kind around things, all in the frame of one movable group, margin included
/// ([`RELATIVE_MARGIN`]).
///
/// Anything of infinite extent among them makes the volume [`Volume::Unbounded`], whatever the kind. Refused are
/// an empty list, things whose extent is not a number, and custom kinds that are not registered or whose fitter
/// returns a volume of another name.
///
/// # Errors
/// The reason in words: what is refused above, or a volume that would not be finite.
pub fn fit(kind: &BoundKind, things: &[&dyn Bounded], ext: &Extensions) -> Result<Volume, String> {
    let Some((min, max)) = bounds(things)? else { return Ok(Volume::Unbounded) };
    let volume = match kind {
        BoundKind::Aabb => aabb::fit_aabb_bounds(min, max),
        BoundKind::Sphere => sphere::fit_sphere(things, &((min + max) * 0.5)).inflated(),
        BoundKind::Obb => obb::fit_obb(things).inflated(),
        BoundKind::Custom(name) => fit_custom(name, things, ext)?,
    };
    if !volume.is_finite() {
        return Err(format!("the {} volume around these things is not finite", kind.name()));
    }
    Ok(volume)
}

fn fit_custom(name: &str, things: &[&dyn Bounded], ext: &Extensions) -> Result<Volume, String> {
    let fitter =
        ext.volume(name).ok_or_else(|| format!("no bounding volume of kind \"{name}\" is registered"))?;
    let volume = fitter(things);
    if volume.kind_name() != name {
        return Err(format!("the fitter of \"{name}\" made a volume of kind \"{}\"", volume.kind_name()));
    }
    Ok(Volume::Custom(volume))
}

/// The least and greatest coordinates over things; `None` if any of them is infinite.
///
/// A convex set without bounds goes to infinity along some direction, and so along an axis that is not across it:
/// the six supports find every unbounded thing.
fn bounds(things: &[&dyn Bounded]) -> Result<Option<(Vec3, Vec3)>, String> {
    if things.is_empty() {
        return Err("there is nothing to bound".to_owned());
    }
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let max = Vec3::from(axes.map(|e| support(things, &e)));
    let min = Vec3::from(axes.map(|e| -support(things, &-e)));
    if min.iter().chain(max.iter()).any(|x| x.is_nan()) {
        return Err("the extent of what is to be bounded is not a number".to_owned());
    }
    if max.max() == f64::INFINITY || min.min() == f64::NEG_INFINITY {
        return Ok(None);
    }
    // No points at all: a support of minus infinity.
    if (max - min).min() < 0.0 {
        return Err("there is nothing to bound".to_owned());
    }
    Ok(Some((min, max)))
}

/// Support of all things together.
pub(super) fn support(things: &[&dyn Bounded], direction: &Vec3) -> f64 {
    largest(things.iter().map(|thing| thing.support(direction)))
}

/// The points that represent all things together.
pub(super) fn representatives(things: &[&dyn Bounded]) -> Vec<Vec3> {
    let mut points = Vec::new();
    for thing in things {
        thing.representatives(&mut points);
    }
    points
}

impl Volume {
    /// The volume grown by [`RELATIVE_MARGIN`]. Fitted volumes already are; one that is written down by hand should
    /// be, before it is tested against others. A custom volume carries a margin of its own.
    pub fn inflated(self) -> Self {
        let margin = |extent: f64, center: &Vec3| RELATIVE_MARGIN * (extent + center.norm());
        match self {
            Self::Aabb { center, half } => {
                Self::Aabb { center, half: half.add_scalar(margin(half.norm(), &center)) }
            }
            Self::Sphere { center, radius } => {
                Self::Sphere { center, radius: radius + margin(radius, &center) }
            }
            Self::Obb { center, axes, half } => {
                Self::Obb { center, axes, half: half.add_scalar(margin(half.norm(), &center)) }
            }
            other => other,
        }
    }

    fn is_finite(&self) -> bool {
        let finite = |v: &Vec3| v.iter().all(|x| x.is_finite());
        match self {
            Self::Unbounded | Self::Custom(_) => true,
            Self::Aabb { center, half } => finite(center) && finite(half),
            Self::Sphere { center, radius } => finite(center) && radius.is_finite(),
            Self::Obb { center, axes, half } => {
                finite(center) && finite(half) && axes.iter().all(|x| x.is_finite())
            }
        }
    }
}
