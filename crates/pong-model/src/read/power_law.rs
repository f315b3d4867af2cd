//! Normal law k·δ^p + c·δ^q·δ' in a model file.

use super::fields::Fields;
use super::law_values::{either_or, exponent, not_rigid, restitution};
use super::reader::Reader;
use crate::limits::LARGEST;
use crate::restitution::{Impact, power_law_damping};
use crate::ron_tree::Node;
use crate::schema::{Field, Kind, Normal};
use crate::surface::{Exponent, NormalLaw};

/// Reads the law; `stiffness` is that of the surface or pair, if it could be read.
pub(super) fn power_law(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    (law, stiffness): (&Kind<Normal>, Option<f64>),
) -> Option<NormalLaw> {
    let fields = Fields::open(reader, node, path, &[law.fields])?;
    either_or(reader, &fields, path, "damping", "restitution");
    let exponent = fields.required(reader, "exponent").and_then(|node| exponent(reader, node, path));
    let damping_exponent = fields
        .required(reader, "damping_exponent")
        .and_then(|node| damping_exponent(reader, node, path, exponent));
    let powers = exponent.zip(damping_exponent);
    let damping = match (fields.optional("damping"), fields.optional("restitution")) {
        (Some(node), _) => reader.not_negative(node, path, "the damping"),
        (None, Some(node)) => damping_of(reader, node, path, (law.nested("restitution"), stiffness, powers)),
        (None, None) => Some(0.0),
    };
    let (exponent, damping_exponent) = powers?;
    Some(NormalLaw::PowerLaw { damping: damping?, exponent, damping_exponent })
}

/// Reads q, from 0 to p: below 0 the damping force would start at infinity; above p the contact would stick
/// at its last depth.
fn damping_exponent(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    exponent: Option<Exponent>,
) -> Option<f64> {
    let q = reader.number(node, path)?;
    let most = exponent?.value();
    if (0.0..=most).contains(&q) {
        return Some(q);
    }
    let cause = format!("the exponent of the damping is {q}");
    reader.refuse(
        node.at,
        path,
        "damping-exponent",
        cause,
        format!("it lies within 0 and the exponent {most:?}"),
    )
}

/// Computes c from a restitution at a speed and a mass.
fn damping_of(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    (table, stiffness, powers): (&'static [Field], Option<f64>, Option<(Exponent, f64)>),
) -> Option<f64> {
    let fields = Fields::open(reader, node, path, &[table])?;
    let e = fields.required(reader, "e").and_then(|node| restitution(reader, node, path));
    let speed = fields.required(reader, "speed").and_then(|node| reader.positive(node, path, "the speed"));
    let mass = fields.required(reader, "mass").and_then(|node| reader.positive(node, path, "the mass"));
    let impact = Impact { e: e?, speed: speed?, mass: mass? };
    let (exponent, damping_exponent) = powers?;
    let stiffness = not_rigid(reader, node, path, stiffness?)?;
    let damping = power_law_damping(stiffness, exponent.value(), damping_exponent, &impact);
    if damping <= LARGEST {
        return Some(damping);
    }
    let Impact { e, speed, mass } = impact;
    let cause = format!(
        "a restitution of {e:e} at {speed:e} m/s and {mass:e} kg makes a damping beyond {LARGEST:e} N·s/m^(1+q)"
    );
    reader.refuse(
        node.at,
        path,
        "restitution-range",
        cause,
        "give a larger restitution, or another speed or mass",
    )
}
