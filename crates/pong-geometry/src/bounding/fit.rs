//! Fitting a volume of a given kind around things.

use super::bounded::support;
use super::volume::{BoundKind, Bounded, Volume};
use super::{aabb, obb, sphere};
use crate::Vec3;
use crate::extension::Extensions;

/// Fits a volume of the given kind around things, all in the frame of one movable group, margin included
/// ([`RELATIVE_MARGIN`](super::RELATIVE_MARGIN)).
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
