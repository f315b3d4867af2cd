//! The same shape from every format, units, axes, and files that are not what they should be.

mod common;

use common::*;
use pong_import::{Options, Up};
use pong_model::Model;
use serde_json::json;
use std::path::PathBuf;

fn corners(model: &Model) -> Vec<[f64; 3]> {
    let mut corners: Vec<[f64; 3]> =
        model.bodies[0].polyhedra[0].vertices.iter().map(|v| v.position.into()).collect();
    corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
    corners
}

fn sorted(mut places: Vec<[f64; 3]>) -> Vec<[f64; 3]> {
    places.sort_by(|a, b| a.partial_cmp(b).unwrap());
    places
}

fn cube_files(test: &str) -> Vec<PathBuf> {
    let folder = folder(test);
    let save = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let gltf = cube_file();
    let obj: String = CUBE.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect::<String>()
        + "o cube\n"
        + &SIDES
            .iter()
            .map(|side| format!("f {}\n", side.map(|v| (v + 1).to_string()).join(" ")))
            .collect::<String>();
    std::fs::write(folder.join("cube data.bin"), gltf.bytes()).unwrap();
    use base64::Engine;
    let data = base64::engine::general_purpose::STANDARD.encode(gltf.bytes());
    vec![
        save("binary.stl", &binary_stl(&cube())),
        save("text.stl", text_stl(&cube()).as_bytes()),
        save("cube.obj", obj.as_bytes()),
        save("cube.glb", &gltf.glb()),
        save("beside.gltf", gltf.text("cube%20data.bin").as_bytes()),
        save("inline.gltf", gltf.text(&format!("data:application/octet-stream;base64,{data}")).as_bytes()),
    ]
}

#[test]
fn a_cube_is_one_polyhedron_of_six_faces_from_every_format() {
    for path in cube_files("cube") {
        let (imported, model) = run(&path, &options()).unwrap();
        assert_eq!(imported.primitives, [("Polyhedron", 1)], "{}", path.display());
        assert!(imported.findings.notes.is_empty(), "{}", imported.findings);
        assert_eq!(corners(&model), sorted(CUBE.to_vec()));
        let text = std::fs::read_to_string(&imported.files[0]).unwrap();
        let faces = text.split("faces: [").nth(1).unwrap().split("]]").next().unwrap();
        assert_eq!(faces.matches('[').count(), 6, "{text}");
        assert_eq!(faces.matches(',').count(), 6 * 3 + 5, "six faces of four corners: {text}");
    }
}

#[test]
fn the_same_file_gives_the_same_bytes() {
    for path in cube_files("bytes") {
        let write = || {
            run(&path, &options()).unwrap();
            std::fs::read(path.with_extension("ron")).unwrap()
        };
        assert_eq!(write(), write());
    }
}

#[test]
fn units_and_axes_are_those_asked_for() {
    let folder = folder("units");
    let path = folder.join("wedge.stl");
    // Corners at distinct distances along the axes.
    let [o, x, y, z] = [[0.0; 3], [100.0, 0.0, 0.0], [0.0, 200.0, 0.0], [0.0, 0.0, 300.0]];
    std::fs::write(&path, binary_stl(&[[o, y, x], [o, x, z], [o, z, y], [x, y, z]])).unwrap();
    let millimetres = Options { unit_m: 0.001, ..options() };
    let (_, model) = run(&path, &millimetres).unwrap();
    assert_eq!(corners(&model), sorted(vec![[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.2, 0.0], [0.0, 0.0, 0.3]]));
    let (_, model) = run(&path, &Options { up: Some(Up::Y), ..millimetres }).unwrap();
    assert_eq!(corners(&model), sorted(vec![[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.0, 0.2], [0.0, -0.3, 0.0]]));
}

#[test]
fn gltf_has_y_up_unless_told_otherwise() {
    let mut gltf = Gltf::new();
    let mesh = gltf.mesh(0, &[[1.0, 2.0, 3.0]]);
    gltf.node(None, json!({"mesh": mesh, "translation": [10.0, 20.0, 30.0]}));
    let path = gltf.save(&folder("up"), "point.glb");
    let at = |options: &Options| run(&path, options).unwrap().1.bodies[0].points[0].position;
    assert_eq!(<[f64; 3]>::from(at(&options())), [11.0, -33.0, 22.0]);
    assert_eq!(<[f64; 3]>::from(at(&Options { up: Some(Up::Z), ..options() })), [11.0, 22.0, 33.0]);
}

#[test]
fn obj_objects_become_groups_and_loose_elements_points_and_segments() {
    let folder = folder("obj");
    let path = folder.join("parts.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\no sheet\nf 1 2 3 4\no roof\nf 1 2 5\nl 1 2 3 # a chain\np -1\n";
    std::fs::write(&path, text).unwrap();
    let (imported, model) = run(&path, &options()).unwrap();
    assert_eq!(imported.primitives, [("Point", 1), ("LineSegment", 2), ("TriangleMesh", 2)]);
    let paths: Vec<&str> = model.bodies[0].primitives.iter().map(|info| info.path.as_str()).collect();
    for expected in ["parts/sheet/sheet", "parts/roof/roof", "parts/parts/parts"] {
        assert!(paths.contains(&expected), "{paths:?}");
    }
    assert_eq!(model.bodies[0].triangles.triangles.len(), 3);
}

/// A dented n-gon keeps its outline: the two triangles a fan would make outside of it are not there.
#[test]
fn dented_faces_are_cut_within_their_outline() {
    let path = folder("dent").join("dent.obj");
    std::fs::write(&path, "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 2 3 4 5 1\n").unwrap();
    let (_, model) = run(&path, &options()).unwrap();
    let set = &model.bodies[0].triangles;
    let area = |t: &pong_geometry::primitive::TriangleRecord| {
        let [a, b, c] = t.vertices.map(|v| set.vertices[v as usize]);
        0.5 * (b - a).cross(&(c - a)).z
    };
    let areas: Vec<f64> = set.triangles.iter().map(area).collect();
    assert!(areas.iter().all(|area| *area > 0.0), "{areas:?}");
    assert_eq!(areas.iter().sum::<f64>(), 10.0);
}

#[test]
fn damaged_and_strange_files_are_refused_and_nothing_is_written() {
    let folder = folder("damaged");
    let cases: [(&str, Vec<u8>, &str); 15] = [
        ("a.ply", b"ply".to_vec(), "unknown-format"),
        ("empty.stl", binary_stl(&[]), "empty-mesh"),
        ("short.stl", binary_stl(&cube())[..300].to_vec(), "damaged"),
        ("nan.stl", binary_stl(&[[[f64::NAN, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]]), "not-finite"),
        ("far.obj", b"v 0 0 0\nv 1 0 0\nv 0 1e154 0\nf 1 2 3\n".to_vec(), "too-large"),
        (
            "positions.gltf",
            cube_file().text("gone.bin").replace("\"POSITION\":0", "\"POSITION\":6").into_bytes(),
            "damaged",
        ),
        ("empty.obj", b"# nothing\n".to_vec(), "empty-mesh"),
        ("index.obj", b"v 0 0 0\nf 1 2 3\n".to_vec(), "damaged"),
        ("curve.obj", b"v 0 0 0\ncstype bezier\n".to_vec(), "free-form"),
        ("line.obj", b"v 0 0 0\nl 1 7\n".to_vec(), "damaged"),
        ("text.glb", b"glTF\x02\0\0\0".to_vec(), "damaged"),
        ("length.glb", b"glTF\x02\0\0\0\x0b\0\0\0\0\0\0\0JSON".to_vec(), "damaged"),
        ("syntax.gltf", b"{".to_vec(), "damaged"),
        ("old.gltf", br#"{"asset": {"version": "1.0"}}"#.to_vec(), "version"),
        ("gone.gltf", cube_file().text("gone.bin").into_bytes(), "buffer"),
    ];
    for (name, bytes, rule) in cases {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        let findings = run(&path, &options()).unwrap_err();
        assert_eq!(rules(&findings), [rule], "{name}: {findings}");
        assert!(findings.faults.iter().all(|fault| !fault.cure.is_empty()));
    }
    assert_eq!(rules(&run(&folder.join("missing.stl"), &options()).unwrap_err()), ["unreadable"]);
    let left: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left.len(), 15, "{left:?}");
}

#[test]
fn big_meshes_go_to_files_beside_the_model_and_mean_the_same() {
    let folder = folder("mesh_files");
    let path = folder.join("sheet.stl");
    let sheet: Vec<[Place; 3]> = (0..20)
        .map(|k| {
            let (x, z) = (f64::from(k) * 0.1, f64::from(k % 3) * 0.01);
            [[x, 0.0, z], [x + 0.07, 0.0, z], [x, 1.0 / 3.0, z]]
        })
        .collect();
    std::fs::write(&path, binary_stl(&sheet)).unwrap();
    let (_, inline) = run(&path, &options()).unwrap();
    let (imported, beside) = run(&path, &Options { inline_max: 10, ..options() }).unwrap();
    assert_eq!(inline.hash, beside.hash);
    let names: Vec<_> =
        imported.files.iter().map(|file| file.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["sheet.ron", "sheet_sheet.obj"]);
}

fn write(folder: &std::path::Path, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// Some editors put three bytes before UTF-8; they are no part of the first line.
#[test]
fn a_mark_of_utf8_costs_no_vertex() {
    let folder = folder("mark");
    let path = write(&folder, "cube.obj", format!("\u{feff}{}", obj(&cube())));
    let (imported, model) = run(&path, &options()).unwrap_or_else(|findings| panic!("{findings}"));
    assert_eq!(imported.vertices, 8);
    assert_eq!(corners(&model), sorted(CUBE.to_vec()));
}

/// A few hundred bytes that promise billions of positions, all but one of them zero.
#[test]
fn an_accessor_that_no_buffer_holds_is_refused() {
    let folder = folder("promise");
    for count in [4_000_000_000_u64, 1000] {
        let sparse = json!({"count": 1, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}});
        let file = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"componentType": 5126, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1],
                           "count": count, "sparse": sparse}],
            "buffers": [{"byteLength": 36, "uri": format!("data:application/octet-stream;base64,{}", "A".repeat(48))}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
        });
        let findings = run(&write(&folder, "sparse.gltf", file.to_string()), &options()).unwrap_err();
        assert_eq!(rules(&findings), ["damaged"], "{findings}");
        assert!(findings.to_string().contains("36 bytes of buffers"), "{findings}");
    }
}

#[test]
fn nothing_is_read_outside_the_folder_unless_that_is_allowed() {
    let folder = folder("outside");
    let (own, other) = (folder.join("own"), folder.join("other"));
    std::fs::create_dir_all(&own).unwrap();
    std::fs::create_dir_all(&other).unwrap();
    let gltf = cube_file();
    write(&other, "cube.bin", gltf.bytes());
    #[cfg(unix)]
    std::os::unix::fs::symlink(other.join("cube.bin"), own.join("link.bin")).unwrap();
    let absolute = other.join("cube.bin").display().to_string();
    let uris = ["../other/cube.bin", if cfg!(unix) { "link.bin" } else { "../other/cube.bin" }, &absolute];
    for uri in uris {
        let path = write(&own, "cube.gltf", gltf.text(uri));
        let findings = run(&path, &options()).unwrap_err();
        assert_eq!(rules(&findings), ["buffer"], "{uri}: {findings}");
        assert!(findings.to_string().contains("--allow-files-below"), "{uri}: {findings}");
        let allowing = Options { allowed: vec![other.clone()], ..options() };
        assert_eq!(run(&path, &allowing).unwrap().0.vertices, 8, "{uri}");
    }
}

#[test]
fn what_the_file_does_not_tell_is_noted_where_it_looks_wrong() {
    let folder = folder("guesses");
    let scaled = |by: [f64; 3]| -> Vec<[Place; 3]> {
        cube().into_iter().map(|t| t.map(|p| [0, 1, 2].map(|k| p[k] * by[k]))).collect()
    };
    let notes = |name: &str, bytes: &[u8], options: &Options| {
        note_rules(&run(&write(&folder, name, bytes), options).unwrap().0)
    };
    let millimetres = scaled([120.0, 80.0, 40.0]);
    assert_eq!(notes("mm.stl", &binary_stl(&millimetres), &options()), ["unit-assumed"]);
    assert_eq!(notes("mm.stl", &binary_stl(&millimetres), &Options { unit_m: 1e-3, ..options() }), [""; 0]);
    // A pyramid with its foot at the lowest y and its tip at the highest.
    let corner = |x: f64, y: f64, z: f64| [x, y, z];
    let foot = [corner(0.0, 0.0, 0.0), corner(1.0, 0.0, 0.0), corner(1.0, 0.0, 1.0), corner(0.0, 0.0, 1.0)];
    let tip = corner(0.5, 1.0, 0.5);
    let mut pyramid = vec![[foot[0], foot[1], foot[2]], [foot[0], foot[2], foot[3]]];
    pyramid.extend((0..4).map(|k| [foot[(k + 1) % 4], foot[k], tip]));
    for name in ["pyramid.obj", "pyramid.stl"] {
        let bytes = if name.ends_with("obj") { obj(&pyramid).into_bytes() } else { binary_stl(&pyramid) };
        assert_eq!(notes(name, &bytes, &options()), ["up-assumed"], "{name}");
        for up in [Up::Y, Up::Z] {
            assert_eq!(notes(name, &bytes, &Options { up: Some(up), ..options() }), [""; 0], "{name}");
        }
    }
}

/// The corners of the second face are 6.5 mm off their plane: one is lifted by four times that.
#[test]
fn bent_faces_are_told_with_how_far() {
    let folder = folder("bent");
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0.026\nf 1 2 3 4\nf 2 5 6 3\n";
    let (imported, _) = run(&write(&folder, "sheet.obj", text), &options()).unwrap();
    let note = imported.findings.notes.iter().find(|note| note.rule == "bent-face").expect("a note");
    assert!(note.cause.contains("a face is bent") && note.cause.contains("6.50e-3 m"), "{note}");
}

/// Thousands of nodes of one name are numbered one after the other.
#[test]
fn nodes_of_one_name_are_numbered() {
    let folder = folder("one_name");
    let mut gltf = cube_file();
    for _ in 0..3000 {
        gltf.node(None, json!({"mesh": 0, "name": "bolt"}));
    }
    let path = gltf.save(&folder, "bolts.glb");
    let (_, model) = run(&path, &options()).unwrap();
    assert!(model.bodies[0].primitives.iter().any(|info| info.path.contains("bolt_3000")));
}
