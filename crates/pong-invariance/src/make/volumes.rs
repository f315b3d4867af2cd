//! Scenes of solids that touch by the volume they share: on a plane, on another solid, on a solid cut into
//! pieces, and L-shaped.

use super::solids;
use super::touched::{self, Make};
use crate::random::Random;
use crate::scene::{Normal, Shape, Surface};
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
fn convex(random: &mut Random, is_round: bool) -> Vec<Shape> {
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
