//! The tables of the schema, the reader, docs/model_format.md and the fuzzer's words agree.

use pong_geometry::primitive::{CustomPrimitive, PrimitiveKind};
use pong_model::Extensions;
use pong_model::schema::{self, Field, FieldDefault, Type};
use std::fmt::Debug;
use std::sync::Arc;

/// Value of a field as text, valid beside the values of the other fields.
fn sample(field: &Field) -> String {
    let text = match (field.name, field.value) {
        ("kind" | "name", _) => "\"x\"",
        ("surface", _) => "\"s\"",
        ("surfaces", Type::TextPair) => "(\"s\", \"s\")",
        ("vertices", Type::VectorTriple) => "((0, 0, 0), (1, 0, 0), (0, 1, 0))",
        ("vertices", _) => "[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]",
        // A group of solids has no points.
        ("contact", _) => "Marked",
        ("faces", _) => "[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]",
        ("triangles", _) => "[(0, 1, 2)]",
        (_, Type::Restitution) => "0.5",
        (_, Type::Boolean) => "true",
        (_, Type::BooleanPair) => "(true, false)",
        (_, Type::Vector | Type::Direction | Type::SemiAxes) => "(0.25, 0.5, 0.75)",
        (_, Type::Rotation) => "(0.0, 1.0, 0.0, 0.0)",
        (_, Type::VectorPair) => "((0, 0, 0), (0, 0, 2))",
        (_, Type::Radii) => "(0.25, 0.75)",
        (_, Type::Numbers) => "[0.5, 2.0]",
        (_, Type::Indices) => "[1]",
        (_, Type::Word(words)) => words[words.len() - 1],
        (_, Type::Bound) => "Sphere",
        (_, Type::NormalLaw) => "Linear(damping: 2.0)",
        (_, Type::FrictionLaw) => "Bristle(mu: 0.5)",
        (_, Type::Record(fields)) => return struct_of("", fields, &[]),
        _ => "1.0",
    };
    text.to_owned()
}

/// Fields that exclude each other.
const EITHER_OR: [(&str, &str); 5] = [
    ("damping", "mass"),
    ("damping", "restitution"),
    ("dissipation", "restitution"),
    ("vertices", "file"),
    ("foundation", "area"),
];

/// Struct with all fields but those left out. Of two fields that exclude each other, the first is written.
fn struct_of(name: &str, fields: &[Field], left_out: &[&str]) -> String {
    let is_there = |name: &str| fields.iter().any(|f| f.name == name) && !left_out.contains(&name);
    let excluded = |name: &str| EITHER_OR.iter().any(|&(one, other)| other == name && is_there(one));
    let written = fields.iter().filter(|f| is_there(f.name) && !excluded(f.name));
    // The scale belongs to a file.
    let written = written.filter(|f| f.name != "scale");
    let all: Vec<_> = written.map(|field| format!("{}: {}", field.name, sample(field))).collect();
    format!("{name}({})", all.join(", "))
}

#[derive(Debug)]
struct Own;

impl CustomPrimitive for Own {
    fn kind_name(&self) -> &str {
        "x"
    }
    fn support(&self, _: &pong_geometry::Vec3) -> f64 {
        1.0
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

fn model(surface: &str, pairs: &str, contents: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": {surface} }}, pairs: [{pairs}],\n\
         root: (name: \"m\", surface: \"s\", {contents}))"
    )
}

const SURFACE: &str = "(stiffness: 1e6)";
const POINT: &str = "primitives: [Point(name: \"p\", position: (0, 0, 0))]";

/// Hash of the model, or the rules that it breaks.
fn loaded(text: &str) -> Result<u64, Vec<&'static str>> {
    let mut ext = Extensions::new();
    ext.add_primitive("x", Arc::new(|_| Ok(Arc::new(Own) as Arc<dyn CustomPrimitive>)));
    let model = pong_model::parse(text, "m", None, &ext);
    model.map(|model| model.hash).map_err(|errors| errors.0.iter().map(|error| error.rule).collect())
}

/// Checks one struct: whole, without each field, with each default and with an unknown field.
fn check(name: &str, tables: &[&[Field]], around: impl Fn(&str) -> String) {
    let fields: Vec<Field> = tables.iter().copied().flatten().map(|f| Field { ..*f }).collect();
    let read = |left_out: &[&str]| loaded(&around(&struct_of(name, &fields, left_out)));
    assert!(read(&[]).is_ok(), "{name}: {:?} {}", read(&[]), struct_of(name, &fields, &[]));
    let strange = struct_of(name, &fields, &[]).replacen('(', "(colour: 1, ", 1);
    assert_eq!(loaded(&around(&strange)), Err(vec!["unknown-field"]), "{name}");
    for field in &fields {
        // Vertices and faces are required unless there is a file.
        let from_file = fields.iter().any(|f| f.name == "file");
        if from_file && ["vertices", "triangles", "faces"].contains(&field.name) {
            continue;
        }
        let without = read(&[field.name]);
        match field.default {
            FieldDefault::Required => assert!(
                without.clone().is_err_and(|rules| rules.contains(&"missing-field")),
                "{name}.{}: {without:?}",
                field.name
            ),
            FieldDefault::Words(_) => assert!(without.is_ok(), "{name}.{}: {without:?}", field.name),
            // A scale is for files, which these models have not.
            FieldDefault::Value(_) if field.name == "scale" => {}
            FieldDefault::Value(value) => {
                // A field that excludes this one is left out as well.
                let of_it = EITHER_OR.iter().filter(|(one, _)| *one == field.name).map(|(_, other)| *other);
                let left_out: Vec<&str> = of_it.chain([field.name]).collect();
                let text = struct_of(name, &fields, &left_out);
                let written = text.replacen('(', &format!("({}: {value}, ", field.name), 1);
                assert_eq!(loaded(&around(&written)), read(&left_out), "{name}.{}: {written}", field.name);
            }
        }
    }
}

#[test]
fn primitives_are_read_by_their_tables() {
    for kind in schema::PRIMITIVES {
        check(kind.name, &[schema::PRIMITIVE, kind.fields], |text| {
            model(SURFACE, "", &format!("primitives: [{text}]"))
        });
    }
}

#[test]
fn laws_are_read_by_their_tables() {
    for law in schema::NORMAL_LAWS {
        check(law.name, &[law.fields], |text| model(&format!("(stiffness: 1e6, normal: {text})"), "", POINT));
        let restitution = law.nested("restitution");
        if !restitution.is_empty() {
            let required = law.fields.iter().filter(|f| f.default == FieldDefault::Required);
            let others: String = required.map(|f| format!("{}: {}, ", f.name, sample(f))).collect();
            check("", &[restitution], |text| {
                let normal = format!("{}({others}restitution: {text})", law.name);
                model(&format!("(stiffness: 1e6, normal: {normal})"), "", POINT)
            });
        }
    }
    for law in schema::FRICTION_LAWS.iter().filter(|law| !law.fields.is_empty()) {
        check(law.name, &[law.fields], |text| {
            model(&format!("(stiffness: 1e6, friction: {text})"), "", POINT)
        });
    }
}

#[test]
fn surfaces_pairs_and_groups_are_read_by_their_tables() {
    check("", &[schema::SURFACE], |text| model(text, "", POINT));
    check("", &[schema::PAIR], |text| model(SURFACE, text, POINT));
    check("", &[schema::POSE], |text| {
        model(SURFACE, "", &format!("groups: [(name: \"g\", pose: {text}, {POINT})]"))
    });
    // A group needs one of `groups` and `primitives`, and neither has a sample of its own.
    let own = |f: &&Field| !["groups", "primitives"].contains(&f.name);
    let group: Vec<Field> = schema::GROUP.iter().filter(own).map(|f| Field { ..*f }).collect();
    check("", &[&group], |text| {
        model(SURFACE, "", &format!("groups: [{}]", text.replacen('(', &format!("({POINT}, "), 1)))
    });
}

#[test]
fn primitives_are_those_of_the_geometry() {
    let names = schema::names(schema::PRIMITIVES);
    assert!(PrimitiveKind::ALL.iter().all(|kind| names.contains(&kind.name())), "{names:?}");
    assert_eq!(names.len(), PrimitiveKind::ALL.len() + 1, "all and TriangleMesh");
}

/// Every word of model files: names of fields, kinds and bounds.
fn words() -> Vec<&'static str> {
    fn of(fields: &'static [Field], all: &mut Vec<&'static str>) {
        for field in fields {
            all.push(field.name);
            match field.value {
                Type::Record(inner) | Type::Map(inner) | Type::List(inner) => of(inner, all),
                Type::Word(words) => all.extend(words),
                _ => {}
            }
        }
    }
    let mut all: Vec<&'static str> = schema::BOUNDS.to_vec();
    for fields in [schema::MODEL, schema::GROUP, schema::PRIMITIVE] {
        of(fields, &mut all);
    }
    fn kinds<T: Debug>(kinds: &'static [schema::Kind<T>], all: &mut Vec<&'static str>) {
        for kind in kinds {
            all.push(kind.name);
            of(kind.fields, all);
        }
    }
    kinds(schema::PRIMITIVES, &mut all);
    kinds(schema::NORMAL_LAWS, &mut all);
    kinds(schema::FRICTION_LAWS, &mut all);
    all.sort_unstable();
    all.dedup();
    all
}

#[test]
fn the_fuzzer_knows_every_word() {
    let dictionary = include_str!("../../../../fuzz/dictionaries/ron.txt");
    let known: Vec<&str> = dictionary.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    let missing: Vec<_> = words().into_iter().filter(|word| !known.contains(word)).collect();
    assert!(missing.is_empty(), "add to fuzz/dictionaries/ron.txt: {missing:?}");
}

const DOCUMENT: &str = include_str!("../../../../docs/model_format.md");

/// Name and default of each row of the first table behind this text of the document.
fn documented(behind: &str) -> Vec<(&'static str, &'static str)> {
    let (_, rest) = DOCUMENT.split_once(behind).unwrap_or_else(|| panic!("no {behind:?}"));
    let table =
        rest.lines().skip_while(|line| !line.starts_with("| ")).take_while(|line| line.starts_with('|'));
    let cells = table.map(|line| line.trim_matches('|').split('|').map(str::trim).collect::<Vec<_>>());
    let rows = cells.filter(|cells| cells[0].starts_with('`') && cells.len() > 2);
    rows.map(|cells| (cells[0].trim_matches('`'), cells[cells.len() - 1])).collect()
}

#[test]
fn documented_fields_are_those_of_the_schema() {
    let bristle = schema::FRICTION_LAWS.iter().find(|law| law.name == "Bristle").expect("it exists");
    let tables = [
        ("## A whole file", schema::MODEL),
        ("## Surfaces", schema::SURFACE),
        ("## Groups", schema::GROUP),
        ("### Friction", bristle.fields),
    ];
    for (heading, fields) in tables {
        let rows: Vec<_> =
            documented(heading).into_iter().filter(|(name, _)| *name != bristle.name).collect();
        let names: Vec<_> = rows.iter().map(|(name, _)| *name).collect();
        assert_eq!(names, fields.iter().map(|field| field.name).collect::<Vec<_>>(), "{heading}");
        for ((name, default), field) in rows.iter().zip(fields) {
            let is_required = field.default == FieldDefault::Required;
            assert_eq!(*default == "required", is_required, "{heading} {name}: {default}");
        }
    }
}

/// Rows of the table of all kinds: kind, field, type, unit and default.
fn table_of_kinds() -> String {
    fn rows<T>(kinds: &'static [schema::Kind<T>], text: &mut String) {
        for kind in kinds {
            for (index, field) in kind.fields.iter().enumerate() {
                let kind = if index == 0 { format!("`{}`", kind.name) } else { String::new() };
                let inner: Vec<_> = field.value.fields().iter().map(|f| format!("`{}`", f.name)).collect();
                let value = match field.value {
                    Type::Word(words) => format!("`{}`", words.join("` or `")),
                    Type::Record(_) => format!("({})", inner.join(", ")),
                    other => other.name().replace('_', " "),
                };
                let default = match field.default {
                    FieldDefault::Required => "required".to_owned(),
                    FieldDefault::Value(value) => format!("`{value}`"),
                    FieldDefault::Words(words) => words.to_owned(),
                };
                *text += &format!("| {kind} | `{}` | {value} | {} | {default} |\n", field.name, field.unit);
            }
        }
    }
    let mut text = String::from("| kind | field | type | unit | default |\n|---|---|---|---|---|\n");
    rows(schema::PRIMITIVES, &mut text);
    rows(schema::NORMAL_LAWS, &mut text);
    rows(schema::FRICTION_LAWS, &mut text);
    text
}

#[test]
fn the_table_of_kinds_is_documented() {
    let table = table_of_kinds();
    assert!(DOCUMENT.contains(&table), "the table in docs/model_format.md must be:\n{table}");
}
