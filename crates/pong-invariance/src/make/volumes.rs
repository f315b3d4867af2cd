//! Scenes of solids that touch by the volume they share: on a plane, on another solid, on a solid cut into
//! pieces, L-shaped, and L-shaped as a mesh.

use super::solids;
use super::touched::{self, Make};
use crate::random::Random;
use crate::scene::{Mesh, Normal, Shape, Surface};
use pong_geometry::Vec3;

/// Common name of all families of solids.
pub const ALL: &str = "volume";

/// Families by name, with the makers of B and of A.
pub const FAMILIES: &[(&str, Make, Make)] = &[
    ("solid_on_plane", touched::plane, convex),
    ("solid_on_solid", one, one),
    ("cut_on_solid", one, touched::pieces),
    ("solid_on_cut", touched::pieces, convex),
    ("l_on_solid", convex, bent),
    ("solid_on_l", bent, convex),
    ("l_on_l", bent, bent),
    ("mesh_on_mesh", bent_mesh, bent_mesh),
];

/// Families in turn.
pub fn family(index: u64) -> &'static str {
    FAMILIES[(index % FAMILIES.len() as u64) as usize].0
}

/// Surface with exponent 1, which solids require.
pub fn linear(surface: Surface) -> Surface {
    let normal = match surface.normal {
        Normal::HuntCrossley { dissipation, .. } => Normal::HuntCrossley { dissipation, exponent: 1.0 },
        Normal::PowerLaw { damping, damping_exponent, .. } => {
            Normal::PowerLaw { damping, exponent: 1.0, damping_exponent }
        }
        law @ Normal::Linear { .. } => law,
    };
    Surface { normal, ..surface }
}

fn one(random: &mut Random, is_round: bool) -> Vec<Shape> {
    touched::solid(random, is_round)
}

/// A convex solid, in one or several pieces.
pub(super) fn convex(random: &mut Random, is_round: bool) -> Vec<Shape> {
    if random.chance(0.7) { one(random, is_round) } else { touched::pieces(random, is_round) }
}

/// An L of three boxes that are joined by internal faces.
fn bent(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let (low, high) = (solids::extents(random, is_round), solids::extents(random, is_round));
    let (x, z) = ([-low.x, 0.0, high.x], [-low.z, 0.0, high.z]);
    let piece = |column: usize, row: usize, inactive: &[usize]| {
        let corner = |step: usize, y: f64| Vec3::new(x[column + step], y, z[row + step]);
        let cuboid = solids::cuboid(&corner(0, -low.y), &corner(1, low.y));
        // Faces in the order −z, +z, −y, +y, −x, +x.
        Shape::Polyhedron(crate::scene::Solid { inactive: inactive.to_vec(), ..cuboid })
    };
    vec![piece(0, 0, &[1, 5]), piece(1, 0, &[4]), piece(0, 1, &[0])]
}

/// An L as a closed mesh that is not divided into convex pieces: each of its facets has a region of its own.
fn bent_mesh(random: &mut Random, is_round: bool) -> Vec<Shape> {
    let (low, high) = (solids::extents(random, is_round), solids::extents(random, is_round));
    vec![l_mesh([-low.x, high.x], [-low.y, low.y], [-low.z, high.z])]
}

/// A closed mesh of an L between these positions along x, y and z. Its inner corner is at x = z = 0.
pub fn l_mesh(x: [f64; 2], y: [f64; 2], z: [f64; 2]) -> Shape {
    let outline = [[x[0], z[0]], [x[1], z[0]], [x[1], 0.0], [0.0, 0.0], [0.0, z[1]], [x[0], z[1]]];
    let ring = |y: f64| outline.map(|[x, z]| Vec3::new(x, y, z));
    let vertices = ring(y[0]).into_iter().chain(ring(y[1])).collect();
    let mut triangles = Vec::new();
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]] {
        triangles.extend([[a, b, c], [a + 6, c + 6, b + 6]]);
    }
    for a in 0..6 {
        let b = (a + 1) % 6;
        triangles.extend([[a, a + 6, b + 6], [a, b + 6, b]]);
    }
    Shape::Mesh(Mesh { vertices, triangles, ..Mesh::default() })
}
