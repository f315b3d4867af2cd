//! Load time of a terrain of a million triangles, inline and from STL and OBJ files.
//!
//! `cargo run --release -p pong-model --example load_time [cells along one side] [only this case]`

use pong_model::Extensions;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::time::Instant;

fn main() {
    let side: usize = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(708);
    let folder = std::env::temp_dir().join(format!("pong_load_time_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for the meshes");
    let vertices = vertices(side);
    let triangles = triangles(side);
    write_obj(&folder.join("terrain.obj"), &vertices, &triangles);
    write_stl(&folder.join("terrain.stl"), &vertices, &triangles);
    println!("{} triangles", triangles.len());
    time("STL", &model("file: \"terrain.stl\""), &folder);
    time("OBJ", &model("file: \"terrain.obj\""), &folder);
    time("inline", &model(&inline(&vertices, &triangles)), &folder);
    let bounded =
        |kind: &str| model("file: \"terrain.obj\"").replace("surface:", &format!("bound: {kind}, surface:"));
    time("Sphere", &bounded("Sphere"), &folder);
    time("Obb", &bounded("Obb"), &folder);
    time("single", &singles(&vertices, &triangles), &folder);
    std::fs::remove_dir_all(&folder).expect("the folder is ours");
}

fn time(what: &str, text: &str, folder: &Path) {
    if std::env::args().nth(2).is_some_and(|only| only != what) {
        return;
    }
    let start = Instant::now();
    let model = pong_model::parse(text, "terrain.ron", Some(folder), &Extensions::new());
    let seconds = start.elapsed().as_secs_f64();
    let model = model.expect("the terrain is sound");
    let body = &model.bodies[0];
    println!(
        "{what:>7}: {seconds:.2} s for {:.1} MB of text; {} vertices, {} shells, {} nodes, hash {:016x}, {} warnings",
        text.len() as f64 / 1e6,
        body.triangles.vertices.len(),
        body.shell_count,
        body.tree.nodes.len(),
        model.hash,
        model.warnings.len()
    );
}

fn model(shape: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"terrain\", surfaces: {{ \"soil\": (stiffness: 1e6) }},\n\
         root: (name: \"terrain\", surface: \"soil\", primitives: [TriangleMesh(name: \"grid\", {shape})]))"
    )
}

/// Every triangle as a primitive of its own.
fn singles(vertices: &[[f32; 3]], triangles: &[[usize; 3]]) -> String {
    let mut text = String::new();
    for (index, triangle) in triangles.iter().enumerate() {
        let [a, b, c] = triangle.map(|v| vertices[v]).map(|[x, y, z]| format!("({x}, {y}, {z})"));
        writeln!(text, "Triangle(name: \"t{index}\", vertices: ({a}, {b}, {c})),").expect("memory");
    }
    model("").replace("TriangleMesh(name: \"grid\", )", &text)
}

fn vertices(side: usize) -> Vec<[f32; 3]> {
    let height = |i: usize, j: usize| ((i * 7919 + j * 104_729) % 1000) as f32 * 1e-4;
    let row = |j: usize| (0..=side).map(move |i| [i as f32 * 0.1, j as f32 * 0.1, height(i, j)]);
    (0..=side).flat_map(row).collect()
}

fn triangles(side: usize) -> Vec<[usize; 3]> {
    let cell = |i: usize, j: usize| {
        let corner = j * (side + 1) + i;
        let above = corner + side + 1;
        [[corner, corner + 1, above + 1], [corner, above + 1, above]]
    };
    (0..side).flat_map(|j| (0..side).flat_map(move |i| cell(i, j))).collect()
}

fn inline(vertices: &[[f32; 3]], triangles: &[[usize; 3]]) -> String {
    let mut text = String::from("vertices: [");
    for [x, y, z] in vertices {
        writeln!(text, "({x}, {y}, {z}),").expect("memory");
    }
    text.push_str("], triangles: [");
    for [a, b, c] in triangles {
        writeln!(text, "({a}, {b}, {c}),").expect("memory");
    }
    text.push(']');
    text
}

fn write_obj(path: &Path, vertices: &[[f32; 3]], triangles: &[[usize; 3]]) {
    let mut text = String::new();
    for [x, y, z] in vertices {
        writeln!(text, "v {x} {y} {z}").expect("memory");
    }
    for [a, b, c] in triangles {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).expect("memory");
    }
    std::fs::write(path, text).expect("a writable folder");
}

fn write_stl(path: &Path, vertices: &[[f32; 3]], triangles: &[[usize; 3]]) {
    let mut file = std::io::BufWriter::new(std::fs::File::create(path).expect("a writable folder"));
    let mut bytes = vec![0_u8; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        let corners = triangle.iter().flat_map(|&v| vertices[v]);
        bytes.extend(corners.flat_map(f32::to_le_bytes));
        bytes.extend([0; 2]);
    }
    file.write_all(&bytes).expect("room for the mesh");
}
