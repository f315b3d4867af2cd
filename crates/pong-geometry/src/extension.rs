//! Extensions by a Rust user: kinds of primitives, kinds of bounding volumes, and tests of pairs of these
//! kinds.

use crate::bounding::{Bounded, CustomVolume, Volume};
use crate::interference::Interference;
use crate::primitive::{CustomPrimitive, Primitive, PrimitiveKind, TriangleSet};
use crate::{Transform, Vec3};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Function that creates a custom primitive from the parameters in the model file. It returns the reason as
/// text if the parameters are invalid.
pub type PrimitiveFactory = Arc<dyn Fn(&[f64]) -> Result<Arc<dyn CustomPrimitive>, String> + Send + Sync>;
/// Function that fits a custom bounding volume around a list of shapes.
pub type VolumeFitter = Arc<dyn Fn(&[&dyn Bounded]) -> Arc<dyn CustomVolume> + Send + Sync>;
/// Overlap test of two volumes, each in its own frame. The transform takes the first volume's frame to the
/// second's. The test returns `false` only if the volumes are certainly disjoint.
pub type VolumeTest = Arc<dyn Fn(&Volume, &Volume, &Transform) -> bool + Send + Sync>;
/// Contact test of A (first kind) against B (second kind), each in its own frame. The transform takes A's
/// frame to B's frame. The result is in B's frame; it is `None` if there is no contact.
pub type ContactTest =
    Arc<dyn Fn(PrimitiveRef<'_>, PrimitiveRef<'_>, &Transform) -> Option<Interference> + Send + Sync>;

/// Kinds and tests registered by a user. Built-in kinds need no entry.
#[derive(Clone, Default)]
pub struct Extensions {
    primitives: BTreeMap<String, PrimitiveFactory>,
    volumes: BTreeMap<String, VolumeFitter>,
    volume_tests: BTreeMap<(String, String), VolumeTest>,
    /// Contact tests by the kind of A, then by the kind of B. In this form a lookup needs only borrowed names
    /// and does not allocate.
    contact_tests: BTreeMap<String, BTreeMap<String, ContactTest>>,
}

/// Shows the names only, because functions have no printable form.
impl std::fmt::Debug for Extensions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Extensions")
            .field("primitives", &self.primitives.keys())
            .field("volumes", &self.volumes.keys())
            .field("volume_tests", &self.volume_tests.keys())
            .field("contact_tests", &self.contact_tests.keys())
            .finish()
    }
}

impl Extensions {
    /// Creates an empty set of extensions.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a kind of primitive that the model file can then name in `Custom(kind: …)`.
    pub fn add_primitive(&mut self, kind: &str, factory: PrimitiveFactory) {
        self.primitives.insert(kind.to_owned(), factory);
    }

    /// Adds a kind of bounding volume that the model file can then name in `bound: Custom(…)`.
    pub fn add_volume(&mut self, kind: &str, fitter: VolumeFitter) {
        self.volumes.insert(kind.to_owned(), fitter);
    }

    /// Adds the overlap test of two kinds of volumes (built-in names: `Aabb`, `Sphere`, `Obb`). It is used
    /// for both orders of the kinds.
    pub fn add_volume_test(&mut self, kind_a: &str, kind_b: &str, test: VolumeTest) {
        self.volume_tests.insert((kind_a.to_owned(), kind_b.to_owned()), test);
    }

    /// Adds the contact test of two kinds of primitives. The first kind is A; built-in names are those of
    /// [`PrimitiveKind::name`].
    pub fn add_contact_test(&mut self, kind_a: &str, kind_b: &str, test: ContactTest) {
        self.contact_tests.entry(kind_a.to_owned()).or_default().insert(kind_b.to_owned(), test);
    }

    /// Returns the factory of a kind of primitive; `None` if it is not registered.
    pub fn primitive(&self, kind: &str) -> Option<&PrimitiveFactory> {
        self.primitives.get(kind)
    }

    /// Returns the fitter of a kind of volume; `None` if it is not registered.
    pub fn volume(&self, kind: &str) -> Option<&VolumeFitter> {
        self.volumes.get(kind)
    }

    /// Returns all registered volume tests, each with its first and second kind.
    pub fn volume_tests(&self) -> impl Iterator<Item = (&str, &str, &VolumeTest)> {
        self.volume_tests.iter().map(|((kind_a, kind_b), test)| (kind_a.as_str(), kind_b.as_str(), test))
    }

    /// Returns the contact test of A's kind and B's kind, in this order; `None` if it is not registered.
    pub fn contact_test(&self, kind_a: &str, kind_b: &str) -> Option<&ContactTest> {
        self.contact_tests.get(kind_a)?.get(kind_b)
    }
}

macro_rules! define_reference {
    ($($(#[$doc:meta])+ $kind:ident = $number:literal: $shape:ty, $array:ident;)*) => {
        /// Primitive as passed to a registered contact tester, in the frame of its own movable group.
        #[derive(Clone, Copy, Debug)]
        pub enum PrimitiveRef<'a> {
            $($(#[$doc])+ $kind(&'a $shape),)*
            /// Triangle of a mesh: the mesh, and the index of the triangle.
            Triangle(&'a TriangleSet, u32),
            /// Kind defined by the user.
            Custom(&'a dyn CustomPrimitive),
        }

        impl<'a> PrimitiveRef<'a> {
            /// Returns the kind of the primitive.
            pub fn kind(&self) -> PrimitiveKind {
                match self {
                    $(Self::$kind(_) => PrimitiveKind::$kind,)*
                    Self::Triangle(..) => PrimitiveKind::Triangle,
                    Self::Custom(_) => PrimitiveKind::Custom,
                }
            }

            /// Returns the properties of the primitive. `None` for a triangle, which is a part of its mesh,
            /// and for a custom primitive, which has only its support function.
            pub fn facts(&self) -> Option<&'a dyn Primitive> {
                match *self {
                    $(Self::$kind(shape) => Some(shape),)*
                    Self::Triangle(..) | Self::Custom(_) => None,
                }
            }

            /// Returns the point of A whose displacement deflects the bristle of a contact, m, as
            /// [`Primitive::reference_point`] does. For a custom primitive it is the centre of its
            /// axis-aligned box.
            #[inline]
            pub fn reference_point(&self, end: u32) -> Cow<'a, Vec3> {
                match *self {
                    $(Self::$kind(shape) => shape.reference_point(end),)*
                    Self::Triangle(..) => Cow::Owned(Vec3::zeros()),
                    Self::Custom(custom) => Cow::Owned(middle(custom)),
                }
            }
        }
    };
}

crate::for_each_kind!(define_reference);

impl PrimitiveRef<'_> {
    /// Returns the name of the kind; for a custom kind, its own name.
    pub fn kind_name(&self) -> &str {
        match self {
            Self::Custom(custom) => custom.kind_name(),
            other => other.kind().name(),
        }
    }
}

/// Returns the centre of a custom primitive's axis-aligned box; the frame's origin if the box is unbounded.
fn middle(primitive: &dyn CustomPrimitive) -> Vec3 {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let coordinates = axes.map(|axis| 0.5 * (primitive.support(&axis) - primitive.support(&-axis)));
    let middle = Vec3::from(coordinates);
    if middle.iter().all(|x| x.is_finite()) { middle } else { Vec3::zeros() }
}
