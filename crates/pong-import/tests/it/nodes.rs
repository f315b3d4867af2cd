//! Trees of nodes: transforms, marks, and content that cannot be imported faithfully.

use crate::common::*;
use pong_import::Options;
use pong_testkit::Random;
use serde_json::{Value, json};

/// `rotate(v)` by the quaternion (x, y, z, w), from its definition q·v·q̄.
fn rotated([x, y, z, w]: [f64; 4], v: [f64; 3]) -> [f64; 3] {
    let n = x * x + y * y + z * z + w * w;
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let inner = cross([x, y, z], v);
    let outer = cross([x, y, z], inner);
    [0, 1, 2].map(|k| v[k] + 2.0 * (w * inner[k] + outer[k]) / n)
}

#[test]
fn a_cube_below_any_chain_of_transforms_has_the_corners_that_their_product_gives() {
    let folder = folder("property");
    let mut random = Random(7);
    for case in 0..60 {
        let mut gltf = Gltf::new();
        let mesh = gltf.triangles(&cube());
        let mut chain = Vec::new();
        let mut parent = None;
        for depth in 0..=case % 4 {
            let (translation, scale) = (
                <[f64; 3]>::from(random.vector(1.0)).map(|x| 3.0 * x),
                <[f64; 3]>::from(random.vector(1.0)).map(|x| if x < 0.0 { x - 0.3 } else { x + 0.3 }),
            );
            let rotation = [0; 4].map(|_| random.between(-1.0, 1.0));
            let mut node = json!({"name": format!("n{depth}"), "translation": translation, "rotation": rotation, "scale": scale});
            if depth == case % 4 {
                node["mesh"] = json!(mesh);
            }
            parent = Some(gltf.node(parent, node));
            chain.push((translation, rotation, scale));
        }
        let path = gltf.save(&folder, &format!("cube{case}.glb"));
        let (imported, model) = run(&path, &options()).unwrap();
        assert_eq!(imported.primitives, [("Polyhedron", 1)]);
        let to_top = |corner: [f64; 3]| {
            chain.iter().rev().fold(corner, |v, (translation, rotation, scale)| {
                let turned = rotated(*rotation, [0, 1, 2].map(|k| scale[k] * v[k]));
                [0, 1, 2].map(|k| turned[k] + translation[k])
            })
        };
        let solid = &model.bodies[0].polyhedra[0];
        assert_eq!((solid.vertices.len(), solid.faces.len()), (8, 6));
        for corner in CUBE.map(to_top).map(|[x, y, z]| [x, -z, y]) {
            let nearest =
                solid.vertices.iter().map(|v| (v.position - pong_geometry::Vec3::from(corner)).norm());
            assert!(nearest.fold(f64::INFINITY, f64::min) < 2e-12, "case {case}");
        }
    }
}

#[test]
fn without_marks_every_node_becomes_a_group() {
    let mut gltf = Gltf::new();
    let cube = gltf.triangles(&cube());
    let sheet = gltf.triangles(&[[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]]);
    let lines = gltf.mesh(3, &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]);
    let top = gltf.node(None, json!({"name": "top", "mesh": sheet}));
    gltf.node(Some(top), json!({"name": "block", "mesh": cube}));
    gltf.node(Some(top), json!({"name": "block", "mesh": cube, "translation": [5.0, 0.0, 0.0]}));
    gltf.node(None, json!({"name": "a/b", "mesh": lines}));
    gltf.node(None, json!({"name": "lamp"}));
    let path = gltf.save(&folder("default"), "scene.glb");
    let (imported, model) = run(&path, &options()).unwrap();
    let paths: Vec<&str> = model.bodies[0].primitives.iter().map(|info| info.path.as_str()).collect();
    let expected = [
        "scene/top/top_own/top",
        "scene/top/block/block",
        "scene/top/block_2/block",
        "scene/a_b/a_b_0",
        "scene/a_b/a_b_1",
    ];
    assert_eq!(paths, expected);
    assert_eq!(note_rules(&imported), ["renamed", "renamed", "not-solid"]);
    assert_eq!(imported.primitives, [("LineSegment", 2), ("TriangleMesh", 1), ("Polyhedron", 2)]);
}

fn marked(mark: Value) -> Value {
    json!({"pong": mark})
}

#[test]
fn marks_make_the_model() {
    let mut gltf = Gltf::new();
    gltf.json["scenes"][0]["extras"] = marked(json!({
        "name": "gripper", "entry_memory": false,
        "surfaces": {
            "steel": {"stiffness": 1e6, "normal": {"Linear": {"damping": 250.0}}, "friction": {"Bristle": {"mu": 0.2}}},
            "granite": {"stiffness": "inf"},
        },
        "pairs": [{"surfaces": ["steel", "steel"], "friction": {"None": {}}}],
        "filters": [["arm", "fixed"]],
    }));
    gltf.json["materials"] = json!([{}, {"extras": {"pong": {"inactive": true}}}]);
    let half = |sides: &[usize]| -> Vec<Place> {
        let cut = |[a, b, c, d]: [usize; 4]| [a, b, c, a, c, d];
        sides.iter().flat_map(|side| cut(SIDES[*side])).map(|corner| CUBE[corner]).collect()
    };
    let five = gltf.positions(&half(&[0, 1, 2, 3, 4]));
    let wall = gltf.positions(&half(&[5]));
    let primitives = json!([{"attributes": {"POSITION": five}, "material": 0}, {"attributes": {"POSITION": wall}, "material": 1}]);
    gltf.json["meshes"].as_array_mut().unwrap().push(json!({"primitives": primitives}));
    let points = gltf.mesh(0, &[[0.0; 3], [1.0, 0.0, 0.0]]);
    let edge = gltf.mesh(1, &[[0.0; 3], [0.0, 0.0, -2.0]]);
    let root = gltf.node(
        None,
        json!({"name": "base", "translation": [9.0, 9.0, 9.0],
        "extras": marked(json!({"role": "root", "surface": "steel", "bound": "Obb"}))}),
    );
    let s = 0.5f64.sqrt();
    let arm = gltf.node(Some(root), json!({"name": "arm", "translation": [1.0, 2.0, 3.0], "rotation": [0.0, s, 0.0, s],
        "scale": [2.0, 2.0, 2.0], "extras": marked(json!({"role": "group", "movable": true, "bound": "Sphere"}))}));
    let add = |gltf: &mut Gltf, parent: usize, mut node: Value, mark: Value| {
        node["extras"] = marked(mark);
        gltf.node(Some(parent), node)
    };
    add(
        &mut gltf,
        arm,
        json!({"name": "block", "mesh": 0}),
        json!({"role": "primitive", "kind": "Polyhedron"}),
    );
    add(
        &mut gltf,
        arm,
        json!({"name": "ball", "scale": [1.0, 1.0, 3.0]}),
        json!({"role": "primitive", "kind": "Sphere", "radius": 0.5, "surface": "granite", "order": 1}),
    );
    let fixed = gltf.node(Some(root), json!({"name": "fixed", "extras": marked(json!({"role": "group"}))}));
    // A node without a mark passes its transform on.
    let shift = gltf.node(Some(fixed), json!({"name": "shift", "translation": [0.0, 1.0, 0.0]}));
    add(
        &mut gltf,
        shift,
        json!({"name": "feet", "mesh": points}),
        json!({"role": "primitive", "kind": "Point"}),
    );
    add(
        &mut gltf,
        shift,
        json!({"name": "bar", "mesh": edge}),
        json!({"role": "primitive", "kind": "LineSegment"}),
    );
    add(
        &mut gltf,
        shift,
        json!({"name": "pin", "scale": [1.0, 4.0, 1.0]}),
        json!({"role": "primitive", "kind": "Ray", "length": 0.5, "reach": 0.1, "response": "Axial"}),
    );
    add(&mut gltf, shift, json!({"name": "floor"}), json!({"role": "primitive", "kind": "Plane"}));
    let path = gltf.save(&folder("marks"), "gripper.glb");
    let (imported, model) = run(&path, &Options { surface: None, ..options() }).unwrap();
    assert_eq!((model.name.as_str(), model.entry_memory), ("gripper", false));
    assert_eq!(
        note_rules(&imported),
        ["scaled-frame", "sphere-to-ellipsoid", "loader"],
        "{}",
        imported.findings
    );
    assert!(
        imported.findings.notes[2].cause.contains("inactive"),
        "a wall without a twin: {}",
        imported.findings
    );
    let [base, arm] = &model.bodies[..] else { panic!("{} bodies", model.bodies.len()) };
    assert_eq!(arm.path, "base/arm");
    let pose = arm.initial_pose.unwrap();
    // Y up becomes z up: (1, 2, 3) is (1, −3, 2), and a turn about y one about z.
    assert_eq!(<[f64; 3]>::from(pose.position), [1.0, -3.0, 2.0]);
    let x = pose.orientation.transform_vector(&pong_geometry::Vec3::x());
    assert!((x - pong_geometry::Vec3::y()).norm() < 1e-12, "{x}");
    let egg = &arm.ellipsoids[0];
    assert_eq!(
        <[f64; 3]>::from(egg.semi_axes),
        [1.0, 3.0, 1.0],
        "scale 3 along glTF's z is along −y here, times 2"
    );
    let block = &arm.polyhedra[0];
    assert!(block.vertices.iter().all(|v| v.position.abs().min() == 2.0 && v.position.amax() == 2.0));
    let wall = block.faces.iter().find(|face| !face.active).unwrap();
    assert_eq!(block.faces.iter().filter(|face| !face.active).count(), 1);
    assert!((wall.normal + pong_geometry::Vec3::x()).norm() < 1e-12);
    let points: Vec<[f64; 3]> = base.points.iter().map(|point| point.position.into()).collect();
    assert_eq!(points, [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0]]);
    assert_eq!(<[f64; 3]>::from(base.segments[0].ends[1]), [0.0, 2.0, 1.0]);
    let ray = &base.rays[0];
    assert_eq!((<[f64; 3]>::from(ray.direction), ray.length), ([0.0, 0.0, 1.0], 2.0));
    let names: Vec<&str> = base.primitives.iter().map(|info| info.name.as_str()).collect();
    assert_eq!(names, ["bar", "feet_0", "feet_1", "floor", "pin"]);
    assert_eq!(arm.primitives.iter().map(|info| info.name.as_str()).collect::<Vec<_>>(), ["ball", "block"]);
    let granite = model.surfaces.iter().position(|surface| surface.name == "granite").unwrap();
    assert_eq!(arm.primitives[0].surface as usize, granite);
    assert_eq!(model.pair_overrides.len(), 1);
    assert_eq!(model.filters, [["base/arm".to_owned(), "base/fixed".to_owned()]]);
}

#[test]
fn all_that_cannot_be_imported_is_told_at_once() {
    let mut gltf = Gltf::new();
    let open = gltf.triangles(&cube()[..10]);
    let flipped: Vec<[Place; 3]> = cube().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    let flipped = gltf.triangles(&flipped);
    let mut dented = cube();
    dented
        .iter_mut()
        .flatten()
        .filter(|place| place.iter().all(|x| *x == 1.0))
        .for_each(|place| *place = [0.1; 3]);
    let dented = gltf.triangles(&dented);
    let cube = gltf.triangles(&cube());
    let role = |kind: &str| marked(json!({"role": "primitive", "kind": kind}));
    let root = gltf.node(None, json!({"name": "root", "extras": marked(json!({"role": "root"}))}));
    let mut add = |node: Value| _ = gltf.node(Some(root), node);
    add(json!({"name": "a_open", "mesh": open, "extras": role("Polyhedron")}));
    add(json!({"name": "b_flipped", "mesh": flipped, "extras": role("Polyhedron")}));
    add(json!({"name": "c_dented", "mesh": dented, "extras": role("Polyhedron")}));
    add(json!({"name": "d_ball", "extras": role("Sphere")}));
    add(json!({"name": "e_no_mesh", "extras": role("TriangleMesh")}));
    add(json!({"name": "f_edges", "mesh": cube, "extras": role("LineSegment")}));
    add(json!({"name": "g_plane", "mesh": cube, "extras": role("Plane")}));
    add(json!({"name": "h_no_kind", "mesh": cube, "extras": marked(json!({"role": "primitive"}))}));
    add(json!({"name": "i_walls", "mesh": cube,
        "extras": marked(json!({"role": "primitive", "kind": "Polyhedron", "inactive_faces": [1]}))}));
    add(json!({"name": "j_surface", "mesh": cube,
        "extras": marked(json!({"role": "primitive", "kind": "Polyhedron", "surface": "glue"}))}));
    add(json!({"name": "j_surface", "mesh": cube, "extras": role("Polyhedron")}));
    let path = gltf.save(&folder("faults"), "faults.glb");
    let findings = run(&path, &options()).unwrap_err();
    let expected = [
        "open-polyhedron",
        "inside-out",
        "not-convex",
        "not-positive",
        "no-geometry",
        "edges-of-faces",
        "no-plane",
        "no-kind",
        "numbered-elements",
        "repeated-name",
        "unknown-surface",
    ];
    assert_eq!(rules(&findings), expected, "{findings}");
    assert!(findings.faults.iter().all(|fault| !fault.cure.is_empty() && fault.path.contains("faults.glb")));
    assert!(findings.faults[0].path.ends_with("root/a_open"));
    assert!(!path.with_extension("ron").exists());
}

/// File of a marked cube `block` in a group below a root, and perhaps a point beside it.
fn marked_cube(root: &str, group: &str, has_foot: bool) -> Gltf {
    let mut gltf = Gltf::new();
    let surface = json!({"stiffness": 1e6, "normal": {"Linear": {"damping": 1.0}}, "foundation": 2e8});
    gltf.json["scenes"][0]["extras"] = marked(json!({"surfaces": {"steel": surface}}));
    let cube = gltf.triangles(&cube());
    let mark = json!({"role": "root", "surface": "steel", "contact": root});
    let root = gltf.node(None, json!({"name": "root", "extras": marked(mark)}));
    let extras = marked(json!({"role": "group", "contact": group}));
    let arm = gltf.node(Some(root), json!({"name": "arm", "extras": extras}));
    let extras = marked(json!({"role": "primitive", "kind": "Polyhedron"}));
    gltf.node(Some(arm), json!({"name": "block", "mesh": cube, "extras": extras}));
    if has_foot {
        let extras = marked(json!({"role": "primitive", "kind": "Point"}));
        gltf.node(Some(arm), json!({"name": "foot", "extras": extras}));
    }
    gltf
}

#[test]
fn marks_give_contact_and_foundation() {
    for (root, group, has_foot, solids, notes) in [
        ("Solid", "Default", false, 1, [].as_slice()),
        ("Solid", "Marked", true, 0, &[]),
        ("Default", "Solid", false, 1, &[]),
        ("Default", "Default", true, 0, &[]),
        ("Automatic", "Default", false, 1, &[]),
        ("Automatic", "Default", true, 0, &["not-solid"]),
    ] {
        let path = marked_cube(root, group, has_foot).save(&folder("contact"), "cube.glb");
        let (imported, model) = run(&path, &Options { surface: None, ..options() }).unwrap();
        assert_eq!(model.bodies[0].solids.len(), solids, "{root} {group} {has_foot}");
        assert_eq!(note_rules(&imported), notes, "{root} {group} {has_foot}");
        let text = std::fs::read_to_string(&imported.files[0]).unwrap();
        assert!(text.contains("(stiffness: 1000000.0, foundation: 200000000.0, normal:"), "{text}");
    }
    let path = marked_cube("Automatic", "Default", false).save(&folder("contact_marked"), "cube.glb");
    let (_, model) = run(&path, &Options { marked: true, ..options() }).unwrap();
    assert_eq!(model.bodies[0].solids.len(), 0);
}

#[test]
fn contact_that_is_not_known_or_contradicts_points_is_refused() {
    for (root, group, has_foot, rule) in [
        ("Hard", "Default", false, "mark"),
        ("Solid", "Automatic", false, "mark"),
        ("Solid", "Default", true, "solid-corner"),
    ] {
        let path = marked_cube(root, group, has_foot).save(&folder("no_contact"), "cube.glb");
        let findings = run(&path, &options()).map(|_| ()).unwrap_err();
        assert!(rules(&findings).contains(&rule), "{findings}");
    }
}

/// Asserts that a file with one fault, made by `spoil`, breaks this rule.
fn assert_refused(test: &str, rule: &str, spoil: impl Fn(&mut Gltf)) {
    let mut gltf = cube_file();
    spoil(&mut gltf);
    let path = gltf.save(&folder(test), "file.glb");
    let findings = run(&path, &options()).map(|_| ()).unwrap_err();
    assert_eq!(rules(&findings), [rule], "{findings}");
    assert!(!path.with_extension("ron").exists());
}

#[test]
fn extensions_that_change_geometry_are_refused_by_name() {
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "ACME_anything"] {
        let mut gltf = cube_file();
        gltf.json["extensionsRequired"] = json!([name, "KHR_materials_unlit"]);
        let path = gltf.save(&folder("extensions"), "file.glb");
        let findings = run(&path, &options()).unwrap_err();
        assert_eq!(rules(&findings), ["unsupported-extension"]);
        assert!(findings.faults[0].cause.contains(name));
    }
    let mut gltf = cube_file();
    gltf.json["extensionsRequired"] = json!(["KHR_materials_unlit"]);
    run(&gltf.save(&folder("harmless"), "file.glb"), &options()).unwrap();
}

#[test]
fn what_deforms_or_lies_outside_is_refused() {
    assert_refused("skin", "skin", |gltf| {
        gltf.json["nodes"][0]["skin"] = json!(0);
        gltf.json["skins"] = json!([{"joints": [0]}]);
    });
    assert_refused("morph", "morph-targets", |gltf| gltf.json["nodes"][0]["weights"] = json!([0.5]));
    assert_refused("index", "damaged", |gltf| {
        let indices = gltf.indices(&[0, 1, 99]);
        gltf.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    });
    assert_refused("bounds", "damaged", |gltf| gltf.json["accessors"][0]["count"] = json!(1000));
    assert_refused("scene", "no-scene", |gltf| {
        let file = gltf.json.as_object_mut().unwrap();
        ["scene", "scenes"].iter().for_each(|key| _ = file.remove(*key));
    });
    assert_refused("empty", "empty-mesh", |gltf| {
        _ = gltf.json["nodes"][0].as_object_mut().unwrap().remove("mesh")
    });
    assert_refused("version", "mark-version", |gltf| {
        gltf.json["nodes"][0]["extras"] =
            marked(json!({"role": "primitive", "kind": "Polyhedron", "version": 2}));
    });
    assert_refused("field", "mark", |gltf| {
        gltf.json["nodes"][0]["extras"] = marked(json!({"role": "primitive", "kind": "Torus"}));
    });
}

#[test]
fn frames_of_movable_groups_must_be_rigid() {
    let frame = |node: Value| {
        move |gltf: &mut Gltf| {
            gltf.json["nodes"][0]["extras"] = marked(json!({"role": "primitive", "kind": "Polyhedron"}));
            let mut group = node.clone();
            group["name"] = json!("arm");
            group["children"] = json!([0]);
            group["extras"] = marked(json!({"role": "group", "movable": true}));
            gltf.json["nodes"].as_array_mut().unwrap().push(group);
            gltf.json["nodes"]
                .as_array_mut()
                .unwrap()
                .push(json!({"name": "stretched", "scale": [2, 1, 1], "children": [1]}));
            gltf.json["scenes"][0]["nodes"] = json!([2]);
        }
    };
    let turned = json!([0.0, 0.5, 0.0, 0.8]);
    assert_refused("sheared", "sheared-frame", frame(json!({"rotation": turned})));
    assert_refused("mirrored", "mirrored-frame", frame(json!({"scale": [1, -1, 1]})));
    assert_refused("flat", "flat-frame", frame(json!({"scale": [1, 0, 1]})));
    let sheared_ball = |gltf: &mut Gltf| {
        frame(json!({"rotation": turned}))(gltf);
        gltf.json["nodes"][1]["extras"]["pong"]["movable"] = json!(false);
        gltf.json["nodes"][0]["extras"] = marked(json!({"role": "primitive", "kind": "Sphere", "radius": 1}));
    };
    assert_refused("ball", "sheared-shape", sheared_ball);
}

#[test]
fn meshes_are_mended_where_nothing_is_lost() {
    // The long edge of the first triangle passes a corner of the other two: a T-junction. One triangle is
    // duplicated, one has no area.
    let [a, b, c, d, m] =
        [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [2.0, 2.0, 0.0], [1.0, 1.0, 0.0]];
    let sheet = [[a, b, c], [b, d, m], [m, d, c], [m, d, c], [a, a, b], [b, m, c]];
    let path = folder("mend").join("sheet.stl");
    std::fs::write(&path, binary_stl(&sheet)).unwrap();
    let (imported, model) = run(&path, &options()).unwrap();
    assert_eq!(
        note_rules(&imported),
        ["sliver-triangle", "duplicate-triangle", "t-junction", "not-solid"],
        "{}",
        imported.findings
    );
    assert_eq!(model.bodies[0].triangles.triangles.len(), 4);
    assert!(model.warnings.is_empty());
    // Triangles that each have a reversed copy form a two-sided sheet.
    let both = [[a, b, c], [a, c, b]];
    std::fs::write(&path, binary_stl(&both)).unwrap();
    let (imported, model) = run(&path, &options()).unwrap();
    assert_eq!(note_rules(&imported), ["two-sided", "not-solid"]);
    assert_eq!(model.bodies[0].triangles.triangles.len(), 2);
    // Corners a micrometre apart are welded only on request.
    let near = [[a, b, c], [[2.0, 1e-6, 0.0], d, c]];
    std::fs::write(&path, binary_stl(&near)).unwrap();
    assert_eq!(run(&path, &options()).unwrap().1.bodies[0].triangles.vertices.len(), 5);
    let (imported, model) = run(&path, &Options { weld_m: Some(1e-5), ..options() }).unwrap();
    assert_eq!(
        (note_rules(&imported), model.bodies[0].triangles.vertices.len()),
        (vec!["welded", "not-solid"], 4)
    );
}

#[test]
fn hollow_solids_stay_surfaces_and_a_placeholder_stands_in_for_a_surface() {
    let inner: Vec<[Place; 3]> =
        cube().into_iter().map(|[a, b, c]| [a, c, b].map(|p| p.map(|x| 0.5 * x))).collect();
    let beside: Vec<[Place; 3]> = cube().into_iter().map(|t| t.map(|[x, y, z]| [x + 5.0, y, z])).collect();
    let path = folder("hollow").join("box.stl");
    std::fs::write(&path, binary_stl(&[cube(), inner, beside].concat())).unwrap();
    let (imported, model) = run(&path, &Options { surface: None, ..options() }).unwrap();
    assert_eq!(imported.primitives, [("TriangleMesh", 1), ("Polyhedron", 1)]);
    assert_eq!(note_rules(&imported), ["placeholder-surface", "not-solid"]);
    assert_eq!(model.surfaces[0].name, "placeholder");
    assert_eq!(model.bodies[0].triangles.triangles.len(), 24);
}

/// glTF's nodes must be trees; otherwise a walk from the root could take practically forever.
#[test]
fn nodes_that_are_no_trees_are_refused() {
    let folder = folder("no_trees");
    let chain = || {
        let mut gltf = Gltf::new();
        let mesh = gltf.triangles(&cube());
        let top = gltf.node(None, json!({"name": "top"}));
        let middle = gltf.node(Some(top), json!({"name": "middle"}));
        gltf.node(Some(middle), json!({"name": "cube", "mesh": mesh}));
        gltf
    };
    assert!(run(&chain().save(&folder, "good.glb"), &options()).is_ok());
    type Spoil = fn(&mut Value);
    let spoils: [(&str, Spoil); 5] = [
        ("a circle, twice", |json| json["nodes"][1]["children"] = json!([0, 1])),
        ("its own child", |json| json["nodes"][2]["children"] = json!([2])),
        ("two parents", |json| json["nodes"][0]["children"] = json!([1, 2])),
        ("twice below one", |json| json["nodes"][1]["children"] = json!([2, 2])),
        ("on top and below", |json| json["scenes"][0]["nodes"] = json!([0, 2])),
    ];
    for (name, spoil) in spoils {
        let mut gltf = chain();
        spoil(&mut gltf.json);
        let findings = run(&gltf.save(&folder, "spoiled.glb"), &options()).unwrap_err();
        assert_eq!(rules(&findings), ["damaged"], "{name}: {findings}");
        assert!(findings.to_string().contains("stands below"), "{name}: {findings}");
    }
}
