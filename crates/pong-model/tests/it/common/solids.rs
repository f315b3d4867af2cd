//! Solids for tests: an exact convex hull of integers, and shapes of many faces.

use nalgebra::Matrix3;
use pong_geometry::Vec3;

/// Vertices and faces, counter-clockwise seen from outside.
#[derive(Clone)]
pub struct Solid {
    pub vertices: Vec<Vec3>,
    pub faces: Vec<Vec<u32>>,
}

pub type Whole = [i64; 3];

/// Six times the volume of a tetrahedron: positive if `d` is in front of a, b, c. Exact to 2^38.
fn volume([a, b, c, d]: [Whole; 4]) -> i128 {
    let [u, v, w] = [b, c, d].map(|p| [0, 1, 2].map(|k| i128::from(p[k] - a[k])));
    u[0] * (v[1] * w[2] - v[2] * w[1])
        + u[1] * (v[2] * w[0] - v[0] * w[2])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}

fn on_a_line([a, b, c]: [Whole; 3]) -> bool {
    let [u, v] = [b, c].map(|p| [0, 1, 2].map(|k| i128::from(p[k] - a[k])));
    (0..3).all(|k| u[(k + 1) % 3] * v[(k + 2) % 3] == u[(k + 2) % 3] * v[(k + 1) % 3])
}

/// Exact convex hull as triangles; `None` if the points have no volume, or if one lies exactly on the line of
/// an edge where it would make a degenerate triangle.
pub fn hull(points: &[Whole]) -> Option<Vec<[u32; 3]>> {
    let at = |i: u32| points[i as usize];
    let count = points.len() as u32;
    let second = (1..count).find(|&i| at(i) != at(0))?;
    let third = (1..count).find(|&i| !on_a_line([at(0), at(second), at(i)]))?;
    let fourth = (1..count).find(|&i| volume([at(0), at(second), at(third), at(i)]) != 0)?;
    let (a, b, c, d) = match volume([at(0), at(second), at(third), at(fourth)]) > 0 {
        true => (0, third, second, fourth),
        false => (0, second, third, fourth),
    };
    let mut faces = vec![[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
    for point in 0..count {
        if [a, b, c, d].contains(&point) {
            continue;
        }
        let sees = |face: &[u32; 3]| volume([at(face[0]), at(face[1]), at(face[2]), at(point)]) > 0;
        let (seen, kept): (Vec<_>, Vec<_>) = faces.iter().copied().partition(sees);
        if seen.is_empty() {
            continue;
        }
        let edges: std::collections::HashSet<(u32, u32)> =
            seen.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
        let mut horizon: Vec<_> = edges.iter().filter(|(a, b)| !edges.contains(&(*b, *a))).collect();
        horizon.sort();
        if horizon.iter().any(|(a, b)| on_a_line([at(*a), at(*b), at(point)])) {
            return None;
        }
        faces = kept;
        faces.extend(horizon.into_iter().map(|&(a, b)| [a, b, point]));
    }
    Some(faces)
}

impl Solid {
    /// Hull of points rounded to multiples of `grid`, which single precision holds exactly while the
    /// multiples stay below 2^24.
    pub fn hull_of(points: &[Vec3], grid: f64) -> Option<Self> {
        let whole: Vec<Whole> =
            points.iter().map(|p| [p.x, p.y, p.z].map(|x| (x / grid).round() as i64)).collect();
        let faces = hull(&whole)?;
        let vertices = whole.iter().map(|p| Vec3::from(p.map(|x| x as f64 * grid))).collect();
        Some(Self { vertices, faces: faces.iter().map(|f| f.to_vec()).collect() }.without_unused())
    }

    fn without_unused(self) -> Self {
        let mut number = vec![None; self.vertices.len()];
        let mut vertices = Vec::new();
        let mut faces = self.faces;
        for vertex in faces.iter_mut().flatten() {
            let place = self.vertices[*vertex as usize];
            *vertex = *number[*vertex as usize].get_or_insert_with(|| {
                vertices.push(place);
                vertices.len() as u32 - 1
            });
        }
        Self { vertices, faces }
    }

    /// Solid rotated, moved and rounded to single precision.
    pub fn posed(&self, turn: Matrix3<f64>, to: Vec3, size: f64) -> Self {
        let place = |v: &Vec3| (to + turn * v * size).map(|x| f64::from(x as f32));
        Self { vertices: self.vertices.iter().map(place).collect(), faces: self.faces.clone() }
    }

    /// Solid with every face cut into triangles around its first corner.
    pub fn triangulated(&self) -> Self {
        let fan = |f: &Vec<u32>| (1..f.len() - 1).map(|k| vec![f[0], f[k], f[k + 1]]).collect::<Vec<_>>();
        Self { vertices: self.vertices.clone(), faces: self.faces.iter().flat_map(fan).collect() }
    }

    /// Solid as a primitive of a model file.
    pub fn text(&self, name: &str) -> String {
        let vertices: Vec<String> =
            self.vertices.iter().map(|v| format!("({:?},{:?},{:?})", v.x, v.y, v.z)).collect();
        let faces: Vec<String> = self.faces.iter().map(|f| format!("{f:?}")).collect();
        let (vertices, faces) = (vertices.join(","), faces.join(","));
        format!("Polyhedron(name: \"{name}\", vertices: [{vertices}], faces: [{faces}])")
    }

    pub fn diameter(&self) -> f64 {
        let pairs = self.vertices.iter().flat_map(|a| self.vertices.iter().map(move |b| (a - b).norm()));
        pairs.fold(0.0, f64::max)
    }
}

/// Prism of radius 1 with its caps as two polygons.
pub fn prism(sides: u32, height: f64) -> Solid {
    let ring = |z: f64| {
        (0..sides).map(move |k| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(sides);
            Vec3::new(libm::cos(angle), libm::sin(angle), z)
        })
    };
    let mut faces: Vec<Vec<u32>> = vec![(0..sides).rev().collect(), (sides..2 * sides).collect()];
    faces.extend((0..sides).map(|k| {
        let next = (k + 1) % sides;
        vec![k, next, sides + next, sides + k]
    }));
    Solid { vertices: ring(0.0).chain(ring(height)).collect(), faces }
}

/// Sphere of meridians and circles of latitude, with quadrilaterals between them.
pub fn uv_sphere(circles: u32, meridians: u32) -> Solid {
    let mut vertices = vec![Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 1.0)];
    for circle in 1..circles {
        let polar = std::f64::consts::PI * f64::from(circle) / f64::from(circles);
        vertices.extend((0..meridians).map(|k| {
            let turn = std::f64::consts::TAU * f64::from(k) / f64::from(meridians);
            Vec3::new(
                libm::sin(polar) * libm::cos(turn),
                libm::sin(polar) * libm::sin(turn),
                -libm::cos(polar),
            )
        }));
    }
    let at = |circle: u32, k: u32| 2 + (circle - 1) * meridians + k % meridians;
    let mut faces = Vec::new();
    for k in 0..meridians {
        faces.push(vec![0, at(1, k + 1), at(1, k)]);
        faces.push(vec![1, at(circles - 1, k), at(circles - 1, k + 1)]);
        for circle in 1..circles - 1 {
            faces.push(vec![at(circle, k), at(circle, k + 1), at(circle + 1, k + 1), at(circle + 1, k)]);
        }
    }
    Solid { vertices, faces }
}

/// Box with every face cut into `cuts`² squares.
pub fn cut_box(size: Vec3, cuts: u32) -> Solid {
    let mut numbers = std::collections::HashMap::new();
    let mut solid = Solid { vertices: Vec::new(), faces: Vec::new() };
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for high in [false, true] {
            for i in 0..cuts {
                for j in 0..cuts {
                    let mut corner = |a: u32, b: u32| {
                        let mut place = [0_u32; 3];
                        (place[axis], place[u], place[v]) = (if high { cuts } else { 0 }, a, b);
                        *numbers.entry(place).or_insert_with(|| {
                            let [x, y, z] = place.map(|x| f64::from(x) / f64::from(cuts));
                            solid.vertices.push(Vec3::new(x * size.x, y * size.y, z * size.z));
                            solid.vertices.len() as u32 - 1
                        })
                    };
                    let mut face =
                        vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
                    if !high {
                        face.reverse();
                    }
                    solid.faces.push(face);
                }
            }
        }
    }
    solid
}

/// Icosahedron with every triangle cut into `cuts`², its vertices on a sphere.
pub fn geodesic(cuts: u32) -> Solid {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut corners = Vec::new();
    for (a, b) in [(1.0, golden), (1.0, -golden), (-1.0, golden), (-1.0, -golden)] {
        corners.extend([Vec3::new(0.0, a, b), Vec3::new(a, b, 0.0), Vec3::new(b, 0.0, a)]);
    }
    let near = |a: &Vec3, b: &Vec3| ((a - b).norm() - 2.0).abs() < 1e-9;
    let mut numbers = std::collections::HashMap::new();
    let mut solid = Solid { vertices: Vec::new(), faces: Vec::new() };
    for i in 0..12 {
        for j in 0..12 {
            for k in 0..12 {
                let [a, b, c] = [corners[i], corners[j], corners[k]];
                let outward = (b - a).cross(&(c - a)).dot(&a) > 0.0;
                if i < j.min(k) && near(&a, &b) && near(&b, &c) && near(&c, &a) && outward {
                    let mut at = |p: u32, q: u32| {
                        let [p, q] = [p, q].map(|x| f64::from(x) / f64::from(cuts));
                        let place = (a + (b - a) * p + (c - a) * q).normalize();
                        let key = [place.x, place.y, place.z].map(|x| (x * 1e9).round() as i64);
                        *numbers.entry(key).or_insert_with(|| {
                            solid.vertices.push(place);
                            solid.vertices.len() as u32 - 1
                        })
                    };
                    for p in 0..cuts {
                        for q in 0..cuts - p {
                            solid.faces.push(vec![at(p, q), at(p + 1, q), at(p, q + 1)]);
                            if p + q + 1 < cuts {
                                solid.faces.push(vec![at(p + 1, q), at(p + 1, q + 1), at(p, q + 1)]);
                            }
                        }
                    }
                }
            }
        }
    }
    solid
}
