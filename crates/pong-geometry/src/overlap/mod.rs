//! Volume that two solids share, divided by the nearest face of one of them (docs/theory.md, 2.11).
//!
//! B is a convex solid: the intersection of half spaces. Its *field* at a point inside is the depth below the
//! nearest of its faces. A is any solid, given by a closed surface of flat polygons in B's frame.
//! [`Overlap::cells`] cuts A by the planes of B and returns the moments of every *cell*: the part of the
//! shared volume nearest to one face. The stored energy, its exact gradient, damping and friction follow from
//! these moments.

mod clip;
mod half_space;
mod moments;
mod planes;

pub use clip::{Cutter, Surface};
pub use half_space::HalfSpace;
pub use moments::Moments;

use crate::{Transform, Twist, Vec3, Wrench};
use clip::Part;
use planes::Planes;

/// Convex solid B, given by its planes.
#[derive(Clone, Copy, Debug)]
pub struct Field<'a> {
    /// Planes of the faces that push. A plane is listed once even if it contains faces of several pieces.
    pub faces: &'a [HalfSpace],
    /// Planes that bound B but do not push: internal faces towards other pieces of the same body.
    pub walls: &'a [HalfSpace],
}

/// Part of the shared volume that is nearest to one face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Index into [`Field::faces`].
    pub face: usize,
    /// Moments about [`Overlap::reference_b`].
    pub moments: Moments,
    /// Least depth rate over the vertices of the cell, m/s; negative where A leaves the face.
    pub least_rate: f64,
    /// Greatest depth rate over the vertices of the cell, m/s.
    pub greatest_rate: f64,
    /// Greatest depth below the face over the vertices of the cell, m.
    pub deepest: f64,
    /// Vertex at that depth, m; of several, the one with the lowest index.
    pub deepest_b: Vec3,
}

impl Cell {
    /// Creates the cell of a face from its surface. `velocity` is that of A relative to B, as a field in B's
    /// frame. Returns `None` if the surface encloses no volume.
    fn new(
        face: usize,
        half_space: &HalfSpace,
        surface: &Surface,
        reference: &Vec3,
        velocity: &Twist,
    ) -> Option<Self> {
        // A reference point far from a thin cell would cost digits, so the moments are taken about a vertex of
        // the cell and shifted.
        let near = surface.vertices().first()?;
        let moments = surface.moments(near).about(&(near - reference));
        if moments.volume <= 0.0 {
            return None;
        }
        let mut cell = Self {
            face,
            moments,
            least_rate: f64::INFINITY,
            greatest_rate: f64::NEG_INFINITY,
            deepest: -1.0,
            deepest_b: Vec3::zeros(),
        };
        // The depth rate at x is rate_at_origin + slope·x.
        let rate_at_origin = -half_space.normal_b.dot(&velocity.linear);
        let slope = velocity.angular.cross(&half_space.normal_b);
        for vertex in surface.vertices() {
            let rate = rate_at_origin + slope.dot(vertex);
            cell.least_rate = cell.least_rate.min(rate);
            cell.greatest_rate = cell.greatest_rate.max(rate);
            let depth = half_space.depth(vertex);
            if depth > cell.deepest {
                (cell.deepest, cell.deepest_b) = (depth, *vertex);
            }
        }
        Some(cell)
    }
}

/// Face that may be the nearest somewhere in the shared volume.
#[derive(Clone, Copy, Debug)]
struct NearFace {
    index: usize,
    /// Least depth below the face over the vertices of the shared volume, m.
    least: f64,
}

/// Workspace for the overlap of two solids, and its result.
#[derive(Clone, Debug, Default)]
pub struct Overlap {
    /// Surface of A in B's frame, its center and its radius about it, m.
    placed: Surface,
    center: Vec3,
    radius: f64,
    shared: Surface,
    cell: Surface,
    cutter: Cutter,
    near_faces: Vec<NearFace>,
    /// Planes that may still cut the shared volume or a cell.
    planes: Planes,
    cells: Vec<Cell>,
    reference_b: Vec3,
}

impl Overlap {
    /// Creates a workspace for solids A and B that have `facets` faces in total.
    pub fn with_capacity(facets: usize) -> Self {
        Self {
            placed: Surface::with_capacity(facets),
            center: Vec3::zeros(),
            radius: 0.0,
            shared: Surface::with_capacity(facets),
            cell: Surface::with_capacity(facets),
            cutter: Cutter::with_capacity(facets),
            near_faces: Vec::with_capacity(facets),
            planes: Planes::with_capacity(facets),
            cells: Vec::with_capacity(facets),
            reference_b: Vec3::zeros(),
        }
    }

    /// Returns the memory that [`with_capacity`](Self::with_capacity) takes, bytes.
    pub fn bytes(facets: usize) -> usize {
        const BYTES_PER_FACET: usize = 3 * Surface::BYTES_PER_FACET
            + Cutter::BYTES_PER_FACET
            + size_of::<NearFace>()
            + Planes::BYTES_PER_FACET
            + size_of::<Cell>();
        facets * BYTES_PER_FACET
    }

    /// Returns the cells of the last call of [`cells`](Self::cells).
    pub fn found(&self) -> &[Cell] {
        &self.cells
    }

    /// Returns the point about which the moments of the last result are taken, m: a vertex of the shared
    /// volume.
    pub fn reference_b(&self) -> Vec3 {
        self.reference_b
    }

    /// Returns the cells of the volume that a closed surface and a convex solid share, by increasing face
    /// index; empty if they share none. `a` is in A's frame, and `x_ba` carries it into B's frame. `velocity`
    /// is that of A relative to B: `linear + angular × x` at the point x of B's frame.
    pub fn cells(&mut self, a: &Surface, x_ba: &Transform, b: &Field<'_>, velocity: &Twist) -> &[Cell] {
        self.place(a, x_ba);
        self.placed_cells(b, velocity)
    }

    /// Places the surface of A for [`placed_cells`](Self::placed_cells): `x_ba` carries it into B's frame.
    pub fn place(&mut self, a: &Surface, x_ba: &Transform) {
        self.placed.copy_moved(a, x_ba);
        (self.center, self.radius) = self.placed.ball();
    }

    /// Returns the least and the greatest coordinates of the vertices of the placed surface, m.
    pub fn placed_bounds(&self) -> (Vec3, Vec3) {
        self.placed.bounds()
    }

    /// Returns `true` if a plane of B has all vertices of the placed surface outside it or on it.
    pub fn placed_apart(&self, b: &Field<'_>) -> bool {
        let outside = |half_space: &HalfSpace| {
            self.placed.vertices().iter().all(|vertex| half_space.depth(vertex) <= 0.0)
        };
        b.faces.iter().chain(b.walls).any(outside)
    }

    /// Cuts the placed surface by a half space of B's frame and keeps the part inside. Returns `false` if this part has
    /// no volume; the placed surface then stays as it is.
    pub fn cut_placed(&mut self, half_space: &HalfSpace) -> bool {
        match self.cutter.cut(&mut self.placed, |x| half_space.depth(x)) {
            Part::Nothing => return false,
            Part::Whole => {}
            Part::Cut => (self.center, self.radius) = self.placed.ball(),
        }
        true
    }

    /// Returns the cells of the volume that the placed surface and a convex solid share, as
    /// [`cells`](Self::cells) does.
    pub fn placed_cells(&mut self, b: &Field<'_>, velocity: &Twist) -> &[Cell] {
        self.cells.clear();
        if !self.cut_shared(b) {
            return &self.cells;
        }
        let Some(reference_b) = self.shared.vertices().first() else { return &self.cells };
        self.reference_b = *reference_b;
        self.find_near_faces(b.faces);
        if let [near] = &self.near_faces[..] {
            let (face, shared) = (&b.faces[near.index], &self.shared);
            self.cells.extend(Cell::new(near.index, face, shared, &self.reference_b, velocity));
            return &self.cells;
        }
        for at in 0..self.near_faces.len() {
            self.push_cell(b.faces, self.near_faces[at], velocity);
        }
        &self.cells
    }

    /// Returns `true` if a closed surface and a convex solid share volume. The arguments are those of
    /// [`Overlap::cells`]. The last result of that function is lost.
    pub fn share_volume(&mut self, a: &Surface, x_ba: &Transform, b: &Field<'_>) -> bool {
        self.cells.clear();
        let inside = |x: &Vec3| b.faces.iter().chain(b.walls).all(|half_space| half_space.depth(x) > 0.0);
        if a.vertices().iter().any(|vertex| inside(&x_ba.point(vertex))) {
            return true;
        }
        self.place(a, x_ba);
        self.cut_shared(b)
            && self.shared.vertices().first().is_some_and(|x| self.shared.moments(x).volume > 0.0)
    }

    /// Returns `true` if a plane of B has all vertices of A outside it or on it, so that they share no
    /// volume. If A is convex too, its planes can be tested by a second call with A and B exchanged.
    pub fn apart(a: &Surface, x_ba: &Transform, b: &Field<'_>) -> bool {
        b.faces.iter().chain(b.walls).any(|half_space| {
            let normal_a = x_ba.rotation.tr_mul(&half_space.normal_b);
            let offset = half_space.depth(&x_ba.translation);
            a.vertices().iter().all(|vertex| offset <= normal_a.dot(vertex))
        })
    }

    /// Cuts the placed surface of A by all planes of B and stores the shared volume. Returns `false` if it is known
    /// to be empty.
    fn cut_shared(&mut self, b: &Field<'_>) -> bool {
        let Self { placed, center, radius, shared, cutter, planes, .. } = self;
        planes.set_center(center);
        b.faces.iter().chain(b.walls).for_each(|half_space| planes.add(half_space));
        match planes.cut_first(cutter, shared, placed, *radius) {
            Part::Nothing => false,
            Part::Whole => {
                shared.copy(placed);
                true
            }
            Part::Cut => {
                let radius = shared.radius_about(center);
                planes.cut(cutter, shared, radius)
            }
        }
    }

    /// Lists the faces that may be the nearest of some point of the shared volume. Each face has a greatest
    /// depth in this volume; the least of these is `bound`. So nowhere is the nearest face deeper than
    /// `bound`, and a face that is deeper everywhere is left out.
    fn find_near_faces(&mut self, faces: &[HalfSpace]) {
        let mut bound = f64::INFINITY;
        self.near_faces.clear();
        for (index, face) in faces.iter().enumerate() {
            let (mut least, mut greatest) = (f64::INFINITY, 0.0);
            for x in self.shared.vertices() {
                let depth = face.depth(x);
                least = if depth < least { depth } else { least };
                greatest = if depth > greatest { depth } else { greatest };
            }
            bound = if greatest < bound { greatest } else { bound };
            if least <= bound {
                self.near_faces.push(NearFace { index, least });
            }
        }
        self.near_faces.retain(|face| face.least <= bound);
    }

    /// Appends the cell of a face, if it has a volume. The cell is cut out of the shared volume by the planes
    /// at which another face is equally near, those nearest to the foot of the cell first.
    fn push_cell(&mut self, faces: &[HalfSpace], near: NearFace, velocity: &Twist) {
        let Self { shared, cell, cutter, near_faces, planes, .. } = self;
        let face = &faces[near.index];
        planes.set_center(&foot(shared, face, near.least));
        for other in near_faces.iter().filter(|other| other.index != near.index) {
            let normal_b = faces[other.index].normal_b - face.normal_b;
            let offset = faces[other.index].offset - face.offset;
            if normal_b != Vec3::zeros() {
                planes.add(&HalfSpace { normal_b, offset });
            } else if offset < 0.0 || (offset == 0.0 && other.index < near.index) {
                // The other face is nearer everywhere. Of two faces in one plane, the face of lower index has
                // the cell.
                return;
            }
        }
        let radius = shared.radius_about(planes.center());
        let surface = match planes.cut_first(cutter, cell, shared, radius) {
            Part::Nothing => return,
            Part::Whole => shared,
            Part::Cut => {
                let radius = cell.radius_about(planes.center());
                if !planes.cut(cutter, cell, radius) {
                    return;
                }
                cell
            }
        };
        self.cells.extend(Cell::new(near.index, face, surface, &self.reference_b, velocity));
    }
}

/// Returns the mean of the vertices that are at the least depth (m) below a face.
fn foot(shared: &Surface, face: &HalfSpace, least: f64) -> Vec3 {
    let low = |x: &&Vec3| face.depth(x) <= least;
    let count = shared.vertices().iter().filter(low).count();
    shared.vertices().iter().filter(low).sum::<Vec3>() / count.max(1) as f64
}

/// Returns energy and wrench of cells for a foundation modulus of 1 N/m³: the energy is `∫ depth dV`, m⁴, and
/// the wrench is its gradient.
///
/// The wrench acts on A, about the origin of the frame (N and N·m per N/m³). The opposite wrench acts on B.
pub fn energy_and_wrench(cells: &[Cell], reference_b: &Vec3, faces: &[HalfSpace]) -> (f64, Wrench) {
    let mut energy = 0.0;
    let mut wrench = Wrench::zero();
    for Cell { face, moments, .. } in cells {
        let face = &faces[*face];
        energy += face.depth(reference_b) * moments.volume - face.normal_b.dot(&moments.first_b);
        wrench.force += face.normal_b * moments.volume;
        wrench.moment += (moments.first_b + reference_b * moments.volume).cross(&face.normal_b);
    }
    (energy, wrench)
}
