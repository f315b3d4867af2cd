//! Straight paths of points of A since the last commit, and their outcome for polyhedra of B. The pieces of a
//! shell, joined at internal faces, form one solid.

use pong_geometry::Vec3;
use pong_geometry::interference::point_polyhedron::entry_of_line;
use pong_geometry::primitive::{Polyhedron, PrimitiveKind};
use pong_model::MovableGroup;

/// Path of a point of an element of A since the last commit, in B's frame, m.
pub(super) struct Line {
    pub from_b: Vec3,
    pub to_b: Vec3,
}

/// Outcome of a path for one shell of B, with the normal of the side through which the path enters.
pub(super) enum Met {
    /// The path enters and leaves the solid, or passes through the sheet.
    Through(Vec3),
    /// The path enters the solid and ends there.
    Into(Vec3),
}

/// Outcome of a path that enters a piece through an active (not internal) face: it leaves the whole solid
/// again, or ends in it. `None` if the path does not enter in this way, or if it starts in the solid:
/// `ended.rs` checks its contacts.
pub(super) fn meet(body: &MovableGroup, shell: u32, piece: u32, line: &Line) -> Option<Met> {
    let polyhedron = &body.polyhedra[piece as usize];
    let entry = entry_of_line(&line.from_b, &line.to_b, polyhedron)?;
    let face = &polyhedron.faces[entry.face];
    if !face.active || holds(body, shell, &line.from_b) {
        return None;
    }
    let inside = holds(body, shell, &line.to_b);
    Some(if inside { Met::Into(face.normal) } else { Met::Through(face.normal) })
}

/// Returns true if a point is inside the solid that the pieces of a shell form.
pub(super) fn holds(body: &MovableGroup, shell: u32, place: &Vec3) -> bool {
    pieces(body, shell).any(|polyhedron| polyhedron.contains(place))
}

/// Normal of the last active face through which a path that starts inside the solid leaves it; `None` if it
/// does not leave.
pub(super) fn way_out(body: &MovableGroup, shell: u32, line: &Line) -> Option<Vec3> {
    let backwards = pieces(body, shell).filter_map(|polyhedron| {
        let entry = entry_of_line(&line.to_b, &line.from_b, polyhedron)?;
        Some((entry.at, &polyhedron.faces[entry.face]))
    });
    let last = backwards.filter(|(_, face)| face.active).min_by(|(a, _), (b, _)| a.total_cmp(b));
    last.map(|(_, face)| face.normal)
}

fn pieces(body: &MovableGroup, shell: u32) -> impl Iterator<Item = &Polyhedron> {
    let of_shell = body.primitives.iter().filter(move |info| info.shell == shell);
    let pieces = of_shell.filter(|info| info.kind == PrimitiveKind::Polyhedron);
    pieces.map(|info| &body.polyhedra[info.elements.start as usize])
}
