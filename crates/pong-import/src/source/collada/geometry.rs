//! Meshes of Collada: positions and elements.

use super::super::faces::{Bent, add_face, weld};
use super::super::tree::Shape;
use super::reader::{Reader, child, children};
use crate::findings::{Finding, Findings};
use nalgebra::Vector3;
use roxmltree::Node as Element;

/// Layout of a list of elements: source of positions, and offsets.
struct Layout {
    places: Vec<Vector3<f64>>,
    /// Offset of the position among the numbers of a corner, and their count.
    offset: usize,
    stride: usize,
}

/// A geometry in the axes and units of the model; faults are noted.
pub(super) fn shape<'a>(
    reader: &Reader<'a>,
    geometry: Element<'a, 'a>,
    findings: &mut Findings,
) -> Option<Shape> {
    let Some(mesh) = child(geometry, "mesh") else {
        let cause = "it is no mesh: convex meshes, splines and solids are not read";
        return findings.refuse(&reader.place(geometry), "free-form", cause, "export triangles");
    };
    let mut shape = Shape::default();
    let mut bent = Bent::default();
    for list in mesh.children().filter(Element::is_element) {
        let read = elements(reader, list, &mut shape, (&mut bent, findings));
        findings.ok(read)?;
    }
    bent.note(findings);
    weld(&mut shape);
    Some(shape)
}

/// Adds the triangles or lines of one list.
fn elements<'a>(
    reader: &Reader<'a>,
    list: Element<'a, 'a>,
    shape: &mut Shape,
    (bent, findings): (&mut Bent, &mut Findings),
) -> Result<(), Finding> {
    let kind = list.tag_name().name();
    let known = ["triangles", "polylist", "polygons", "trifans", "tristrips", "lines", "linestrips"];
    if !known.contains(&kind) {
        return Ok(());
    }
    if children(list, "ph").next().is_some() {
        let cause = "a polygon with holes".to_owned();
        let cure = "triangulate it where it was made".to_owned();
        return Err(Finding { path: reader.place(list), rule: "face-not-cut", cause, cure });
    }
    if list.attribute("count") == Some("0") || child(list, "p").is_none() {
        return Ok(());
    }
    let layout = layout(reader, list)?;
    let first = shape.vertices.len() as u32;
    shape.vertices.extend(&layout.places);
    let counts = match (kind, child(list, "vcount")) {
        ("polylist", Some(counts)) => Some(integers(reader, counts)?),
        ("polylist", None) => return Err(reader.damaged(list, "a <polylist> has no <vcount>".to_owned())),
        _ => None,
    };
    for p in children(list, "p") {
        let corners = corners(reader, p, &layout, first)?;
        match kind {
            "triangles" => {
                let (whole, rest) = corners.as_chunks::<3>();
                if !rest.is_empty() {
                    return Err(reader.damaged(p, format!("{} corners are no triangles", corners.len())));
                }
                shape.triangles.extend(whole);
            }
            "polygons" => polygon(reader, p, shape, &corners, (bent, findings))?,
            "polylist" => {
                let mut rest = corners.as_slice();
                for &count in counts.iter().flatten() {
                    let Some((face, behind)) = rest.split_at_checked(count) else {
                        let cause =
                            format!("its faces have more corners than its <p>, which has {}", corners.len());
                        return Err(reader.damaged(p, cause));
                    };
                    polygon(reader, p, shape, face, (bent, findings))?;
                    rest = behind;
                }
                if !rest.is_empty() {
                    return Err(reader.damaged(p, format!("{} corners belong to no face", rest.len())));
                }
            }
            "trifans" => {
                shape.triangles.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
            }
            "tristrips" => shape.triangles.extend(
                corners
                    .windows(3)
                    .enumerate()
                    .map(|(k, t)| if k.is_multiple_of(2) { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] }),
            ),
            "lines" => shape.lines.extend(corners.as_chunks::<2>().0),
            _ => shape.lines.extend(corners.windows(2).map(|pair| [pair[0], pair[1]])),
        }
    }
    Ok(())
}

fn polygon<'a>(
    reader: &Reader<'a>,
    p: Element<'a, 'a>,
    shape: &mut Shape,
    face: &[u32],
    (bent, findings): (&mut Bent, &mut Findings),
) -> Result<(), Finding> {
    if face.len() < 3 {
        return Err(reader.damaged(p, format!("a face of {} corners", face.len())));
    }
    add_face(shape, face, &reader.place(p), bent, findings);
    Ok(())
}

/// Vertex numbers of the corners of one `<p>`.
fn corners<'a>(
    reader: &Reader<'a>,
    p: Element<'a, 'a>,
    layout: &Layout,
    first: u32,
) -> Result<Vec<u32>, Finding> {
    let numbers = integers(reader, p)?;
    if !numbers.len().is_multiple_of(layout.stride) {
        let cause = format!("{} numbers are no corners of {} each", numbers.len(), layout.stride);
        return Err(reader.damaged(p, cause));
    }
    let vertex = |corner: &[usize]| {
        let index = corner[layout.offset];
        if index >= layout.places.len() {
            let cause = format!("there is no vertex {index} among {}", layout.places.len());
            return Err(reader.damaged(p, cause));
        }
        Ok(first + index as u32)
    };
    numbers.chunks_exact(layout.stride).map(vertex).collect()
}

fn integers<'a>(reader: &Reader<'a>, element: Element<'a, 'a>) -> Result<Vec<usize>, Finding> {
    let words = element.text().unwrap_or("").split_ascii_whitespace();
    words
        .map(|word| word.parse().map_err(|_| reader.damaged(element, format!("`{word}` is no whole number"))))
        .collect()
}

fn layout<'a>(reader: &Reader<'a>, list: Element<'a, 'a>) -> Result<Layout, Finding> {
    let (mut stride, mut vertices) = (1, None);
    for input in children(list, "input") {
        let offset: usize = match input.attribute("offset").unwrap_or("0").trim().parse() {
            Ok(offset) if offset < 1000 => offset,
            _ => return Err(reader.damaged(input, "its offset is no small whole number".to_owned())),
        };
        stride = stride.max(offset + 1);
        if input.attribute("semantic") == Some("VERTEX") {
            vertices = Some((offset, reader.linked(input, &["vertices"])?));
        }
    }
    let Some((offset, vertices)) = vertices else {
        return Err(reader.damaged(list, "it has no input of the semantic VERTEX".to_owned()));
    };
    let position = children(vertices, "input").find(|input| input.attribute("semantic") == Some("POSITION"));
    let position =
        position.ok_or_else(|| reader.damaged(vertices, "its vertices have no POSITION".to_owned()))?;
    let places = places(reader, reader.linked(position, &["source"])?)?;
    Ok(Layout { places, offset, stride })
}

/// Positions of a source, in the axes and units of the model.
fn places<'a>(reader: &Reader<'a>, source: Element<'a, 'a>) -> Result<Vec<Vector3<f64>>, Finding> {
    let damaged = |cause: &str| reader.damaged(source, cause.to_owned());
    let array = child(source, "float_array").ok_or_else(|| damaged("it has no <float_array>"))?;
    let words = array.text().unwrap_or("").split_ascii_whitespace();
    let number =
        |word: &str| word.parse().map_err(|_| reader.damaged(array, format!("`{word}` is no number")));
    let numbers: Vec<f64> = words.map(number).collect::<Result<_, _>>()?;
    let accessor = child(source, "technique_common").and_then(|technique| child(technique, "accessor"));
    let field = |name: &str, usual: usize| -> Result<usize, Finding> {
        let Some(text) = accessor.and_then(|accessor| accessor.attribute(name)) else { return Ok(usual) };
        text.trim().parse().map_err(|_| damaged("its <accessor> does not count in whole numbers"))
    };
    let (offset, stride) = (field("offset", 0)?, field("stride", 3)?);
    if stride < 3 {
        return Err(damaged("its positions are not three numbers each"));
    }
    let there = numbers.get(offset..).unwrap_or(&[]);
    let count = field("count", there.len() / stride)?;
    let promised = count.checked_mul(stride).and_then(|length| length.checked_sub(stride - 3));
    if count > 0 && promised.is_none_or(|length| length > there.len()) {
        let cause = format!("it promises {count} positions, and its array has {} numbers", numbers.len());
        return Err(reader.damaged(source, cause));
    }
    let place = |xyz: &[f64]| reader.up.turned(Vector3::new(xyz[0], xyz[1], xyz[2])) * reader.unit_m;
    Ok(there.chunks(stride).take(count).map(place).collect())
}
