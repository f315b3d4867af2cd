//! Masses, steps and their loads.

use super::session::{Session, Sure};
use pong::ids::pong_interface_id;
use pong::step_plan::{
    pong_check_step, pong_default_step_plan, pong_joints, pong_mass, pong_plan_step, pong_set_joints,
    pong_set_mass, pong_step_check,
};

impl Session<'_> {
    /// Valid masses and a step, in most worlds.
    pub fn good_plan(&mut self, kind: u8) {
        if kind == 1 {
            return;
        }
        let host = self.host().expect("just made");
        let (world, interfaces) = (host.world, host.ids.interfaces.clone());
        for (index, interface) in interfaces.into_iter().enumerate() {
            let mass = if index == 0 { f64::INFINITY } else { 2.0 };
            let mass = pong_mass { mass, inertia: [1.0, 1.0, 1.0, 0.0, 0.0, 0.0], mass_center: [0.1; 3] };
            self.call("set mass", Sure::Right, || unsafe { pong_set_mass(world, interface, &mass) });
        }
        let mut plan = pong_default_step_plan();
        plan.step = 1e-2;
        plan.wrench_coupling = 1 + u32::from(kind % 3);
        self.call("plan step", Sure::Right, || unsafe { pong_plan_step(world, &plan) });
    }

    /// Any mass and plan, and loads of the present plan.
    pub fn plan_any(&mut self) {
        let (world, known) = self.world();
        let sealed = self.host().is_some_and(|host| host.sealed);
        let (interface, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let mut mass = pong_mass { mass: self.input.number(), inertia: [0.0; 6], mass_center: [0.0; 3] };
        let fit = mass.mass == f64::INFINITY || (1e-100..=1e100).contains(&mass.mass);
        let mut sure = known.and(good).only_if(!sealed && fit);
        if self.input.chance(128) {
            mass.inertia = [(); 6].map(|()| self.input.number());
            mass.mass_center = [(); 3].map(|()| self.input.number());
            let numbers = mass.inertia.iter().chain(&mass.mass_center);
            sure = sure.and(Sure::Unknown).only_if(numbers.copied().all(|x| x.abs() <= 1e100));
        }
        let nothing = self.input.chance(4);
        let pointer = if nothing { std::ptr::null() } else { std::ptr::from_ref(&mass) };
        self.call("set mass", sure.only_if(!nothing), || unsafe { pong_set_mass(world, interface, pointer) });

        self.joints();

        let mut plan = pong_default_step_plan();
        plan.step = self.input.number();
        plan.wrench_coupling = self.input.one_of(&[0, 1, 2, 3, 3, 4, u32::MAX]);
        plan.delay_frames = self.input.one_of(&[0, 0, 0, 1, 100, 101, u32::MAX]);
        plan.closing_speed = self.input.number();
        let late = if plan.wrench_coupling == 3 { 100 } else { 0 };
        let fit = plan.step > 0.0
            && plan.step.is_finite()
            && (1..=3).contains(&plan.wrench_coupling)
            && plan.delay_frames <= late
            && plan.closing_speed >= 0.0
            && plan.closing_speed.is_finite();
        let mut sure = known.only_if(!sealed && fit);
        if self.input.chance(64) {
            (plan.depth_within, plan.rebound_within) = (self.input.number(), self.input.number());
            plan.reserved[3] = u64::from(self.input.chance(64));
            sure = sure.and(Sure::Unknown).only_if(plan.reserved[3] == 0);
        }
        let pointer = if nothing { std::ptr::null() } else { std::ptr::from_ref(&plan) };
        self.call("plan step", sure.only_if(!nothing), || unsafe { pong_plan_step(world, pointer) });

        let place = self.place::<pong_step_check>();
        let sure = known.and(place.sure).and(Sure::Unknown).only_if(sealed);
        if self.call("get acting", sure, || unsafe { pong_check_step(world, place.pointer) }) {
            let acting = place.get();
            let numbers = [acting.stable_step, acting.stiffness_rate, acting.damping_rate];
            assert!(numbers.into_iter().all(|x| x >= 0.0), "what acts: {acting:?}");
        }
    }

    /// Joints of any group: symmetric or not, with springs or without.
    fn joints(&mut self) {
        let (world, known) = self.world();
        let (interface, good) = self.id(|ids| &ids.interfaces, |bits| pong_interface_id { bits });
        let mut inverse_inertia = [0.0; 36];
        for row in 0..6 {
            inverse_inertia[7 * row] = 0.5;
        }
        if self.input.chance(128) {
            let index = self.input.byte() as usize % 36;
            inverse_inertia[index] = self.input.number();
        }
        let joints = pong_joints {
            inverse_inertia,
            spring_rate: self.input.number(),
            damper_rate: self.input.number(),
            mechanism: self.input.one_of(&[0, 1, u32::MAX]),
            reserved: u32::from(self.input.chance(16)),
        };
        let fit = [joints.spring_rate, joints.damper_rate]
            .iter()
            .chain(&joints.inverse_inertia)
            .all(|x| x.is_finite());
        let nothing = self.input.chance(4);
        let pointer = if nothing { std::ptr::null() } else { std::ptr::from_ref(&joints) };
        let sure = known.and(good).and(Sure::Unknown).only_if(fit && !nothing && joints.reserved == 0);
        self.call("set joints", sure, || unsafe { pong_set_joints(world, interface, pointer) });
    }
}
