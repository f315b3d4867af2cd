//! Surface properties: stiffness, damping and friction, per surface and per pair of surfaces.

use crate::limits::LARGEST;

/// Named surface: the material of primitives.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name, unique in the model.
    pub name: String,
    /// Normal stiffness: N/m, or N/m^1.5 with the exponent 3/2; infinite means rigid. If finite, within
    /// [`SOFTEST`](Self::SOFTEST) and [`STIFFEST`](Self::STIFFEST).
    pub stiffness: f64,
    /// Foundation modulus K of solids, N/m³; `None` takes stiffness over area.
    pub foundation: Option<f64>,
    /// Area over which a solid's contact has the stiffness, m²; `None` takes that of each solid
    /// ([`Solid::reference_area`](crate::Solid::reference_area)).
    pub area: Option<f64>,
    /// Normal force law and its damping.
    pub normal: NormalLaw,
    /// Friction law.
    pub friction: FrictionLaw,
}

impl PairOverride {
    /// Priority of the entry for two surfaces, each given as (model, surface): the number of names in the
    /// entry that include a model. `None` if the entry does not apply to them. Of two entries that apply, the
    /// one with the greater number counts.
    pub fn names_models(&self, a: (&str, &str), b: (&str, &str)) -> Option<usize> {
        let [one, other] = &self.surfaces;
        let in_order = |x, y| Some(names(one, x)? + names(other, y)?);
        in_order(a, b).max(in_order(b, a))
    }
}

/// Returns 1 if a name of an entry matches with model and surface, 0 if it matches with the surface only,
/// `None` if it does not match.
fn names(entry: &str, (model, surface): (&str, &str)) -> Option<usize> {
    if entry == surface {
        return Some(0);
    }
    let rest = entry.strip_prefix(model)?.strip_prefix('/')?;
    (rest == surface).then_some(1)
}

impl Surface {
    /// Returns `true` if `entry`, a name in a pair table, means this surface of the model named `model`.
    pub fn is_called(&self, entry: &str, model: &str) -> bool {
        names(entry, (model, &self.name)).is_some()
    }

    /// Returns `true` if the surface defines no normal or no friction law, and so takes the law of the other
    /// surface.
    pub fn inherits(&self) -> bool {
        self.normal == NormalLaw::Inherited || self.friction == FrictionLaw::Inherited
    }

    /// Stiffness k_t (N/m) and damping c_t (N·s/m) of its bristle, defaults included; `None` without a
    /// bristle.
    pub fn bristle(&self) -> Option<(f64, f64)> {
        let FrictionLaw::Bristle { stiffness, damping, .. } = self.friction else { return None };
        let k_t = stiffness.unwrap_or(Self::BRISTLE_SHARE * self.stiffness);
        Some((k_t, damping.unwrap_or_else(|| self.normal.bristle_damping(self.stiffness, k_t))))
    }

    /// Lengths of its rolling and its spinning resistance, m; zero without a bristle.
    pub fn resistances(&self) -> [f64; 2] {
        match self.friction {
            FrictionLaw::Bristle { rolling, spinning, .. } => [rolling, spinning],
            _ => [0.0; 2],
        }
    }

    /// Default stiffness of a bristle relative to the normal stiffness.
    pub const BRISTLE_SHARE: f64 = 2.0 / 3.0;

    /// Largest finite stiffness, N/m (N/m^1.5 with the exponent 3/2), of surface, pair and bristle. As no
    /// coordinate exceeds 1e100 m, energy and moment of a spring without damping stay below 1e301, within the
    /// range of numbers, and so do sums of stiffnesses.
    pub const STIFFEST: f64 = LARGEST;
    /// Smallest stiffness, N/m: its inverse and its share of the depth stay within the range of numbers.
    pub const SOFTEST: f64 = 1e-100;

    /// Returns `true` if a spring that is not rigid may have this stiffness.
    pub fn can_be_so_stiff(stiffness: f64) -> bool {
        (Self::SOFTEST..=Self::STIFFEST).contains(&stiffness)
    }
}

/// Normal force law of a surface (docs/theory.md, 3).
#[derive(Clone, Debug, PartialEq)]
pub enum NormalLaw {
    /// F = max(0, k·δ + c·S(δ/ramp)·δ').
    Linear {
        /// c, N·s/m.
        damping: f64,
        /// Depth over which the damping sets in, m; 0 for immediately.
        ramp: f64,
    },
    /// F = max(0, k·δ^e·(1 + χ·δ')).
    HuntCrossley {
        /// χ, s/m.
        dissipation: f64,
        /// e.
        exponent: Exponent,
    },
    /// F = max(0, k·δ^p + c·δ^q·δ').
    PowerLaw {
        /// c, N·s/m^(1+q).
        damping: f64,
        /// p.
        exponent: Exponent,
        /// q, from 0 to p.
        damping_exponent: f64,
    },
    /// Law registered with the engine under this name.
    Custom {
        /// Name of the registered law.
        name: String,
        /// Parameters passed to the law unchanged.
        parameters: Vec<f64>,
    },
    /// Law of the other surface: for a rigid surface that names none.
    Inherited,
}

impl NormalLaw {
    /// Exponent of the depth in the spring's force; 1 for a law of the host.
    pub fn exponent(&self) -> Exponent {
        match self {
            Self::HuntCrossley { exponent, .. } | Self::PowerLaw { exponent, .. } => *exponent,
            Self::Linear { .. } | Self::Custom { .. } | Self::Inherited => Exponent::One,
        }
    }

    /// Default damping c_t (N·s/m) of a bristle of stiffness `k_t` beside a normal spring of stiffness `k`:
    /// c·√(k_t/k). For every mass, the bristle then has the damping ratio of the linear law. A rigid surface
    /// and the other laws have no such ratio; the result is then 0.
    pub fn bristle_damping(&self, k: f64, k_t: f64) -> f64 {
        match self {
            // Both operands finite: a compiler may divide before it tests `k`, and ∞/∞ is an invalid
            // operation.
            Self::Linear { damping, .. } if k.is_finite() => {
                damping * (k_t.min(f64::MAX) / k.min(f64::MAX)).sqrt()
            }
            _ => 0.0,
        }
    }
}

/// Exponent of the depth in the Hunt-Crossley law and the power law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exponent {
    /// e = 1.
    One,
    /// e = 3/2 (Hertz).
    ThreeHalves,
}

impl Exponent {
    /// 1 or 1.5.
    pub fn value(self) -> f64 {
        match self {
            Self::One => 1.0,
            Self::ThreeHalves => 1.5,
        }
    }
}

/// Friction law of a surface (docs/theory.md, 4).
#[derive(Clone, Debug, PartialEq)]
pub enum FrictionLaw {
    /// No friction; costs nothing.
    None,
    /// Reset-integrator bristle.
    Bristle {
        /// μ_k.
        mu: f64,
        /// a, so that μ_s = (1 + a)·μ_k.
        static_excess: f64,
        /// k_t, N/m; `None` takes ⅔ of the normal stiffness.
        stiffness: Option<f64>,
        /// c_t, N·s/m; `None` takes the damping ratio of the normal law ([`NormalLaw::bristle_damping`]).
        damping: Option<f64>,
        /// b_r, rolling resistance: largest moment against rolling over the normal force, m.
        rolling: f64,
        /// b_s, spinning resistance: largest moment against turning about the normal over the normal force, m.
        spinning: f64,
    },
    /// Regularised Coulomb friction; creeps.
    Coulomb {
        /// μ_k.
        mu: f64,
        /// v_ε, the slip speed at which the full force is reached, m/s.
        slip_speed: f64,
    },
    /// Law registered with the engine under this name.
    Custom {
        /// Name of the registered law.
        name: String,
        /// Parameters passed to the law unchanged.
        parameters: Vec<f64>,
    },
    /// Law of the other surface: for a rigid surface that names none.
    Inherited,
}

/// Entry of the model's table for a pair of surfaces: every value given replaces the combined one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairOverride {
    /// The two surfaces, in either order; they may be equal, and may belong to another model. `model/surface`
    /// is that surface of that model only; a name without a slash is that surface of any model.
    pub surfaces: [String; 2],
    /// Stiffness k of the pair, N/m (N/m^1.5).
    pub stiffness: Option<f64>,
    /// Normal law of the pair, with its damping values.
    pub normal: Option<NormalLaw>,
    /// Friction law of the pair, with its values. `stiffness: None` keeps ⅔·k. `damping: None` follows the
    /// normal law of this entry or, without one, keeps the combined damping ratio of the bristles of the two
    /// surfaces.
    pub friction: Option<FrictionLaw>,
}
