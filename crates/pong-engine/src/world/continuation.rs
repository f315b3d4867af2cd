//! Continuation of a run in a world of more or fewer Objects.

use super::World;
use crate::error::EngineError;
use crate::report::Clock;
use crate::scene::{Scene, Shared, States, Surfaces, refused};
use crate::seal;
use crate::sealed::SurfaceTable;
use crate::state::{CarryOutcome, Counterparts};

/// Objects, pairs and contacts that continue from another world, and those left behind there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Continuation {
    /// Objects that are in both worlds.
    pub objects: usize,
    /// Their pairs that go on.
    pub pairs: usize,
    /// Contacts that push and go on.
    pub contacts: usize,
    /// Objects of the other world that are not in this one.
    pub objects_left: usize,
    /// Pairs of theirs, which are left with all that is remembered of them: contacts and accounts.
    pub pairs_left: usize,
    /// Contacts of those pairs that pushed.
    pub contacts_left: usize,
    /// Energy that was stored in them, J. The ledger counts it as dissipated.
    pub energy_left: f64,
}

impl World {
    /// Goes on where another world is: what is in both, Objects of one name and the pairs between them, has from here on the
    /// states, switched pairs, values of surfaces and contact state that it has there. Contacts between those Objects go on as
    /// if nothing had been added or taken away: given the same states, their wrenches are the same bits for as long as nothing
    /// else touches them. So are the totals of the ledger, and the accounts of their pairs.
    ///
    /// What is in this world alone keeps its states, pairs and surfaces, and has no past: contacts of it begin. What is in the
    /// other world alone is left behind, and the answer says how much that is. Whatever this world has remembered before is
    /// forgotten; it has no frame before its next one. The other world does not change and may run on or be dropped.
    ///
    /// Not for frames: it takes memory, but no more time than a few frames do. [`WorldBuilder::extending`] makes a world of the
    /// Objects of another one and more.
    ///
    /// [`WorldBuilder::extending`]: crate::WorldBuilder::extending
    ///
    /// # Errors
    /// [`EngineError::WrongPhase`] if a frame of either world was evaluated and not committed. [`EngineError::BadValue`] where the
    /// contacts would not go on as they were: an Object of the same name has another model, Objects were created or paired in
    /// another order, a pair or its filters are missing or others, energies are kept otherwise, a law remembers another count of
    /// numbers, or there is no room. [`EngineError::Seal`] if values of surfaces cannot be combined with those of what is new.
    /// This world is as it was then.
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

        // Nothing is refused any more.
        if let Some((surfaces, tables)) = surfaces {
            self.surfaces = surfaces;
            self.runtime.set_tables(tables);
        }
        self.states.take_over(&other.states, bodies, pairs);
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

    /// Surface values with those that another world has of common Objects, and the tables of their pairs; `None` if nothing
    /// differs.
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

    /// Scene, surfaces, states and clock as they are now, for a builder.
    pub(crate) fn set_up_again(&self) -> (Scene, Surfaces, States, Clock) {
        let Self { scene, surfaces, states, runtime } = self;
        (Scene::clone(scene), surfaces.clone(), states.clone(), runtime.clock)
    }
}
