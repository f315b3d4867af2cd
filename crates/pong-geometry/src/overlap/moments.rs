//! Moments of a volume up to the second order.

use crate::{Mat3, Vec3};

/// Moments of a volume about a reference point, along the axes of B's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Volume ∫ dV, m³.
    pub volume: f64,
    /// First moment ∫ y dV, m⁴; y is the position from the reference point.
    pub first_b: Vec3,
    /// Second moment ∫ y yᵀ dV, m⁵.
    pub second: Mat3,
}

impl Moments {
    /// Returns the centroid, as a position from the reference point, m.
    pub fn centroid(&self) -> Vec3 {
        self.first_b / self.volume
    }

    /// Returns the moments of the same volume about another point. `from` is the position of the present
    /// reference point, seen from the new one, m.
    pub fn about(&self, from: &Vec3) -> Self {
        let mixed = from * self.first_b.transpose();
        Self {
            volume: self.volume,
            first_b: self.first_b + from * self.volume,
            second: self.second + mixed + mixed.transpose() + from * from.transpose() * self.volume,
        }
    }
}

impl std::ops::AddAssign for Moments {
    /// Adds the moments of another volume about the same point.
    fn add_assign(&mut self, other: Self) {
        self.volume += other.volume;
        self.first_b += other.first_b;
        self.second += other.second;
    }
}

/// Sums over tetrahedra of the reference point and a triangle each. The common factors of the moments are
/// left for the end, and of the symmetric second moment only six entries are summed.
#[derive(Default)]
pub(super) struct Tetrahedra {
    /// Six times the volume, m³.
    volumes: f64,
    /// 24 times the first moment, m⁴.
    firsts: Vec3,
    /// 120 times the second moment, m⁵: xx, yy and zz; yz, zx and xy.
    squares: Vec3,
    products: Vec3,
}

impl Tetrahedra {
    /// Adds the tetrahedron of the reference point and a triangle. The corners of the triangle are positions
    /// from the reference point, m. The tetrahedron counts positive if they run counter-clockwise, seen from
    /// the side away from the reference point; otherwise negative.
    #[inline]
    pub fn add(&mut self, [a, b, c]: [Vec3; 3]) {
        let volume = a.dot(&b.cross(&c));
        let sum = a + b + c;
        let square =
            |axis: usize| a[axis] * a[axis] + b[axis] * b[axis] + c[axis] * c[axis] + sum[axis] * sum[axis];
        let product = |i: usize, j: usize| a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j];
        self.volumes += volume;
        self.firsts += sum * volume;
        self.squares += Vec3::new(square(0), square(1), square(2)) * volume;
        self.products += Vec3::new(product(1, 2), product(2, 0), product(0, 1)) * volume;
    }

    /// Returns the moments of all tetrahedra.
    pub fn moments(&self) -> Moments {
        let (squares, products) = (self.squares / 120.0, self.products / 120.0);
        let (yz, zx, xy) = (products.x, products.y, products.z);
        Moments {
            volume: self.volumes / 6.0,
            first_b: self.firsts / 24.0,
            second: Mat3::new(squares.x, xy, zx, xy, squares.y, yz, zx, yz, squares.z),
        }
    }
}
