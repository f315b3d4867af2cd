//! Bristle of a surface or a pair of surfaces, and its damping from a mass (docs/theory.md, 4).

use super::fields::Fields;
use super::law_values::either_or;
use super::reader::Reader;
use super::stiffness::finite_stiffness;
use crate::limits::LARGEST;
use crate::ron_tree::{Node, Value};
use crate::schema::{Friction, Kind};
use crate::surface::{FrictionLaw, Surface};

/// Values given next to a friction law.
#[derive(Clone, Copy)]
pub(super) struct Beside<'n> {
    /// Stiffness of the surface or pair; `None` if an entry of `pairs` gives none.
    pub(super) stiffness: Option<f64>,
    /// Normal law as written.
    pub(super) normal: Option<&'n Node>,
}

pub(super) fn bristle(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    (law, beside): (&Kind<Friction>, Beside<'_>),
) -> Option<FrictionLaw> {
    let fields = Fields::open(reader, node, path, &[law.fields])?;
    either_or(reader, &fields, path, "damping", "mass");
    let mu = fields.required(reader, "mu").and_then(|node| reader.not_negative(node, path, "mu"));
    let static_excess = match fields.optional("static_excess") {
        Some(node) => reader.not_negative(node, path, "static_excess"),
        None => Some(0.0),
    };
    let mut length = |name| match fields.optional(name) {
        Some(node) => reader.not_negative(node, path, name),
        None => Some(0.0),
    };
    let (rolling, spinning) = (length("rolling"), length("spinning"));
    let stiffness = match fields.optional("stiffness") {
        Some(node) => Some(finite_stiffness(reader, node, path, "the bristle's stiffness")?),
        None => None,
    };
    let k_t = stiffness.or(beside.stiffness.map(|k| Surface::BRISTLE_SHARE * k));
    let damping = match (fields.optional("damping"), fields.optional("mass")) {
        (Some(node), _) => Some(reader.not_negative(node, path, "damping")?),
        (None, Some(node)) => Some(damping_of_mass(reader, node, path, k_t)?),
        (None, None) => match (beside.normal.and_then(named_mass), k_t) {
            (Some(mass), Some(k_t)) if k_t.is_finite() => Some(critical(reader, node, path, (k_t, mass))?),
            _ => None,
        },
    };
    let (mu, static_excess) = (mu?, static_excess?);
    Some(FrictionLaw::Bristle {
        mu,
        static_excess,
        stiffness,
        damping,
        rolling: rolling?,
        spinning: spinning?,
    })
}

/// Mass that a normal law gives in its `restitution`. Its faults are reported where the law is read.
fn named_mass(law: &Node) -> Option<f64> {
    let restitution = Fields::peek(law)?.optional("restitution")?;
    match Fields::peek(restitution)?.optional("mass")?.value {
        Value::Number(mass) if mass > 0.0 && mass <= LARGEST => Some(mass),
        _ => None,
    }
}

/// Critical damping of the bristle for the mass given in its own fields.
fn damping_of_mass(reader: &mut Reader<'_>, node: &Node, path: &str, k_t: Option<f64>) -> Option<f64> {
    let mass = reader.positive(node, path, "the mass")?;
    match k_t {
        Some(k_t) if k_t.is_finite() => critical(reader, node, path, (k_t, mass)),
        Some(_) => {
            let cause = "a rigid surface has no bristle that a mass could damp";
            let cure = "name the mass on the softer surface or in `pairs`, or give the bristle a `stiffness`";
            reader.refuse(node.at, path, "mass-of-rigid", cause, cure)
        }
        None => {
            let cause = "the damping for a mass needs the stiffness of the bristle or of the pair";
            let cure = "add `stiffness: …` to this entry or to its bristle";
            reader.refuse(node.at, path, "mass-without-stiffness", cause, cure)
        }
    }
}

/// Critical damping c_t = 2·√(k_t·m).
fn critical(reader: &mut Reader<'_>, node: &Node, path: &str, (k_t, mass): (f64, f64)) -> Option<f64> {
    let damping = 2.0 * (k_t * mass).sqrt();
    if damping <= LARGEST {
        return Some(damping);
    }
    let cause =
        format!("a mass of {mass:e} kg on a bristle of {k_t:e} N/m makes a damping beyond {LARGEST:e} N·s/m");
    reader.refuse(node.at, path, "damping-range", cause, "give a smaller mass or stiffness, or a `damping`")
}
