//! Sealing: which movable groups meet, what their surfaces make together, and how much must be remembered.

use crate::dispatch::has_tester;
use crate::error::EngineError;
use crate::frame::arena_bytes;
use crate::law::{FrictionProps, NormalProps, PairProps, combine};
use crate::scene::Scene;
use crate::sharing::scratch_bytes;
use crate::state::{ContactKey, fnv1a};
use pong_geometry::bounding::VolumeTests;
use pong_geometry::extension::Extensions;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Body, Exponent, FrictionLaw, Model, NormalLaw, PairOverride, PrimitiveInfo, Surface, Tree};
use pong_threads::WorkerStart;
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
    /// The directions of those pairs in which something can be found, in order.
    pub plans: Vec<Plan>,
    /// The movable groups of all pairs, each once.
    pub paired_bodies: Vec<usize>,
    /// Whether a ray may hit two movable groups of one Object.
    pub rays_meet_groups: bool,
    pub limits: Limits,
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

/// How much memory the frames get.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    /// Contacts that the calling thread can hold: all that a frame may keep, and room to find more before it has to
    /// choose.
    pub lane_contacts: usize,
    /// Interferences of one chunk of A before any is left out.
    pub found: usize,
    /// For the testers of a block, bytes.
    pub arena_bytes: usize,
    /// For solutions among contacts, the ledger and rays, bytes.
    pub scratch_bytes: usize,
}

impl Limits {
    fn new(scene: &Scene, group_pairs: &[GroupPair], record_capacity: usize, custom_stride: usize) -> Self {
        /// Interferences of one chunk at most, where the host has not chosen a capacity: what a ball finds on a fine
        /// mesh before it is settled which of them push.
        const FOUND_MAX: usize = 8192;
        /// Contacts of one surface that are shared exactly where their normals are more than 90° apart.
        const SHARED: usize = 128;
        let most = if scene.config.contact_capacity.is_some() { usize::MAX } else { FOUND_MAX };
        let found = record_capacity.clamp(1024, most);
        let lane_contacts = record_capacity + (record_capacity / 8).max(64);
        let in_tree = |count: fn(&Tree) -> usize| {
            let bodies = group_pairs.iter().flat_map(|pair| [pair.first, pair.second]);
            bodies.map(|body| count(&scene.body(body).tree)).max().unwrap_or(0)
        };
        let (nodes, batches) = (in_tree(|tree| tree.nodes.len()), in_tree(|tree| tree.batches.len()));
        let arena_bytes = arena_bytes(nodes, batches, found, custom_stride);
        /// Every piece is rounded up to a grain.
        const GRAINS: usize = 64;
        let per_contact = size_of::<((usize, u32, usize, usize), f64)>();
        let numbers = custom_stride * size_of::<f64>();
        let scratch_bytes = scratch_bytes(SHARED).max(lane_contacts * per_contact) + numbers + GRAINS;
        Self { lane_contacts, found, arena_bytes, scratch_bytes }
    }

    /// Contacts that one of several lanes can hold. A lane that finds more than this leaves the frame to the caller
    /// alone: an uneven share of the work must be rare, not impossible.
    pub fn worker_contacts(&self, lanes: usize) -> usize {
        self.lane_contacts.min((2 * self.lane_contacts / lanes).max(4096))
    }
}

/// One direction of a pair of movable groups in which something can be found.
#[derive(Clone, Debug)]
pub(crate) struct Plan {
    pub group_pair: u32,
    /// 0 if A is in the pair's first body, 1 if in the second.
    pub flipped: u32,
    pub body_a: usize,
    pub body_b: usize,
    /// What an element of A of each kind may cost, ns, roughly; `None` for kinds that nothing of B can touch.
    element_ns: [Option<u32>; PrimitiveKind::ALL.len()],
    /// By the kind of A: a bit for every kind of B that it may touch.
    touched: [u16; PrimitiveKind::ALL.len()],
}

impl Plan {
    /// What an element of A may cost, ns; `None` if nothing of B can touch it.
    pub fn element_ns(&self, kind: PrimitiveKind) -> Option<u32> {
        self.element_ns[kind as usize]
    }

    fn new(scene: &Scene, group_pair: usize, pair: &GroupPair, flipped: u32) -> Self {
        let (body_a, body_b) =
            if flipped == 0 { (pair.first, pair.second) } else { (pair.second, pair.first) };
        let (a, b) = (scene.body(body_a), scene.body(body_b));
        let in_order = (flipped == 0) == pair.first_named_first;
        let (mut element_ns, mut touched) = ([None; PrimitiveKind::ALL.len()], [0; PrimitiveKind::ALL.len()]);
        for info_a in representatives(a) {
            let met = representatives(b)
                .filter(|info_b| info_a.kind != info_b.kind || in_order)
                .filter(|info_b| can_be_tested(&scene.extensions, (a, info_a), (b, info_b)));
            for info_b in met {
                let slot = &mut element_ns[info_a.kind as usize];
                *slot = Some(rough_cost_ns(info_a.kind, info_b.kind)).max(*slot);
                touched[info_a.kind as usize] |= 1 << info_b.kind as u16;
            }
        }
        Self { group_pair: group_pair as u32, flipped, body_a, body_b, element_ns, touched }
    }

    /// Whether anything of these two kinds in A and B is tested: by the table of testers, of two primitives of one
    /// kind only with A in the Object that was named first; or by a registered test.
    pub fn tests(&self, kind_a: PrimitiveKind, kind_b: PrimitiveKind) -> bool {
        self.touched[kind_a as usize] >> kind_b as u16 & 1 == 1
    }

    fn finds_something(&self) -> bool {
        self.element_ns.iter().any(Option::is_some)
    }
}

/// One primitive of every kind in a body.
fn representatives(body: &Body) -> impl Iterator<Item = &PrimitiveInfo> {
    let mut seen = BTreeSet::new();
    body.primitives.iter().filter(move |info| seen.insert(kind_name(body, info).to_owned()))
}

/// Time that an element of A takes against a body with elements of B, for cutting the work into blocks and for the
/// choice to do it alone. It decides nothing else.
fn rough_cost_ns(a: PrimitiveKind, b: PrimitiveKind) -> u32 {
    match (a, b) {
        (PrimitiveKind::Sphere | PrimitiveKind::Ellipsoid, PrimitiveKind::Triangle) => 1000,
        (PrimitiveKind::Point | PrimitiveKind::Sphere, _) => 15,
        (PrimitiveKind::LineSegment | PrimitiveKind::Ray, _) => 50,
        _ => 200,
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
    /// How every worker started: its core and priority, or why it has none.
    pub workers: Vec<WorkerStart>,
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

pub(crate) fn seal(
    scene: &Scene,
    surfaces: &[Vec<Surface>],
) -> Result<(Sealed, Vec<SurfaceTable>, SealReport), EngineError> {
    let mut group_pairs = group_pairs(scene);
    let volume_tests = VolumeTests::new(&scene.extensions);
    let mut problems = untestable_volumes(scene, &group_pairs, &volume_tests);
    let mut tables = Vec::new();
    match surface_tables(scene, surfaces, &group_pairs) {
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
        workers: Vec::new(),
        warnings: warnings(scene, &group_pairs),
    };
    let limits = Limits::new(scene, &group_pairs, record_capacity, custom_stride);
    let sealed = Sealed {
        plans: plans(scene, &group_pairs),
        paired_bodies: paired_bodies(&group_pairs),
        rays_meet_groups: rays_meet_groups(scene, &group_pairs),
        group_pairs,
        limits,
        volume_tests,
        contact_capacity,
        record_capacity,
        custom_stride,
        hash,
    };
    Ok((sealed, tables, report))
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

fn plans(scene: &Scene, group_pairs: &[GroupPair]) -> Vec<Plan> {
    let directions = group_pairs
        .iter()
        .enumerate()
        .flat_map(|(index, pair)| [0, 1].map(|flipped| Plan::new(scene, index, pair, flipped)));
    directions.filter(Plan::finds_something).collect()
}

fn paired_bodies(group_pairs: &[GroupPair]) -> Vec<usize> {
    let bodies: BTreeSet<usize> = group_pairs.iter().flat_map(|pair| [pair.first, pair.second]).collect();
    bodies.into_iter().collect()
}

fn rays_meet_groups(scene: &Scene, group_pairs: &[GroupPair]) -> bool {
    let has_rays = |body: usize| !scene.body(body).rays.is_empty();
    let mut met = BTreeSet::new();
    group_pairs.iter().any(|pair| {
        [(pair.first, pair.second), (pair.second, pair.first)]
            .into_iter()
            .filter(|&(a, _)| has_rays(a))
            .any(|(a, b)| !met.insert((a, scene.bodies[b].object)))
    })
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
    surfaces: &[Vec<Surface>],
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
                    tables.push(SurfaceTable::empty(model_a, model_b, surfaces));
                    tables.len() - 1
                }
            };
            fill_table((scene, surfaces), &mut tables[index], scene.body(a), scene.body(b), &mut problems);
        }
    }
    if problems.is_empty() { Ok(tables) } else { Err(problems.into_iter().collect()) }
}

impl SurfaceTable {
    fn empty(model_a: usize, model_b: usize, surfaces: &[Vec<Surface>]) -> Self {
        let columns = surfaces[model_b].len();
        Self { model_a, model_b, columns, props: vec![None; surfaces[model_a].len() * columns] }
    }
}

fn fill_table(
    (scene, surfaces): (&Scene, &[Vec<Surface>]),
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
            let a = &surfaces[table.model_a][info_a.surface as usize];
            let b = &surfaces[table.model_b][info_b.surface as usize];
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
