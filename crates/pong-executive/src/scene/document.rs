//! The fields of a scene file (docs/scene_format.md).

use crate::integrate::Integrator;
use crate::load::Axes;
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, SeqAccess, Visitor};

pub(crate) type Triple = [f64; 3];
pub(crate) type Six = [f64; 6];

/// Order (w, x, y, z).
pub(crate) type Quaternion = [f64; 4];

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "scene")]
pub(crate) struct Document {
    pub format: String,
    pub version: u32,
    pub name: String,
    #[serde(deserialize_with = "pairs_of_map")]
    pub models: Vec<(String, String)>,
    pub objects: Vec<ObjectEntry>,
    /// `None` if left out, which differs from an empty list: see [`Self::pairs`].
    pairs: Option<Vec<(String, String)>>,
    /// Entries of `pairs` that by intention have no contacts.
    #[serde(default)]
    pub passes_through: Vec<(String, String)>,
    /// Groups that never touch each other, `object/path`.
    #[serde(default)]
    pub filters: Vec<(String, String)>,
    #[serde(default, deserialize_with = "gravity")]
    pub gravity: Triple,
    #[serde(default)]
    pub loads: Vec<LoadEntry>,
    #[serde(default)]
    pub springs: Vec<SpringEntry>,
    pub integrator: Integrator,
    /// Step of the integrator, s.
    pub step: f64,
    /// End of the run, s.
    pub duration: f64,
    #[serde(default = "one")]
    pub record_every: u64,
    #[serde(default)]
    pub ledger: bool,
    pub contact_capacity: Option<usize>,
    #[serde(default)]
    pub preload: Vec<PreloadEntry>,
    #[serde(default)]
    pub alternatives: Vec<AlternativeEntry>,
}

impl Document {
    /// Objects that may touch; none if the scene leaves the field out.
    pub fn pairs(&self) -> &[(String, String)] {
        self.pairs.as_deref().unwrap_or_default()
    }

    /// True if there are several bodies and the scene does not say which may touch.
    pub fn leaves_out_pairs(&self) -> bool {
        self.pairs.is_none() && self.objects.iter().map(|object| object.bodies.len()).sum::<usize>() > 1
    }
}

/// Initial friction between two objects.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "preload")]
pub(crate) struct PreloadEntry {
    pub pair: (String, String),
    pub friction: FrictionEntry,
}

#[derive(Clone, Debug, Deserialize)]
pub(crate) enum FrictionEntry {
    Sliding,
    Holding(Triple),
}

/// Replacement files for some of the models.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "alternative")]
pub(crate) struct AlternativeEntry {
    pub name: String,
    #[serde(deserialize_with = "pairs_of_map")]
    pub models: Vec<(String, String)>,
}

/// Reads three numbers; a single one is refused with an explanation, because many tools give gravity that
/// way.
fn gravity<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Triple, D::Error> {
    struct Three;

    impl<'de> Visitor<'de> for Three {
        type Value = Triple;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str(
                "the three components of `gravity`, m/s² along the common axes: gravity: (0.0, 0.0, -9.81)",
            )
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Triple, A::Error> {
            let mut triple = Triple::default();
            for (place, number) in triple.iter_mut().enumerate() {
                *number = items.next_element()?.ok_or_else(|| A::Error::invalid_length(place, &self))?;
            }
            match items.next_element::<f64>()? {
                None => Ok(triple),
                Some(_) => Err(A::Error::invalid_length(4, &self)),
            }
        }
    }

    deserializer.deserialize_any(Three)
}

fn one() -> u64 {
    1
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "object")]
pub(crate) struct ObjectEntry {
    pub name: String,
    pub model: String,
    pub bodies: Vec<BodyEntry>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "body")]
pub(crate) struct BodyEntry {
    #[serde(default)]
    pub group: String,
    pub motion: MotionEntry,
    /// Mass, kg; free bodies need it.
    pub mass: Option<f64>,
    pub inertia: Option<InertiaEntry>,
    #[serde(default)]
    pub mass_center: Triple,
    pub position: Option<Triple>,
    pub orientation: Option<Quaternion>,
    pub linear_velocity: Option<Triple>,
    pub angular_velocity: Option<Triple>,
    /// Motion of the surface along itself, in the group frame: m/s, rad/s, m/s.
    #[serde(default)]
    pub surface_velocity: Triple,
    #[serde(default)]
    pub surface_angular_velocity: Triple,
    #[serde(default)]
    pub belt_velocity: Triple,
}

impl BodyEntry {
    /// Returns true if the surface moves along itself.
    pub fn has_moving_surface(&self) -> bool {
        let velocities = [self.surface_velocity, self.surface_angular_velocity, self.belt_velocity];
        velocities.iter().flatten().any(|x| *x != 0.0)
    }
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) enum InertiaEntry {
    Diagonal(f64, f64, f64),
    Full { xx: f64, yy: f64, zz: f64, xy: f64, xz: f64, yz: f64 },
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) enum MotionEntry {
    Free,
    Fixed,
    Prescribed(PathEntry),
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) enum PathEntry {
    ConstantTwist,
    Table(Vec<PathRowEntry>),
    Sinusoid {
        axis: Triple,
        #[serde(default)]
        travel: f64,
        #[serde(default)]
        angle: f64,
        frequency: f64,
        #[serde(default)]
        phase: f64,
    },
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "path row")]
pub(crate) struct PathRowEntry {
    /// Time, s.
    pub time: f64,
    pub position: Triple,
    pub orientation: Option<Quaternion>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "load")]
pub(crate) struct LoadEntry {
    pub body: String,
    #[serde(default)]
    pub point: Triple,
    #[serde(default)]
    pub axes: Axes,
    pub force: Option<Triple>,
    pub moment: Option<Triple>,
    pub table: Option<Vec<LoadRowEntry>>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "load row")]
pub(crate) struct LoadRowEntry {
    /// Time, s.
    pub time: f64,
    #[serde(default)]
    pub force: Triple,
    #[serde(default)]
    pub moment: Triple,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename = "spring")]
pub(crate) struct SpringEntry {
    pub first: EndEntry,
    pub second: EndEntry,
    pub stiffness: Six,
    #[serde(default)]
    pub damping: Six,
    #[serde(default)]
    pub preload: Six,
    #[serde(default)]
    pub rest: PoseEntry,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) enum EndEntry {
    Ground {
        #[serde(default)]
        position: Triple,
        orientation: Option<Quaternion>,
    },
    On {
        body: String,
        #[serde(default)]
        position: Triple,
        orientation: Option<Quaternion>,
    },
}

#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename = "pose")]
pub(crate) struct PoseEntry {
    #[serde(default)]
    pub position: Triple,
    pub orientation: Option<Quaternion>,
}

/// Reads a map in the order of the file with its repeated keys, so that a later check can name them.
fn pairs_of_map<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<(String, String)>, D::Error> {
    struct InOrder;
    impl<'de> Visitor<'de> for InOrder {
        type Value = Vec<(String, String)>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str("a map from names to model files")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut pairs = Vec::new();
            while let Some(pair) = map.next_entry()? {
                pairs.push(pair);
            }
            Ok(pairs)
        }
    }
    deserializer.deserialize_map(InOrder)
}
