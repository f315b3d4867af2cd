//! Contents of one model: groups, primitives, extent, surfaces.

use super::bristles;
use crate::text::{count, number, numbers};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Element, Exponent, FrictionLaw, Model, MovableGroup, Node, NormalLaw, Surface, printable};
use std::collections::{BTreeMap, HashMap};

/// A group as the engine sees it.
struct Group {
    path: String,
    movable: bool,
    bound: String,
    /// Primitives directly in this group, by kind: their number, and the number of their elements.
    holds: BTreeMap<PrimitiveKind, (usize, usize)>,
}

pub(super) fn description(name: &str, model: &Model) -> String {
    let memory = if model.entry_memory { "remembered" } else { "not remembered" };
    let mut text = format!("{name}: hash {:016x}, side of entry {memory}\n", model.hash);
    let groups: Vec<Group> = model.bodies.iter().flat_map(groups_of).collect();
    if let Some(root) = model.bodies.first() {
        let mut below: HashMap<&str, Vec<&Group>> = HashMap::new();
        for group in &groups {
            if let Some(path) = above(&group.path) {
                below.entry(path).or_default().push(group);
            }
        }
        if let Some(group) = groups.iter().find(|group| group.path == root.path) {
            draw(group, &below, 1, &mut text);
        }
    }
    for body in &model.bodies {
        text += &extent(body);
    }
    for surface in &model.surfaces {
        text += &format!("  surface {}\n", printable(&surface_line(surface)));
    }
    for entry in &model.pair_overrides {
        text += &format!(
            "  pair of surfaces `{}` and `{}` has values of its own\n",
            printable(&entry.surfaces[0]),
            printable(&entry.surfaces[1])
        );
    }
    text
}

/// The authored groups of a body in the order of the file, with and without volumes of their own. The
/// loader's subdivisions have the path of their leaf and are merged with it.
fn groups_of(body: &MovableGroup) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    let mut numbers: HashMap<&str, usize> = HashMap::new();
    let nodes = nodes_of(body);
    let mut paths: Vec<&str> = vec![&body.path];
    for info in &body.primitives {
        let from = paths.len();
        let owners = std::iter::successors(above(&info.path), |path| above(path));
        paths.extend(owners.take_while(|path| path.len() > body.path.len()));
        paths[from..].reverse();
    }
    for path in paths {
        numbers.entry(path).or_insert_with(|| {
            groups.push(group_at(body, path, nodes.get(path).map_or(&[], Vec::as_slice)));
            groups.len() - 1
        });
    }
    for info in &body.primitives {
        let owner = info.path.rsplit_once('/').map_or("", |(group, _)| group);
        if let Some(&number) = numbers.get(owner) {
            let group = &mut groups[number];
            let (primitives, elements) = group.holds.entry(info.kind).or_default();
            *primitives += 1;
            *elements += info.elements.len();
        }
    }
    groups
}

/// The path of the parent group.
fn above(path: &str) -> Option<&str> {
    path.rsplit_once('/').map(|(above, _)| above)
}

/// The nodes of a body's tree, by their group.
fn nodes_of(body: &MovableGroup) -> HashMap<&str, Vec<&Node>> {
    let mut nodes: HashMap<&str, Vec<&Node>> = HashMap::new();
    body.tree.nodes.iter().for_each(|node| nodes.entry(&*node.group).or_default().push(node));
    nodes
}

fn group_at(body: &MovableGroup, path: &str, nodes: &[&Node]) -> Group {
    let mut bound = nodes.first().map_or("Above", |node| node.volume.kind_name()).to_owned();
    let leaves = nodes.iter().filter(|node| !node.items.is_empty()).count();
    if leaves > 1 {
        bound += &format!(", {leaves} leaves");
    }
    Group { path: path.to_owned(), movable: path == body.path, bound, holds: BTreeMap::new() }
}

fn draw(group: &Group, below: &HashMap<&str, Vec<&Group>>, depth: usize, text: &mut String) {
    let name = group.path.rsplit('/').next().unwrap_or(&group.path);
    let movable = if group.movable { " movable" } else { "" };
    let holds: Vec<String> = group
        .holds
        .iter()
        .map(|(kind, (primitives, elements))| held(*kind, *primitives, *elements))
        .collect();
    let holds = if holds.is_empty() { String::new() } else { format!(": {}", holds.join(", ")) };
    *text += &format!(
        "{:indent$}{} ({}{movable}){holds}\n",
        "",
        printable(name),
        printable(&group.bound),
        indent = 2 * depth
    );
    for child in below.get(&*group.path).into_iter().flatten() {
        draw(child, below, depth + 1, text);
    }
}

fn held(kind: PrimitiveKind, primitives: usize, elements: usize) -> String {
    match kind {
        PrimitiveKind::Triangle if primitives != elements => {
            format!("{} Triangle in {}", elements, count(primitives, "primitive", "primitives"))
        }
        _ => format!("{primitives} {}", kind.name()),
    }
}

fn extent(body: &MovableGroup) -> String {
    let items = &body.tree.items;
    if items.is_empty() {
        return format!("  extent of {}: nothing\n", printable(&body.path));
    }
    let start = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    let (low, high) = items.iter().fold(start, |(low, high), item| {
        let (l, h) = Element::new(body, *item).extent();
        (low.inf(&l), high.sup(&h))
    });
    format!(
        "  extent of {}: ({}) … ({}) m\n",
        printable(&body.path),
        numbers(low.as_slice()),
        numbers(high.as_slice())
    )
}

fn surface_line(surface: &Surface) -> String {
    let normal = match &surface.normal {
        NormalLaw::Linear { damping, ramp } => {
            format!("linear, c {} N·s/m, ramp {} m", number(*damping), number(*ramp))
        }
        NormalLaw::HuntCrossley { dissipation, exponent } => {
            format!("Hunt-Crossley, exponent {}, χ {} s/m", exponent_text(*exponent), number(*dissipation))
        }
        NormalLaw::PowerLaw { damping, exponent, damping_exponent } => format!(
            "power law, exponent {}, c {} N·s/m^{} with exponent {damping_exponent}",
            exponent_text(*exponent),
            number(*damping),
            1.0 + damping_exponent
        ),
        NormalLaw::Custom { name, .. } => format!("law `{name}`"),
        NormalLaw::Inherited => "the law of what it meets".to_owned(),
    };
    let friction = match &surface.friction {
        FrictionLaw::None => "no friction".to_owned(),
        FrictionLaw::Bristle { mu, static_excess, .. } => {
            let static_mu = number(mu * (1.0 + static_excess));
            let springs = bristles::springs(surface);
            format!("bristle, μ_k {}, μ_s {static_mu}{springs}{}", number(*mu), resistances(surface))
        }
        FrictionLaw::Coulomb { mu, slip_speed } => {
            format!("regularised Coulomb, μ {}, v_ε {} m/s", number(*mu), number(*slip_speed))
        }
        FrictionLaw::Custom { name, .. } => format!("friction law `{name}`"),
        FrictionLaw::Inherited => "friction of what it meets".to_owned(),
    };
    let unit = match surface.normal.exponent() {
        Exponent::One => "N/m",
        Exponent::ThreeHalves => "N/m^1.5",
    };
    let foundation = match (surface.foundation, surface.area) {
        (Some(modulus), _) => format!(", K {} N/m³", number(modulus)),
        (None, Some(area)) => format!(", K {} N/m³ from the area", number(surface.stiffness / area)),
        (None, None) => String::new(),
    };
    format!("`{}`: k {} {unit}{foundation}, {normal}, {friction}", surface.name, number(surface.stiffness))
}

/// Rolling and spinning resistance of a surface; empty without them.
fn resistances(surface: &Surface) -> String {
    let lengths = surface.resistances();
    if lengths == [0.0; 2] {
        return String::new();
    }
    format!(", rolling {} m, spinning {} m", number(lengths[0]), number(lengths[1]))
}

fn exponent_text(exponent: Exponent) -> &'static str {
    match exponent {
        Exponent::One => "1",
        Exponent::ThreeHalves => "3/2",
    }
}
