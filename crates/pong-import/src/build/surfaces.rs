//! Default surfaces, and names of unknown surfaces.

use super::building::Building;
use crate::findings::Findings;
use crate::laws::DefaultSurface;
use crate::model::{Group, Model};
use std::collections::BTreeSet;

/// Name of the placeholder when no surface is given.
const PLACEHOLDER: &str = "placeholder";

/// Gives the root a surface if something below has none.
pub fn default_surface(model: &mut Model, building: &Building<'_>, findings: &mut Findings) {
    if !lacks_surface(&model.root) {
        if let (Some(surface), true) = (&building.surface, findings.faults.is_empty()) {
            let cause =
                format!("everything has a surface: `{}` of the command line is not used", surface.name);
            findings.note(&building.file, "surface-not-used", cause, "");
        }
        return;
    }
    let surface = building.surface.clone().unwrap_or_else(|| {
        let cause = format!(
            "nothing says what it is made of: `{PLACEHOLDER}` (1e6 N/m, no damping, no friction) stands in"
        );
        let cure = "give --stiffness, --damping and --mu, or correct the surface in the model file";
        findings.note(&building.file, "placeholder-surface", cause, cure);
        let line =
            format!("The surface `{PLACEHOLDER}` stands in for one that was not given: correct its numbers.");
        model.comment.push(line);
        DefaultSurface { name: PLACEHOLDER.to_owned(), stiffness: 1e6, damping: 0.0, mu: 0.0 }
    });
    if model.surfaces.iter().any(|(name, _)| *name == surface.name) {
        let cause = format!("the surface `{}` is in the file already", surface.name);
        findings.fault(
            &building.file,
            "repeated-surface",
            cause,
            "--surface gives the default one another name",
        );
        return;
    }
    model.surfaces.push((surface.name.clone(), surface.record()));
    model.root.surface = Some(surface.name);
}

/// Tests whether a primitive has no surface, neither its own nor from a group above.
fn lacks_surface(group: &Group) -> bool {
    group.surface.is_none()
        && (group.primitives.iter().any(|primitive| primitive.surface.is_none())
            || group.groups.iter().any(lacks_surface))
}

/// Reports every surface name that the model does not define.
pub(super) fn unknown_surfaces(model: &Model, building: &Building<'_>, findings: &mut Findings) {
    let mut named: BTreeSet<(String, String)> = BTreeSet::new();
    let mut open = vec![(model.root.name.clone(), &model.root)];
    while let Some((path, group)) = open.pop() {
        named.extend(group.surface.iter().map(|surface| (path.clone(), surface.clone())));
        for primitive in &group.primitives {
            named.extend(
                primitive
                    .surface
                    .iter()
                    .map(|surface| (format!("{path}/{}", primitive.name), surface.clone())),
            );
        }
        open.extend(group.groups.iter().map(|below| (format!("{path}/{}", below.name), below)));
    }
    for (path, surface) in named {
        if !model.surfaces.iter().any(|(name, _)| *name == surface) {
            let cause = format!("there is no surface `{surface}` in the file");
            let cure = "add it to the surfaces of the scene's extras.pong, or correct the name";
            findings.fault(&format!("{}: {path}", building.file), "unknown-surface", cause, cure);
        }
    }
}
