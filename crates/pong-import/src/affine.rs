//! Transforms of nodes: composed in double precision, taken apart only where a rigid frame is needed.

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};

/// Largest cosine between two axes of a frame that counts as a right angle: matrices in files have single
/// precision.
const RIGHT_ANGLE: f64 = 1e-6;
/// Scales within this share of each other count as one.
const SAME_SCALE: f64 = 1e-6;

/// `x ↦ linear·x + translation`, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    pub linear: Matrix3<f64>,
    pub translation: Vector3<f64>,
}

/// Factors of a linear map: `turn · diag(scale)`, a stretch along the axes followed by a rotation.
pub struct Stretch {
    pub turn: UnitQuaternion<f64>,
    /// Positive unless `mirrored`; then the last one is negative.
    pub scale: Vector3<f64>,
    pub mirrored: bool,
}

/// Reasons why a linear map is not a stretch followed by a rotation.
#[derive(Debug, PartialEq)]
pub enum Skew {
    /// The determinant is zero.
    Flat,
    /// Largest cosine between two axes; zero without shear.
    Sheared(f64),
}

impl Affine {
    pub fn identity() -> Self {
        Self { linear: Matrix3::identity(), translation: Vector3::zeros() }
    }

    /// Builds the map from translation, rotation (x, y, z, w) and scale; `None` for a zero quaternion.
    pub fn from_parts(translation: Vector3<f64>, rotation: [f64; 4], scale: Vector3<f64>) -> Option<Self> {
        let [x, y, z, w] = rotation;
        let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-6)?;
        Some(Self {
            linear: turn.to_rotation_matrix().into_inner() * Matrix3::from_diagonal(&scale),
            translation,
        })
    }

    /// Composition: first `inner`, then `self`.
    pub fn after(&self, inner: &Self) -> Self {
        Self { linear: self.linear * inner.linear, translation: self.point(&inner.translation) }
    }

    pub fn point(&self, place: &Vector3<f64>) -> Vector3<f64> {
        self.linear * place + self.translation
    }

    pub fn is_identity(&self) -> bool {
        *self == Self::identity()
    }

    /// Tests whether the map turns a surface inside out.
    pub fn mirrors(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    pub fn stretch(&self) -> Result<Stretch, Skew> {
        let axes: Vec<Vector3<f64>> = self.linear.column_iter().map(|axis| axis.into_owned()).collect();
        let lengths = Vector3::new(axes[0].norm(), axes[1].norm(), axes[2].norm());
        if lengths.min() <= 1e-12 * lengths.max() || !lengths.iter().all(|length| length.is_finite()) {
            return Err(Skew::Flat);
        }
        let cosine = |i: usize, j: usize| (axes[i].dot(&axes[j]) / (lengths[i] * lengths[j])).abs();
        let worst = cosine(0, 1).max(cosine(1, 2)).max(cosine(2, 0));
        if worst > RIGHT_ANGLE {
            return Err(Skew::Sheared(worst));
        }
        let mirrored = self.mirrors();
        let x = axes[0] / lengths[0];
        let y = (axes[1] - x * x.dot(&axes[1])).normalize();
        let turn = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, x.cross(&y)]));
        let scale = if mirrored { Vector3::new(lengths.x, lengths.y, -lengths.z) } else { lengths };
        Ok(Stretch { turn: UnitQuaternion::from_rotation_matrix(&turn), scale, mirrored })
    }
}

impl Stretch {
    /// Common scale of all axes; `None` if they differ.
    pub fn uniform(&self) -> Option<f64> {
        let scale = self.scale.abs();
        (scale.max() - scale.min() <= SAME_SCALE * scale.max()).then_some(scale.x)
    }
}

/// Upward axis of a source; models have z up, y to the left of x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Up {
    /// glTF's: x stays, −z becomes y, y becomes z.
    Y,
    /// No rotation.
    Z,
    /// Collada's: −y becomes x, −z becomes y, x becomes z.
    X,
}

impl Up {
    /// A position or direction of the source in the axes of the model; exact.
    pub fn turned(self, v: Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Y => Vector3::new(v.x, 0.0 - v.z, v.y),
            Self::Z => v,
            Self::X => Vector3::new(0.0 - v.y, 0.0 - v.z, v.x),
        }
    }

    /// A node's transform in the axes of the model; its local axes are turned as well.
    pub fn turned_transform(self, transform: &Affine) -> Affine {
        let turn = match self {
            Self::Z => return *transform,
            Self::Y => Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0),
            Self::X => Matrix3::new(0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0),
        };
        Affine {
            linear: turn * transform.linear * turn.transpose(),
            translation: self.turned(transform.translation),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(axis: [f64; 3], angle: f64, scale: [f64; 3]) -> Affine {
        let turn =
            UnitQuaternion::from_axis_angle(&nalgebra::Unit::new_normalize(Vector3::from(axis)), angle);
        let rotation = [turn.i, turn.j, turn.k, turn.w];
        Affine::from_parts(Vector3::new(1.0, 2.0, 3.0), rotation, Vector3::from(scale)).unwrap()
    }

    #[test]
    fn a_stretch_is_taken_apart_and_put_together() {
        for scale in [[1.0, 1.0, 1.0], [0.5, 2.0, 3.0], [-1.0, 1.0, 1.0], [-2.0, -1.0, 1.0]] {
            let affine = turned([1.0, -2.0, 0.5], 0.8, scale);
            let stretch = affine.stretch().unwrap();
            let again =
                stretch.turn.to_rotation_matrix().into_inner() * Matrix3::from_diagonal(&stretch.scale);
            assert!((again - affine.linear).norm() < 1e-14, "{again}");
            assert_eq!(stretch.mirrored, scale.iter().product::<f64>() < 0.0);
        }
    }

    #[test]
    fn shear_and_flatness_are_seen() {
        let parent = turned([0.0, 0.0, 1.0], 0.0, [2.0, 1.0, 1.0]);
        let sheared = parent.after(&turned([0.0, 0.0, 1.0], 0.7, [1.0; 3]));
        assert!(matches!(sheared.stretch(), Err(Skew::Sheared(cosine)) if cosine > 0.1));
        assert_eq!(turned([0.0, 0.0, 1.0], 0.0, [1.0, 0.0, 1.0]).stretch().err(), Some(Skew::Flat));
    }

    #[test]
    fn up_turns_nodes_with_their_vertices() {
        let node = turned([0.3, 0.2, -1.0], 1.1, [1.0, 2.0, 3.0]);
        let v = Vector3::new(0.3, -0.7, 1.9);
        for up in [Up::X, Up::Y, Up::Z] {
            let turned_node = up.turned_transform(&node);
            assert!((turned_node.point(&up.turned(v)) - up.turned(node.point(&v))).norm() < 1e-14);
        }
        assert_eq!(Up::X.turned(Vector3::x()), Vector3::z());
        assert_eq!(Up::Y.turned(Vector3::y()), Vector3::z());
    }
}
