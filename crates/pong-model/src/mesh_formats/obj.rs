//! OBJ: faces of any number of corners, lines and points. Normals, texture coordinates and materials are
//! ignored.

use super::text::{FormatFault, decoded, lines, marked, quoted, words};
use std::borrow::Cow;

/// Contents of an OBJ file.
#[derive(Debug, Default)]
pub struct Obj {
    pub places: Vec<[f64; 3]>,
    /// Objects and groups with faces, in file order.
    pub objects: Vec<ObjObject>,
    /// Vertices of lines and points of all objects.
    pub lines: Vec<[u32; 2]>,
    pub points: Vec<u32>,
    /// Number of faces of fewer than three corners, which are skipped.
    pub without_area: usize,
}

/// Faces of one object or group.
#[derive(Debug, Default)]
pub struct ObjObject {
    /// Name after `o` or `g`; empty if there is none.
    pub name: String,
    /// Vertex indices, face after face.
    pub corners: Vec<u32>,
    /// End of each face in `corners`.
    pub ends: Vec<u32>,
}

impl ObjObject {
    /// Corners of each face.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.corners[start as usize..end as usize])
    }
}

/// Reads an OBJ file.
///
/// # Errors
/// Damaged content, or curves and surfaces other than faces; with the line.
pub fn obj(bytes: &[u8]) -> Result<Obj, FormatFault> {
    let mut found = Obj::default();
    let mut object = ObjObject::default();
    for (number, line) in whole_lines(marked(bytes)?) {
        let content = line.split(|&byte| byte == b'#').next().unwrap_or(b"");
        let mut words = words(content);
        match words.next().unwrap_or(b"") {
            b"v" => found.places.push(place(number, &mut words)?),
            b"f" => {
                for word in words {
                    object.corners.push(index(number, word, found.places.len())?);
                }
                let before = object.ends.last().map_or(0, |&end| end as usize);
                if object.corners.len() - before < 3 {
                    found.without_area += 1;
                    object.corners.truncate(before);
                } else {
                    object.ends.push(object.corners.len() as u32);
                }
            }
            b"o" | b"g" => {
                let name = decoded(content.trim_ascii_start()[1..].trim_ascii()).into_owned();
                let before = std::mem::replace(&mut object, ObjObject { name, ..ObjObject::default() });
                found.objects.extend(Some(before).filter(|before| !before.ends.is_empty()));
            }
            keyword @ (b"l" | b"p") => {
                let count = found.places.len();
                let chain = words.map(|word| index(number, word, count)).collect::<Result<Vec<_>, _>>()?;
                match keyword {
                    b"l" => found.lines.extend(chain.windows(2).map(|pair| [pair[0], pair[1]])),
                    _ => found.points.extend(chain),
                }
            }
            keyword @ (b"curv" | b"curv2" | b"surf" | b"cstype") => {
                let cause = format!("{}: free-form curves and surfaces are not read", quoted(keyword));
                let cure = "export plain faces, lines and points";
                return Err(FormatFault { line: number, rule: "free-form", cause, cure });
            }
            _ => {}
        }
    }
    found.objects.extend(Some(object).filter(|object| !object.ends.is_empty()));
    Ok(found)
}

/// Joined lines with the number of their first part: a backslash at the end continues a line on the next one.
fn whole_lines(bytes: &[u8]) -> impl Iterator<Item = (usize, Cow<'_, [u8]>)> {
    let mut lines = lines(bytes);
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let mut whole = Cow::Borrowed(line);
        while let Some(part) = continued(&whole) {
            let mut joined = whole[..part].to_vec();
            joined.push(b' ');
            joined.extend_from_slice(lines.next().map_or(&b""[..], |(_, next)| next));
            whole = Cow::Owned(joined);
        }
        Some((number, whole))
    })
}

/// Length of a line before the backslash that continues it. Names of materials and files may end with a
/// backslash.
fn continued(line: &[u8]) -> Option<usize> {
    let text = line.trim_ascii_end();
    let keyword = words(text).next()?;
    let takes_numbers = matches!(keyword, b"v" | b"f" | b"l" | b"p" | b"vn" | b"vt" | b"vp");
    (text.ends_with(b"\\") && takes_numbers).then(|| text.len() - 1)
}

fn place<'a>(number: usize, words: &mut impl Iterator<Item = &'a [u8]>) -> Result<[f64; 3], FormatFault> {
    let mut place = [0.0; 3];
    for x in &mut place {
        let word = words.next().unwrap_or(b"");
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        *x = value.ok_or_else(|| {
            FormatFault::damaged(number, format!("{} is no coordinate of a vertex", quoted(word)))
        })?;
    }
    Ok(place)
}

/// Vertex that a word `7`, `7/1/2` or `-1` refers to, among those read so far.
fn index(number: usize, word: &[u8], count: usize) -> Result<u32, FormatFault> {
    let digits = word.split(|&byte| byte == b'/').next().unwrap_or(b"");
    let named: Option<i64> = std::str::from_utf8(digits).ok().and_then(|digits| digits.parse().ok());
    let named = named
        .ok_or_else(|| FormatFault::damaged(number, format!("{} is no number of a vertex", quoted(word))))?;
    let index = if named < 0 { count as i64 + named } else { named - 1 };
    match u32::try_from(index) {
        Ok(index) if (index as usize) < count => Ok(index),
        _ => {
            let cause = match named {
                0 => "there is no vertex 0: vertices count from 1".to_owned(),
                _ => format!("there is no vertex {named} among the {count} before this line"),
            };
            Err(FormatFault::damaged(number, cause))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Name of an object, and the corner positions of its faces.
    type Named = (String, Vec<Vec<[f64; 3]>>);

    fn read(bytes: &[u8]) -> Result<Vec<Named>, FormatFault> {
        let found = obj(bytes)?;
        let face = |face: &[u32]| face.iter().map(|&v| found.places[v as usize]).collect();
        Ok(found
            .objects
            .iter()
            .map(|object| (object.name.clone(), object.faces().map(face).collect()))
            .collect())
    }

    const PLACES: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

    #[test]
    fn lines_of_all_kinds_are_read() {
        let triangle = vec![vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
        let cases = [
            (format!("{PLACES}f 1 2 3\n"), ""),
            (format!("mtllib a.mtl\nusemtl \ng\ns off\n{PLACES}f 1 2 3"), ""),
            (format!("o left/part \n{PLACES}f 1/7 2//3 3/1/2\n"), "left/part"),
            (format!("{PLACES}f 1 \\\n 2 \\\r\n3\n"), ""),
            (format!("usemtl C:\\\n{PLACES}f 1 2 3\n"), ""),
            (format!("# first\n{PLACES}f 1 2 3 # the only face\n"), ""),
            (format!("{PLACES}f -3 -2 -1\n").replace(' ', "\t").replace('\n', "\r"), ""),
            ("v 0 0 0 1.0\nv +1. .0 0.e0 0.5 0.5 0.5\n v 0 1E0 0\n f 1 2 3".to_owned(), ""),
            (format!("\u{feff}{PLACES}f 1 2 3\n"), ""),
        ];
        for (text, name) in cases {
            assert_eq!(read(text.as_bytes()), Ok(vec![(name.to_owned(), triangle.clone())]), "{text}");
        }
        let latin: Vec<u8> = [b"o pi\xe8ce\n", PLACES.as_bytes(), b"f 1 2 3\n"].concat();
        assert_eq!(read(&latin).unwrap()[0].0, "pièce");
    }

    #[test]
    fn objects_lines_and_points_are_kept_apart() {
        let text = format!("{PLACES}o a\nf 1 2 3\no empty\nf 1 2\ng b\nf 3 2 1\nf 1 2 3 2\nl 1 2 3\np -1\n");
        let found = obj(text.as_bytes()).unwrap();
        let counts: Vec<(&str, usize)> =
            found.objects.iter().map(|o| (o.name.as_str(), o.ends.len())).collect();
        assert_eq!(counts, [("a", 1), ("b", 2)]);
        assert_eq!((found.lines, found.points, found.without_area), (vec![[0, 1], [1, 2]], vec![2], 1));
    }

    #[test]
    fn damage_is_told_with_its_line() {
        let told = |text: &str, line: usize, words: &str| {
            let fault = obj(text.as_bytes()).unwrap_err();
            assert!(fault.line == line && fault.cause.contains(words), "{text}: {fault:?}");
        };
        told(&format!("{PLACES}f 1 2 99\n"), 4, "no vertex 99 among the 3");
        told(&format!("{PLACES}f 0 1 2\n"), 4, "count from 1");
        told(&format!("{PLACES}f 1 2 -4\n"), 4, "no vertex -4");
        told(&format!("{PLACES}f 1 \\\n2 x\n"), 4, "`x`");
        told("v 0 0 0\r\nv 1 0,5 0\r\n", 2, "`0,5`");
        told("v 0 0 0\rv 1 0\r", 2, "``");
        told("v 0 0 0\n\n  curv 0 1 1\n", 3, "free-form");
        told("v 0 0 0\nl 1 7\n", 2, "no vertex 7");
        assert!(obj(b"\xff\xfev\0 \0").unwrap_err().cause.contains("UTF-16"));
    }
}
