//! Our reader compared with the `ron` crate, and the positions it reports.

use super::{Node, Value, parse};
use std::collections::BTreeMap;

/// Reads a text with both readers; `Some` only if both accept it as RON.
fn both(text: &str) -> Option<(Node, ron::Value)> {
    let options = ron::Options::default();
    match (parse(text), options.from_str::<ron::Value>(text)) {
        (Ok(ours), Ok(theirs)) => Some((ours, theirs)),
        (Err(_), Err(_)) => None,
        (ours, theirs) => panic!("readers differ on {text:?}:\n{ours:?}\n{theirs:?}"),
    }
}

fn agree(ours: &Node, theirs: &ron::Value, text: &str) {
    use ron::Value as Theirs;
    match (&ours.value, theirs) {
        (Value::Bool(a), Theirs::Bool(b)) => assert_eq!(a, b, "{text}"),
        (Value::Number(a), Theirs::Number(b)) => {
            let b = b.into_f64();
            assert!(*a == b || (a.is_nan() && b.is_nan()), "{text}: {a} {b}");
        }
        (Value::Text(a), Theirs::String(b)) => assert_eq!(a, b, "{text}"),
        (Value::Text(a), Theirs::Char(b)) => assert_eq!(a, &b.to_string(), "{text}"),
        (Value::Tuple(Some(name), items), Theirs::Option(Some(inner))) if name.as_ref() == "Some" => {
            agree(&items[0], inner, text);
        }
        (Value::Name(name), Theirs::Option(None)) => assert_eq!(name.as_ref(), "None"),
        (Value::Name(_), Theirs::Unit) => {}
        (Value::Tuple(_, items), Theirs::Unit) => assert!(items.is_empty(), "{text}"),
        (Value::Tuple(_, a) | Value::List(a), Theirs::Seq(b)) => {
            assert_eq!(a.len(), b.len(), "{text}");
            a.iter().zip(b).for_each(|(a, b)| agree(a, b, text));
        }
        (Value::Numbers(a), Theirs::Seq(b)) => numbers_agree(a, b, text),
        (Value::Rows(a), Theirs::Seq(b)) => {
            assert_eq!(a.len(), b.len(), "{text}");
            for (index, row) in b.iter().enumerate() {
                match row {
                    Theirs::Seq(row) => numbers_agree(a.row(index), row, text),
                    Theirs::Unit => assert!(a.row(index).is_empty()),
                    other => panic!("{text}: {other:?}"),
                }
            }
        }
        (Value::Struct(_, fields), Theirs::Map(map)) => {
            let map: BTreeMap<_, _> = map.iter().map(|(k, v)| (format!("{k:?}"), v)).collect();
            for field in fields {
                let key = format!("{:?}", Theirs::String(field.name.to_string()));
                agree(&field.value, map[&key], text);
            }
        }
        (Value::Map(entries), Theirs::Map(map)) => {
            // Their map is sorted by key; ours keeps the file order.
            let mut entries: Vec<_> = entries.iter().collect();
            entries.sort_by_key(|(key, _)| format!("{:?}", key.value));
            entries.iter().zip(map.iter()).for_each(|((_, a), (_, b))| agree(a, b, text));
        }
        (ours, theirs) => panic!("{text}: {ours:?} {theirs:?}"),
    }
}

fn numbers_agree(ours: &[f64], theirs: &[ron::Value], text: &str) {
    assert_eq!(ours.len(), theirs.len(), "{text}");
    for (a, b) in ours.iter().zip(theirs) {
        agree(&Node { at: 0, value: Value::Number(*a) }, b, text);
    }
}

const GOOD: &[&str] = &[
    "1",
    "-1",
    "+1",
    "0",
    "007",
    "1.5",
    "-1.5e3",
    "1e5",
    "1E-5",
    "1e+5",
    ".5",
    "5.",
    "-.5",
    "1_000",
    "1_000.5",
    "1_",
    "1__0",
    "0xff",
    "0xFF_ff",
    "-0x10",
    "0b1010",
    "0o17",
    "inf",
    "-inf",
    "+inf",
    "NaN",
    "-NaN",
    "1u8",
    "0xffu8",
    "1.5f32",
    "1.5f64",
    "2f64",
    "1i64",
    "18446744073709551615",
    "true",
    "false",
    "\"a\"",
    r#""a\n\t\\\"\u{3bc}\x41\0""#,
    "r\"a\\b\"",
    "r#\"a\"b\"#",
    "'x'",
    r"'\n'",
    "'\\''",
    "\"two\nlines\"",
    "\"a\\\n   b\"",
    "()",
    "[]",
    "{}",
    "(1)",
    "(1,)",
    "(1,2)",
    "[1,2,]",
    "[1, 2 , 3]",
    "[(1,2),(3,4)]",
    "[(1,2),(3,4),]",
    "[[1],[2,3],[]]",
    "[(1,2),(3,\"a\")]",
    "[(1,2),[3]]",
    "[(1,inf),(2,3)]",
    "{\"a\": 1, \"b\": 2}",
    "{\"a\": 1,}",
    "(a: 1)",
    "(a: 1, b: (c: [2]),)",
    "Name(a: 1)",
    "Name(1, 2)",
    "Name",
    "Name()",
    "Some(1)",
    "None",
    "Some(Some(2))",
    "// c\n1",
    "1 // c",
    "/* c */ 1",
    "/* a /* b */ c */ 1 /* d */",
    "[/**/1/**/,/**/2/**/]",
    "(a /**/ : /**/ 1)",
    " \t\r\n 1 ",
    "(r#type: 1)",
    "#![enable(implicit_some)]\n1",
    "#![enable(implicit_some, unwrap_newtypes)] (a: 1)",
    "((1,2),(3,4))",
    "Name (a: 1)",
    "(trueish: 1)",
    "[truely]",
    "(µ: 1)",
    "\u{2028}1",
    "1\u{85}",
    "[(), ()]",
    "[((1))]",
    "[1, \"a\"]",
    "{1: 2, (3, 4): 5}",
    "1e400",
    "123456789012345678901234567890.0",
    "[(1.0,-2e-3,+.5),(0x1,0b1,1_0)]",
];

const BAD: &[&str] = &[
    "",
    " ",
    "1 2",
    "[1 2]",
    "[1,,2]",
    "(1",
    "[1",
    "{\"a\": 1",
    "{\"a\" 1}",
    "(a: 1",
    "(a: 1 b: 2)",
    "(a: )",
    "(a 1)",
    "\"a",
    "r\"a",
    "r#\"a\"",
    "'ab'",
    "''",
    "'",
    r#""\q""#,
    r#""\u{110000}""#,
    r#""\u{}""#,
    r#""\xZZ""#,
    "/* a",
    "1 /* a",
    "/",
    "-",
    "+",
    ".",
    "--1",
    "1.2.3",
    "1e",
    "1e5.5",
    "0x",
    "0xg",
    "0b2",
    "0o8",
    "1._5",
    "12abc",
    "1-2",
    "@",
    "(,)",
    "[,]",
    ")",
    "]",
    "}",
    "(1]",
    "[1)",
    "Name(a: 1",
    "#![enable(nonsense)]\n1",
    "#![foo]\n1",
    "(1, a: 2)",
    "(a: 1, 2)",
    "-_1",
    "0x_1",
    "1e1e1",
    "[(1,2),(3,4)",
    "[(1,2) (3,4)]",
    "[(1 2)]",
    "[(1,2],(3,4)]",
    "tru e",
    "-true",
    "- 1",
];

#[test]
fn reads_what_the_ron_crate_reads_and_the_same_values() {
    for text in GOOD {
        let (ours, theirs) = both(text).unwrap_or_else(|| panic!("both refuse {text:?}"));
        agree(&ours, &theirs, text);
    }
}

#[test]
fn refuses_what_the_ron_crate_refuses() {
    for text in BAD {
        assert!(both(text).is_none(), "both accept {text:?}");
    }
}

#[test]
fn every_cut_of_a_file_is_judged_as_the_ron_crate_does() {
    let text = include_str!("../../tests/models/everything.ron");
    let (ours, theirs) = both(text).expect("a good file");
    agree(&ours, &theirs, "everything");
    let cuts = (0..text.len()).filter(|&cut| text.is_char_boundary(cut));
    for cut in cuts.step_by(7) {
        both(&text[..cut]);
    }
}

#[test]
fn nodes_tell_where_they_stand() {
    let text = "(a: [(1, 2),\n (3, 4)], b: Some(5))";
    let Value::Struct(_, fields) = parse(text).unwrap().value else { panic!() };
    assert_eq!(fields[0].at, 1);
    let Value::Rows(rows) = &fields[0].value.value else { panic!("{:?}", fields[0]) };
    assert_eq!(rows.at, [5, 14]);
    assert_eq!(rows.row(1), [3.0, 4.0]);
    assert_eq!((fields[1].at, fields[1].value.at), (23, 26));
}

#[test]
fn deep_nesting_is_refused_before_the_stack_ends() {
    for (open, close) in [("[", "]"), ("(", ")"), ("(a: ", ")"), ("{1: ", "}"), ("Some(", ")")] {
        let deep = format!("{}1{}", open.repeat(100_000), close.repeat(100_000));
        assert_eq!(parse(&deep).unwrap_err().rule, "too-deep", "{open}");
        let fair = format!("{}1{}", open.repeat(100), close.repeat(100));
        assert!(parse(&fair).is_ok(), "{open}");
    }
}
