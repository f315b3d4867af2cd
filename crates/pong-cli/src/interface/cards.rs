//! Interface as NASTRAN cards: CBUSH and PBUSH with the diagonals, DMIG with whole symmetric matrices.

use super::tables::{About, SMALL, largest_off_diagonal, limit_lines, sides};
use pong_advise::LinearInterface;
use pong_engine::TangentMatrix;
use pong_model::printable;
use std::fmt::Write as _;

/// Share of the largest entry of a matrix up to which an entry is rounding.
const ROUNDING: f64 = 1e-15;
/// Longest line of a comment.
const WIDTH: usize = 80;

/// Grids 1 (first set) and 2 (second set) coincide at the reference point; the basic system has the axes of the interface.
pub(super) fn text(about: &About, interface: &LinearInterface) -> String {
    let mut text = String::new();
    comment(&mut text, &format!("{}: {}", printable(&about.source), sides(about)));
    let (position, q) = (interface.frame.position, interface.frame.orientation);
    comment(
        &mut text,
        &format!(
            "Grid 1 is the first set, grid 2 the second. Both are at the origin of `{}`, with its axes: there at {:e} {:e} {:e} m, quaternion w x y z {:e} {:e} {:e} {:e} in the common frame. Units N, m, rad, s.",
            about.reference, position.x, position.y, position.z, q.w, q.i, q.j, q.k
        ),
    );
    comment(&mut text, "The interface is linear until, beyond the preload, a load on grid 1:");
    limit_lines(interface).for_each(|line| comment(&mut text, &line));
    let (share, _) = largest_off_diagonal(interface);
    if share > SMALL {
        comment(
            &mut text,
            &format!(
                "The CBUSH leaves out off-diagonal stiffness of up to {share:.2} of the root of the diagonals."
            ),
        );
    }
    for grid in [1, 2] {
        let _ = writeln!(text, "{:<8}{grid:>16}{:>16}{}{}", "GRID*", "", large(0.0), large(0.0));
        let _ = writeln!(text, "{:<8}{}", "*", large(0.0));
    }
    let _ = writeln!(text, "{:<8}{:>8}{:>8}{:>8}{:>8}{:24}{:>8}", "CBUSH", 1, 1, 1, 2, "", 0);
    diagonal(&mut text, &interface.stiffness, &interface.damping);
    comment(&mut text, "Instead of CBUSH and PBUSH: K2GG = KIFACE and B2GG = BIFACE (symmetric parts)");
    matrix(&mut text, "KIFACE", &interface.stiffness);
    matrix(&mut text, "BIFACE", &interface.damping);
    text
}

/// A comment in lines of a card's width, in ASCII: readers of other characters differ.
fn comment(text: &mut String, comment: &str) {
    let comment: String = comment
        .chars()
        .map(|letter| match letter {
            '·' => '.',
            letter if letter.is_ascii() => letter,
            _ => '?',
        })
        .collect();
    let mut line = "$".to_owned();
    for word in comment.split_whitespace() {
        if line.len() + 1 + word.len() > WIDTH && line.len() > 1 {
            let _ = writeln!(text, "{line}");
            line = "$".to_owned();
        }
        line = line + " " + word;
    }
    let _ = writeln!(text, "{line}");
}

/// PBUSH in fields of 16 characters: four fields a line, after a field of 8.
fn diagonal(text: &mut String, stiffness: &TangentMatrix, damping: &TangentMatrix) {
    let of = |matrix: &TangentMatrix| -> [String; 6] { std::array::from_fn(|i| large(matrix[(i, i)])) };
    let (k, b) = (of(stiffness), of(damping));
    let _ = writeln!(text, "{:<8}{:>16}{:>16}{}{}", "PBUSH*", 1, "K", k[0], k[1]);
    let _ = writeln!(text, "{:<8}{}{}{}{}", "*", k[2], k[3], k[4], k[5]);
    let _ = writeln!(text, "{:<8}{:>16}{:>16}{}{}", "*", "", "B", b[0], b[1]);
    let _ = writeln!(text, "{:<8}{}{}{}{}", "*", b[2], b[3], b[4], b[5]);
}

/// Lower half of the symmetric matrix of both grids.
fn matrix(text: &mut String, name: &str, values: &TangentMatrix) {
    let _ = writeln!(text, "{:<8}{name:<8}{:>8}{:>8}{:>8}{:>8}", "DMIG", 0, 6, 2, 0);
    let symmetric = (values + values.transpose()) * 0.5;
    let least = ROUNDING * symmetric.amax();
    for column in 0..12 {
        let entries: Vec<usize> =
            (column..12).filter(|row| symmetric[(row % 6, column % 6)].abs() > least).collect();
        if entries.is_empty() {
            continue;
        }
        let (grid, part) = (1 + column / 6, 1 + column % 6);
        let _ = writeln!(text, "{:<8}{name:<16}{grid:>16}{part:>16}", "DMIG*");
        for row in entries {
            let sign = if column / 6 == row / 6 { 1.0 } else { -1.0 };
            let value = with_exponent(sign * symmetric[(row % 6, column % 6)], 'D');
            let _ = writeln!(text, "{:<8}{:>16}{:>16}{value}", "*", 1 + row / 6, 1 + row % 6);
        }
    }
}

/// A real number in a field of 16 characters.
fn large(value: f64) -> String {
    with_exponent(value, 'E')
}

/// Nine digits and an exponent with its sign: `E` for single precision, `D` for double.
fn with_exponent(value: f64, letter: char) -> String {
    let text = format!("{value:.8e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let sign = if exponent.starts_with('-') { "" } else { "+" };
    format!("{:>16}", format!("{digits}{letter}{sign}{exponent}"))
}
