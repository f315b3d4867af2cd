//! Models in the notation of model files.

use nalgebra::Vector3;

/// Wraps primitives into a model of one movable group.
pub fn model(name: &str, surfaces: &str, primitives: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"{name}\", surfaces: {{ {surfaces} }},\n\
         root: (name: \"{name}\", surface: \"s\", primitives: [ {primitives} ]))"
    )
}

/// A surface named `s`.
pub fn surface(stiffness: f64, rest: &str) -> String {
    format!("\"s\": (stiffness: {stiffness:?}, {rest})")
}

/// Coordinates of a vector as text.
pub fn place_of(v: &Vector3<f64>) -> String {
    format!("({:?},{:?},{:?})", v.x, v.y, v.z)
}

/// A box about a centre, with vertices mapped by `carry`; `inactive` lists its inactive faces, of −z, +z, −y,
/// +y, −x, +x.
pub fn carried_box(
    name: &str,
    [center, half]: [Vector3<f64>; 2],
    inactive: &str,
    carry: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> String {
    let corner = |i: usize| {
        let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        place_of(&carry(center + half.component_mul(&Vector3::new(sign(0), sign(1), sign(2)))))
    };
    let vertices: Vec<String> = (0..8).map(corner).collect();
    format!(
        "Polyhedron(name: \"{name}\", vertices: [{}], \
         faces: [[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]], inactive_faces: [{inactive}])",
        vertices.join(",")
    )
}

/// A box along the axes, of half extents `half` around `center`.
pub fn box_polyhedron(name: &str, center: [f64; 3], half: [f64; 3], inactive: &str) -> String {
    carried_box(name, [center.into(), half.into()], inactive, |corner| corner)
}

/// A mesh; `more` is text with further fields.
pub fn triangle_mesh(name: &str, vertices: &[Vector3<f64>], triangles: &[[usize; 3]], more: &str) -> String {
    let vertices: Vec<String> = vertices.iter().map(place_of).collect();
    let triangles: Vec<String> = triangles.iter().map(|[a, b, c]| format!("({a},{b},{c})")).collect();
    format!(
        "TriangleMesh(name: \"{name}\", {more} vertices: [{}], triangles: [{}])",
        vertices.join(","),
        triangles.join(",")
    )
}

/// A flat square plate of `n × n` cells, two triangles each, of side `size`, with vertices mapped by `place`.
pub fn plate_mesh(name: &str, n: usize, size: f64, place: impl Fn(f64, f64) -> Vector3<f64>) -> String {
    let step = size / n as f64;
    let mut vertices = Vec::new();
    for j in 0..=n {
        for i in 0..=n {
            vertices.push(place(i as f64 * step - size / 2.0, j as f64 * step - size / 2.0));
        }
    }
    let mut triangles = Vec::new();
    for j in 0..n {
        for i in 0..n {
            let v = j * (n + 1) + i;
            let (a, b, c, d) = (v, v + 1, v + n + 1, v + n + 2);
            if (i + j) % 2 == 0 {
                triangles.extend([[a, b, d], [a, d, c]]);
            } else {
                triangles.extend([[a, b, c], [b, d, c]]);
            }
        }
    }
    triangle_mesh(name, &vertices, &triangles, "")
}

/// A spherical shell of `cells × cells` cells around the origin, 0.1995 m from it, from one angle off its
/// lowest point to another, facing inwards or outwards.
pub fn shell_mesh(cells: usize, from: f64, to: f64, seen_from_within: bool) -> String {
    let place = |x: f64, y: f64| {
        let (up, around) = (from + (to - from) * (y + 0.5), std::f64::consts::TAU * (x + 0.5));
        let out = 0.1995 * libm::sin(up);
        let (a, b) = (out * libm::sin(around), out * libm::cos(around));
        let (x, y) = if seen_from_within { (a, b) } else { (b, a) };
        Vector3::new(x, y, -0.1995 * libm::cos(up))
    };
    plate_mesh("shell", cells, 1.0, place)
}
