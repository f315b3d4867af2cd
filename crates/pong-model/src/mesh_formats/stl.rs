//! STL: binary files, and text files with any number of solids.

use super::text::{FormatFault, decoded, lines, marked, quoted, words};
use std::borrow::Cow;

/// Size of a binary STL file's header before its first triangle, bytes.
pub const STL_HEAD: usize = 84;
/// Size of a triangle in a binary STL file, bytes.
pub const STL_TRIANGLE: usize = 50;

/// Contents of an STL file except its triangles.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Stl {
    /// Names of the solids in file order; one empty name for a binary file.
    pub solids: Vec<String>,
    /// True if a text file ends without `endsolid`.
    pub unfinished: bool,
}

/// Reads a binary or a text file and passes the number of the solid and the corners of each triangle to
/// `each`.
///
/// # Errors
/// Damaged content, with the line of a text file.
pub fn stl(bytes: &[u8], mut each: impl FnMut(usize, [[f32; 3]; 3])) -> Result<Stl, FormatFault> {
    // Some programs begin binary files with "solid", the mark of text files: the length tells them apart.
    if promised_length(bytes) == Some(bytes.len()) {
        return binary(bytes, each);
    }
    let text = marked(bytes)?;
    if is_text(text) { Reader::default().read(text, &mut each) } else { binary(bytes, each) }
}

/// Length of a binary file computed from the number of triangles in its header.
fn promised_length(bytes: &[u8]) -> Option<usize> {
    let count = u32::from_le_bytes(*bytes.get(80..)?.first_chunk()?);
    (count as usize).checked_mul(STL_TRIANGLE)?.checked_add(STL_HEAD)
}

/// Returns `true` if a file begins with the keyword of a text file and has no zero byte where a binary file
/// has its number of triangles.
fn is_text(bytes: &[u8]) -> bool {
    let first = words(bytes).next().unwrap_or(b"");
    let starts =
        |keyword: &[u8]| first.len() >= keyword.len() && first[..keyword.len()].eq_ignore_ascii_case(keyword);
    let zero = bytes.iter().take(STL_HEAD).any(|&byte| byte == 0);
    !zero && (starts(b"solid") || starts(b"facet") || first.starts_with(b";") || first.starts_with(b"#"))
}

fn binary(bytes: &[u8], mut each: impl FnMut(usize, [[f32; 3]; 3])) -> Result<Stl, FormatFault> {
    let damaged = |cause: String| FormatFault::damaged(0, cause);
    let length = promised_length(bytes).ok_or_else(|| {
        damaged(format!("it is neither text nor long enough for a binary file: {} bytes", bytes.len()))
    })?;
    let triangles = bytes[STL_HEAD..].chunks_exact(STL_TRIANGLE);
    let (there, promised) = (triangles.len(), (length - STL_HEAD) / STL_TRIANGLE);
    if there < promised {
        let cause = format!("it ends before its last triangle: it has {there} of {promised}");
        return Err(damaged(cause));
    }
    for triangle in triangles.take(promised) {
        let (corners, _) = triangle[12..48].as_chunks::<12>();
        let number = |bytes: &[u8; 12], k: usize| {
            f32::from_le_bytes([bytes[4 * k], bytes[4 * k + 1], bytes[4 * k + 2], bytes[4 * k + 3]])
        };
        each(0, [0, 1, 2].map(|corner| [0, 1, 2].map(|k| number(&corners[corner], k))));
    }
    Ok(Stl { solids: vec![String::new()], unfinished: false })
}

/// State of reading a text file.
#[derive(Default)]
struct Reader {
    found: Stl,
    /// True between `solid` and `endsolid`.
    in_solid: bool,
    /// Line of the open facet; 0 between facets.
    facet: usize,
    corners: Vec<[f32; 3]>,
}

impl Reader {
    fn read(mut self, text: &[u8], each: &mut impl FnMut(usize, [[f32; 3]; 3])) -> Result<Stl, FormatFault> {
        for (number, line) in lines(text) {
            self.line(number, line, each)?;
        }
        if self.facet > 0 {
            let cause = "it ends within the facet that begins here".to_owned();
            return Err(FormatFault::damaged(self.facet, cause));
        }
        self.found.unfinished = self.in_solid;
        Ok(self.found)
    }

    fn line(
        &mut self,
        number: usize,
        line: &[u8],
        each: &mut impl FnMut(usize, [[f32; 3]; 3]),
    ) -> Result<(), FormatFault> {
        let mut words = words(line);
        while let Some(word) = words.next() {
            match word.to_ascii_lowercase().as_slice() {
                b"vertex" => self.vertex(number, &mut words)?,
                b"facet" => {
                    self.open_facet(number)?;
                    // Normals are recomputed from the corners; some programs write `nan` here.
                    words.by_ref().take_while(|word| !word.eq_ignore_ascii_case(b"outer")).for_each(drop);
                }
                b"outer" | b"loop" | b"endloop" | b"normal" => {}
                b"endfacet" => self.close_facet(number, each)?,
                b"solid" => {
                    self.between_facets(number)?;
                    let name: Vec<Cow<'_, str>> = words.map(decoded).collect();
                    self.open_solid(&name.join(" "));
                    return Ok(());
                }
                b"endsolid" => {
                    self.between_facets(number)?;
                    self.in_solid = false;
                    return Ok(());
                }
                // Comments, and `end facet` and `color …` as some programs write them.
                b"end" => {
                    let what = words.next().unwrap_or(b"").to_ascii_lowercase();
                    match what.as_slice() {
                        b"facet" => self.close_facet(number, each)?,
                        b"solid" => {
                            self.in_solid = false;
                            return Ok(());
                        }
                        _ => {}
                    }
                }
                b"color" => return Ok(()),
                other if other.starts_with(b";") || other.starts_with(b"#") || other.starts_with(b"//") => {
                    return Ok(());
                }
                _ => {
                    let cause = format!("{} is no keyword of a text STL file", quoted(word));
                    return Err(FormatFault::damaged(number, cause));
                }
            }
        }
        Ok(())
    }

    fn between_facets(&self, number: usize) -> Result<(), FormatFault> {
        if self.facet == 0 {
            return Ok(());
        }
        let cause = format!("the facet that begins in line {} has no `endfacet`", self.facet);
        Err(FormatFault::damaged(number, cause))
    }

    fn open_solid(&mut self, name: &str) {
        self.in_solid = true;
        self.found.solids.push(name.to_owned());
    }

    fn open_facet(&mut self, number: usize) -> Result<(), FormatFault> {
        self.between_facets(number)?;
        if !self.in_solid {
            self.open_solid("");
        }
        self.facet = number;
        Ok(())
    }

    fn vertex<'a>(
        &mut self,
        number: usize,
        words: &mut impl Iterator<Item = &'a [u8]>,
    ) -> Result<(), FormatFault> {
        let mut place = [0.0; 3];
        for x in &mut place {
            let word = words.next().unwrap_or(b"");
            let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
            *x = value.ok_or_else(|| {
                let cause = format!("{} is no coordinate of a vertex", quoted(word));
                FormatFault::damaged(number, cause)
            })?;
        }
        match (self.facet, self.corners.len()) {
            (0, _) => Err(FormatFault::damaged(number, "a vertex outside of a facet".to_owned())),
            (_, 3) => {
                let cause = "a fourth vertex in a facet, which is a triangle".to_owned();
                Err(FormatFault { cure: "export triangles", ..FormatFault::damaged(number, cause) })
            }
            _ => {
                self.corners.push(place);
                Ok(())
            }
        }
    }

    fn close_facet(
        &mut self,
        number: usize,
        each: &mut impl FnMut(usize, [[f32; 3]; 3]),
    ) -> Result<(), FormatFault> {
        let Ok(corners) = <[[f32; 3]; 3]>::try_from(self.corners.as_slice()) else {
            let cause = format!("a facet of {} vertices instead of three", self.corners.len());
            return Err(FormatFault::damaged(number, cause));
        };
        self.corners.clear();
        self.facet = 0;
        each(self.found.solids.len() - 1, corners);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACET: &str =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

    fn read(bytes: &[u8]) -> Result<(Vec<String>, Vec<usize>, bool), FormatFault> {
        let mut of = Vec::new();
        let found = stl(bytes, |solid, corners| {
            assert_eq!(corners, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
            of.push(solid);
        })?;
        Ok((found.solids, of, found.unfinished))
    }

    fn one(name: &str) -> Result<(Vec<String>, Vec<usize>, bool), FormatFault> {
        Ok((vec![name.to_owned()], vec![0], false))
    }

    #[test]
    fn heads_of_all_kinds_are_read() {
        let upper = FACET.to_uppercase();
        let loose = FACET.replace(' ', "\t ").replace('\n', "\r\n\r\n");
        let cases = [
            (format!("solid\n{FACET}endsolid\n"), ""),
            (format!("solid\tpart\n{FACET}endsolid\tpart\n"), "part"),
            (format!("SOLID Part\n{upper}ENDSOLID Part\n"), "Part"),
            (format!("  \n   solid part\n{FACET}endsolid part   \n \n"), "part"),
            (format!("\u{feff}solid part\n{loose}endsolid"), "part"),
            (format!("solid my facet normal part\n{FACET}endsolid\n"), "my facet normal part"),
            (format!("; made by a program\nsolid part\n{FACET}; a comment\nendsolid\n"), "part"),
            (format!("solid part\n{}endsolid", FACET.replace("0 0 1", "-nan(ind) nan NaN")), "part"),
            (format!("solid part\n{}endsolid", FACET.replace("1 0 0", "1.0E+000 +.0e0 0.")), "part"),
            (format!("solid part\n{}endsolid", FACET.replace('\n', "\r")), "part"),
            (format!("solid part\n{}endsolid", FACET.replace('\n', " ")), "part"),
            (format!("solid part\n{}end solid", FACET.replace("endf", "end f")), "part"),
        ];
        for (text, name) in cases {
            assert_eq!(read(text.as_bytes()), one(name), "{text}");
        }
        let latin: Vec<u8> = [b"solid pi\xe8ce\n", FACET.as_bytes(), b"endsolid\n"].concat();
        assert_eq!(read(&latin), one("pièce"));
    }

    #[test]
    fn every_solid_is_read() {
        let text = format!(
            "solid none\nendsolid none\nsolid a\n{FACET}endsolid a\nsolid b\n{FACET}{FACET}endsolid b\n"
        );
        let names = ["none", "a", "b"].map(str::to_owned).to_vec();
        assert_eq!(read(text.as_bytes()), Ok((names, vec![1, 2, 2], false)));
        let (names, of, unfinished) = read(format!("solid a\n{FACET}solid b\n{FACET}").as_bytes()).unwrap();
        assert_eq!((names.len(), of, unfinished), (2, vec![0, 1], true));
    }

    #[test]
    fn damage_is_told_with_its_line() {
        let whole = format!("solid part\n{FACET}endsolid part\n");
        let told = |text: &str| {
            let fault = read(text.as_bytes()).unwrap_err();
            (fault.line, fault.cause)
        };
        let starts = |(line, cause): (usize, String), at: usize, words: &str| {
            assert!(line == at && cause.contains(words), "{line}: {cause}");
        };
        starts(told(&whole[..54]), 2, "ends within the facet");
        starts(told(&whole.replace("vertex 1 0 0", "vertex 1 x 0")), 5, "`x`");
        starts(told(&whole.replace("vertex 1 0 0", "vertex 1")), 5, "``");
        starts(told(&whole.replace("vertex 1 0 0\n", "")), 7, "2 vertices");
        starts(told(&whole.replace("endloop", "vertex 9 9 9\nendloop")), 7, "a fourth vertex");
        starts(told(&whole.replace("endfacet\n", "")), 8, "line 2");
        starts(told(&whole.replace("endfacet", "end\nwhat")), 9, "`what`");
        starts(told(&format!("{whole}vertex 0 0 0")), 10, "outside of a facet");
        assert!(read(b"\xff\xfes\0o\0l\0i\0d\0").unwrap_err().cause.contains("UTF-16"));
    }

    #[test]
    fn binary_files_may_begin_like_text() {
        let binary = |head: &[u8], count: u32| {
            let mut bytes = head.to_vec();
            bytes.resize(80, b' ');
            bytes.extend(count.to_le_bytes());
            bytes.extend([0; 12]);
            [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
                .iter()
                .for_each(|x| bytes.extend(x.to_le_bytes()));
            bytes.extend([0; 2]);
            bytes
        };
        for head in [&b"solid part"[..], b"", b"facet normal"] {
            assert_eq!(read(&binary(head, 1)), one(""));
            let cut = read(&binary(head, 2)).unwrap_err();
            assert!(cut.line == 0 && cut.cause.contains("1 of 2"), "{cut:?}");
        }
        assert!(read(b"").unwrap_err().cause.contains("0 bytes"));
    }
}
