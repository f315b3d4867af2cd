//! Solids of polyhedra: a polyhedron, or several joined by internal faces.

use super::convex;
use super::facets::{Facet, total_area};
use super::refusal::{self, Refusal};
use crate::draft::BodyDraft;
use crate::model::MovableGroup;
use crate::solid::{Solid, SolidField, SolidPart};
use crate::solid_box::SolidBox;
use crate::solid_tree::SolidTree;
use crate::surface::Surface;
use pong_geometry::Vec3;
use pong_geometry::overlap::{HalfSpace, Surface as ClosedSurface};
use pong_geometry::primitive::{Polyhedron, PrimitiveKind};
use std::collections::BTreeMap;

/// Solids of the polyhedra of a movable group.
pub(super) fn solids(draft: &BodyDraft, surfaces: &[Surface], refusals: &mut Vec<Refusal>) -> Vec<Solid> {
    let mut shells: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (index, info) in draft.body.primitives.iter().enumerate() {
        if info.kind == PrimitiveKind::Polyhedron {
            shells.entry(info.shell).or_default().push(index);
        }
    }
    shells.retain(|_, pieces| pieces.iter().any(|&piece| draft.is_solid[piece]));
    shells.retain(|_, pieces| refusal::is_uniform(draft, surfaces, pieces, refusals));
    shells.iter().map(|(shell, pieces)| solid(draft, *shell, pieces)).collect()
}

/// Solid of the polyhedra of one shell.
fn solid(draft: &BodyDraft, shell: u32, pieces: &[usize]) -> Solid {
    let body = &draft.body;
    let polyhedra: Vec<&Polyhedron> =
        pieces.iter().map(|&piece| &body.polyhedra[body.primitives[piece].elements.start as usize]).collect();
    let vertices: Vec<Vec3> = polyhedra.iter().flat_map(|polyhedron| places(polyhedron)).collect();
    let bound = SolidBox::around(&vertices);
    let facets = |active| polyhedra.iter().flat_map(move |polyhedron| facets(polyhedron, active));
    let outer: Vec<Facet> = facets(true).collect();
    let internal: Vec<Facet> = facets(false).collect();
    let diameter = 2.0 * bound.half.norm();
    let merged = convex::field(convex::planes(&outer, diameter), &internal, &vertices, diameter);
    let parts: Vec<SolidPart> = pieces.iter().map(|&piece| part(body, piece)).collect();
    let items = match merged {
        Some(_) => vec![bound],
        None => parts.iter().map(|part| part.bound).collect(),
    };
    Solid {
        primitive: pieces[0] as u32,
        shell,
        surface: body.primitives[pieces[0]].surface,
        leaf: 0,
        bound,
        area: total_area(&outer),
        parts,
        fields: merged
            .map_or_else(|| polyhedra.iter().map(|piece| field(piece)).collect(), |field| vec![field]),
        facets: Vec::new(),
        facet_walls: Vec::new(),
        tree: SolidTree::new(&items),
    }
}

fn places(polyhedron: &Polyhedron) -> impl Iterator<Item = Vec3> {
    polyhedron.vertices.iter().map(|vertex| vertex.position)
}

/// Faces of a polyhedron that may push, or its internal faces.
fn facets(polyhedron: &Polyhedron, active: bool) -> impl Iterator<Item = Facet> {
    let faces = polyhedron.faces.iter().filter(move |face| face.active == active);
    faces.map(|face| Facet {
        plane: HalfSpace { normal_b: face.normal, offset: face.offset },
        corners: polyhedron
            .rims_of(face)
            .iter()
            .map(|rim| polyhedron.vertices[rim.start as usize].position)
            .collect(),
    })
}

fn part(body: &MovableGroup, piece: usize) -> SolidPart {
    let element = body.primitives[piece].elements.start;
    let polyhedron = &body.polyhedra[element as usize];
    let mut surface = ClosedSurface::with_capacity(polyhedron.faces.len());
    surface.add_vertices(places(polyhedron));
    for face in &polyhedron.faces {
        surface.add_facet(polyhedron.rims_of(face).iter().map(|rim| rim.start));
    }
    let primitive = piece as u32;
    SolidPart { primitive, element, bound: SolidBox::around(surface.vertices()), surface, facets: 0..0 }
}

/// Field of one piece of a solid that is not convex.
fn field(polyhedron: &Polyhedron) -> SolidField {
    let vertices: Vec<Vec3> = places(polyhedron).collect();
    let bound = SolidBox::around(&vertices);
    let planes = |active| {
        let facets: Vec<Facet> = facets(polyhedron, active).collect();
        convex::planes(&facets, 2.0 * bound.half.norm())
    };
    SolidField { bound, faces: planes(true), walls: planes(false), edges: Vec::new() }
}
