//! Comparison of a loaded solid with the solid that was written.

use super::solids::Solid;
use pong_geometry::Vec3;
use pong_geometry::primitive::Polyhedron;
use pong_model::Extensions;

/// Tolerance of docs/model_format.md, in diameters.
pub const TOLERANCE: f64 = 1e-6;
/// Difference of heights between loader and test, which round in different orders, relative to the diameter
/// and to the distance from the origin.
const ROUNDING: f64 = 1e-14;

/// Loads a solid; on refusal returns the message.
pub fn load(solid: &Solid) -> Result<Polyhedron, String> {
    let text = super::model_of(&solid.text("solid"));
    let mut model = pong_model::parse(&text, "t.ron", None, &Extensions::new()).map_err(|e| e.to_string())?;
    Ok(model.bodies[0].polyhedra.remove(0))
}

/// Loads a solid and compares it with the original.
pub fn holds(solid: &Solid, what: &str) -> Polyhedron {
    let loaded = load(solid).unwrap_or_else(|told| panic!("{what}: {told}\n{}", brief(solid)));
    if let Err(told) = is_held(solid, &loaded) {
        panic!("{what}: {told}\n{}", brief(solid));
    }
    loaded
}

/// Compares a loaded solid with the original: no vertex is farther than the tolerance in front of a face,
/// none is deeper below the surface, and no vertex of a face is farther from its plane or beyond one of its
/// lateral planes.
pub fn is_held(solid: &Solid, loaded: &Polyhedron) -> Result<(), String> {
    let far = solid.vertices.iter().map(Vec3::amax).fold(0.0, f64::max);
    let most = TOLERANCE * loaded.diameter + ROUNDING * (loaded.diameter + far);
    let fault = |what: &str, off: f64| Err(format!("{what}: {:e} of the diameter", off / loaded.diameter));
    for vertex in &solid.vertices {
        let height = loaded.faces.iter().map(|f| f.normal.dot(vertex) - f.offset).fold(f64::MIN, f64::max);
        if height.is_nan() || height.abs() > most {
            return fault("a vertex has left the surface", height);
        }
    }
    for (index, face) in loaded.faces.iter().enumerate() {
        if face.rim_count < 3 || (face.normal.norm() - 1.0).abs() > 1e-12 {
            return Err(format!("face {index} is none"));
        }
        let place = |start: u32| loaded.vertices[start as usize].position;
        let rims = loaded.rim(index);
        for corner in rims.iter().map(|rim| place(rim.start)) {
            let off = face.normal.dot(&corner) - face.offset;
            if off.abs() > most {
                return fault("a corner is off the plane of its face", off);
            }
            // Only some of a cap's many lateral planes are tested.
            let walls = rims.iter().step_by(1 + rims.len() / 100);
            let beyond = walls.map(|wall| wall.outward.dot(&(corner - wall.anchor))).fold(0.0, f64::max);
            if beyond > most {
                return fault("a corner is beyond a wall of its face", beyond);
            }
        }
    }
    is_closed(loaded)
}

/// Checks that every edge has two faces, which run along it in opposite directions, and that the numbers of
/// vertices, edges and faces satisfy Euler's formula.
fn is_closed(loaded: &Polyhedron) -> Result<(), String> {
    let mut runs = vec![[0, 0]; loaded.edges.len()];
    for (index, _) in loaded.faces.iter().enumerate() {
        for rim in loaded.rim(index) {
            let forward = loaded.edges[rim.edge as usize].vertices[0] == rim.start;
            runs[rim.edge as usize][usize::from(forward)] += 1;
        }
    }
    if let Some(edge) = runs.iter().position(|run| *run != [1, 1]) {
        return Err(format!("edge {edge} is run along {:?} times", runs[edge]));
    }
    let euler = loaded.vertices.len() + loaded.faces.len() - loaded.edges.len();
    if euler == 2 { Ok(()) } else { Err(format!("vertices − edges + faces are {euler}, not 2")) }
}

/// Loaded solid in the form in which it would be written.
pub fn written(loaded: &Polyhedron) -> Solid {
    let outline = |face| loaded.rim(face).iter().map(|rim| rim.start).collect();
    Solid {
        vertices: loaded.vertices.iter().map(|vertex| vertex.position).collect(),
        faces: (0..loaded.faces.len()).map(outline).collect(),
    }
}

/// Least distance from a face's plane to the vertex farthest behind it, over the faces with reliable planes.
pub fn thickness(solid: &Solid) -> f64 {
    let plane = |face: &Vec<u32>| {
        let [a, b, c] = [0, 1, 2].map(|k| solid.vertices[face[k] as usize]);
        let area = (b - a).cross(&(c - a));
        (area.norm(), area.normalize(), a)
    };
    let behind = |(_, normal, on): (f64, Vec3, Vec3)| {
        solid.vertices.iter().map(|v| normal.dot(&(on - v))).fold(0.0, f64::max)
    };
    let largest = solid.faces.iter().map(|f| plane(f).0).fold(0.0, f64::max);
    let sure = solid.faces.iter().map(plane).filter(|(area, ..)| *area > 1e-3 * largest);
    sure.map(behind).fold(f64::INFINITY, f64::min)
}

/// Prints small solids, so that a failure can be analysed by hand.
pub fn brief(solid: &Solid) -> String {
    if solid.vertices.len() <= 20 {
        solid.text("solid")
    } else {
        format!("{} vertices", solid.vertices.len())
    }
}
