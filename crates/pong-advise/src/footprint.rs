//! Largest flat contact that a solid can make: its shadow along the normal of one of its faces.
//!
//! A convex solid that lies flat on a plane touches it with that face, and no deeper overlap has a larger section
//! than the shadow. A solid of several pieces counts its internal faces too, and a concave one all faces that look
//! into the direction, so their shadows are upper bounds.

use crate::mobility::{Mat6, Mobility, largest_eigenvalue};
use nalgebra::DMatrix;
use pong_geometry::{Mat3, Vec3};
use pong_model::Solid;

/// Number of directions that are compared, the largest faces first.
const DIRECTIONS: usize = 16;
/// Cosine above which two faces have one direction.
const PARALLEL: f64 = 0.999;

/// Shadow of a solid on the plane of a face, in the group frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Footprint {
    /// Area, m².
    pub area: f64,
    /// Unit normal of the face, outwards.
    normal: Vec3,
    /// Centre of the area, m.
    center: Vec3,
    /// Mean of y·yᵀ over the area, with y the position from the centre, m².
    spread: Mat3,
}

impl Footprint {
    /// Largest shadow of a solid; `None` if it has no area.
    pub fn largest(solid: &Solid) -> Option<Self> {
        let shadows = directions(solid).into_iter().filter_map(|normal| Self::along(solid, &normal));
        shadows.max_by(|a, b| a.area.total_cmp(&b.area))
    }

    /// Shadow on the plane of this normal.
    fn along(solid: &Solid, normal: &Vec3) -> Option<Self> {
        let origin = solid.bound.center;
        let (mut area, mut first, mut second) = (0.0, Vec3::zeros(), Mat3::zeros());
        for triangles in facets(solid) {
            let shadow = |[a, b, c]: &[Vec3; 3]| 0.5 * (b - a).cross(&(c - a)).dot(normal);
            if triangles.iter().map(shadow).sum::<f64>() <= 0.0 {
                continue;
            }
            for triangle in &triangles {
                let part = shadow(triangle);
                let [a, b, c] = triangle.map(|corner| corner - origin);
                let sum = a + b + c;
                area += part;
                first += sum * (part / 3.0);
                let squares = a * a.transpose() + b * b.transpose() + c * c.transpose();
                second += (squares + sum * sum.transpose()) * (part / 12.0);
            }
        }
        if area.is_nan() || area <= 0.0 {
            return None;
        }
        let mean = first / area.max(f64::MIN_POSITIVE);
        let spread = second / area.max(f64::MIN_POSITIVE) - mean * mean.transpose();
        Some(Self { area, normal: *normal, center: origin + mean, spread })
    }

    /// Largest inverse of the effective mass that an even pressure on the area feels along the normal, 1/kg: the
    /// largest eigenvalue of M⁻¹·(mean of JᵀJ) with J = (n, r × n). For a body above the middle of its face it is
    /// 1/m, or the larger value of its rocking.
    pub fn compliance(&self, mobility: &Mobility) -> f64 {
        let mut sum = Mat6::zeros();
        mobility.add(&mut sum, 1.0, &self.normal, &self.center);
        let turned = self.normal.cross_matrix();
        let rocking = (turned * self.spread * turned.transpose()).symmetric_eigen();
        for (axis, share) in rocking.eigenvectors.column_iter().zip(rocking.eigenvalues.iter()) {
            mobility.add_rotational(&mut sum, share.max(0.0), &axis.into_owned());
        }
        largest_eigenvalue(DMatrix::from_column_slice(6, 6, sum.as_slice()))
    }

    /// Largest inverse of the effective mass of the friction at the centre of the area, 1/kg.
    pub fn compliance_along(&self, mobility: &Mobility) -> f64 {
        mobility.compliance(&self.center)
    }
}

/// Triangles of each facet; those of a facet with holes overlap, and their signed areas add up to the facet.
fn facets(solid: &Solid) -> impl Iterator<Item = Vec<[Vec3; 3]>> {
    solid.parts.iter().flat_map(|part| {
        let vertices = part.surface.vertices();
        part.surface.facets().map(|edges| {
            let origin = edges.first().map_or(Vec3::zeros(), |[start, _]| vertices[*start as usize]);
            let triangle =
                |[start, end]: &[u32; 2]| [origin, vertices[*start as usize], vertices[*end as usize]];
            edges.iter().map(triangle).collect()
        })
    })
}

/// Outward unit normals of the largest facets; facets of one direction count once.
fn directions(solid: &Solid) -> Vec<Vec3> {
    let area = |triangles: Vec<[Vec3; 3]>| -> Vec3 {
        triangles.iter().map(|[a, b, c]| (b - a).cross(&(c - a)) * 0.5).sum()
    };
    let mut areas: Vec<(f64, Vec3)> = facets(solid).map(area).map(|area| (area.norm(), area)).collect();
    areas.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut chosen: Vec<Vec3> = Vec::new();
    for (size, area) in areas {
        if size == 0.0 || chosen.len() == DIRECTIONS {
            break;
        }
        let normal = area / size.max(f64::MIN_POSITIVE);
        if chosen.iter().all(|known| known.dot(&normal) < PARALLEL) {
            chosen.push(normal);
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GroupMass;
    use pong_testkit::ron::box_polyhedron;

    fn solid(half: [f64; 3]) -> Solid {
        let text = format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1e5) }}, root: (name: \"m\",
             surface: \"s\", contact: Solid, primitives: [{}]))",
            box_polyhedron("box", [0.3, -0.1, 0.7], half, "")
        );
        let model = pong_model::parse(&text, "m.ron", None, &pong_model::Extensions::new());
        model.unwrap_or_else(|errors| panic!("{errors}")).bodies.swap_remove(0).solids.swap_remove(0)
    }

    /// The largest face of a box is a·b; on it a plate of even mass feels 1/m, and its rocking less.
    #[test]
    fn shadow_of_a_box_is_its_largest_face() {
        let [a, b, c] = [0.4, 0.2, 0.1];
        let found = Footprint::largest(&solid([a / 2.0, b / 2.0, c / 2.0])).unwrap();
        assert!((found.area - a * b).abs() < 1e-15 && found.normal.z.abs() == 1.0);
        let lowest = Vec3::new(0.3, -0.1, 0.7 + 0.05 * found.normal.z);
        assert!((found.center - lowest).norm() < 1e-15, "{}", found.center);
        let moment = |one: f64, other: f64| 2.0 * (one * one + other * other) / 12.0;
        let inertia = [moment(b, c), moment(a, c), moment(a, b), 0.0, 0.0, 0.0];
        let mass = GroupMass { inertia, mass_center: [0.3, -0.1, 0.7], ..GroupMass::point(2.0) };
        let mobility = Mobility::new(&mass).unwrap();
        assert!((found.compliance(&mobility) - 0.5).abs() < 1e-14);
        // A body with its mass near the centre rocks: ∫y²dA/a over I.
        let dense = GroupMass { inertia: inertia.map(|moment| 0.1 * moment), ..mass };
        let rocking = (a * a / 12.0) / (0.1 * moment(a, c));
        assert!((found.compliance(&Mobility::new(&dense).unwrap()) / rocking - 1.0).abs() < 1e-12);
        // Friction at the face: 1/m + h²/I.
        let along = 0.5 + (c / 2.0) * (c / 2.0) / moment(b, c);
        assert!((found.compliance_along(&mobility) / along - 1.0).abs() < 1e-12);
    }
}
