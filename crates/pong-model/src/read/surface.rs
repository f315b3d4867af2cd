//! Tables of surfaces and of pairs of surfaces.

use super::bristle::{Beside, bristle};
use super::fields::Fields;
use super::foundation::foundation;
use super::law_values::{either_or, exponent, not_rigid, restitution};
use super::power_law::power_law;
use super::reader::Reader;
use super::stiffness::{finite_stiffness, in_range};
use crate::limits::LARGEST;
use crate::restitution::{chi_for_restitution, zeta_for_restitution};
use crate::ron_tree::{Node, Value};
use crate::schema::{self, Field, Friction, Kind, Normal};
use crate::surface::{FrictionLaw, NormalLaw, PairOverride, Surface};
use std::collections::HashSet;

/// Reads the `surfaces` map, in file order.
pub(super) fn surfaces(reader: &mut Reader<'_>, node: &Node) -> Vec<Surface> {
    let Value::Map(entries) = &node.value else {
        let cause = format!("expected a map of surfaces, found {}", node.value.describe());
        reader.fault(node.at, "surfaces", "wrong-type", cause, "write { \"steel\": (stiffness: …), … }");
        return Vec::new();
    };
    let mut surfaces: Vec<Surface> = Vec::new();
    let mut names = HashSet::new();
    for (key, value) in entries {
        let Some(name) = reader.text(key, "surfaces") else { continue };
        let path = format!("surfaces/{name}");
        if name.is_empty() {
            reader.fault(key.at, &path, "empty-name", "a surface without a name", "name it");
        }
        if !names.insert(name.clone()) {
            let cause = format!("the surface \"{name}\" is defined twice");
            reader.fault(key.at, &path, "repeated-surface", cause, "keep one of them or rename one");
        }
        surfaces.push(surface(reader, value, name, &path));
    }
    surfaces
}

/// Reads a surface. A surface with faults still counts as defined, so that its users cause no second fault.
fn surface(reader: &mut Reader<'_>, node: &Node, name: String, path: &str) -> Surface {
    let mut surface = Surface {
        name,
        stiffness: 1.0,
        foundation: None,
        area: None,
        normal: NormalLaw::Linear { damping: 0.0, ramp: 0.0 },
        friction: FrictionLaw::None,
    };
    let Some(fields) = Fields::open(reader, node, path, &[schema::SURFACE]) else {
        return surface;
    };
    let stiffness = fields.required(reader, "stiffness").and_then(|node| stiffness(reader, node, path));
    surface.stiffness = stiffness.unwrap_or(1.0);
    if surface.stiffness.is_infinite() {
        // Laws not given below are taken from the other surface.
        (surface.normal, surface.friction) = (NormalLaw::Inherited, FrictionLaw::Inherited);
    }
    let normal = fields.optional("normal");
    if let Some(node) = normal {
        surface.normal = normal_law(reader, node, path, stiffness).unwrap_or(surface.normal);
    }
    foundation(reader, &fields, path, &mut surface);
    if let Some(node) = fields.literal("friction") {
        let beside = Beside { stiffness: Some(surface.stiffness), normal };
        surface.friction = friction_law(reader, node, path, beside).unwrap_or(FrictionLaw::None);
        if let Some((k_t, c_t)) = surface.bristle().filter(|(_, c_t)| *c_t > LARGEST) {
            let cause = format!("the damping of the normal law makes one of {c_t:e} N·s/m on {k_t:e} N/m");
            reader.fault(node.at, path, "damping-range", cause, "give the bristle a `damping`");
        }
    }
    surface
}

/// Reads a positive stiffness; infinite means rigid.
fn stiffness(reader: &mut Reader<'_>, node: &Node, path: &str) -> Option<f64> {
    let value = reader.any_number(node, path)?;
    if value == f64::INFINITY {
        return Some(value);
    }
    if value > 0.0 {
        return in_range(reader, node, path, value, "the stiffness", "; `inf` is rigid");
    }
    let rule = if value.is_nan() { "not-finite" } else { "not-positive" };
    reader.refuse(
        node.at,
        path,
        rule,
        format!("the stiffness is {value}"),
        "it must be above zero; `inf` is rigid",
    )
}

/// Reads a normal law; `known_stiffness` is that of the surface or pair, if it could be read.
fn normal_law(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    known_stiffness: Option<f64>,
) -> Option<NormalLaw> {
    let law = reader.kind(node, path, schema::NORMAL_LAWS)?;
    match law.tag {
        Normal::Linear => linear(reader, node, path, (law, known_stiffness)),
        Normal::HuntCrossley => hunt_crossley(reader, node, path, law),
        Normal::PowerLaw => power_law(reader, node, path, (law, known_stiffness)),
        Normal::Custom => {
            let (name, parameters) = custom(reader, node, path, law.fields)?;
            Some(NormalLaw::Custom { name, parameters })
        }
    }
}

fn linear(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    (law, stiffness): (&Kind<Normal>, Option<f64>),
) -> Option<NormalLaw> {
    let fields = Fields::open(reader, node, path, &[law.fields])?;
    either_or(reader, &fields, path, "damping", "restitution");
    let ramp = match fields.optional("ramp") {
        Some(node) => reader.not_negative(node, path, "the ramp")?,
        None => 0.0,
    };
    let damping = match (fields.optional("damping"), fields.optional("restitution")) {
        (Some(node), _) => reader.not_negative(node, path, "the damping")?,
        (None, Some(node)) => linear_damping(reader, node, path, (law.nested("restitution"), stiffness))?,
        (None, None) => 0.0,
    };
    Some(NormalLaw::Linear { damping, ramp })
}

/// Computes c = 2·ζ·√(k·m), with ζ from the law that never pulls.
fn linear_damping(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    (table, stiffness): (&'static [Field], Option<f64>),
) -> Option<f64> {
    let fields = Fields::open(reader, node, path, &[table])?;
    let e = fields.required(reader, "e").and_then(|node| restitution(reader, node, path));
    let mass = fields.required(reader, "mass").and_then(|node| reader.positive(node, path, "the mass"));
    let (e, mass, stiffness) = (e?, mass?, not_rigid(reader, node, path, stiffness?)?);
    let damping = 2.0 * zeta_for_restitution(e) * (stiffness * mass).sqrt();
    if damping <= LARGEST {
        return Some(damping);
    }
    let cause =
        format!("a mass of {mass:e} kg on {stiffness:e} N/m makes a damping beyond {LARGEST:e} N·s/m");
    reader.refuse(node.at, path, "restitution-range", cause, "give a smaller mass or stiffness")
}

fn hunt_crossley(reader: &mut Reader<'_>, node: &Node, path: &str, law: &Kind<Normal>) -> Option<NormalLaw> {
    let fields = Fields::open(reader, node, path, &[law.fields])?;
    either_or(reader, &fields, path, "dissipation", "restitution");
    let exponent = fields.required(reader, "exponent").and_then(|node| exponent(reader, node, path));
    let dissipation = match (fields.optional("dissipation"), fields.optional("restitution")) {
        (Some(node), _) => reader.not_negative(node, path, "the dissipation"),
        (None, Some(node)) => chi(reader, node, path, law.nested("restitution")),
        (None, None) => Some(0.0),
    };
    Some(NormalLaw::HuntCrossley { dissipation: dissipation?, exponent: exponent? })
}

fn chi(reader: &mut Reader<'_>, node: &Node, path: &str, table: &'static [Field]) -> Option<f64> {
    let fields = Fields::open(reader, node, path, &[table])?;
    let e = fields.required(reader, "e").and_then(|node| restitution(reader, node, path));
    let speed = fields.required(reader, "speed").and_then(|node| reader.positive(node, path, "the speed"));
    let (e, speed) = (e?, speed?);
    let chi = chi_for_restitution(e, speed);
    if chi <= LARGEST {
        return Some(chi);
    }
    let cause = format!("a restitution of {e:e} at {speed:e} m/s makes a dissipation beyond {LARGEST:e} s/m");
    reader.refuse(node.at, path, "restitution-range", cause, "give a larger restitution or speed")
}

fn friction_law(reader: &mut Reader<'_>, node: &Node, path: &str, beside: Beside<'_>) -> Option<FrictionLaw> {
    let node = match &node.value {
        Value::Tuple(Some(name), items) if name.as_ref() == "Some" && items.len() == 1 => &items[0],
        _ => node,
    };
    let law = reader.kind(node, path, schema::FRICTION_LAWS)?;
    match law.tag {
        Friction::None => Some(FrictionLaw::None),
        Friction::Bristle => bristle(reader, node, path, (law, beside)),
        Friction::Coulomb => coulomb(reader, node, path, law.fields),
        Friction::Custom => {
            let (name, parameters) = custom(reader, node, path, law.fields)?;
            Some(FrictionLaw::Custom { name, parameters })
        }
    }
}

fn coulomb(reader: &mut Reader<'_>, node: &Node, path: &str, table: &'static [Field]) -> Option<FrictionLaw> {
    let fields = Fields::open(reader, node, path, &[table])?;
    let mu = fields.required(reader, "mu").and_then(|node| reader.not_negative(node, path, "mu"));
    let slip_speed =
        fields.required(reader, "slip_speed").and_then(|node| reader.positive(node, path, "the slip speed"));
    Some(FrictionLaw::Coulomb { mu: mu?, slip_speed: slip_speed? })
}

fn custom(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    table: &'static [Field],
) -> Option<(String, Vec<f64>)> {
    let fields = Fields::open(reader, node, path, &[table])?;
    let name = fields.required(reader, "name").and_then(|node| reader.text(node, path));
    let parameters = match fields.optional("parameters") {
        Some(node) => reader.numbers(node, path)?,
        None => Vec::new(),
    };
    Some((name?, parameters))
}

/// Reads the `pairs` table of a model with this name.
pub(super) fn pairs(
    reader: &mut Reader<'_>,
    node: &Node,
    model: &str,
    defined: &[Surface],
) -> Vec<PairOverride> {
    let Some(items) = reader.list(node, "pairs") else { return Vec::new() };
    let mut pairs: Vec<PairOverride> = Vec::new();
    let mut listed = HashSet::new();
    for (index, item) in items.iter().enumerate() {
        let path = format!("pairs[{index}]");
        let Some(pair) = pair(reader, item, &path, (model, defined)) else { continue };
        let mut unordered = pair.surfaces.clone();
        unordered.sort();
        if !listed.insert(unordered) {
            let cause = format!("the pair {:?} is listed twice", pair.surfaces);
            reader.fault(item.at, &path, "repeated-pair", cause, "keep one entry");
        }
        pairs.push(pair);
    }
    pairs
}

/// Name of the model and the surfaces that it defines.
type Defined<'d> = (&'d str, &'d [Surface]);

fn pair(reader: &mut Reader<'_>, node: &Node, path: &str, defined: Defined<'_>) -> Option<PairOverride> {
    let fields = Fields::open(reader, node, path, &[schema::PAIR])?;
    let names = fields.required(reader, "surfaces").and_then(|node| pair_names(reader, node, path, defined));
    let stiffness = match fields.optional("stiffness") {
        Some(node) => Some(pair_stiffness(reader, node, path)?),
        None => None,
    };
    let normal = match fields.optional("normal") {
        Some(node) => Some(pair_normal(reader, node, path, stiffness)?),
        None => None,
    };
    let friction = match fields.literal("friction") {
        Some(node) => {
            let beside = Beside { stiffness, normal: fields.optional("normal") };
            Some(friction_law(reader, node, path, beside)?)
        }
        None => None,
    };
    Some(PairOverride { surfaces: names?, stiffness, normal, friction })
}

fn pair_stiffness(reader: &mut Reader<'_>, node: &Node, path: &str) -> Option<f64> {
    finite_stiffness(reader, node, path, "the stiffness of a pair")
}

/// Reads the normal law of a pair. A restitution needs the stiffness of the pair, which only this entry can
/// give for certain.
fn pair_normal(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    stiffness: Option<f64>,
) -> Option<NormalLaw> {
    if stiffness.is_none() && wants_restitution_of_stiffness(node) {
        let cause = "a restitution of the pair needs the stiffness of the pair";
        return reader.refuse(
            node.at,
            path,
            "restitution-without-stiffness",
            cause,
            "add `stiffness: …` to this entry",
        );
    }
    normal_law(reader, node, path, stiffness)
}

fn wants_restitution_of_stiffness(node: &Node) -> bool {
    match &node.value {
        Value::Struct(Some(name), fields) => {
            matches!(name.as_ref(), "Linear" | "PowerLaw")
                && fields.iter().any(|field| field.name.as_ref() == "restitution")
        }
        _ => false,
    }
}

fn pair_names(
    reader: &mut Reader<'_>,
    node: &Node,
    path: &str,
    (model, defined): Defined<'_>,
) -> Option<[String; 2]> {
    let Value::Tuple(None, items) = &node.value else {
        let cause = format!("expected two names, found {}", node.value.describe());
        return reader.refuse(node.at, path, "wrong-type", cause, "write (\"steel\", \"rubber\")");
    };
    let [first, second] = items.as_slice() else {
        let cause = format!("expected two names, found {}", items.len());
        return reader.refuse(node.at, path, "wrong-type", cause, "write (\"steel\", \"rubber\")");
    };
    let names = [reader.text(first, path)?, reader.text(second, path)?];
    let is_defined = |name: &String| defined.iter().any(|surface| surface.is_called(name, model));
    if !names.iter().any(is_defined) {
        let cause = format!("neither \"{}\" nor \"{}\" is defined in this file", names[0], names[1]);
        reader.fault(
            node.at,
            path,
            "unknown-surface",
            cause,
            "at least one must be; the other may be another model's",
        );
    }
    Some(names)
}
