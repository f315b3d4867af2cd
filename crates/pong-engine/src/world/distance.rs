//! Distance of two movable groups.

use super::World;
use crate::distance::{nearest, without_solid};
use crate::error::EngineError;
use crate::ids::InterfaceId;
use crate::seal::kind_name;
use pong_geometry::Vec3;

/// Distance of two movable groups.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupDistance {
    /// Smallest distance, m, between a primitive of one group and a primitive of the other that have a
    /// contact test with each other. Zero if two such primitives overlap; infinite if there are none.
    pub distance: f64,
    /// The nearest primitives; in front that of the group named first. `None` if the distance is infinite.
    pub nearest: Option<[NearestPrimitive; 2]>,
}

/// Primitive of a movable group that is nearest to another group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPrimitive {
    /// Index of the primitive in its movable group's list (see
    /// [`Scene::primitive_path`](crate::Scene::primitive_path)).
    pub primitive: u32,
    /// Index of the element within the primitive: a mesh's triangle, from 0; 0 for all other kinds.
    pub element: u32,
    /// Nearest point, m, in the common frame. If the primitives overlap, it is some point near them.
    pub point: Vec3,
}

impl World {
    /// Distance of two movable groups, with the two nearest primitives, at the states that were set last,
    /// whether a frame has been computed from them or not. Computed when it is asked for, so that a frame
    /// pays nothing. Allocates nothing.
    ///
    /// * Two primitives count if they have a contact test with each other and no filter keeps them apart. So
    ///   the distance is zero wherever the geometry of the two groups can be in contact.
    /// * A pair that is switched off has a distance too.
    /// * A triangle counts without its thickness, a ray with its free length.
    ///
    /// # Errors
    /// [`EngineError::UnknownId`] for an Interface of another world, [`EngineError::UnsetState`] for a group
    /// without a state, [`EngineError::BadValue`] for one and the same group, for groups whose Objects are
    /// not paired, and for a bore or a primitive of a host's kind that the other group can touch: these have
    /// no convex solid.
    pub fn distance(&self, a: InterfaceId, b: InterfaceId) -> Result<GroupDistance, EngineError> {
        let (a, b) = (self.scene.body_index(a)?, self.scene.body_index(b)?);
        let Some(group_pair) = self.sealed().group_pair_of(a.min(b), a.max(b)) else {
            self.require_paired([a, b], |[a, b]| format!("distance of `{a}` and `{b}`"))?;
            return Ok(GroupDistance { distance: f64::INFINITY, nearest: None });
        };
        if let Some(&unset) = [a, b].iter().find(|&&body| self.states.bodies[body].is_none()) {
            return Err(EngineError::UnsetState { interface: self.scene.body_name(unset) });
        }
        if let Some((body, primitive)) = without_solid(&self.scene, self.sealed(), group_pair) {
            return Err(self.has_no_solid([a, b], body, primitive));
        }
        let poses = &self.states.poses;
        let Some(nearest) = nearest(&self.scene, self.sealed(), group_pair, poses) else {
            return Ok(GroupDistance { distance: f64::INFINITY, nearest: None });
        };
        let frame = &poses[nearest.bodies[1]];
        let side = |body: usize| {
            let side = usize::from(nearest.bodies[1] == body);
            let (item, point) = (nearest.items[side], nearest.found.points_b[side]);
            let first = self.scene.body(body).primitives[item.primitive as usize].elements.start;
            let point = frame.position + frame.orientation * point;
            NearestPrimitive { primitive: item.primitive, element: item.element - first, point }
        };
        Ok(GroupDistance { distance: nearest.found.distance, nearest: Some([side(a), side(b)]) })
    }

    #[cold]
    fn has_no_solid(&self, groups: [usize; 2], body: usize, primitive: usize) -> EngineError {
        let [a, b] = groups.map(|group| self.scene.body_name(group));
        let group = self.scene.body(body);
        let info = &group.primitives[primitive];
        let (kind, path, holder) = (kind_name(group, info), &info.path, self.scene.body_name(body));
        let cause = format!(
            "`{path}` of `{holder}` is a {kind}, which has no convex solid; give it to a movable group of its own, or keep it \
             and what it meets apart with a filter"
        );
        EngineError::BadValue { what: format!("distance of `{a}` and `{b}`"), cause }
    }
}
