//! Meshes made by code, as triangles with vertices counter-clockwise seen from outside.

/// A position, m.
pub type Place = [f64; 3];

/// Vertices of the cube from −1 to 1.
pub const CUBE: [Place; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [-1.0, 1.0, 1.0],
    [1.0, 1.0, 1.0],
];
/// Sides of the cube, outwards: indices of vertices.
pub const SIDES: [[usize; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [1, 3, 7, 5], [0, 4, 6, 2]];

/// The cube as triangles.
pub fn cube() -> Vec<[Place; 3]> {
    let cut = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    SIDES.into_iter().flat_map(cut).map(|triangle| triangle.map(|corner| CUBE[corner])).collect()
}

/// The surface of a set of unit cubes, scaled: triangles outwards, without the faces between cubes.
pub fn blocks(cubes: &[[i32; 3]], edge: f64) -> Vec<[Place; 3]> {
    let mut triangles = Vec::new();
    for cube in cubes {
        for side in SIDES {
            let corner =
                |vertex: usize| [0, 1, 2].map(|axis| cube[axis] + i32::from(CUBE[vertex][axis] > 0.0));
            let beyond = |axis: usize| {
                let twice: i32 = side.iter().map(|&vertex| corner(vertex)[axis]).sum::<i32>() / 2;
                cube[axis] + (twice - 2 * cube[axis] - 1)
            };
            if !cubes.contains(&[0, 1, 2].map(beyond)) {
                let places = side.map(|vertex| corner(vertex).map(|x| f64::from(x) * edge));
                triangles.extend([[0, 1, 2], [0, 2, 3]].map(|cut| cut.map(|k| places[k])));
            }
        }
    }
    triangles
}

/// An L: an outline of six corners in x and z, from −0.08 m to 0.08 m along y. Its arm is 0.06 m thick.
pub fn l_shape() -> Vec<[Place; 3]> {
    let outline = [[-0.1, -0.06], [0.1, -0.06], [0.1, 0.0], [0.0, 0.0], [0.0, 0.06], [-0.1, 0.06]];
    let place = |corner: usize, y: f64| [outline[corner][0], y, outline[corner][1]];
    let mut triangles = Vec::new();
    for [a, b, c] in [[0, 1, 2], [0, 2, 3], [0, 3, 5], [3, 4, 5]] {
        triangles.push([a, b, c].map(|corner| place(corner, -0.08)));
        triangles.push([a, c, b].map(|corner| place(corner, 0.08)));
    }
    for a in 0..6 {
        let b = (a + 1) % 6;
        triangles.push([place(a, -0.08), place(a, 0.08), place(b, 0.08)]);
        triangles.push([place(a, -0.08), place(b, 0.08), place(b, -0.08)]);
    }
    triangles
}

/// A torus around z: rings of `sides` vertices.
pub fn torus(radius: f64, thickness: f64, rings: usize, sides: usize) -> Vec<[Place; 3]> {
    let angle = |k: usize, of: usize| std::f64::consts::TAU * (k % of) as f64 / of as f64;
    let place = |ring: usize, side: usize| {
        let (across, around) = (angle(side, sides), angle(ring, rings));
        let out = radius + thickness * across.cos();
        [out * around.cos(), out * around.sin(), thickness * across.sin()]
    };
    let quads = (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side)));
    let cut = |(i, j): (usize, usize)| {
        let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    quads.flat_map(cut).collect()
}

/// An OBJ file of triangles, with all digits; equal positions become one vertex.
pub fn obj(triangles: &[[Place; 3]]) -> String {
    let mut places: Vec<Place> = Vec::new();
    let mut faces = String::new();
    for triangle in triangles {
        faces.push('f');
        for corner in triangle {
            let found = places.iter().position(|place| place == corner);
            let number = found.unwrap_or_else(|| (places.push(*corner), places.len() - 1).1);
            faces += &format!(" {}", number + 1);
        }
        faces.push('\n');
    }
    places.iter().map(|[x, y, z]| format!("v {x:?} {y:?} {z:?}\n")).collect::<String>() + &faces
}
