//! Meshes from OBJ and STL files.

use crate::common::model_of;
use pong_model::{Extensions, Model, ModelErrors};
use std::fs;
use std::path::PathBuf;

/// Separate folder for each test.
struct Folder(PathBuf);

impl Folder {
    fn new(test: &str) -> Self {
        let path = std::env::temp_dir().join(format!("pong_meshes_{test}_{}", std::process::id()));
        fs::create_dir_all(path.join("sub")).expect("a folder");
        Self(path)
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.0.join(name), bytes).expect("a file");
    }

    fn load(&self, primitive: &str) -> Result<Model, ModelErrors> {
        let path = self.0.join("model.ron");
        fs::write(&path, model_of(primitive)).expect("a file");
        pong_model::load(&path, &Extensions::new())
    }

    fn rule(&self, primitive: &str) -> &'static str {
        let errors = self.load(primitive).expect_err("a fault");
        assert_eq!(errors.0.len(), 1, "{errors}");
        assert_eq!(errors.0[0].line, 3);
        errors.0[0].rule
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// The triangles of a cube, two per side, edge length 2.
fn cube_triangles() -> Vec<[[f32; 3]; 3]> {
    let corner = |i: usize| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.0 } else { 1.0 });
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).map(|t| t.map(corner)).collect()
}

fn binary_stl(triangles: &[[[f32; 3]; 3]], head: &[u8]) -> Vec<u8> {
    let mut bytes = head.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii_stl(triangles: &[[[f32; 3]; 3]]) -> String {
    let mut text = "solid cube\n".to_owned();
    for triangle in triangles {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in triangle {
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid cube\n"
}

const OBJ: &str = "mtllib none.mtl\no cube\nv -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\n\
    v 1 1 1\nvn 0 0 -1\nusemtl none\ns off\nf 1//1 3//1 4//1 2//1\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

#[test]
fn an_stl_cube_is_one_closed_shell_of_welded_vertices() {
    let folder = Folder::new("stl");
    folder.write("cube.stl", &binary_stl(&cube_triangles(), b"made by nobody"));
    folder.write("solid.stl", &binary_stl(&cube_triangles(), b"solid but binary\n"));
    folder.write("sub/ascii.STL", ascii_stl(&cube_triangles()).as_bytes());
    let mut hashes = Vec::new();
    for file in ["cube.stl", "solid.stl", "sub/ascii.STL"] {
        let model = folder.load(&format!("TriangleMesh(name: \"m\", file: \"{file}\", scale: 0.5)")).unwrap();
        let set = &model.bodies[0].triangles;
        assert_eq!(
            (set.vertices.len(), set.triangles.len(), model.bodies[0].shell_count),
            (8, 12, 1),
            "{file}"
        );
        assert!(set.triangles.iter().all(|t| t.neighbors.iter().all(|&n| n < 12)));
        assert!(set.vertices.iter().all(|v| v.amax() == 0.5));
        hashes.push(model.hash);
    }
    assert!(hashes.iter().all(|&hash| hash == hashes[0]));
}

#[test]
fn hulls_from_files_have_their_triangles_merged_into_faces() {
    let folder = Folder::new("hull");
    folder.write("cube.stl", &binary_stl(&cube_triangles(), b""));
    folder.write("cube.obj", OBJ.as_bytes());
    for file in ["cube.stl", "cube.obj"] {
        let model = folder.load(&format!("Polyhedron(name: \"h\", file: \"{file}\", scale: 0.1)")).unwrap();
        let hull = &model.bodies[0].polyhedra[0];
        assert_eq!((hull.faces.len(), hull.edges.len(), hull.vertices.len()), (6, 12, 8), "{file}");
        assert!(hull.vertices.iter().all(|v| v.pushes));
        assert!(model.warnings.is_empty());
    }
}

#[test]
fn inactive_faces_are_counted_as_in_the_file() {
    let folder = Folder::new("inactive");
    folder.write("cube.stl", &binary_stl(&cube_triangles(), b""));
    let model = folder.load("Polyhedron(name: \"h\", file: \"cube.stl\", inactive_faces: [2, 3])").unwrap();
    let hull = &model.bodies[0].polyhedra[0];
    let inactive: Vec<_> = hull.faces.iter().filter(|face| !face.active).collect();
    assert_eq!(inactive.len(), 1);
    assert_eq!(inactive[0].normal.z, 1.0);
    assert_eq!(model.warnings.len(), 1, "{:?}", model.warnings);
    assert!(model.warnings[0].contains("no twin"));
}

#[test]
fn an_obj_mesh_of_triangles_is_read_and_one_of_quads_is_refused() {
    let folder = Folder::new("obj");
    folder.write("t.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf -1 -2 -3\n");
    folder.write("two.obj", b"o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nv 1 1 0\nf 2 4 3\n");
    let one = folder.load("TriangleMesh(name: \"m\", file: \"t.obj\")").unwrap();
    let two = folder.load("TriangleMesh(name: \"m\", file: \"two.obj\")").unwrap();
    for model in [one, two] {
        let set = &model.bodies[0].triangles;
        assert_eq!((set.vertices.len(), set.triangles.len(), model.bodies[0].shell_count), (4, 2, 1));
    }
    folder.write("cube.obj", OBJ.as_bytes());
    let errors = folder.load("TriangleMesh(name: \"m\", file: \"cube.obj\")").expect_err("quads");
    assert!(errors.0.len() == 6 && errors.0.iter().all(|e| e.rule == "not-a-triangle"));
}

/// The keyword of the first line is recognised after a byte order mark.
#[test]
fn a_mark_of_utf8_costs_no_vertex() {
    let folder = Folder::new("mark");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    folder.write("a.obj", text.as_bytes());
    folder.write("b.obj", format!("\u{feff}{text}").as_bytes());
    let mesh = |file: &str| {
        let model = folder.load(&format!("TriangleMesh(name: \"m\", file: \"{file}\")"));
        model.map(|model| model.bodies[0].triangles.vertices.clone()).map_err(|errors| errors.to_string())
    };
    assert_eq!(mesh("b.obj"), mesh("a.obj"));
    assert!(mesh("a.obj").is_ok());
}

/// Links out of the model's folder are followed only into folders that the host allows.
#[cfg(unix)]
#[test]
fn nothing_is_read_outside_the_folder_unless_that_is_allowed() {
    let (own, other) = (Folder::new("own"), Folder::new("other"));
    other.write("sub/a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    std::os::unix::fs::symlink(other.0.join("sub/a.obj"), own.0.join("link.obj")).unwrap();
    std::os::unix::fs::symlink(other.0.join("sub"), own.0.join("linked")).unwrap();
    for file in ["link.obj", "linked/a.obj"] {
        let primitive = format!("TriangleMesh(name: \"m\", file: \"{file}\")");
        assert_eq!(own.rule(&primitive), "mesh-file-outside", "{file}");
        let mut extensions = Extensions::new();
        extensions.allow_files_below(&other.0);
        let model = pong_model::load(&own.0.join("model.ron"), &extensions).unwrap();
        assert_eq!(model.bodies[0].triangles.triangles.len(), 1, "{file}");
    }
}

/// A pipe would block the reader, a device would fill the memory.
#[cfg(unix)]
#[test]
fn a_model_that_is_no_regular_file_is_refused_at_once() {
    for path in ["/dev/zero", "/dev/stdin", "/"] {
        let Ok(about) = fs::metadata(path) else { continue };
        if !about.is_file() {
            let errors = pong_model::load(path.as_ref(), &Extensions::new()).unwrap_err();
            assert!(errors.0[0].rule == "unreadable" && errors.0[0].cause.contains("regular"), "{errors}");
        }
    }
}

#[test]
fn bad_files_are_told() {
    let folder = Folder::new("bad");
    let mesh = |file: &str| folder.rule(&format!("TriangleMesh(name: \"m\", file: \"{file}\")"));
    assert_eq!(mesh("none.stl"), "mesh-file-unreadable");
    // Only regular files: a pipe would block the reader.
    assert_eq!(mesh("."), "mesh-file-unreadable");
    let pipe = std::process::Command::new("mkfifo").arg(folder.0.join("pipe.stl")).status();
    if pipe.is_ok_and(|status| status.success()) {
        assert_eq!(mesh("pipe.stl"), "mesh-file-unreadable");
    }
    folder.write("a.ply", b"ply");
    assert_eq!(mesh("a.ply"), "mesh-file-kind");
    folder.write("cut.stl", &binary_stl(&cube_triangles(), b"")[..300]);
    assert_eq!(mesh("cut.stl"), "mesh-file-damaged");
    let cut = folder.load("TriangleMesh(name: \"m\", file: \"cut.stl\")").expect_err("a fault").to_string();
    assert!(cut.contains("ends before its last triangle"), "{cut}");
    folder.write("cut.obj", b"v 0 0\nf 1 2 3\n");
    assert_eq!(mesh("cut.obj"), "mesh-file-damaged");
    folder.write("beyond.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 9\n");
    assert_eq!(mesh("beyond.obj"), "mesh-file-damaged");
    folder.write("empty.obj", b"# nothing\n");
    assert_eq!(mesh("empty.obj"), "empty-mesh");
    let nan = [[[0.0, 0.0, f32::NAN], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
    folder.write("nan.stl", &binary_stl(&nan, b""));
    assert_eq!(mesh("nan.stl"), "not-finite");
    let scaled = "TriangleMesh(name: \"m\", file: \"nan.stl\", scale: 0)";
    assert_eq!(folder.rule(scaled), "not-positive");
    // A damaged file may have a count without triangles after it.
    let mut lying = binary_stl(&[], b"");
    lying[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    folder.write("lying.stl", &lying);
    assert_eq!(mesh("lying.stl"), "mesh-file-damaged");
}

#[test]
fn every_solid_of_a_text_stl_is_read() {
    let folder = Folder::new("solids");
    let moved = |by: f32| -> Vec<_> {
        cube_triangles().into_iter().map(|t| t.map(|[x, y, z]| [x + by, y, z])).collect()
    };
    let text = format!("SOLID\nEND SOLID\n{}{}", ascii_stl(&cube_triangles()), ascii_stl(&moved(5.0)));
    folder.write("two.stl", text.as_bytes());
    let model = folder.load("TriangleMesh(name: \"m\", file: \"two.stl\")").expect("both solids are read");
    assert_eq!((model.bodies[0].triangles.triangles.len(), model.bodies[0].shell_count), (24, 2));
    let end = text.rfind("endloop").unwrap();
    folder.write("cut.stl", &text.as_bytes()[..end]);
    let errors = folder.load("TriangleMesh(name: \"m\", file: \"cut.stl\")").expect_err("cut");
    let line = text[..end].lines().count() - 4;
    assert!(errors.0[0].cause.contains(&format!("line {line}: it ends within the facet")), "{errors}");
    let end = text.rfind("endsolid").unwrap();
    folder.write("open.stl", &text.as_bytes()[..end]);
    let model = folder.load("TriangleMesh(name: \"m\", file: \"open.stl\")").unwrap();
    assert!(
        model.warnings.iter().any(|warning| warning.contains("without `endsolid`")),
        "{:?}",
        model.warnings
    );
}

#[test]
fn a_file_whose_mesh_faces_inwards_is_told() {
    let folder = Folder::new("inward");
    let turned: Vec<_> = cube_triangles().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    folder.write("in.stl", &binary_stl(&turned, b""));
    folder.write("out.stl", &binary_stl(&cube_triangles(), b""));
    folder.write("open.stl", &binary_stl(&turned[1..], b""));
    let told = |name: &str, more: &str| {
        let mesh = format!("TriangleMesh(name: \"m\", file: \"{name}\"{more})");
        let model = folder.load(&mesh).unwrap();
        model
            .warnings
            .iter()
            .any(|warning| warning.contains("faces inwards") && warning.contains("8.000e0 m³"))
    };
    assert!(told("in.stl", ""));
    assert!(!told("out.stl", "") && !told("open.stl", "") && !told("in.stl", ", two_sided: true"));
}
