//! Tangents and other derivatives of a frame.

use super::session::{Session, Sure};
use pong::contacts::pong_contact;
use pong::ids::pong_model_id;
use pong::slopes::{
    pong_get_incremental_potentials, pong_get_surface_slopes, pong_potential, pong_surface_slope,
};
use pong::tangents::{
    pong_contact_tangent, pong_get_complete_tangents, pong_get_contact_tangents, pong_get_tangents,
    pong_get_tangents_by_differences, pong_tangent,
};
use pong::world::pong_world;

/// Most contacts of a frame whose tangents are computed by differences: each takes up to 48 evaluations.
const DIFFERENCES_MAX: usize = 8;

impl Session<'_> {
    /// Gets the tangents of the contacts of the last frame. Takes no bytes of the input.
    pub fn tangents(&mut self, world: *mut pong_world, known: Sure, contacts: &[pong_contact]) {
        let own_laws = self.host().is_some_and(|host| host.own_laws);
        let capacity = contacts.len();
        let mut slopes = Vec::<pong_contact_tangent>::with_capacity(capacity);
        let mut listed = 0;
        if self.call("contact tangents", known.unless(own_laws), || unsafe {
            pong_get_contact_tangents(world, slopes.as_mut_ptr(), capacity, &mut listed)
        }) {
            assert_eq!(listed, capacity);
            // SAFETY: the call succeeded, so this many were written.
            unsafe { slopes.set_len(listed) };
            let of = |slope: &pong_contact_tangent| [slope.normal_stiffness, slope.tangential_stiffness];
            assert!(slopes.iter().flat_map(of).all(|number| !number.is_infinite()), "{slopes:?}");
        }
        // Refused after a commit, and for contacts without derivatives in closed form.
        let sure = known.and(Sure::Unknown);
        let mut tangents = Vec::<pong_tangent>::with_capacity(capacity);
        let mut found = 0;
        if self.call("tangents", sure, || unsafe {
            pong_get_tangents(world, tangents.as_mut_ptr(), capacity, &mut found)
        }) {
            assert!(found <= capacity, "{found} pairs of groups touch in {capacity} contacts");
        }
        let mut potentials = Vec::<pong_potential>::with_capacity(capacity);
        self.call("incremental potentials", sure, || unsafe {
            pong_get_incremental_potentials(world, 0.01, potentials.as_mut_ptr(), capacity, &mut found)
        });
        if capacity <= DIFFERENCES_MAX {
            self.surface_slopes(world, sure, capacity);
            self.call("tangents by differences", sure, || unsafe {
                pong_get_tangents_by_differences(world, tangents.as_mut_ptr(), capacity, &mut found)
            });
            self.call("complete tangents", sure, || unsafe {
                pong_get_complete_tangents(world, tangents.as_mut_ptr(), capacity, &mut found)
            });
        }
    }

    /// Gets the derivatives by a number of a surface that the models of the harness have, and of one that they have not.
    fn surface_slopes(&mut self, world: *mut pong_world, sure: Sure, capacity: usize) {
        let mut slopes = Vec::<pong_surface_slope>::with_capacity(capacity);
        let mut found = 0;
        let model = pong_model_id { bits: 1 << 32 | 1 };
        for number in [c"stiffness", c"friction.mu", c"nothing"] {
            self.call("surface slopes", sure, || unsafe {
                let (surface, slopes) = (c"s".as_ptr(), slopes.as_mut_ptr());
                pong_get_surface_slopes(world, model, surface, number.as_ptr(), slopes, capacity, &mut found)
            });
        }
    }
}
