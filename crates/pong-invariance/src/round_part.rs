//! Round parts as plain data: capsule, cylinder, cone, bore.

use pong_geometry::{Pose, Quat, Vec3};

/// A round part, with the fields of a model file. Lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundPart {
    /// Kind of the part.
    pub kind: RoundKind,
    /// Ends of its axis.
    pub ends: [Vec3; 2],
    /// Radius at each end; equal for a capsule and a cylinder.
    pub radii: [f64; 2],
    /// Depth behind its wall to which a bore pushes; by default its smaller radius.
    pub thickness: Option<f64>,
    /// True for each end of a bore that is a convex edge.
    pub mouths: [bool; 2],
}

/// Kind of a round part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum RoundKind {
    Capsule,
    Cylinder,
    Cone,
    Bore,
}

impl RoundPart {
    /// A part with a radius at each end and convex openings.
    pub fn new(kind: RoundKind, ends: [Vec3; 2], radii: [f64; 2]) -> Self {
        Self { kind, ends, radii, thickness: None, mouths: [true; 2] }
    }

    /// Name of its kind in a model file.
    pub fn kind_name(&self) -> &'static str {
        match self.kind {
            RoundKind::Capsule => "Capsule",
            RoundKind::Cylinder => "Cylinder",
            RoundKind::Cone => "Cone",
            RoundKind::Bore => "Bore",
        }
    }

    /// Unit vector from end 0 to end 1.
    pub fn axis(&self) -> Vec3 {
        (self.ends[1] - self.ends[0]).normalize()
    }

    /// The larger of its radii, m.
    pub fn widest(&self) -> f64 {
        self.radii[0].max(self.radii[1])
    }

    /// The part transformed by a pose.
    pub fn carried(&self, pose: &Pose) -> Self {
        Self { ends: self.ends.map(|end| pose.orientation * end + pose.position), ..self.clone() }
    }

    /// The part in another unit of length.
    pub fn scaled(&self, s: f64) -> Self {
        Self {
            ends: self.ends.map(|end| end * s),
            radii: self.radii.map(|radius| radius * s),
            // `black_box`: the compiler may multiply before it tests for a thickness, on undefined bits (ci/traps).
            thickness: self.thickness.and(Some(std::hint::black_box(self.thickness.unwrap_or(0.0)) * s)),
            ..self.clone()
        }
    }

    /// The part with its ends in reverse order.
    pub fn reversed(&self) -> Self {
        let Self { ends: [p, q], radii: [r, s], mouths: [m, n], .. } = *self;
        Self { ends: [q, p], radii: [s, r], mouths: [n, m], ..self.clone() }
    }

    /// The part with its numbers rounded to single precision.
    pub fn in_single_precision(&self) -> Self {
        let single = |x: f64| f64::from(x as f32);
        Self { ends: self.ends.map(|end| end.map(single)), radii: self.radii.map(single), ..self.clone() }
    }

    /// Divides a hole into two that meet at the fraction `t` of its length.
    pub fn cut(&self, t: f64) -> [Self; 2] {
        let Self { ends: [p, q], radii: [r, s], .. } = *self;
        let (seam, radius) = (p + (q - p) * t, r + (s - r) * t);
        let thickness = Some(self.thickness.unwrap_or(if r.min(s) > 0.0 { r.min(s) } else { r.max(s) }));
        [
            Self {
                ends: [p, seam],
                radii: [r, radius],
                mouths: [self.mouths[0], false],
                thickness,
                ..self.clone()
            },
            Self {
                ends: [seam, q],
                radii: [radius, s],
                mouths: [false, self.mouths[1]],
                thickness,
                ..self.clone()
            },
        ]
    }

    /// Rotation about its own axis by an angle, as a pose of its group.
    pub fn own_turn(&self, angle: f64) -> Pose {
        let orientation: Quat = crate::random::rotation_about(&self.axis(), angle);
        let middle = (self.ends[0] + self.ends[1]) * 0.5;
        Pose { position: middle - orientation * middle, orientation }
    }

    /// Support point of a solid part along a unit direction, at end 0 or 1, or at its middle (2).
    pub fn lowest(&self, down: &Vec3, end: usize) -> Vec3 {
        let axis = self.axis();
        let (place, radius) = match end {
            0 | 1 => (self.ends[end], self.radii[end]),
            _ => ((self.ends[0] + self.ends[1]) * 0.5, 0.5 * (self.radii[0] + self.radii[1])),
        };
        let across = down - axis * axis.dot(down);
        match self.kind {
            RoundKind::Capsule => place + down * radius,
            _ if across.norm() < 1e-12 => place,
            _ => place + across.normalize() * radius,
        }
    }
}
