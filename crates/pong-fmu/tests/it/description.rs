//! Contents of an FMU: the description, the files, and the refusals while it is made.

use crate::support;
use crate::support::{library, make, scratch, unzip, write_scene};
use pong_fmu::{Fmi, Options, package};

/// Elements in document order, as paths of names with attributes; refuses XML that is not well formed.
fn elements(xml: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut stack: Vec<String> = Vec::new();
    let mut found = Vec::new();
    let body = xml.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n").expect("a declaration");
    for line in body.lines() {
        let inside =
            line.trim().strip_prefix('<').and_then(|line| line.strip_suffix('>')).expect("one tag a line");
        assert!(!inside.contains(['<', '>']), "{inside}");
        if let Some(name) = inside.strip_prefix('/') {
            assert_eq!(stack.pop().as_deref(), Some(name));
            continue;
        }
        let (inside, is_empty) = inside.strip_suffix('/').map_or((inside, false), |inside| (inside, true));
        let (name, mut rest) = inside.split_once(' ').unwrap_or((inside, ""));
        let mut attributes: Vec<(String, String)> = Vec::new();
        while !rest.is_empty() {
            let (key, after) = rest.split_once("=\"").expect("an attribute has a value");
            let (value, after) = after.split_once('"').expect("a value ends");
            assert!(attributes.iter().all(|(other, _)| other != key), "{key} twice: {inside}");
            attributes.push((key.to_owned(), value.to_owned()));
            rest = after.trim_start();
        }
        stack.push(name.to_owned());
        found.push((stack.join("/"), attributes));
        if is_empty {
            stack.pop();
        }
    }
    assert!(stack.is_empty());
    found
}

fn value<'a>(attributes: &'a [(String, String)], name: &str) -> Option<&'a str> {
    attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
}

#[test]
fn the_descriptions_name_every_variable_alike() {
    let scene = write_scene(&scratch("description"), "");
    let mut lists = Vec::new();
    for fmi in [Fmi::V2, Fmi::V3] {
        let package = make(&scene, fmi, &Options::default());
        let files = unzip(&package.bytes);
        let xml = String::from_utf8(files["modelDescription.xml"].clone()).unwrap();
        let elements = elements(&xml);
        let root = &elements[0].1;
        assert_eq!(value(root, "fmiVersion"), Some(if fmi == Fmi::V2 { "2.0" } else { "3.0" }));
        assert_eq!(value(root, "modelName"), Some("drop of &quot;2&quot; &lt;balls&gt;"));
        let variables: Vec<_> = elements
            .iter()
            .map(|(_, attributes)| attributes)
            .filter(|a| value(a, "causality").is_some())
            .collect();
        for (place, variable) in variables.iter().enumerate() {
            assert_eq!(value(variable, "valueReference"), Some(place.to_string().as_str()));
        }
        let count = |causality| variables.iter().filter(|v| value(v, "causality") == Some(causality)).count();
        // One free body: 6 inputs, 13 start values, 13 states and as many rates; three bodies with 13 + 6 outputs, and 6.
        assert_eq!([count("input"), count("output"), count("local")], [6, 3 * 19 + 6, 26]);
        // Two surfaces of finite stiffness with three factors each; for the rigid one damping and friction.
        assert_eq!(count("parameter"), 13 + 3 + 3 + 2);
        assert_eq!(package.counts, [6, 63, 21, 13]);
        let names: Vec<_> = variables.iter().map(|v| value(v, "name").unwrap().to_owned()).collect();
        for name in
            ["time", "'my ball'.position[1]", "arm.contact_force[3]", "der('my ball'.state.velocity[3])"]
        {
            assert!(names.iter().any(|other| other == name), "{name}");
        }
        // Every rate names its state, which FMI 2.0 counts from 1.
        let first = usize::from(fmi == Fmi::V2);
        let states = elements.iter().filter_map(|(_, a)| value(a, "derivative")?.parse::<usize>().ok());
        let rates: Vec<_> = states.map(|state| format!("der({})", names[state - first])).collect();
        assert_eq!(rates, names.iter().filter(|name| name.starts_with("der(")).cloned().collect::<Vec<_>>());
        let unknowns = elements.iter().filter(|(path, _)| path.contains("ModelStructure/")).count();
        let lists_of_2 = if fmi == Fmi::V2 { 3 } else { 0 };
        assert_eq!(unknowns, lists_of_2 + 63 + 13 + (63 + 26));
        lists.push(names);
    }
    assert_eq!(lists[0], lists[1]);
}

#[test]
fn an_fmu_holds_all_that_it_reads_and_the_same_bytes_each_time() {
    let folder = scratch("contents");
    let scene = write_scene(&folder, "");
    let package = make(&scene, Fmi::V3, &Options::default());
    assert_eq!(package.bytes, make(&scene, Fmi::V3, &Options::default()).bytes);
    let files = unzip(&package.bytes);
    let names: Vec<&str> = files.keys().map(String::as_str).collect();
    assert_eq!(
        names,
        [
            "binaries/x86_64-linux/drop_of__2___balls_.so",
            "documentation/index.html",
            "documentation/licenses/license.txt",
            "documentation/licenses/third_party.md",
            "modelDescription.xml",
            "resources/contents.ron",
            "resources/models/0/ball.ron",
            "resources/models/1/ground.ron",
            "resources/models/2/tile.obj",
            "resources/models/2/tile.ron",
            "resources/scene.ron",
        ]
    );
    let second = unzip(&make(&scene, Fmi::V2, &Options::default()).bytes);
    assert!(second.contains_key("binaries/linux64/drop_of__2___balls_.so"));
    // A change of any file changes the token.
    let token = |files: &support::Files| {
        let xml = String::from_utf8(files["modelDescription.xml"].clone()).unwrap();
        value(&elements(&xml)[0].1, "instantiationToken").unwrap().to_owned()
    };
    let mesh = folder.join("parts/tile.obj");
    std::fs::write(&mesh, std::fs::read_to_string(&mesh).unwrap() + "\n").unwrap();
    assert_ne!(token(&files), token(&unzip(&make(&scene, Fmi::V3, &Options::default()).bytes)));
}

#[test]
fn what_cannot_be_an_fmu_is_refused() {
    let folder = scratch("refused_packages");
    let scene = write_scene(&folder, "");
    let refused = |options: &Options| package(&scene, &library(), Fmi::V3, options).unwrap_err();
    let input = |name: &str| Options { inputs: vec![name.to_owned()], ..Options::default() };
    let told = refused(&input("bal"));
    assert!(told.contains("`bal`") && told.contains("my ball, ground, arm"), "{told}");
    let twice = Options { inputs: vec!["arm".to_owned(), "arm".to_owned()], ..Options::default() };
    assert!(refused(&twice).contains("named twice"));
    assert!(
        package(&scene, b"\x7fELF", Fmi::V3, &Options::default()).unwrap_err().contains("shared library")
    );
    std::fs::remove_file(folder.join("ground.ron")).unwrap();
    assert!(refused(&Options::default()).contains("ground.ron"));
    assert!(
        package(&folder.join("none.ron"), &library(), Fmi::V3, &Options::default())
            .unwrap_err()
            .contains("none.ron")
    );
}

#[test]
fn contact_alone_has_no_states() {
    let scene = write_scene(&scratch("contact_only"), "");
    let options = Options { all_inputs: true, ..Options::default() };
    let package = make(&scene, Fmi::V2, &options);
    assert_eq!(package.inputs, ["my ball", "arm"]);
    // Two bodies with 13 inputs; the outputs are three wrenches, the motion of the ground, and six of contact.
    assert_eq!(package.counts, [26, 3 * 6 + 13 + 6, 8, 0]);
}
