//! Tables of text. Control characters in cells are escaped, so that no name breaks a line.

use pong_model::printable;

/// A row of cells for each row; the heading goes first.
type Lines = Vec<Vec<String>>;

/// Heading and rows, printable.
fn lines(heading: &[&str], rows: &[Vec<String>]) -> Lines {
    let head = heading.iter().map(|title| (*title).to_owned()).collect();
    let cells = |row: &Vec<String>| row.iter().map(|cell| printable(cell).into_owned()).collect();
    std::iter::once(head).chain(rows.iter().map(cells)).collect()
}

/// Pads every cell to the width of its column, at least `least`: the first `left` columns to the left, the
/// others to the right. Returns the lines and the widths.
fn padded(lines: Lines, least: usize, left: usize) -> (Lines, Vec<usize>) {
    let count = lines.first().map_or(0, Vec::len);
    let width =
        |column: usize| lines.iter().map(|line| line[column].chars().count()).max().unwrap_or(0).max(least);
    let widths: Vec<usize> = (0..count).map(width).collect();
    let pad = |line: Vec<String>| {
        let cells = line.into_iter().zip(&widths).enumerate();
        let cell = |(column, (text, width)): (usize, (String, &usize))| {
            if column < left { format!("{text:<width$}") } else { format!("{text:>width$}") }
        };
        cells.map(cell).collect()
    };
    (lines.into_iter().map(pad).collect(), widths)
}

/// Table for a terminal: indented, the first column left-aligned, the others right-aligned.
pub fn aligned(heading: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &Vec<String>| format!("  {}\n", cells.join("   ").trim_end());
    padded(lines(heading, rows), 0, 1).0.iter().map(line).collect()
}

/// Table for a terminal: not indented, all columns left-aligned.
pub fn aligned_left(heading: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &Vec<String>| format!("{}\n", cells.join("  ").trim_end());
    padded(lines(heading, rows), 0, heading.len()).0.iter().map(line).collect()
}

/// Markdown table whose columns line up as text too: the first left-aligned, the others right-aligned.
pub fn markdown(heading: &[&str], rows: &[Vec<String>]) -> String {
    let (lines, widths) = padded(lines(heading, rows), 3, 1);
    let rule = |(column, width): (usize, &usize)| match column {
        0 => "-".repeat(width + 2),
        _ => format!("{}:", "-".repeat(width + 1)),
    };
    let rules: Vec<String> = widths.iter().enumerate().map(rule).collect();
    with_rule(&lines, &rules)
}

/// Markdown table of long cells, which do not line up.
pub fn markdown_of_prose(heading: &[&str], rows: &[Vec<String>]) -> String {
    with_rule(&lines(heading, rows), &vec!["---".to_owned(); heading.len()])
}

fn with_rule(lines: &[Vec<String>], rules: &[String]) -> String {
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rest: String = lines[1..].iter().map(line).collect();
    format!("{}|{}|\n{rest}", line(&lines[0]), rules.join("|"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cells: [&str; 2]) -> Vec<Vec<String>> {
        vec![cells.map(str::to_owned).to_vec()]
    }

    #[test]
    fn columns_line_up() {
        assert_eq!(aligned(&["a", "long"], &row(["é1", "2"])), "  a    long\n  é1      2\n");
        assert_eq!(aligned(&["a", "b"], &row(["x\ny", "2"])), "  a      b\n  x\\ny   2\n");
        assert_eq!(aligned_left(&["a", "long"], &row(["é12", "2"])), "a    long\né12  2\n");
    }

    #[test]
    fn markdown_has_a_rule_below_its_heading() {
        let padded = "| case |  s |\n".replace("  s", "   s");
        let expected = format!("{padded}|------|----:|\n| é1   | 2.5 |\n");
        assert_eq!(markdown(&["case", "s"], &row(["é1", "2.5"])), expected);
        assert_eq!(markdown_of_prose(&["a", "b"], &row(["x", "y"])), "| a | b |\n|---|---|\n| x | y |\n");
    }
}
