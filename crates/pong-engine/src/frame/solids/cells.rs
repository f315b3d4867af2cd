//! Cells of the two fields of a pair of sides: the volume that both share, divided by the nearest faces of B,
//! and by those of A.

use super::cell_force::CellForce;
use super::entry::{self, Entry};
use super::relative::Relative;
use super::side::{Regions, Side};
use pong_geometry::overlap::{Cell, Field, HalfSpace, Moments, Overlap};
use pong_geometry::{Transform, Twist, Vec3, divisor};
use pong_model::SolidFacet;

/// Depth, relative to the height of a region, from which a cell counts as cut off by the floor. The rest is rounding of the
/// vertices in the floor.
const FLOOR_REACHED: f64 = 1.0 - 1e-9;

/// Working memory for solids.
#[derive(Debug, Default)]
pub(crate) struct SolidScratch {
    overlap: Overlap,
    /// Facets whose regions are near a part, as indices among the facets of the side.
    near_facets: Vec<u32>,
    /// Faces of B and of A that push.
    pub(super) faces_b: PushingFaces,
    pub(super) faces_a: PushingFaces,
    /// Cells of B's field in B's frame, and of A's field in A's frame, by increasing face.
    pub(super) of_b: FieldCells,
    pub(super) of_a: FieldCells,
    /// Contacts of the patch.
    pub(super) forces: Vec<CellForce>,
}

/// Cells of one field of a pair, with the faces that push and the workspace for a second cut.
pub(super) struct FoundField<'s> {
    pub cells: &'s FieldCells,
    pub faces: &'s PushingFaces,
    pub overlap: &'s mut Overlap,
}

/// Faces of a side that push, with their numbers among all faces of the side. The edges of its field are counted after them.
#[derive(Debug, Default)]
pub(super) struct PushingFaces {
    pub planes: Vec<HalfSpace>,
    pub numbers: Vec<u32>,
}

impl PushingFaces {
    fn with_capacity(faces: usize) -> Self {
        Self { planes: Vec::with_capacity(faces), numbers: Vec::with_capacity(faces) }
    }

    fn choose(&mut self, side: &Side<'_>, entry: Option<&Vec3>) {
        self.planes.clear();
        self.numbers.clear();
        for (number, facet) in (side.regions.first..).zip(side.regions.facets) {
            self.planes.push(facet.face);
            self.numbers.push(number);
        }
        for (number, face) in (0..).zip(side.faces) {
            if entry.is_none_or(|entry| Entry::pushes(face, entry)) {
                self.planes.push(*face);
                self.numbers.push(number);
            }
        }
        for (number, edge) in (side.faces.len() as u32..).zip(side.edges) {
            if let Some(wall) = entry.and_then(|entry| entry::wall_at(edge, side.faces, entry)) {
                self.planes.push(wall);
                self.numbers.push(number);
            }
        }
    }
}

/// Cells of one field.
#[derive(Debug, Default)]
pub(super) struct FieldCells {
    /// Cells with their moments about `reference_b`.
    pub cells: Vec<Cell>,
    /// Reference point, m, in the frame of the field's owner, the B of the overlap.
    pub reference_b: Vec3,
    /// Number of regions of facets that the other side reaches down to the floor (`height` of [`SolidFacet`](pong_model::SolidFacet)).
    pub floors_reached: u32,
}

impl FieldCells {
    fn with_capacity(faces: usize) -> Self {
        Self { cells: Vec::with_capacity(faces), reference_b: Vec3::zeros(), floors_reached: 0 }
    }

    fn clear(&mut self) {
        self.cells.clear();
        self.floors_reached = 0;
    }

    /// Adds cells with moments about the reference point of `overlap`.
    fn add(&mut self, cells: &[Cell], reference: &Vec3) {
        if self.cells.is_empty() {
            self.reference_b = *reference;
        }
        let from = reference - self.reference_b;
        for cell in cells {
            let moments = cell.moments.about(&from);
            match self.cells.iter_mut().find(|earlier| earlier.face == cell.face) {
                Some(earlier) => {
                    earlier.moments += moments;
                    earlier.least_rate = earlier.least_rate.min(cell.least_rate);
                    earlier.greatest_rate = earlier.greatest_rate.max(cell.greatest_rate);
                }
                None => self.cells.push(Cell { moments, ..*cell }),
            }
        }
    }

    /// Shared volume, m³.
    pub fn volume(&self) -> f64 {
        self.cells.iter().map(|cell| cell.moments.volume).sum()
    }

    /// Moments of the whole shared volume.
    pub fn sum(&self) -> Moments {
        let mut sum = Moments::default();
        self.cells.iter().for_each(|cell| sum += cell.moments);
        sum
    }
}

impl SolidScratch {
    /// Memory for two sides with at most this many facets in a part, and this many faces in a field.
    pub fn with_capacity(facets: usize, faces: usize) -> Self {
        let list = || PushingFaces::with_capacity(faces);
        Self {
            overlap: Overlap::with_capacity(facets + 2 * faces),
            near_facets: Vec::with_capacity(faces),
            faces_b: list(),
            faces_a: list(),
            of_b: FieldCells::with_capacity(faces),
            of_a: FieldCells::with_capacity(faces),
            forces: Vec::with_capacity(2 * faces),
        }
    }

    /// Memory that [`with_capacity`](Self::with_capacity) takes, bytes.
    pub fn bytes(facets: usize, faces: usize) -> usize {
        let per_face = 2 * (size_of::<HalfSpace>() + size_of::<u32>())
            + size_of::<u32>()
            + 2 * size_of::<Cell>()
            + 2 * size_of::<CellForce>();
        Overlap::bytes(facets + 2 * faces) + faces * per_face
    }

    /// Returns true if the last search found a cell.
    pub(super) fn found_any(&self) -> bool {
        !self.of_b.cells.is_empty() || !self.of_a.cells.is_empty()
    }

    /// Returns true if two sides share volume. At least one of them has faces.
    pub(super) fn share_volume(&mut self, relative: &Relative, a: &Side<'_>, b: &Side<'_>) -> bool {
        let x = (&relative.x_ba, &relative.x_ab);
        // A face of either that separates them is found much sooner than the empty volume.
        if are_apart(a, x.0, b) || are_apart(b, x.1, a) {
            return false;
        }
        // One part of a side without a field is compared with the field of the other.
        if !b.faces.is_empty() {
            let field = Field { faces: b.faces, walls: b.walls };
            return a.parts.iter().any(|part| self.overlap.share_volume(&part.surface, x.0, &field));
        }
        let field = Field { faces: a.faces, walls: a.walls };
        b.parts.iter().any(|part| self.overlap.share_volume(&part.surface, x.1, &field))
    }

    /// Cells of the field of A or of B, and the forces found so far.
    pub(super) fn field(&mut self, is_of_a: bool) -> (FoundField<'_>, &mut Vec<CellForce>) {
        let Self { overlap, faces_b, faces_a, of_b, of_a, forces, .. } = self;
        let (cells, faces) = if is_of_a { (&*of_a, &*faces_a) } else { (&*of_b, &*faces_b) };
        (FoundField { cells, faces, overlap }, forces)
    }

    /// Lists the faces of both sides that push.
    pub(super) fn choose_faces(&mut self, (a, b): (&Side<'_>, &Side<'_>), entry: Option<&Entry>) {
        self.faces_b.choose(b, entry.map(|entry| &entry.in_b));
        self.faces_a.choose(a, entry.map(|entry| &entry.in_a));
    }
}

/// Returns true if each part of a side is outside one of the planes of `owner`. `x` transforms from the frame of the
/// side to that of `owner`.
fn are_apart(side: &Side<'_>, x: &Transform, owner: &Side<'_>) -> bool {
    let field = Field { faces: owner.faces, walls: owner.walls };
    !side.parts.is_empty() && side.parts.iter().all(|part| Overlap::apart(&part.surface, x, &field))
}

/// Fields of a pair of sides to be evaluated.
pub(super) struct Cells<'a> {
    pub relative: &'a Relative,
    /// Shares of A's and B's field in the energy.
    pub shares: [f64; 2],
    pub sides: (&'a Side<'a>, &'a Side<'a>),
}

impl Cells<'_> {
    /// Finds the cells of both fields that have a share.
    pub fn find(&self, scratch: &mut SolidScratch) {
        let Self { relative, shares, sides: (a, b) } = *self;
        let SolidScratch { overlap, near_facets, faces_b, faces_a, of_b, of_a, .. } = scratch;
        of_b.clear();
        of_a.clear();
        if shares[1] > 0.0 {
            let search = Search { x: &relative.x_ba, velocity: &relative.a_in_b };
            search.find((overlap, near_facets), (a, b), faces_b, of_b);
        }
        // Against a plane, only the plane's field has a share.
        if shares[0] > 0.0 {
            let search = Search { x: &relative.x_ab, velocity: &relative.b_in_a };
            search.find((overlap, near_facets), (b, a), faces_a, of_a);
        }
        of_b.cells.sort_by_key(|cell| cell.face);
        of_a.cells.sort_by_key(|cell| cell.face);
    }
}

/// Search for the cells of one field.
struct Search<'a> {
    /// Transform from the frame of the other side to that of the field.
    x: &'a Transform,
    /// Velocity of the other side in the frame of the field.
    velocity: &'a Twist,
}

impl Search<'_> {
    /// Finds the cells of the field of `owner` in the parts of `other`.
    fn find(
        &self,
        (overlap, near_facets): (&mut Overlap, &mut Vec<u32>),
        (other, owner): (&Side<'_>, &Side<'_>),
        faces: &PushingFaces,
        found: &mut FieldCells,
    ) {
        for part in other.parts {
            overlap.place(&part.surface, self.x);
            if owner.regions.facets.is_empty() {
                let field = Field { faces: &faces.planes, walls: owner.walls };
                overlap.placed_cells(&field, self.velocity);
                found.add(overlap.found(), &overlap.reference_b());
                continue;
            }
            list_near_facets(overlap, &owner.regions, near_facets);
            if near_facets.len() > 1 && !overlap.cut_placed(&bound_of_regions(&owner.regions, near_facets)) {
                continue;
            }
            for index in near_facets.iter().map(|&index| index as usize) {
                let facet = &owner.regions.facets[index];
                let field = Field { faces: &faces.planes[index..=index], walls: owner.regions.walls(facet) };
                if overlap.placed_apart(&field) {
                    continue;
                }
                overlap.placed_cells(&field, self.velocity);
                if let [cell] = overlap.found() {
                    // The floor cuts off what lies deeper, so the deepest vertex of the cell is then on the floor.
                    found.floors_reached += u32::from(cell.deepest >= FLOOR_REACHED * facet.height);
                    found.add(&[Cell { face: index, ..*cell }], &overlap.reference_b());
                }
            }
        }
    }
}

impl FoundField<'_> {
    /// Moments of the part of a cell inside a half space, about the reference point of the cells. `face` is the face of
    /// the cell, `x` transforms from the frame of `other` to that of `owner`, which has the field.
    pub fn part_inside(
        &mut self,
        face: usize,
        half_space: &HalfSpace,
        (other, owner): (&Side<'_>, &Side<'_>),
        x: &Transform,
    ) -> Moments {
        let Self { cells, faces, overlap } = self;
        let (field, face) = match owner.regions.facets.get(face) {
            Some(facet) => {
                let walls = owner.regions.walls(facet);
                (Field { faces: &faces.planes[face..=face], walls }, 0)
            }
            None => (Field { faces: &faces.planes, walls: owner.walls }, face),
        };
        let mut sum = Moments::default();
        for part in other.parts {
            overlap.place(&part.surface, x);
            if overlap.cut_placed(half_space) {
                let found =
                    overlap.placed_cells(&field, &Twist::zero()).iter().find(|cell| cell.face == face);
                let moments = found.map(|cell| cell.moments);
                let from = overlap.reference_b() - cells.reference_b;
                moments.inspect(|moments| sum += moments.about(&from));
            }
        }
        sum
    }
}

/// Lists the facets whose regions may have volume in common with the placed surface.
fn list_near_facets(overlap: &Overlap, regions: &Regions<'_>, near: &mut Vec<u32>) {
    near.clear();
    let bounds = overlap.placed_bounds();
    for (index, facet) in (0..).zip(regions.facets) {
        let face = Field { faces: &[facet.face], walls: &[] };
        if !facet.bound.is_beside(&bounds) && !overlap.placed_apart(&face) {
            near.push(index);
        }
    }
}

/// Half space around the regions of some facets, along the mean of their normals. The surface of a part is cut by it
/// once, so that little is left to be cut by the planes of each region.
fn bound_of_regions(regions: &Regions<'_>, facets: &[u32]) -> HalfSpace {
    let facets = || facets.iter().map(|&index| &regions.facets[index as usize]);
    let sum: Vec3 = facets().map(|facet| facet.face.normal_b).sum();
    let normal_b = sum / divisor(sum.norm());
    // A region lies below its face and in its box. Along a normal that differs little from that of the face, the
    // first says more.
    let reach = |facet: &SolidFacet| {
        let along_box =
            |direction: &Vec3| direction.dot(&facet.bound.center) + direction.abs().dot(&facet.bound.half);
        let below_face = facet.face.offset + along_box(&(normal_b - facet.face.normal_b));
        below_face.min(along_box(&normal_b))
    };
    HalfSpace { normal_b, offset: facets().map(reach).fold(f64::NEG_INFINITY, f64::max) }
}
