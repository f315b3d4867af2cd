//! Solids of triangles: each connected shell that is closed, or that a thickness closes.

use super::crossing::{self, Crossing};
use super::facets::{self, Facet};
use super::refusal::{self, Refusal};
use super::thickened::{Triangles, thickened};
use super::{convex, parts, regions};
use crate::draft::BodyDraft;
use crate::hull::{PLANE_TOLERANCE, area};
use crate::solid::Solid;
use crate::solid_box::SolidBox;
use crate::solid_tree::SolidTree;
use crate::surface::Surface;
use pong_geometry::Vec3;
use pong_geometry::overlap::HalfSpace;
use pong_geometry::primitive::{NO_NEIGHBOR, PrimitiveKind};
use std::collections::BTreeMap;

/// Triangles of one shell and the primitives that they belong to, both in order.
#[derive(Default)]
struct Shell {
    triangles: Vec<u32>,
    primitives: Vec<usize>,
}

/// Solids of the triangles of a movable group.
pub(super) fn solids(draft: &BodyDraft, surfaces: &[Surface], refusals: &mut Vec<Refusal>) -> Vec<Solid> {
    let mut shells: BTreeMap<u32, Shell> = BTreeMap::new();
    for (index, info) in draft.body.primitives.iter().enumerate() {
        if info.kind != PrimitiveKind::Triangle {
            continue;
        }
        if draft.is_solid[index] && info.first_mirror < info.elements.end {
            refusals.push(Refusal {
                primitive: index,
                rule: "solid-two-sided",
                cause: "a solid has an inside, but a two-sided mesh has none".to_owned(),
                cure: "remove `two_sided`, or give the group `contact: Marked`",
            });
            continue;
        }
        for triangle in info.elements.start..info.first_mirror {
            let shell = shells.entry(draft.body.triangles.triangles[triangle as usize].shell).or_default();
            shell.triangles.push(triangle);
            if shell.primitives.last() != Some(&index) {
                shell.primitives.push(index);
            }
        }
    }
    shells.retain(|_, shell| {
        shell.primitives.iter().any(|&primitive| draft.is_solid[primitive])
            && refusal::is_uniform(draft, surfaces, &shell.primitives, refusals)
    });
    shells.iter().filter_map(|(number, shell)| solid(draft, *number, shell, refusals)).collect()
}

/// Solid of one shell.
fn solid(draft: &BodyDraft, number: u32, shell: &Shell, refusals: &mut Vec<Refusal>) -> Option<Solid> {
    let closed = closed(draft, shell, refusals)?;
    let bound = SolidBox::around(&closed.vertices);
    let diameter = 2.0 * bound.half.norm();
    let outer: Vec<Facet> = closed.facets(0..closed.outer).collect();
    let surface_area = outer.iter().map(|facet| area(&facet.corners)).sum();
    let volume = closed.volume();
    let is_layer = closed.outer < closed.triangles.len();
    // The volume of a plate is its thickness times half the area of its surface.
    let least = if is_layer { 0.0 } else { 0.5 * PLANE_TOLERANCE * diameter * surface_area };
    if volume <= least {
        refusals.push(no_volume(shell.primitives[0], volume, least));
        return None;
    }
    let tree = tree_of(&outer);
    if let Some(crossing) = crossing::crossing(&outer, &tree, diameter) {
        refusals.push(crosses_itself(draft, shell, &crossing));
        return None;
    }
    let walls: Vec<Facet> = closed.facets(closed.outer..closed.triangles.len()).collect();
    let field = match convex::is_clearly_concave(&outer, &closed.vertices, diameter) {
        true => None,
        false => {
            let (triangles, tolerance) = (&closed.triangles[..closed.outer], PLANE_TOLERANCE * diameter);
            let faces = facets::planes_of_mesh(&outer, triangles, tolerance);
            convex::field(faces, &walls, &closed.vertices, diameter)
        }
    };
    let all: Vec<Facet> = outer.into_iter().chain(walls).collect();
    let owner = |number: usize| {
        let element = shell.triangles[number % shell.triangles.len()];
        let has = |primitive: &&usize| draft.body.primitives[**primitive].elements.contains(&element);
        let primitive = shell.primitives.iter().find(has).unwrap_or(&shell.primitives[0]);
        (*primitive as u32, element)
    };
    let mut parts = parts::of_mesh(owner, &closed.vertices, &closed.triangles);
    let (mut facets, mut facet_walls, mut items) = (Vec::new(), Vec::new(), vec![bound]);
    if field.is_none() {
        let tree = if is_layer { tree_of(&all) } else { tree };
        let (regions, walls) = regions::regions(&closed, &all, &tree, diameter);
        (facets, facet_walls) = (parts::with_facets(&mut parts, &all, regions, diameter), walls);
        items = parts.iter().map(|part| parts::reach(part, &facets)).collect();
    }
    Some(Solid {
        primitive: shell.primitives[0] as u32,
        shell: number,
        surface: draft.body.primitives[shell.primitives[0]].surface,
        leaf: 0,
        bound,
        area: surface_area,
        parts,
        fields: field.into_iter().collect(),
        facets,
        facet_walls,
        tree: SolidTree::new(&items),
    })
}

/// Tree of the boxes around triangles.
fn tree_of(facets: &[Facet]) -> SolidTree {
    let boxes: Vec<SolidBox> = facets.iter().map(|facet| SolidBox::around(&facet.corners)).collect();
    SolidTree::new(&boxes)
}

/// Refusal of a mesh whose triangles cross. Triangles are named by their numbers in their primitives.
fn crosses_itself(draft: &BodyDraft, shell: &Shell, crossing: &Crossing) -> Refusal {
    let named = crossing.triangles.map(|number| {
        let element = shell.triangles[number];
        let info = |primitive: &usize| &draft.body.primitives[*primitive];
        let owner = shell.primitives.iter().find(|primitive| info(primitive).elements.contains(&element));
        let primitive = *owner.unwrap_or(&shell.primitives[0]);
        (primitive, element - info(&primitive).elements.start)
    });
    let [(primitive, first), (other, second)] = named;
    let of = match other == primitive {
        true => String::new(),
        false => format!(" of {}", draft.body.primitives[other].path),
    };
    Refusal {
        primitive,
        rule: "solid-crossing",
        cause: format!(
            "the mesh crosses itself: triangle {first} and triangle {second}{of} cross at {}",
            place(&crossing.place)
        ),
        cure: "take the triangles apart, make two meshes of it, or give the group `contact: Marked`",
    }
}

fn no_volume(primitive: usize, volume: f64, least: f64) -> Refusal {
    let (cause, cure) = if volume < -least {
        let cause = format!("the mesh is closed and faces inwards: its volume is {volume:.3e} m³");
        (cause, "turn its normals, or give the group `contact: Marked` if it is a room")
    } else {
        let cause = format!("the mesh is thinner than 1e-6 of its diameter: it encloses {volume:.3e} m³");
        (cause, "give it a thickness, or give the group `contact: Marked`")
    };
    Refusal { primitive, rule: "solid-volume", cause, cure }
}

/// Closed surface of a shell: its triangles if they are closed, otherwise those of the layer behind them.
fn closed(draft: &BodyDraft, shell: &Shell, refusals: &mut Vec<Refusal>) -> Option<Triangles> {
    let set = &draft.body.triangles;
    let triangles = Triangles::new(set, &shell.triangles);
    let is_open = |&&triangle: &&u32| set.triangles[triangle as usize].neighbors.contains(&NO_NEIGHBOR);
    let Some(&open) = shell.triangles.iter().find(is_open) else { return Some(triangles) };
    let info = |primitive: usize| &draft.body.primitives[primitive];
    let owner = shell.primitives.iter().copied().find(|&p| info(p).elements.contains(&open));
    let primitive = owner.unwrap_or(shell.primitives[0]);
    let mut refuse = |rule, cause, cure| {
        refusals.push(Refusal { primitive, rule, cause, cure });
        None
    };
    let thickness = info(primitive).thickness;
    if shell.primitives.iter().any(|&other| info(other).thickness != thickness) {
        let cause = "it is open, and a mesh that is joined to it has another `thickness`".to_owned();
        return refuse("solid-thickness", cause, "give all meshes that are joined one thickness");
    }
    let Some(thickness) = thickness else {
        let record = &set.triangles[open as usize];
        let edge = record.neighbors.iter().position(|&neighbor| neighbor == NO_NEIGHBOR).unwrap_or(0);
        let [a, b] = [edge, (edge + 1) % 3].map(|k| place(&set.vertices[record.vertices[k] as usize]));
        let cause = format!("the mesh is open: no triangle joins another at the edge from {a} to {b}");
        let cure = "close the mesh, give it a `thickness`, or give the group `contact: Marked`";
        return refuse("open-solid", cause, cure);
    };
    match thickened(&triangles, thickness) {
        Ok(layer) => Some(layer),
        Err(at) => {
            let cause = format!(
                "the mesh is open, and the layer of {thickness} m behind it turns over near {}",
                place(&at)
            );
            refuse("solid-thickness", cause, "give a smaller `thickness`, or close the mesh")
        }
    }
}

fn place(p: &Vec3) -> String {
    format!("({}, {}, {})", p.x, p.y, p.z)
}

impl Triangles {
    /// Facets of a range of its triangles.
    fn facets(&self, range: std::ops::Range<usize>) -> impl Iterator<Item = Facet> {
        self.triangles[range].iter().map(|triangle| {
            let corners = triangle.map(|vertex| self.vertices[vertex as usize]);
            let [a, b, c] = corners;
            let normal = (b - a).cross(&(c - a));
            let normal_b = (normal / normal.amax()).normalize();
            let offset = normal_b.dot(&((a + b + c) / 3.0));
            Facet { plane: HalfSpace { normal_b, offset }, corners: corners.to_vec() }
        })
    }
}
