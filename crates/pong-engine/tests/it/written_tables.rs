//! The tables of the documents agree with the engine's tester table.

use pong_engine::has_tester;
use pong_geometry::primitive::PrimitiveKind;
use std::collections::BTreeSet;

fn kind(name: &str) -> PrimitiveKind {
    PrimitiveKind::ALL
        .into_iter()
        .find(|kind| kind.name() == name)
        .unwrap_or_else(|| panic!("no kind {name}"))
}

fn cells(line: &str) -> Vec<&str> {
    line.trim().trim_matches('|').split('|').map(str::trim).collect()
}

/// The table of docs/modelling.md has a dot for every tested pair of kinds, and no other.
#[test]
fn the_modelling_guide_shows_which_kinds_touch() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/modelling.md");
    let text = std::fs::read_to_string(path).expect("the modelling guide");
    let mut lines = text.lines().skip_while(|line| !line.starts_with("| | Plane |"));
    let head: Vec<PrimitiveKind> = cells(lines.next().expect("a table"))
        .iter()
        .skip(1)
        .map(|name| kind(name.split(',').next().unwrap()))
        .collect();
    let mut shown = BTreeSet::new();
    for line in lines.skip(1).take_while(|line| line.starts_with('|')) {
        let cells = cells(line);
        let a = kind(cells[0]);
        assert_eq!(cells.len(), head.len() + 1, "{line}");
        for (b, cell) in head.iter().zip(&cells[1..]) {
            let touch = has_tester(a, *b) || has_tester(*b, a);
            assert_eq!(*cell == "●", touch, "{} and {}", a.name(), b.name());
            shown.insert((a as usize, *b as usize));
            shown.insert((*b as usize, a as usize));
        }
    }
    for a in PrimitiveKind::ALL {
        for b in PrimitiveKind::ALL.into_iter().filter(|b| has_tester(a, *b)) {
            assert!(shown.contains(&(a as usize, b as usize)), "{} and {} are not shown", a.name(), b.name());
        }
    }
}
