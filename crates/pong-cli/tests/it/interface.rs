//! `pong interface` on the command line: files for structural models.

use crate::common;
use crate::common::pong;
use std::path::{Path, PathBuf};

const FEET: usize = 8;
const RADIUS: f64 = 0.5;
const K: f64 = 1e5;
/// Weight of 1 kg, N.
const P: f64 = 10.0;

/// A ring of 1 kg on eight feet of 1e5 N/m each, at rest in gravity of 10 m/s².
fn folder(test: &str) -> PathBuf {
    let feet: String = (0..FEET)
        .map(|foot| {
            let angle = std::f64::consts::TAU * foot as f64 / FEET as f64;
            let (x, y) = (RADIUS * angle.cos(), RADIUS * angle.sin());
            format!("Point(name: \"foot_{foot}\", position: ({x:?}, {y:?}, 0.0)),")
        })
        .collect();
    let ring = format!(
        r#"(format: "pong-model", version: 1, name: "ring",
        surfaces: {{ "soft": (stiffness: {K:?}, normal: Linear(damping: 400.0), friction: Bristle(mu: 0.5, damping: 10.0)) }},
        root: (name: "ring", surface: "soft", primitives: [{feet}]))"#
    );
    let folder = common::folder(&format!("interface/{test}"), &[]);
    std::fs::write(folder.join("ring.ron"), ring).unwrap();
    std::fs::write(
        folder.join("ground.ron"),
        r#"(format: "pong-model", version: 1, name: "ground",
        surfaces: { "stone": (stiffness: inf, friction: Bristle(mu: 0.5, damping: 10.0)) },
        root: (name: "ground", surface: "stone", primitives: [Plane(name: "floor", normal: (0, 0, 1), offset: 0)]))"#,
    )
    .unwrap();
    let scene = format!(
        r#"(format: "pong-scene", version: 1, name: "rest",
        models: {{ "ring": "ring.ron", "ground": "ground.ron" }},
        objects: [
            (name: "ring", model: "ring", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(0.1, 0.1, 0.2), position: (0.0, 0.0, {:?}))]),
            (name: "ground", model: "ground", bodies: [(motion: Fixed)])],
        pairs: [("ring", "ground")], gravity: (0.0, 0.0, -10.0), integrator: RungeKutta4, step: 1e-4, duration: 1.0)"#,
        -P / (FEET as f64 * K)
    );
    std::fs::write(folder.join("rest.ron"), scene).unwrap();
    folder
}

/// Rows of a CSV file: quantity, name and six numbers.
struct Rows(Vec<(String, String, Vec<f64>)>);

impl Rows {
    fn row(&self, quantity: &str, name: &str) -> &[f64] {
        &self.0.iter().find(|row| row.0 == quantity && row.1 == name).unwrap().2
    }

    /// The load of this component at which the first contact opens.
    fn opens(&self, component: usize) -> f64 {
        let loads = self.0.iter().filter(|row| row.0 == "opens").map(|row| row.2[component]);
        loads.into_iter().find(|load| *load > 0.0).unwrap()
    }
}

fn csv(path: &Path) -> Rows {
    let text = std::fs::read_to_string(path).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let row = |line: &str| {
        let parts: Vec<&str> = line.split('"').collect();
        let numbers = parts[2].split(',').skip(1).map(|value| value.parse().unwrap()).collect();
        (parts[0].trim_end_matches(',').to_owned(), parts[1].to_owned(), numbers)
    };
    Rows(rows.map(row).collect())
}

/// Fields of the cards of a bulk data file: a name of 8 characters; then four fields of 16 in a line with an asterisk,
/// eight of 8 in one without. Lines that begin with an asterisk go on with the card before.
fn cards(path: &Path) -> Vec<Vec<String>> {
    let mut cards: Vec<Vec<String>> = Vec::new();
    for line in std::fs::read_to_string(path).unwrap().lines().filter(|line| !line.starts_with('$')) {
        assert!(line.is_ascii() && line.len() <= 72, "{line}");
        let (name, rest) = line.split_at(8);
        let (width, count) = if name.contains('*') { (16, 4) } else { (8, 8) };
        let name = name.trim_end().trim_end_matches('*').to_owned();
        if !name.is_empty() {
            cards.push(vec![name]);
        }
        let card = cards.last_mut().unwrap();
        for field in 0..count {
            let cut = rest.get(field * width..).unwrap_or("");
            card.push(cut.get(..width).unwrap_or(cut).trim().to_owned());
        }
    }
    cards
}

fn real(field: &str) -> f64 {
    field.replace('D', "E").parse().unwrap_or_else(|_| panic!("`{field}` is no real number"))
}

/// Matrix of two grids of a DMIG: both halves of a symmetric matrix.
fn matrix(cards: &[Vec<String>], name: &str) -> [[f64; 12]; 12] {
    let mut matrix = [[0.0; 12]; 12];
    let place = |grid: &str, part: &str| {
        6 * (grid.parse::<usize>().unwrap() - 1) + part.parse::<usize>().unwrap() - 1
    };
    let mut columns = cards.iter().filter(|card| card[0] == "DMIG" && card[1] == name);
    let head = columns.next().unwrap();
    assert_eq!(head[2..6], ["0", "6", "2", "0"], "symmetric, real, double precision");
    for column in columns {
        let of = place(&column[2], &column[3]);
        for entry in column[5..].chunks(4).filter(|entry| !entry[0].is_empty()) {
            let on = place(&entry[0], &entry[1]);
            (matrix[on][of], matrix[of][on]) = (real(&entry[2]), real(&entry[2]));
        }
    }
    matrix
}

fn assert_near(value: f64, wanted: f64, tolerance: f64) {
    assert!((value / wanted - 1.0).abs() < tolerance, "{value} instead of {wanted}");
}

/// The ring lifts off at its weight P, and tilts at P·r/2.
#[test]
fn a_resting_ring_opens_at_its_weight_and_at_half_of_it_times_the_radius() {
    let folder = folder("ring");
    let call = ["interface", "rest.ron", "--of", "ring", "--on", "ground", "--out"];
    let (code, out, err) = pong(&folder, &[&call[..], &["ring.csv"]].concat());
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.starts_with("rest, at the start: `ring` on `ground`\n8 contacts (0 slipping)"), "{out}");
    let rows = csv(&folder.join("ring.csv"));
    assert_near(rows.row("K", "Fz")[2], FEET as f64 * K, 1e-9);
    assert_near(rows.row("K", "Mx")[3], FEET as f64 * K * RADIUS * RADIUS / 2.0, 1e-6);
    assert_near(rows.row("D", "Fz")[2], FEET as f64 * 400.0, 1e-9);
    assert_near(rows.row("preload", "")[2], P, 1e-9);
    assert_near(rows.opens(2), P, 1e-9);
    assert_near(rows.opens(3), P * RADIUS / 2.0, 1e-6);
    assert!(rows.0.iter().any(|row| row.0 == "slides" && row.1.contains("ring/ring/foot_")));
    assert!(out.contains("+Mx   2.5 N·m"), "{out}");
    assert!(out.contains("+Fz   10 N"), "{out}");
}

/// An independent reader of bulk data finds the matrices of the CSV file.
#[test]
fn cards_have_the_matrices_of_the_table() {
    let folder = folder("cards");
    for file in ["ring.csv", "ring.bdf"] {
        let call = ["interface", "rest.ron", "--of", "ring", "--on", "ground", "--out", file];
        assert_eq!(pong(&folder, &call).0, 0);
    }
    let (rows, cards) = (csv(&folder.join("ring.csv")), cards(&folder.join("ring.bdf")));
    let bush = cards.iter().find(|card| card[0] == "CBUSH").unwrap();
    assert_eq!(bush[1..9], ["1", "1", "1", "2", "", "", "", "0"]);
    let property = cards.iter().find(|card| card[0] == "PBUSH").unwrap();
    assert_eq!([&property[1], &property[2], &property[9], &property[10]], ["1", "K", "", "B"]);
    let grids: Vec<&str> =
        cards.iter().filter(|card| card[0] == "GRID").map(|card| card[1].as_str()).collect();
    assert_eq!(grids, ["1", "2"]);
    let names = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"];
    let half_of = |quantity: &str, i: usize, j: usize| {
        let of = |row: usize, column: usize| rows.row(quantity, names[row])[column];
        0.5 * (of(i, j) + of(j, i))
    };
    for (quantity, name, first) in [("K", "KIFACE", 3), ("D", "BIFACE", 11)] {
        let both = matrix(&cards, name);
        let most = (0..6).map(|i| half_of(quantity, i, i)).fold(0.0, f64::max);
        for i in 0..6 {
            assert!((real(&property[first + i]) - half_of(quantity, i, i)).abs() < 1e-8 * most);
            for j in 0..6 {
                let wanted = half_of(quantity, i, j);
                for (on, of, sign) in [(0, 0, 1.0), (6, 6, 1.0), (0, 6, -1.0), (6, 0, -1.0)] {
                    let found = both[on + i][of + j];
                    assert!(
                        (found - sign * wanted).abs() < 1e-8 * most,
                        "{name} {on} {of} {i} {j}: {found}, {wanted}"
                    );
                }
            }
        }
    }
}

/// A log gives the interface of the run that it holds.
#[test]
fn a_log_has_the_interface_of_its_run() {
    let folder = folder("log");
    let run = ["run", "rest.ron", "--quiet", "--every-step", "--log", "log"];
    assert_eq!(pong(&folder, &run).0, 0);
    let of = |source: &str, more: &[&str], file: &str| {
        let call = ["interface", source, "--of", "rin*", "--on", "ground", "--out", file];
        let (code, out, err) = pong(&folder, &[&call[..], more].concat());
        assert_eq!((code, err.as_str()), (0, ""), "{out}");
        csv(&folder.join(file))
    };
    let (scene, log) = (of("rest.ron", &["--at", "1.0"], "a.csv"), of("log", &[], "b.csv"));
    for row in ["Fx", "Fz", "My", "Mz"] {
        for (a, b) in scene.row("K", row).iter().zip(log.row("K", row)) {
            assert!((a - b).abs() < 1e-6 * K, "{row}: {a}, {b}");
        }
    }
}

#[test]
fn bodies_that_do_not_touch_or_do_not_exist_are_refused() {
    let folder = folder("refused");
    let raised = std::fs::read_to_string(folder.join("rest.ron"))
        .unwrap()
        .replace("0.0, 0.0, -1.25e-5", "0.0, 0.0, 1.0");
    std::fs::write(folder.join("apart.ron"), raised).unwrap();
    let cases = [
        (
            &["rest.ron", "--of", "ring", "--on", "moon"][..],
            1,
            "--on: there is no other body `moon`; there are ring, ground",
        ),
        (&["apart.ron", "--of", "ring", "--on", "ground"], 1, "the two sets do not touch each other"),
        (&["rest.ron", "--of", "ring", "--on", "ring"], 1, "a group is in both sets"),
        (&["rest.ron", "--of", "ring"], 2, "--on"),
    ];
    for (arguments, code, cause) in cases {
        let (ended, _, err) = pong(&folder, &[&["interface"], arguments].concat());
        assert_eq!(ended, code, "{arguments:?}: {err}");
        assert!(err.contains(cause), "{arguments:?}: {err}");
    }
}
