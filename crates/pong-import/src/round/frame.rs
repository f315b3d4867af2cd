//! A frame whose z axis is that of a round part.

use nalgebra::Vector3;

/// Origin on the axis, and three unit vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) origin: Vector3<f64>,
    x: Vector3<f64>,
    y: Vector3<f64>,
    pub(super) z: Vector3<f64>,
}

impl Frame {
    /// Builds a frame about an axis, which need not be of unit length.
    pub(super) fn about(origin: Vector3<f64>, axis: &Vector3<f64>) -> Self {
        let z = axis.normalize();
        let least = [Vector3::x(), Vector3::y(), Vector3::z()]
            .into_iter()
            .min_by(|a, b| a.dot(&z).abs().total_cmp(&b.dot(&z).abs()))
            .unwrap_or_default();
        let x = least.cross(&z).normalize();
        Self { origin, x, y: z.cross(&x), z }
    }

    /// Coordinates of a point.
    pub(super) fn local(&self, place: &Vector3<f64>) -> Vector3<f64> {
        let arm = place - self.origin;
        Vector3::new(self.x.dot(&arm), self.y.dot(&arm), self.z.dot(&arm))
    }

    /// Point of the axis at a height.
    pub(super) fn on_axis(&self, z: f64) -> Vector3<f64> {
        self.origin + self.z * z
    }

    /// The frame shifted across its axis and tilted by these slopes of x and y over z.
    pub(super) fn changed(&self, across: [f64; 2], leant: [f64; 2]) -> Self {
        let origin = self.origin + self.x * across[0] + self.y * across[1];
        Self::about(origin, &(self.z + self.x * leant[0] + self.y * leant[1]))
    }
}
