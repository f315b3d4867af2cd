//! Transforms of Collada nodes: composed in the order of the file.

use super::reader::Reader;
use crate::affine::Affine;
use crate::findings::Finding;
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use roxmltree::Node as Element;

/// Transform from a node to its parent, in the axes and units of the file.
pub(super) fn of<'a>(reader: &Reader<'a>, node: Element<'a, 'a>) -> Result<Affine, Finding> {
    let mut whole = Affine::identity();
    for element in node.children().filter(Element::is_element) {
        let step = match element.tag_name().name() {
            "matrix" => matrix(reader, element)?,
            "translate" => {
                Affine { translation: numbers::<3>(reader, element)?.into(), ..Affine::identity() }
            }
            "scale" => linear(Matrix3::from_diagonal(&numbers::<3>(reader, element)?.into())),
            "rotate" => rotation(reader, element)?,
            other @ ("skew" | "lookat") => {
                let cause = format!("a node with a mesh has the transform <{other}>, which is not read");
                return Err(reader.damaged(element, cause));
            }
            _ => continue,
        };
        whole = whole.after(&step);
    }
    Ok(whole)
}

fn linear(linear: Matrix3<f64>) -> Affine {
    Affine { linear, ..Affine::identity() }
}

/// Rows of a matrix of four by four.
fn matrix<'a>(reader: &Reader<'a>, element: Element<'a, 'a>) -> Result<Affine, Finding> {
    let m = numbers::<16>(reader, element)?;
    if m[12..] != [0.0, 0.0, 0.0, 1.0] {
        return Err(reader.damaged(element, "its matrix is no affine transform".to_owned()));
    }
    let linear = Matrix3::new(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
    Ok(Affine { linear, translation: Vector3::new(m[3], m[7], m[11]) })
}

/// Axis and angle in degrees; quarter turns are exact.
fn rotation<'a>(reader: &Reader<'a>, element: Element<'a, 'a>) -> Result<Affine, Finding> {
    let [x, y, z, degrees] = numbers::<4>(reader, element)?;
    let axis = Vector3::new(x, y, z);
    if degrees == 0.0 {
        return Ok(Affine::identity());
    }
    let Some(axis) = Unit::try_new(axis, 0.0) else {
        return Err(reader.damaged(element, "it turns around an axis without direction".to_owned()));
    };
    let turn = Rotation3::from_axis_angle(&axis, degrees.to_radians()).into_inner();
    let exact = degrees % 90.0 == 0.0 && axis.iter().all(|x| *x == x.round());
    Ok(linear(if exact { turn.map(f64::round) } else { turn }))
}

fn numbers<'a, const N: usize>(reader: &Reader<'a>, element: Element<'a, 'a>) -> Result<[f64; N], Finding> {
    let words = element.text().unwrap_or("").split_ascii_whitespace();
    let all: Option<Vec<f64>> =
        words.map(|word| word.parse().ok().filter(|number: &f64| number.is_finite())).collect();
    all.and_then(|all| <[f64; N]>::try_from(all).ok()).ok_or_else(|| {
        let cause = format!("its <{}> is not {N} numbers", element.tag_name().name());
        reader.damaged(element, cause)
    })
}
