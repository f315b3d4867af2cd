//! Sealing: which movable groups meet, what their surfaces make together, and how much must be remembered.

use crate::dispatch::has_tester;
use crate::error::EngineError;
use crate::law::{FrictionProps, NormalProps, PairProps, combine};
use crate::scene::Scene;
use crate::state::{ContactKey, fnv1a};
use pong_geometry::bounding::VolumeTests;
use pong_geometry::extension::Extensions;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Body, Exponent, FrictionLaw, Model, NormalLaw, PairOverride, PrimitiveInfo, Surface};
use std::collections::BTreeSet;

/// The most contacts of a frame where the scene's worst case is larger and the host names no limit.
const DEFAULT_CAPACITY_MAX: usize = 65_536;

/// The least capacity where the host names no limit: a ball centred in a cone of many facets touches all of them,
/// more than the worst case counts for it.
const DEFAULT_CAPACITY_MIN: usize = 256;

/// A pair of movable groups that are tested against each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupPair {
    /// The pair of Objects.
    pub pair: usize,
    /// The lower of the two bodies, whatever the order of pairing.
    pub first: usize,
    /// The higher.
    pub second: usize,
    /// Whether the first body's Object was named first: it is A among primitives of one kind.
    pub first_named_first: bool,
    /// Surface tables: with A in the first body, with A in the second.
    pub tables: [usize; 2],
}

/// Values of all pairs of surfaces of two models, A's model first.
pub(crate) struct SurfaceTable {
    pub model_a: usize,
    pub model_b: usize,
    columns: usize,
    props: Vec<Option<PairProps>>,
}

impl SurfaceTable {
    /// The values of a pair of surfaces that can meet.
    pub fn props(&self, surface_a: u32, surface_b: u32) -> &PairProps {
        let entry = &self.props[surface_a as usize * self.columns + surface_b as usize];
        entry.as_ref().expect("sealing combined every pair of surfaces that can meet")
    }
}

impl SurfaceTable {
    /// Stiffness and damping of the stiffest pair of surfaces whose force is linear in the depth.
    pub fn stiffest(&self) -> Option<(f64, f64)> {
        let linear = self.props.iter().flatten().filter_map(|props| match &props.normal {
            NormalProps::Linear { damping, .. } => Some((props.stiffness, *damping)),
            NormalProps::HuntCrossley { exponent: Exponent::One, .. } => Some((props.stiffness, 0.0)),
            NormalProps::HuntCrossley { .. } | NormalProps::Custom { .. } => None,
        });
        linear.max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// What sealing makes of a scene.
pub(crate) struct Sealed {
    pub group_pairs: Vec<GroupPair>,
    pub tables: Vec<SurfaceTable>,
    pub volume_tests: VolumeTests,
    pub contact_capacity: usize,
    /// Records: contacts, and as many that are only remembered.
    pub record_capacity: usize,
    pub custom_stride: usize,
    pub hash: u64,
}

impl Sealed {
    /// The bodies that hold A and B of a contact.
    pub fn bodies_of(&self, key: &ContactKey) -> (usize, usize) {
        let pair = &self.group_pairs[key.group_pair as usize];
        if key.flipped == 0 { (pair.first, pair.second) } else { (pair.second, pair.first) }
    }
}

/// What sealing tells the host.
#[derive(Clone, Debug, PartialEq)]
pub struct SealReport {
    /// Pairs of movable groups that will be tested.
    pub group_pairs: usize,
    /// Most contacts of a frame.
    pub contact_capacity: usize,
    /// Size of the contact state block, bytes.
    pub state_size: usize,
    /// Pairs of kinds that meet but have no tester: they are ignored, as the author may intend.
    pub warnings: Vec<SetupWarning>,
}

/// Something the author may not have intended.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SetupWarning {
    /// Primitives of two kinds without a tester meet in a pair of Objects and are ignored.
    IgnoredPair {
        /// Names of the two Objects.
        objects: [String; 2],
        /// Names of the two kinds.
        kinds: [String; 2],
    },
    /// A pair of Objects in which nothing can touch.
    NothingToTest {
        /// Names of the two Objects.
        objects: [String; 2],
    },
}

impl std::fmt::Display for SetupWarning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::IgnoredPair { objects: [a, b], kinds: [kind_a, kind_b] } => {
                write!(f, "`{a}` and `{b}`: {kind_a} and {kind_b} have no tester and ignore each other")
            }
            Self::NothingToTest { objects: [a, b] } => {
                write!(f, "`{a}` and `{b}` are paired but nothing of one can touch anything of the other")
            }
        }
    }
}

/// Beyond this a slip of the pen is likelier than a scene.
const CONTACTS_MAX: usize = 1 << 24;

pub(crate) fn seal(scene: &Scene) -> Result<(Sealed, SealReport), EngineError> {
    let mut group_pairs = group_pairs(scene);
    let volume_tests = VolumeTests::new(&scene.extensions);
    let mut problems = untestable_volumes(scene, &group_pairs, &volume_tests);
    let mut tables = Vec::new();
    match surface_tables(scene, &group_pairs) {
        Ok(made) => tables = made,
        Err(more) => problems.extend(more),
    }
    if let Some(0) = scene.config.contact_capacity {
        problems.push("contact capacity: 0 leaves no contact; give at least 1 or leave it out".to_owned());
    }
    if let Some(wanted) = scene.config.contact_capacity.filter(|wanted| *wanted > CONTACTS_MAX) {
        problems.push(format!(
            "contact capacity: {wanted} is more than memory could hold; give at most {CONTACTS_MAX} or leave it out"
        ));
    }
    if !problems.is_empty() {
        return Err(EngineError::Seal { problems });
    }
    for pair in &mut group_pairs {
        let models = [pair.first, pair.second].map(|body| scene.objects[scene.bodies[body].object].model);
        let find = |a, b| tables.iter().position(|table| (table.model_a, table.model_b) == (a, b));
        pair.tables =
            [find(models[0], models[1]), find(models[1], models[0])].map(|t| t.expect("made above"));
    }
    let contact_capacity = scene.config.contact_capacity.unwrap_or_else(|| worst_case(scene, &group_pairs));
    let record_capacity = 2 * contact_capacity;
    let custom_stride = custom_stride(&tables);
    let hash = scene_hash(scene, contact_capacity, custom_stride);
    let state_size = crate::state::block_len(group_pairs.len(), record_capacity, custom_stride);
    let report = SealReport {
        group_pairs: group_pairs.len(),
        contact_capacity,
        state_size,
        warnings: warnings(scene, &group_pairs),
    };
    let sealed =
        Sealed { group_pairs, tables, volume_tests, contact_capacity, record_capacity, custom_stride, hash };
    Ok((sealed, report))
}

/// Every pair of movable groups of paired Objects, in the order of their bodies.
fn group_pairs(scene: &Scene) -> Vec<GroupPair> {
    let bodies_of = |object: usize| {
        let object = &scene.objects[object];
        object.first_body..object.first_body + scene.models[object.model].bodies.len()
    };
    let mut found = Vec::new();
    for (pair, objects) in scene.pairs.iter().enumerate() {
        for a in bodies_of(objects.a) {
            for b in bodies_of(objects.b).filter(|b| objects.a != objects.b || a < *b) {
                found.push(GroupPair {
                    pair,
                    first: a.min(b),
                    second: a.max(b),
                    first_named_first: a < b,
                    tables: [0, 0],
                });
            }
        }
    }
    found.sort_by_key(|pair| (pair.first, pair.second));
    found
}

fn untestable_volumes(scene: &Scene, group_pairs: &[GroupPair], tests: &VolumeTests) -> Vec<String> {
    let mut problems = BTreeSet::new();
    let kinds = |body: usize| -> BTreeSet<String> {
        scene.body(body).tree.nodes.iter().map(|node| node.volume.kind_name().to_owned()).collect()
    };
    for pair in group_pairs {
        for a in kinds(pair.first) {
            for b in kinds(pair.second).into_iter().filter(|b| !tests.supports(&a, b)) {
                problems.insert(format!(
                    "bounding volumes {a} and {b} of `{}` and `{}`: no test is registered; register one or use \
                     another bound kind",
                    scene.body_name(pair.first),
                    scene.body_name(pair.second)
                ));
            }
        }
    }
    problems.into_iter().collect()
}

/// The name of a primitive's kind, a custom kind's own name included.
fn kind_name<'a>(body: &'a Body, info: &PrimitiveInfo) -> &'a str {
    match info.kind {
        PrimitiveKind::Custom => body.customs[info.elements.start as usize].kind_name(),
        kind => kind.name(),
    }
}

fn can_be_tested(extensions: &Extensions, a: (&Body, &PrimitiveInfo), b: (&Body, &PrimitiveInfo)) -> bool {
    has_tester(a.1.kind, b.1.kind)
        || extensions.contact_test(kind_name(a.0, a.1), kind_name(b.0, b.1)).is_some()
}

/// Combines every pair of surfaces that can meet; all that cannot be combined are reported.
pub(crate) fn surface_tables(
    scene: &Scene,
    group_pairs: &[GroupPair],
) -> Result<Vec<SurfaceTable>, Vec<String>> {
    let mut tables: Vec<SurfaceTable> = Vec::new();
    let mut problems = BTreeSet::new();
    for pair in group_pairs {
        for (a, b) in [(pair.first, pair.second), (pair.second, pair.first)] {
            let model_of = |body: usize| scene.objects[scene.bodies[body].object].model;
            let (model_a, model_b) = (model_of(a), model_of(b));
            let index = match tables.iter().position(|t| (t.model_a, t.model_b) == (model_a, model_b)) {
                Some(index) => index,
                None => {
                    tables.push(SurfaceTable::empty(model_a, model_b, &scene.models));
                    tables.len() - 1
                }
            };
            fill_table(scene, &mut tables[index], scene.body(a), scene.body(b), &mut problems);
        }
    }
    if problems.is_empty() { Ok(tables) } else { Err(problems.into_iter().collect()) }
}

impl SurfaceTable {
    fn empty(model_a: usize, model_b: usize, models: &[std::sync::Arc<Model>]) -> Self {
        let columns = models[model_b].surfaces.len();
        Self { model_a, model_b, columns, props: vec![None; models[model_a].surfaces.len() * columns] }
    }
}

fn fill_table(
    scene: &Scene,
    table: &mut SurfaceTable,
    body_a: &Body,
    body_b: &Body,
    problems: &mut BTreeSet<String>,
) {
    // One representative per kind and surface: meshes of a thousand parts share a handful of them.
    let distinct = |body: &Body| -> Vec<usize> {
        let mut seen = BTreeSet::new();
        (0..body.primitives.len())
            .filter(|&i| {
                let info = &body.primitives[i];
                seen.insert((kind_name(body, info).to_owned(), info.surface))
            })
            .collect()
    };
    let (in_a, in_b) = (distinct(body_a), distinct(body_b));
    for info_a in in_a.iter().map(|&i| &body_a.primitives[i]) {
        for info_b in in_b.iter().map(|&i| &body_b.primitives[i]) {
            let slot = info_a.surface as usize * table.columns + info_b.surface as usize;
            let met = can_be_tested(&scene.extensions, (body_a, info_a), (body_b, info_b));
            if !met || table.props[slot].is_some() {
                continue;
            }
            let model_a = &scene.models[table.model_a];
            let model_b = &scene.models[table.model_b];
            let a = &model_a.surfaces[info_a.surface as usize];
            let b = &model_b.surfaces[info_b.surface as usize];
            let made = table_entry(model_a, model_b, a, b)
                .and_then(|entry| combine(a, b, entry, &scene.laws).map_err(|e| (e.cause, e.cure)));
            match made {
                Ok(props) => table.props[slot] = Some(props),
                Err((cause, cure)) => {
                    let (a, b) = if a.name <= b.name { (a, b) } else { (b, a) };
                    problems.insert(format!("surfaces `{}` and `{}`: {cause}; {cure}", a.name, b.name));
                }
            }
        }
    }
}

/// The entry that the two models' tables hold for a pair of surfaces; they must not contradict each other.
fn table_entry<'a>(
    model_a: &'a Model,
    model_b: &'a Model,
    a: &Surface,
    b: &Surface,
) -> Result<Option<&'a PairOverride>, (String, String)> {
    let find = |model: &'a Model| {
        model.pair_overrides.iter().find(|entry| {
            let [x, y] = &entry.surfaces;
            (*x == a.name && *y == b.name) || (*x == b.name && *y == a.name)
        })
    };
    match (find(model_a), find(model_b)) {
        (Some(x), Some(y))
            if (x.stiffness, &x.normal, &x.friction) != (y.stiffness, &y.normal, &y.friction) =>
        {
            Err((
                format!(
                    "models `{}` and `{}` give different values for this pair",
                    model_a.name, model_b.name
                ),
                "make the two `pairs` entries equal or drop one".to_owned(),
            ))
        }
        (Some(entry), _) | (None, Some(entry)) => Ok(Some(entry)),
        (None, None) => Ok(None),
    }
}

fn custom_stride(tables: &[SurfaceTable]) -> usize {
    let lens = tables.iter().flat_map(|table| &table.props).flatten().map(|props| match &props.friction {
        FrictionProps::Custom { law, .. } => law.state_len(),
        _ => 0,
    });
    lens.max().unwrap_or(0)
}

/// Contacts if everything that can touch did: points and rays 1 per opposing shell, segments 2, balls 4.
fn worst_case(scene: &Scene, group_pairs: &[GroupPair]) -> usize {
    let contacts_of = |kind: PrimitiveKind| match kind {
        PrimitiveKind::Point | PrimitiveKind::Ray | PrimitiveKind::Custom => 1,
        PrimitiveKind::LineSegment => 2,
        PrimitiveKind::Sphere | PrimitiveKind::Ellipsoid => 4,
        PrimitiveKind::Triangle | PrimitiveKind::Polyhedron | PrimitiveKind::Plane => 0,
    };
    let mut total = 0_usize;
    for pair in group_pairs {
        for (a, b) in [(pair.first, pair.second), (pair.second, pair.first)] {
            let movers: usize = scene.body(a).primitives.iter().map(|info| contacts_of(info.kind)).sum();
            total = total.saturating_add(movers.saturating_mul(scene.body(b).shell_count as usize));
        }
    }
    total.clamp(DEFAULT_CAPACITY_MIN, DEFAULT_CAPACITY_MAX)
}

fn warnings(scene: &Scene, group_pairs: &[GroupPair]) -> Vec<SetupWarning> {
    let mut found = BTreeSet::new();
    for (index, pair) in scene.pairs.iter().enumerate() {
        let objects = [pair.a, pair.b].map(|object| scene.objects[object].name.clone());
        let mut anything = false;
        for groups in group_pairs.iter().filter(|groups| groups.pair == index) {
            let (first, second) = (scene.body(groups.first), scene.body(groups.second));
            let kinds = |body: &Body| -> BTreeSet<(String, usize)> {
                let mut by_name: std::collections::BTreeMap<String, usize> = Default::default();
                for (i, info) in body.primitives.iter().enumerate() {
                    by_name.entry(kind_name(body, info).to_owned()).or_insert(i);
                }
                by_name.into_iter().collect()
            };
            for (name_a, a) in kinds(first) {
                for (name_b, b) in kinds(second) {
                    let a = (first, &first.primitives[a]);
                    let b = (second, &second.primitives[b]);
                    if can_be_tested(&scene.extensions, a, b) || can_be_tested(&scene.extensions, b, a) {
                        anything = true;
                    } else {
                        let mut kinds = [name_a.clone(), name_b.clone()];
                        kinds.sort();
                        found.insert(SetupWarning::IgnoredPair { objects: objects.clone(), kinds });
                    }
                }
            }
        }
        if !anything {
            found.insert(SetupWarning::NothingToTest { objects });
        }
    }
    found.into_iter().collect()
}

/// Hash of everything that decides what a contact state block means.
fn scene_hash(scene: &Scene, capacity: usize, custom_stride: usize) -> u64 {
    let mut text = format!("capacity {capacity} stride {custom_stride} ledger {}\n", scene.config.ledger);
    for model in &scene.models {
        text += &format!("model {:016x}\n", model.hash);
    }
    for object in &scene.objects {
        text += &format!("object {} {}\n", object.model, object.name);
    }
    for pair in &scene.pairs {
        text += &format!("pair {} {}\n", pair.a, pair.b);
    }
    for law in scene.laws.names() {
        text += &format!("law {law}\n");
    }
    fnv1a(text.as_bytes())
}

/// Refuses a change of law, and values that no surface may have.
pub(crate) fn check_surface_change(old: &Surface, new: &Surface) -> Result<(), EngineError> {
    let bad = |cause: &str| {
        Err(EngineError::BadValue { what: format!("surface `{}`", new.name), cause: cause.to_owned() })
    };
    let same_normal = match (&old.normal, &new.normal) {
        (NormalLaw::Linear { .. }, NormalLaw::Linear { .. }) => true,
        (NormalLaw::HuntCrossley { exponent: a, .. }, NormalLaw::HuntCrossley { exponent: b, .. }) => a == b,
        (NormalLaw::Custom { name: a, .. }, NormalLaw::Custom { name: b, .. }) => a == b,
        _ => false,
    };
    let same_friction = match (&old.friction, &new.friction) {
        (FrictionLaw::None, FrictionLaw::None)
        | (FrictionLaw::Bristle { .. }, FrictionLaw::Bristle { .. })
        | (FrictionLaw::Coulomb { .. }, FrictionLaw::Coulomb { .. }) => true,
        (FrictionLaw::Custom { name: a, .. }, FrictionLaw::Custom { name: b, .. }) => a == b,
        _ => false,
    };
    if !same_normal || !same_friction {
        return bad("values may change between frames, laws may not; keep the law and change its numbers");
    }
    if new.stiffness.is_nan() || new.stiffness <= 0.0 {
        return bad("the stiffness must be positive (infinite means rigid)");
    }
    let numbers: &[f64] = match &new.normal {
        NormalLaw::Linear { damping, ramp } => &[*damping, *ramp],
        NormalLaw::HuntCrossley { dissipation, .. } => &[*dissipation],
        NormalLaw::Custom { parameters, .. } => parameters,
    };
    let custom = matches!(new.normal, NormalLaw::Custom { .. });
    if numbers.iter().any(|x| !x.is_finite() || (!custom && *x < 0.0)) {
        return bad("damping values must be finite and not negative");
    }
    let rough: &[f64] = match &new.friction {
        FrictionLaw::None => &[],
        FrictionLaw::Bristle { mu, static_excess, stiffness, damping } => {
            &[*mu, *static_excess, stiffness.unwrap_or(0.0), *damping]
        }
        FrictionLaw::Coulomb { mu, slip_speed } if *slip_speed > 0.0 => &[*mu],
        FrictionLaw::Coulomb { .. } => return bad("the slip speed must be positive"),
        FrictionLaw::Custom { .. } => &[],
    };
    if rough.iter().any(|x| !x.is_finite() || *x < 0.0) {
        return bad("friction values must be finite and not negative");
    }
    Ok(())
}
