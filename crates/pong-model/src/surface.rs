//! Surface properties: stiffness, damping and friction, per surface and per pair of surfaces.

use crate::limits::LARGEST;

/// A named surface: what primitives are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name, unique in the model.
    pub name: String,
    /// Normal stiffness: N/m, or N/m^1.5 with the exponent 3/2; infinite means rigid. If finite, within
    /// [`SOFTEST`](Self::SOFTEST) and [`STIFFEST`](Self::STIFFEST).
    pub stiffness: f64,
    /// Normal force law and its damping.
    pub normal: NormalLaw,
    /// Friction law.
    pub friction: FrictionLaw,
}

impl PairOverride {
    /// How many of the two names say the model, if the entry is for these two surfaces, given as (model, surface); `None` if
    /// it is not. Of two entries that are, the one that says more goes first.
    pub fn names_models(&self, a: (&str, &str), b: (&str, &str)) -> Option<usize> {
        let [one, other] = &self.surfaces;
        let in_order = |x, y| Some(names(one, x)? + names(other, y)?);
        in_order(a, b).max(in_order(b, a))
    }
}

/// 1 if a name of an entry says model and surface, 0 if only the surface, `None` if it is another's.
fn names(entry: &str, (model, surface): (&str, &str)) -> Option<usize> {
    if entry == surface {
        return Some(0);
    }
    let rest = entry.strip_prefix(model)?.strip_prefix('/')?;
    (rest == surface).then_some(1)
}

impl Surface {
    /// Whether an entry of the table of pairs means this surface, of a model of that name.
    pub fn is_called(&self, entry: &str, model: &str) -> bool {
        names(entry, (model, &self.name)).is_some()
    }

    /// Whether it says nothing of its own about a law, and so takes that of what it meets.
    pub fn inherits(&self) -> bool {
        self.normal == NormalLaw::Inherited || self.friction == FrictionLaw::Inherited
    }

    /// k_t (N/m) and c_t (N·s/m) of its bristle, values left out included; `None` without a bristle.
    pub fn bristle(&self) -> Option<(f64, f64)> {
        let FrictionLaw::Bristle { stiffness, damping, .. } = self.friction else { return None };
        let k_t = stiffness.unwrap_or(Self::BRISTLE_SHARE * self.stiffness);
        Some((k_t, damping.unwrap_or_else(|| self.normal.bristle_damping(self.stiffness, k_t))))
    }

    /// Stiffness of a bristle that gives none, over the normal stiffness.
    pub const BRISTLE_SHARE: f64 = 2.0 / 3.0;

    /// The stiffest that is not rigid, N/m (N/m^1.5 with the exponent 3/2), of surface, pair and bristle. As no place is
    /// beyond 1e100 m, energy and moment of a spring without damping stay below 1e301: within the range of numbers, and so
    /// do sums of stiffnesses.
    pub const STIFFEST: f64 = LARGEST;
    /// The softest, N/m: its inverse and its share of the yield stay within that range.
    pub const SOFTEST: f64 = 1e-100;

    /// Whether a spring may have this stiffness, if it is not rigid.
    pub fn can_be_so_stiff(stiffness: f64) -> bool {
        (Self::SOFTEST..=Self::STIFFEST).contains(&stiffness)
    }
}

/// The normal force law of a surface (docs/theory.md, 3).
#[derive(Clone, Debug, PartialEq)]
pub enum NormalLaw {
    /// F = max(0, k·δ + c·S(δ/ramp)·δ').
    Linear {
        /// c, N·s/m.
        damping: f64,
        /// Depth over which the damping sets in, m; 0 means at once.
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
    /// A law registered with the engine under this name.
    Custom {
        /// Name of the registered law.
        name: String,
        /// Handed to the law as they stand.
        parameters: Vec<f64>,
    },
    /// That of the surface it meets: a rigid surface that names none.
    Inherited,
}

impl NormalLaw {
    /// Exponent of the depth in the spring's force; 1 of a law of the host's.
    pub fn exponent(&self) -> Exponent {
        match self {
            Self::HuntCrossley { exponent, .. } | Self::PowerLaw { exponent, .. } => *exponent,
            Self::Linear { .. } | Self::Custom { .. } | Self::Inherited => Exponent::One,
        }
    }

    /// c_t (N·s/m) of a bristle of stiffness `k_t` that gives none, beside a normal spring of stiffness `k`: c·√(k_t/k) is the
    /// damping ratio of the linear law on every mass. A rigid surface and the other laws have no such ratio, which leaves 0.
    pub fn bristle_damping(&self, k: f64, k_t: f64) -> f64 {
        match self {
            // Finite on both sides: a compiler may divide before it asks for k, and ∞/∞ traps.
            Self::Linear { damping, .. } if k.is_finite() => {
                damping * (k_t.min(f64::MAX) / k.min(f64::MAX)).sqrt()
            }
            _ => 0.0,
        }
    }
}

/// Exponent of the depth in the Hunt-Crossley law and in the power law.
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

/// The friction law of a surface (docs/theory.md, 4).
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
    },
    /// Regularised Coulomb friction; creeps.
    Coulomb {
        /// μ_k.
        mu: f64,
        /// v_ε, the slip speed at which the full force is reached, m/s.
        slip_speed: f64,
    },
    /// A law registered with the engine under this name.
    Custom {
        /// Name of the registered law.
        name: String,
        /// Handed to the law as they stand.
        parameters: Vec<f64>,
    },
    /// That of the surface it meets: a rigid surface that names none.
    Inherited,
}

/// An entry of the model's table for a pair of surfaces: every value given replaces the combined one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairOverride {
    /// The two surfaces, in either order; they may be the same, and may belong to another model. `model/surface` is that
    /// surface of that model alone, a name without a slash that of any model.
    pub surfaces: [String; 2],
    /// k of the pair, N/m (N/m^1.5).
    pub stiffness: Option<f64>,
    /// Normal law with its damping values, those of the pair.
    pub normal: Option<NormalLaw>,
    /// Friction law with its values, those of the pair. `stiffness: None` keeps ⅔·k. `damping: None` follows the normal law of
    /// this entry, or without one keeps the damping ratio that the bristles of the two surfaces have together.
    pub friction: Option<FrictionLaw>,
}
