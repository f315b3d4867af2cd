//! Input of the step adviser, kept until the seal and for later checks.

use pong_advise::{GroupMass, Joints, SpringRates, StepPlan, StepReport};
use pong_engine::{EngineError, InterfaceId, Scene, World};
use std::collections::BTreeMap;

/// Masses, joints and step plan that the host gave the step adviser before the seal.
#[derive(Clone, Default)]
pub(crate) struct Advice {
    masses: BTreeMap<InterfaceId, GroupMass>,
    pub plan: Option<StepPlan>,
}

impl Advice {
    pub fn set_mass(
        &mut self,
        scene: &Scene,
        interface: InterfaceId,
        mass: GroupMass,
    ) -> Result<(), EngineError> {
        mass.check(&scene.interface_name(interface)?)?;
        self.masses.insert(interface, mass);
        Ok(())
    }

    /// # Errors
    /// Fails for a group without a mass, and for values that no mechanism has.
    pub fn set_joints(
        &mut self,
        scene: &Scene,
        interface: InterfaceId,
        joints: Joints,
        springs: SpringRates,
    ) -> Result<(), EngineError> {
        let name = scene.interface_name(interface)?;
        let Some(mass) = self.masses.get_mut(&interface) else {
            let cause = "the group has no mass; call pong_set_mass() first".to_owned();
            return Err(EngineError::BadValue { what: format!("joints of `{name}`"), cause });
        };
        let changed = GroupMass { joints: Some(joints), springs, ..*mass };
        changed.check(&name)?;
        *mass = changed;
        Ok(())
    }

    pub fn masses(&self) -> Vec<(InterfaceId, GroupMass)> {
        self.masses.iter().map(|(interface, mass)| (*interface, *mass)).collect()
    }

    /// Report of the planned step in the sealed world; `None` without a plan.
    pub fn report(&self, world: &World) -> Result<Option<StepReport>, EngineError> {
        self.plan.as_ref().map(|plan| pong_advise::step_report(world, plan, &self.masses())).transpose()
    }
}
