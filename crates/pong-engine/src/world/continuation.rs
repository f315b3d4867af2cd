//! Continuation of a run in a world of more or fewer Objects.

use super::World;
use crate::error::EngineError;
use crate::report::Clock;
use crate::scene::{Scene, Shared, States, Surfaces, refused};
use crate::seal;
use crate::seal::SurfaceTable;
use crate::state::{CarryOutcome, Counterparts};

/// Objects, pairs and contacts that continue from another world, and those left behind there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Continuation {
    /// Objects that are in both worlds.
    pub objects: usize,
    /// Pairs that continue.
    pub pairs: usize,
    /// Contacts that push and continue.
    pub contacts: usize,
    /// Objects of the other world that this one does not have.
    pub objects_left: usize,
    /// Pairs left behind, with their contacts and accounts.
    pub pairs_left: usize,
    /// Contacts of those pairs that pushed.
    pub contacts_left: usize,
    /// Energy stored in those contacts, J; the ledger counts it as dissipated.
    pub energy_left: f64,
}

impl World {
    /// Continues the run of another world. Common Objects (those of equal name) and their pairs take over
    /// from it the states, the switches of the pairs, the surface values and the contact state. Contacts
    /// between common Objects continue as if no Object had been added or removed: for the same states their
    /// wrenches are bit-identical, as long as nothing else touches these Objects. The totals of the ledger
    /// and the accounts of these pairs continue as well.
    ///
    /// Objects that only this world has keep their states, pairs and surfaces, and their contacts start
    /// without history. Objects that only the other world has are left behind, as counted in the result. All
    /// earlier contact state of this world is dropped, and it has no results before its next frame. The other
    /// world is unchanged, and may run on or be dropped.
    ///
    /// Not for use within frames: it allocates, and its time grows with Objects, pairs and contacts.
    /// [`WorldBuilder::extending`] makes a world with the Objects of another one and more.
    ///
    /// [`WorldBuilder::extending`]: crate::WorldBuilder::extending
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] if either world has an evaluated frame that is not committed.
    /// [`EngineError::BadValue`] if contacts could not continue unchanged: a common Object has another model,
    /// Objects were created or paired in another order, a pair is missing or has other filters, the energy
    /// settings differ, a law has another number of state values, or there is not enough room.
    /// [`EngineError::Seal`] if surface values cannot be combined with those of new Objects. This world is
    /// unchanged then.
    pub fn continue_from(&mut self, other: &Self) -> Result<Continuation, EngineError> {
        if self.is_evaluated() || other.is_evaluated() {
            let cure = "commit the frame that was evaluated, in both worlds, first";
            return Err(EngineError::WrongPhase { call: "continue from another world", cure });
        }
        let shared = Shared::of((&other.scene, &other.runtime.sealed), (&self.scene, &self.runtime.sealed))?;
        let Shared { objects, bodies, pairs, group_pairs } = &shared;
        let counterparts = Counterparts { bodies, pairs, group_pairs };
        let surfaces = self.surfaces_as_in(other, objects)?;
        self.runtime.require_room_for(&other.runtime, &counterparts)?;

        // No errors from here on.
        if let Some((surfaces, tables)) = surfaces {
            self.surfaces = surfaces;
            self.runtime.set_tables(tables);
        }
        self.states.take_over(&other.states, (bodies, pairs), self.scene.config.moving_surfaces);
        let (poses, keeps_ledger) = (&self.states.poses, self.scene.config.ledger);
        let CarryOutcome { contacts, contacts_left, energy_left } =
            self.runtime.carry(&other.runtime, &counterparts, poses, keeps_ledger);
        let in_both = |numbers: &[Option<usize>]| numbers.iter().flatten().count();
        Ok(Continuation {
            objects: in_both(objects),
            pairs: in_both(pairs),
            contacts,
            objects_left: other.scene.objects.len() - in_both(objects),
            pairs_left: other.scene.pairs.len() - in_both(pairs),
            contacts_left,
            energy_left,
        })
    }

    /// Surface values after taking over those of common Objects from another world, with the tables of their
    /// pairs; `None` if nothing differs.
    fn surfaces_as_in(
        &self,
        other: &Self,
        objects: &[Option<usize>],
    ) -> Result<Option<(Surfaces, Vec<SurfaceTable>)>, EngineError> {
        let mut surfaces = self.surfaces.clone();
        let mut given_by: Vec<Option<usize>> = vec![None; surfaces.of_models.len()];
        for (object, earlier) in objects.iter().enumerate().filter_map(|(o, e)| Some((o, (*e)?))) {
            let model = self.scene.objects[object].model;
            let values = &other.surfaces.of_models[other.scene.objects[earlier].model];
            match given_by[model] {
                None => surfaces.of_models[model].clone_from(values),
                Some(first) if surfaces.of_models[model] != *values => {
                    let [first, second] = [first, object].map(|index| &self.scene.objects[index].name);
                    let cause = "they are of one model here, and of two in the other world, whose surfaces have other values by \
                                 now; add the model twice, once for each";
                    return refused(&format!("objects `{first}` and `{second}`"), cause.to_owned());
                }
                Some(_) => {}
            }
            given_by[model] = Some(object);
        }
        if surfaces.of_models == self.surfaces.of_models {
            return Ok(None);
        }
        let sealed = &self.runtime.sealed;
        let tables =
            seal::surface_tables(&self.scene, &surfaces.of_models, &sealed.group_pairs, &sealed.filters);
        let tables = tables.map_err(|problems| EngineError::Seal { problems })?;
        Ok(Some((surfaces, tables)))
    }

    /// Current scene, surfaces, states and clock, for a builder.
    pub(crate) fn set_up_again(&self) -> (Scene, Surfaces, States, Clock) {
        let Self { scene, surfaces, states, runtime } = self;
        (Scene::clone(scene), surfaces.clone(), states.clone(), runtime.clock)
    }
}
