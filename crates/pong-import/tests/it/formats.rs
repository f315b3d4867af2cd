//! One shape from every format, units, axes, and faulty files.

use crate::common::*;
use pong_import::{Options, Up};
use pong_model::Model;
use serde_json::json;
use std::path::{Path, PathBuf};

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
        save("triangles.dae", collada("<up_axis>Z_UP</up_axis>", "", &collada_list("triangles")).as_bytes()),
        save(
            "polylist.dae",
            collada("", "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>", &collada_list("polylist"))
                .as_bytes(),
        ),
        save("polygons.dae", collada("<up_axis>X_UP</up_axis>", "", &collada_list("polygons")).as_bytes()),
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

/// A polygon with a dent keeps its outline: a fan would add two triangles outside of it.
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

fn write(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// A UTF-8 byte order mark is no part of the first line.
#[test]
fn a_mark_of_utf8_costs_no_vertex() {
    let folder = folder("mark");
    let path = write(&folder, "cube.obj", format!("\u{feff}{}", obj(&cube())));
    let (imported, model) = run(&path, &options()).unwrap_or_else(|findings| panic!("{findings}"));
    assert_eq!(imported.vertices, 8);
    assert_eq!(corners(&model), sorted(CUBE.to_vec()));
}

/// A few hundred bytes that declare billions of positions, all but one of them zero.
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
    // A pyramid with its base at the lowest y and its tip at the highest.
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

/// Thousands of nodes of one name are numbered in order.
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

type Triangles = Vec<[Place; 3]>;

fn moved(triangles: &Triangles, by: f64) -> Triangles {
    triangles.iter().map(|triangle| triangle.map(|[x, y, z]| [x + by, y, z])).collect()
}

fn turned(triangle: [Place; 3]) -> [Place; 3] {
    let [a, b, c] = triangle;
    [a, c, b]
}

/// Paths of primitives in a model, without the name of the model.
fn paths(model: &Model) -> Vec<String> {
    let paths = model.bodies[0].primitives.iter().map(|info| info.path.clone());
    paths.map(|path| path.split_once('/').map_or(path.clone(), |(_, rest)| rest.to_owned())).collect()
}

/// Text of several solids, named 0, 1, …
fn solids(parts: &[Triangles]) -> String {
    let solid =
        |(k, part): (usize, &Triangles)| text_stl(part).replace("solid cube", &format!("solid part {k}"));
    parts.iter().enumerate().map(solid).collect()
}

#[test]
fn every_solid_of_a_text_stl_becomes_a_group() {
    let folder = folder("solids");
    let parts = [Vec::new(), cube(), moved(&cube(), 5.0)];
    let (imported, model) = run(&write(&folder, "parts.stl", solids(&parts)), &options()).unwrap();
    assert_eq!((imported.triangles, imported.primitives.as_slice()), (24, &[("Polyhedron", 2)][..]));
    assert_eq!(paths(&model), ["part 1/part 1", "part 2/part 2"]);
    assert_eq!(note_rules(&imported), [""; 0]);
    // A body whose faces are separate solids is one body.
    let sides: Vec<Triangles> = cube().chunks(2).map(<[_]>::to_vec).collect();
    let (imported, model) = run(&write(&folder, "sides.stl", solids(&sides)), &options()).unwrap();
    assert_eq!((imported.vertices, imported.primitives.as_slice()), (8, &[("Polyhedron", 1)][..]));
    assert_eq!(corners(&model), sorted(CUBE.to_vec()));
    assert_eq!(note_rules(&imported), ["solids-joined"]);
}

#[test]
fn damage_of_text_files_is_told_with_its_line() {
    let folder = folder("lines");
    let stl = text_stl(&cube());
    let end = stl.find("endfacet").unwrap() - 14;
    let cases = [
        ("cut.stl", stl[..end].to_owned(), 2),
        ("word.stl", stl.replacen("endloop", "endlop", 1), 7),
        ("index.obj", "v 0 0 0\n\nf 1 2 3\n".to_owned(), 3),
        ("comma.obj", "v 0 0 0\rv 1,5 0 0\r".to_owned(), 2),
        ("index.dae", collada("", "", &collada_list("triangles").replace("<p>0 ", "<p>8 ")), 9),
        ("matrix.dae", collada("", "\n<matrix>1 2 3</matrix>", &collada_list("triangles")), 14),
        (
            "url.dae",
            collada("", "", &collada_list("triangles")).replace("url=\"#cube-mesh", "url=\"#cub"),
            13,
        ),
    ];
    for (name, text, line) in cases {
        let findings = run(&write(&folder, name, text), &options()).unwrap_err();
        assert_eq!(rules(&findings), ["damaged"], "{name}: {findings}");
        assert!(findings.faults[0].path.ends_with(&format!("{name}:{line}")), "{findings}");
    }
    // Without its last line a text file may still be complete.
    let (imported, _) =
        run(&write(&folder, "no_end.stl", stl.replace("endsolid cube\n", "")), &options()).unwrap();
    assert_eq!(note_rules(&imported), ["no-endsolid"]);
}

/// The cube as integers: as they are, or normalized.
#[test]
fn quantized_positions_are_read() {
    let folder = folder("quantized");
    let save = |name: &str, component: u32, normalized: bool, scale: f64, bytes: Vec<u8>, stride: usize| {
        let mut gltf = Gltf::new();
        let mesh = gltf.triangles(&cube());
        gltf.node(None, json!({"mesh": mesh, "scale": [scale, scale, scale]}));
        use base64::Engine;
        let uri = base64::engine::general_purpose::STANDARD.encode(&bytes);
        let count = bytes.len() / stride;
        gltf.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        gltf.json["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
        gltf.json["buffers"] = json!([{"byteLength": bytes.len(), "uri": format!("data:application/octet-stream;base64,{uri}")}]);
        gltf.json["bufferViews"] = json!([{"buffer": 0, "byteLength": bytes.len(), "byteStride": stride}]);
        gltf.json["accessors"] = json!([{"bufferView": 0, "componentType": component, "normalized": normalized,
            "count": count, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}]);
        gltf.json["meshes"] = json!([{"primitives": [{"attributes": {"POSITION": 0}}]}]);
        write(&folder, name, gltf.json.to_string())
    };
    let places = || cube().into_iter().flatten();
    let words = |high: i32, low: i32| -> Vec<u8> {
        let word = |x: f64| (if x > 0.0 { high } else { low } as u16).to_le_bytes();
        places().flat_map(|place| [word(place[0]), word(place[1]), word(place[2]), [0, 0]].concat()).collect()
    };
    let bytes = |high: i8, low: i8| -> Vec<u8> {
        let byte = |x: f64| (if x > 0.0 { high } else { low }) as u8;
        places().flat_map(|place| [byte(place[0]), byte(place[1]), byte(place[2]), 0]).collect()
    };
    // Component types 5120 to 5123: signed and unsigned bytes, signed and unsigned words.
    let files = [
        (save("i16.gltf", 5122, false, 0.001, words(1000, -1000), 8), -1.0),
        (save("i16n.gltf", 5122, true, 1.0, words(32767, -32768), 8), -1.0),
        (save("u16n.gltf", 5123, true, 1.0, words(65535, 0), 8), 0.0),
        (save("i8.gltf", 5120, false, 0.01, bytes(100, -100), 4), -1.0),
        (save("i8n.gltf", 5120, true, 1.0, bytes(127, -128), 4), -1.0),
        (save("u8n.gltf", 5121, true, 1.0, bytes(-1, 0), 4), 0.0),
    ];
    for (path, low) in files {
        let (imported, model) = run(&path, &options()).unwrap_or_else(|findings| panic!("{findings}"));
        assert_eq!(imported.primitives, [("Polyhedron", 1)], "{}", path.display());
        let wanted: Vec<Place> =
            CUBE.iter().map(|place| place.map(|x| if x > 0.0 { 1.0 } else { low })).collect();
        // glTF has y up; the cube from 0 to 1 then reaches from −1 to 0 along y.
        let wanted = wanted.into_iter().map(|[x, y, z]| [x, 0.0 - z, y]).collect();
        assert_eq!(corners(&model), sorted(wanted), "{}", path.display());
    }
    // A third of the largest integer is a third, not the nearest single-precision number.
    let third = save("third.gltf", 5123, true, 1.0, words(65535, 21845), 8);
    assert!(corners(&run(&third, &options()).unwrap().1).iter().flatten().any(|x| *x == 0.333_333_333_333_3));
}

#[test]
fn collada_has_its_unit_axis_and_tree() {
    let folder = folder("collada");
    let at = |name: &str, text: String, options: &Options| {
        let (imported, model) = run(&write(&folder, name, text), options).unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(imported.primitives, [("Polyhedron", 1)], "{name}");
        let all = corners(&model);
        [all[0], all[7]]
    };
    let z_up = "<unit name=\"millimeter\" meter=\"0.001\"/><up_axis>Z_UP</up_axis>";
    let list = collada_list("polylist");
    let shift = "<translate>10 20 30</translate><rotate>0 0 1 90</rotate><scale>1 2 3</scale>";
    assert_eq!(
        at("tree.dae", collada(z_up, shift, &list), &options()),
        [[0.008, 0.019, 0.027], [0.012, 0.021, 0.033]]
    );
    let inches = Options { unit_m: 25.4, ..options() };
    assert_eq!(at("unit.dae", collada(z_up, "", &list), &inches), [[-0.0254; 3], [0.0254; 3]]);
    let y_up = collada("<up_axis>Y_UP</up_axis>", "<translate>1 2 3</translate>", &list);
    assert_eq!(at("y.dae", y_up.clone(), &options()), [[0.0, -4.0, 1.0], [2.0, -2.0, 3.0]]);
    assert_eq!(
        at("z.dae", y_up, &Options { up: Some(Up::Z), ..options() }),
        [[0.0, 1.0, 2.0], [2.0, 3.0, 4.0]]
    );
    let x_up = collada("<up_axis>X_UP</up_axis>", "<translate>1 2 3</translate>", &list);
    assert_eq!(at("x.dae", x_up, &options()), [[-3.0, -4.0, 0.0], [-1.0, -2.0, 2.0]]);
    // A mirror reverses the winding: the solid still faces outwards.
    let mirror = "<matrix>-1 0 0 5  0 1 0 0  0 0 1 0  0 0 0 1</matrix>";
    assert_eq!(at("mirror.dae", collada(z_up, mirror, &list), &options())[0], [0.004, -0.001, -0.001]);
    // Library nodes, instanced a second time through a parent node.
    let twice = collada(z_up, "", &list).replace(
        "</visual_scene>",
        "<node id=\"two\"><translate>9 0 0</translate><instance_node url=\"#part\"/></node></visual_scene>",
    );
    let (imported, model) = run(&write(&folder, "twice.dae", twice), &options()).unwrap();
    assert_eq!(
        (imported.triangles, paths(&model)),
        (24, vec!["part/part".to_owned(), "two/part/part".to_owned()])
    );
    // Without a scene every geometry is read.
    let bare = collada(z_up, "", &list);
    let (from, to) = (bare.find("<library_visual").unwrap(), bare.find("</COLLADA>").unwrap());
    let (imported, _) =
        run(&write(&folder, "bare.dae", format!("{}{}", &bare[..from], &bare[to..])), &options()).unwrap();
    assert_eq!((imported.triangles, note_rules(&imported)), (12, vec!["no-scene"]));
}

#[test]
fn collada_that_cannot_be_read_is_refused() {
    let folder = folder("collada_faults");
    let list = collada_list("polylist");
    let plain = || collada("", "", &list);
    let cases = [
        ("syntax.dae", plain().replace("</mesh>", ""), "damaged"),
        ("root.dae", "<svg/>".to_owned(), "damaged"),
        ("skin.dae", plain().replace("instance_geometry", "instance_controller"), "skin"),
        ("spline.dae", plain().replace("mesh>", "spline>"), "free-form"),
        ("hole.dae", collada("", "", &list.replace("<vcount>", "<ph/><vcount>")), "face-not-cut"),
        ("skew.dae", collada("", "<skew>45 0 1 0 1 0 0</skew>", &list), "damaged"),
        ("count.dae", collada("", "", &list.replace("4 4 4 4 4 4", "4 4 4 4 4 5")), "damaged"),
        ("short.dae", collada("", "", &list.replace("4 4 4 4 4 4", "4 4 4 4 4")), "damaged"),
        ("unit.dae", collada("<unit meter=\"0\"/>", "", &list), "damaged"),
        ("promise.dae", plain().replace("count=\"8\" stride", "count=\"900000000000\" stride"), "damaged"),
        ("empty.dae", plain().replace("<instance_geometry url=\"#cube-mesh\"/>", ""), "empty-mesh"),
        ("itself.dae", collada("", "<instance_node url=\"#part\"/>", &list), "too-deep"),
        ("entity.dae", format!("<!DOCTYPE a [<!ENTITY b \"c\">]>{}", &plain()[39..]), "damaged"),
    ];
    for (name, text, rule) in cases {
        let findings = run(&write(&folder, name, text), &options()).unwrap_err();
        assert_eq!(findings.faults[0].rule, rule, "{name}: {findings}");
        assert!(findings.faults.iter().all(|fault| !fault.cure.is_empty()));
    }
}

/// Short files that instance one mesh many times: by nodes, by primitives of a mesh, by nodes without a mesh.
#[test]
fn copies_beyond_a_limit_are_refused() {
    let folder = folder("copies");
    let few = |triangles_max: usize| Options { triangles_max, ..options() };
    let mut nodes = cube_file();
    (0..999).for_each(|k| _ = nodes.node(None, json!({"mesh": 0, "name": format!("n{k}")})));
    let nodes = nodes.save(&folder, "nodes.glb");
    assert_eq!(run(&nodes, &few(12_400)).unwrap().0.triangles, 12_000);
    let mut primitives = Gltf::new();
    let mesh = primitives.triangles(&torus(1.0, 0.3, 32, 16));
    primitives.node(None, json!({"mesh": mesh}));
    let one = primitives.json["meshes"][0]["primitives"][0].clone();
    primitives.json["meshes"][0]["primitives"] = json!(vec![one; 300]);
    let primitives = primitives.save(&folder, "primitives.glb");
    let list = collada_list("triangles");
    let level = |k: u32| {
        let below = format!("<instance_node url=\"#n{}\"/>", k + 1);
        format!("<node id=\"n{k}\">{below}{below}</node>")
    };
    let library: String = (0..40).map(level).collect();
    let doubled = collada("", "", &list).replace(
        "<library_visual_scenes>",
        &format!("<library_nodes>{library}<node id=\"n40\"><instance_geometry url=\"#cube-mesh\"/></node></library_nodes><library_visual_scenes>"),
    );
    let doubled = doubled.replace(
        "</visual_scene>",
        "<instance_node url=\"#n0\"/><node><instance_node url=\"#n0\"/></node></visual_scene>",
    );
    let doubled = write(&folder, "doubled.dae", doubled);
    for path in [nodes, primitives, doubled] {
        let findings = run(&path, &few(100)).expect_err("refused");
        assert_eq!(rules(&findings), ["too-many-copies"], "{}: {findings}", path.display());
        assert!(findings.faults[0].cure.contains("--triangles-max"), "{findings}");
    }
    // Paths of nodes repeat the names of their ancestors.
    let mut long = Gltf::new();
    let top = long.node(None, json!({"name": "a".repeat(100_000)}));
    (0..800).for_each(|_| _ = long.node(Some(top), json!({"name": "b"})));
    let findings = run(&long.save(&folder, "names.glb"), &options()).expect_err("refused");
    assert_eq!(rules(&findings), ["too-many-copies"], "{findings}");
}

/// The cube with these triangles, in every format.
fn in_all_formats(folder: &Path, triangles: &Triangles) -> Vec<PathBuf> {
    let mut gltf = Gltf::new();
    let mesh = gltf.triangles(triangles);
    gltf.node(None, json!({"name": "cube", "mesh": mesh}));
    let number = |place: &Place| CUBE.iter().position(|corner| corner == place).unwrap().to_string();
    let corners: Vec<String> = triangles.iter().flatten().map(number).collect();
    let inputs = r##"<input semantic="VERTEX" source="#corners" offset="0"/>"##;
    let list = format!("<triangles count=\"12\">{inputs}<p>{}</p></triangles>", corners.join(" "));
    vec![
        write(folder, "cube.stl", binary_stl(triangles)),
        write(folder, "cube.obj", obj(triangles)),
        write(folder, "cube.dae", collada("<up_axis>Z_UP</up_axis>", "", &list)),
        gltf.save(folder, "cube.glb"),
    ]
}

#[test]
fn surfaces_that_face_the_wrong_way_are_told_and_turned_if_asked() {
    let mut one = cube();
    one[4] = turned(one[4]);
    let all: Triangles = cube().into_iter().map(turned).collect();
    for (test, triangles, rule) in [("one_turned", one, "winding"), ("all_turned", all, "inside-out")] {
        for path in in_all_formats(&folder(test), &triangles) {
            let (imported, _) = run(&path, &options()).unwrap();
            let notes = &imported.findings.notes;
            assert_eq!(imported.primitives, [("TriangleMesh", 1)]);
            assert_eq!(notes.iter().filter(|note| note.rule == rule).count(), 1, "{}", imported.findings);
            let expected = [rule, "loader", "not-solid"];
            assert!(notes.iter().all(|note| expected.contains(&note.rule)), "{}", imported.findings);
            let told =
                if rule == "winding" { "1 of 12 triangles run against the others" } else { "8.000e0 m³" };
            assert!(notes[0].cause.contains(told) && notes[0].cure.contains("--outward"), "{}", notes[0]);
            let (imported, model) = run(&path, &Options { outward: true, ..options() }).unwrap();
            assert_eq!(imported.primitives, [("Polyhedron", 1)], "{}", path.display());
            assert_eq!((note_rules(&imported), corners(&model)), (vec!["turned"], sorted(CUBE.to_vec())));
        }
    }
}

#[test]
fn holes_are_closed_if_asked_and_missing_sides_are_not() {
    let folder = folder("holes");
    let closing = Options { close: true, ..options() };
    let run = |name: &str, triangles: &Triangles| run(&write(&folder, name, obj(triangles)), &closing);
    // Two of twelve triangles form a side: 4 m² beside 20 m².
    for missing in [1, 2] {
        let (imported, model) = run("cube.obj", &cube()[..12 - missing].to_vec()).unwrap();
        assert_eq!(imported.primitives, [("Polyhedron", 1)]);
        assert_eq!((note_rules(&imported), corners(&model)), (vec!["closed"], sorted(CUBE.to_vec())));
        let area = if missing == 1 { "2.000e0 m² added" } else { "4.000e0 m² added" };
        assert!(imported.findings.notes[0].cause.contains(area), "{}", imported.findings);
    }
    // The upper end of a square tube is a ring of 8 m², with collinear corners in its outline.
    let wall = |x: i32, y: i32| (x, y) != (1, 1);
    let all: Vec<[i32; 3]> =
        (0..36).map(|k| [k % 3, k / 3 % 3, k / 9]).filter(|&[x, y, _]| wall(x, y)).collect();
    let tube: Triangles =
        blocks(&all, 1.0).into_iter().filter(|t| t.iter().any(|place| place[2] < 4.0)).collect();
    let (imported, _) = run("tube.obj", &tube).unwrap();
    let note = &imported.findings.notes[0];
    assert!(
        note.rule == "closed" && note.cause.starts_with("1 hole closed") && note.cause.contains("8.000e0 m²"),
        "{note}"
    );
    assert!(!imported.findings.notes.iter().any(|note| ["winding", "crowded-edge"].contains(&note.rule)));
    // A sheet, and a cube of five sides lacking a triangle of the sixth: more than a quarter is missing.
    for (name, triangles) in [("sheet.obj", cube()[..2].to_vec()), ("three.obj", cube()[..6].to_vec())] {
        let findings = run(name, &triangles).unwrap_err();
        assert_eq!(rules(&findings), ["not-closed"], "{findings}");
        assert!(findings.faults[0].cause.contains("more than a quarter"), "{findings}");
    }
}

/// Closed meshes and polyhedra become solids; a file with an open mesh keeps `contact: Marked` with a note.
#[test]
fn closed_shapes_become_solids() {
    let folder = folder("contact");
    let cube_text = obj(&cube());
    let path = write(&folder, "cube.obj", &cube_text);
    let (imported, model) = run(&path, &options()).unwrap();
    assert_eq!(note_rules(&imported), [""; 0]);
    assert!(model.bodies[0].solids[0].is_convex());
    let (_, model) = run(&path, &Options { marked: true, ..options() }).unwrap();
    assert!(model.bodies[0].solids.is_empty());
    let text = std::fs::read_to_string(path.with_extension("ron")).unwrap();
    assert!(!text.contains("contact"), "{text}");
    // The last face is missing.
    let open = cube_text.trim_end().rsplit_once('\n').expect("lines").0;
    let (imported, model) = run(&write(&folder, "open.obj", open), &options()).unwrap();
    assert_eq!(note_rules(&imported), ["not-solid"]);
    let note = &imported.findings.notes[0];
    assert!(note.cause.contains("the mesh is open") && !note.path.contains(".open"), "{note}");
    assert!(model.bodies[0].solids.is_empty());
}
