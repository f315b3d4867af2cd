//! Families of random convex solids: typical output of exporters, and hard cases.

use super::solids::{Solid, geodesic, prism, uv_sphere};
use pong_geometry::Vec3;
use pong_testkit::Random;

/// Family of solids of about unit size around the origin, before they are rotated, moved and rounded.
pub struct Family {
    pub name: &'static str,
    /// Creates a random solid; `None` if these numbers make none.
    pub make: fn(&mut Random) -> Option<Solid>,
    /// Number of solids relative to other families; smaller for solids of many faces.
    pub share: f64,
}

pub const FAMILIES: [Family; 9] = [
    Family { name: "chamfered boxes", make: |random| Some(chamfered_box(random)), share: 1.0 },
    Family { name: "hulls of chamfered boxes", make: hull_of_chamfers, share: 1.0 },
    Family { name: "prisms", make: |random| Some(prism_of(random, 60)), share: 1.0 },
    Family { name: "frusta", make: |random| Some(frustum(random, 60)), share: 1.0 },
    Family { name: "thin wedges", make: |random| Some(wedge(random)), share: 1.0 },
    Family { name: "shallow caps", make: cap, share: 0.3 },
    Family { name: "balls", make: |random| Some(ball(random)), share: 0.1 },
    Family { name: "prisms of many sides", make: |random| Some(prism_of(random, 5000)), share: 0.01 },
    Family { name: "frusta of many sides", make: |random| Some(frustum(random, 5000)), share: 0.01 },
];

/// Box with a chamfer along every edge, from below the tolerance to a quarter of its size; its faces are
/// polygons.
fn chamfered_box(random: &mut Random) -> Solid {
    let half = Vec3::new(1.0, random.log_between(0.02, 1.0), random.log_between(0.02, 1.0));
    let chamfer = random.log_between(3e-7, 0.5) * half.min();
    // Each vertex is at a corner (a bit for each axis), in the face perpendicular to one axis.
    let at = |corner: usize, axis: usize| (3 * corner + axis) as u32;
    let vertices = (0..24)
        .map(|number| {
            let (corner, axis) = (number / 3, number % 3);
            Vec3::from([0, 1, 2].map(|k| {
                let size = if k == axis { half[k] } else { half[k] - chamfer };
                if corner >> k & 1 == 1 { size } else { -size }
            }))
        })
        .collect();
    let mut faces: Vec<Vec<u32>> =
        (0..8).map(|corner| (0..3).map(|axis| at(corner, axis)).collect()).collect();
    for axis in 0..3 {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in 0..4 {
            let (low, high) = (side & 1, side >> 1);
            let corner =
                |along: usize, i_high: usize, j_high: usize| along << axis | i_high << i | j_high << j;
            let (first, second) = (corner(0, low, high), corner(1, low, high));
            faces.push(vec![at(first, i), at(first, j), at(second, j), at(second, i)]);
        }
        for high in 0..2 {
            let around = [(0, 0), (1, 0), (1, 1), (0, 1)];
            faces.push(around.map(|(a, b)| at(high << axis | a << i | b << j, axis)).to_vec());
        }
    }
    let solid = Solid { vertices, faces }.outward();
    if random.chance(0.7) { solid.cut(random) } else { solid }
}

/// Exact hull of points along chamfers of about ten times the tolerance.
fn hull_of_chamfers(random: &mut Random) -> Option<Solid> {
    let (wide, count) = (random.log_between(2e-6, 1e-4), 8 + random.below(80));
    let place = |random: &mut Random| {
        let chamfer = random.direction().abs() * random.between(0.0, wide);
        (Vec3::new(1.0, 1.0, 1.0) - chamfer).map(|x| if random.chance(0.5) { -x } else { x })
    };
    let places: Vec<Vec3> = (0..count).map(|_| place(random)).collect();
    Solid::hull_of(&places, 2.0_f64.powi(-22))
}

fn sides(random: &mut Random, most: u32) -> u32 {
    random.log_between(3.0, f64::from(most + 1)) as u32
}

fn prism_of(random: &mut Random, most: u32) -> Solid {
    prism(sides(random, most), random.log_between(1e-4, 1e3)).cut(random)
}

/// Prism whose second cap is smaller, down to a thousandth.
fn frustum(random: &mut Random, most: u32) -> Solid {
    let height = random.log_between(1e-3, 30.0);
    let mut solid = prism(sides(random, most), height);
    let ring = solid.vertices.len() / 2;
    let narrow =
        if random.chance(0.3) { 1.0 - random.log_between(1e-6, 0.1) } else { random.log_between(1e-3, 1.0) };
    for vertex in &mut solid.vertices[ring..] {
        (vertex.x, vertex.y) = (vertex.x * narrow, vertex.y * narrow);
    }
    solid.cut(random)
}

/// Wedge with an angle down to the tolerance.
fn wedge(random: &mut Random) -> Solid {
    let mut solid = prism(3, random.log_between(1e-3, 10.0));
    let tip = Vec3::new(random.between(0.0, 1.0), random.log_between(1e-5, 0.3), 0.0);
    for (number, vertex) in solid.vertices.iter_mut().enumerate() {
        let height = vertex.z;
        *vertex = [Vec3::zeros(), Vec3::x(), tip][number % 3] + Vec3::z() * height;
    }
    // The second cap is not quite perpendicular.
    let slant = random.between(-0.5, 0.5);
    solid.vertices[3..].iter_mut().for_each(|v| v.z *= 1.0 + slant * v.x);
    solid.cut(random)
}

/// Hull of points on a shallow cap.
fn cap(random: &mut Random) -> Option<Solid> {
    let height = random.log_between(5e-6, 0.3);
    let place = |random: &mut Random| {
        let (radius, angle) = (0.7 * random.unit().sqrt(), random.between(0.0, std::f64::consts::TAU));
        Vec3::new(
            radius * libm::cos(angle),
            radius * libm::sin(angle),
            height * (1.0 - (radius / 0.7).powi(2)),
        )
    };
    let places: Vec<Vec3> = (0..60).map(|_| place(random)).collect();
    Solid::hull_of(&places, 2.0_f64.powi(-24))
}

/// Ellipsoid of triangles of one size, or of circles and meridians.
fn ball(random: &mut Random) -> Solid {
    let mut solid = match random.chance(0.5) {
        true => geodesic(1 + random.below(12) as u32),
        false => uv_sphere(3 + random.below(40) as u32, 3 + random.below(80) as u32).cut(random),
    };
    let axes = Vec3::new(1.0, random.log_between(1e-3, 1.0), random.log_between(1e-3, 1.0));
    solid.vertices.iter_mut().for_each(|v| *v = v.component_mul(&axes));
    solid
}

impl Solid {
    /// Solid with every face counter-clockwise seen from outside; the origin is inside.
    fn outward(mut self) -> Self {
        for face in &mut self.faces {
            let [a, b, c] = [0, 1, 2].map(|k| self.vertices[face[k] as usize]);
            if (b - a).cross(&(c - a)).dot(&a) < 0.0 {
                face.reverse();
            }
        }
        self
    }

    /// Solid with every face cut into triangles: a fan around any corner, a strip, or ear by ear in any
    /// order.
    fn cut(&self, random: &mut Random) -> Self {
        let how = random.below(4);
        if how == 3 {
            return self.clone();
        }
        let mut faces = Vec::new();
        for face in &self.faces {
            let mut rest = face.clone();
            rest.rotate_left(random.below(face.len()));
            let mut ear = 0;
            while rest.len() > 3 {
                let count = rest.len();
                ear = match how {
                    0 => 1,
                    // From both ends in turn.
                    1 => {
                        if ear == 1 {
                            count - 1
                        } else {
                            1
                        }
                    }
                    _ => random.below(count),
                };
                faces.push(vec![rest[(ear + count - 1) % count], rest[ear], rest[(ear + 1) % count]]);
                rest.remove(ear);
            }
            faces.push(rest);
        }
        Self { vertices: self.vertices.clone(), faces }
    }
}
