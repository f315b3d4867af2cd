//! Velocity or travel of a surface that moves along itself, as a field of position and normal.

use pong_geometry::Vec3;

/// Velocity or travel of a surface relative to its movable group, as a field of position and normal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SurfaceField {
    linear: Vec3,
    angular: Vec3,
    belt: Vec3,
}

impl SurfaceField {
    /// Count of numbers.
    pub const NUMBERS: usize = 9;

    pub fn new([linear, angular, belt]: [Vec3; 3]) -> Self {
        Self { linear, angular, belt }
    }

    /// Linear part, angular part, belt part.
    pub fn parts(&self) -> [Vec3; 3] {
        [self.linear, self.angular, self.belt]
    }

    /// Angular part: rad/s or rad.
    pub fn angular(&self) -> &Vec3 {
        &self.angular
    }

    pub fn from_numbers(numbers: &[f64; Self::NUMBERS]) -> Self {
        let [a, b, c, d, e, f, g, h, i] = *numbers;
        Self { linear: Vec3::new(a, b, c), angular: Vec3::new(d, e, f), belt: Vec3::new(g, h, i) }
    }

    pub fn numbers(&self) -> [f64; Self::NUMBERS] {
        let (l, a, b) = (&self.linear, &self.angular, &self.belt);
        [l.x, l.y, l.z, a.x, a.y, a.z, b.x, b.y, b.z]
    }

    /// Value at a point with an outward unit normal.
    pub fn at(&self, point: &Vec3, normal: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(point) + self.belt.cross(normal)
    }

    /// Difference of two fields.
    pub fn minus(&self, other: &Self) -> Self {
        Self {
            linear: self.linear - other.linear,
            angular: self.angular - other.angular,
            belt: self.belt - other.belt,
        }
    }

    pub fn is_zero(&self) -> bool {
        *self == Self::default()
    }
}
