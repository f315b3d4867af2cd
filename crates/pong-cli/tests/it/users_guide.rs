//! The files of docs/users_guide.md and of the short way in docs/modelling.md are written, their commands run, and
//! their output compared. `…` matches anything, and a line of it any number of lines.

use std::path::Path;
use std::process::Command;

const GUIDE: &str = include_str!("../../../../docs/users_guide.md");
const MODELLING: &str = include_str!("../../../../docs/modelling.md");

/// Fenced blocks: the words of the fence and the text.
fn blocks(page: &'static str) -> Vec<(Vec<&'static str>, &'static str)> {
    let fenced = page.split("\n```").skip(1).step_by(2);
    fenced
        .map(|block| {
            let (head, text) = block.split_once('\n').unwrap();
            (head.split(' ').collect(), text)
        })
        .collect()
}

/// True if a line of output agrees with the guide.
fn is_like(line: &str, shown: &str) -> bool {
    let mut rest = line;
    for (index, part) in shown.split('…').map(str::trim).enumerate() {
        match rest.find(part) {
            Some(at) if index > 0 || rest[..at].trim().is_empty() => rest = &rest[at + part.len()..],
            _ => return false,
        }
    }
    true
}

fn run(folder: &Path, block: &str) {
    let mut lines = block.lines();
    let command = lines.next().and_then(|line| line.strip_prefix("$ pong ")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pong"))
        .args(command.split(' '))
        .current_dir(folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    if !lines.clone().any(|shown| shown.trim() == "…") {
        assert_eq!(text.lines().count(), lines.clone().count(), "{text}");
    }
    let mut rest = text.lines();
    for shown in lines.filter(|shown| shown.trim() != "…") {
        assert!(rest.any(|line| is_like(line, shown)), "{command}: no line like `{shown}` here in\n{text}");
    }
}

#[test]
fn the_guide_shows_what_happens() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("users_guide");
    std::fs::create_dir_all(&folder).unwrap();
    let mut commands = 0;
    for (head, text) in blocks(GUIDE) {
        match head[..] {
            ["ron", file] => std::fs::write(folder.join(file), text).unwrap(),
            ["console"] => {
                run(&folder, text);
                commands += 1;
            }
            ["text"] | ["rust"] => {}
            _ => panic!("unknown block {head:?}"),
        }
    }
    assert_eq!(commands, 2);
    assert!(folder.join("slide_out/contacts.csv").exists());
    // The sliding distance in the guide's text.
    let states = std::fs::read_to_string(folder.join("slide_out/states.csv")).unwrap();
    let last = states.lines().rfind(|line| line.contains(",block,")).unwrap();
    let distance: f64 = last.split(',').nth(2).unwrap().parse().unwrap();
    assert!((distance - 1.0 / (2.0 * 0.3 * 9.81)).abs() < 2e-4, "{distance}");
}

/// Import, check, rest on a rail, two rails as one surface, a belt.
#[test]
fn the_short_way_shows_what_happens() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("short_way");
    // `pong join` replaces no file.
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let short_way = MODELLING.split("\n# Short or fast?").next().unwrap();
    let mut commands = Vec::new();
    for (head, text) in blocks(short_way) {
        match head[..] {
            ["ron" | "obj", file] => std::fs::write(folder.join(file), text).unwrap(),
            ["console"] => {
                run(&folder, text);
                commands.extend(text.split(' ').nth(2));
            }
            _ => panic!("unknown block {head:?}"),
        }
    }
    assert_eq!(commands, ["import", "import", "check", "run", "check", "join", "run", "run"]);
}
