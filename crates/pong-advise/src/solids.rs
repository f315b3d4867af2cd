//! Contacts of solids before they touch: two solids flat on each other, on the smaller of their largest shadows.

use crate::footprint::Footprint;
use crate::mass::GroupMass;
use crate::setting::{Known, STIFF, Setting};
use crate::spring::springs;
use pong_engine::inspect::{GroupPair, SolidMeeting};
use pong_engine::{FrictionProps, NormalProps, PairProps};
use std::collections::BTreeMap;

/// Largest shadows of the solids of each movable group, by group and solid.
pub(crate) type Footprints = BTreeMap<(usize, usize), Option<Footprint>>;

/// Largest shadows of all solids of a world; groups of one model share them.
pub(crate) fn footprints(setting: &Setting<'_>) -> Footprints {
    let mut of_model: BTreeMap<usize, Vec<Option<Footprint>>> = BTreeMap::new();
    let mut all = Footprints::new();
    for group in 0..setting.scene.group_count() {
        let body = setting.scene.body(group);
        // Groups of one model have the same data in one place.
        let place = std::ptr::from_ref(body) as usize;
        let shadows =
            of_model.entry(place).or_insert_with(|| body.solids.iter().map(Footprint::largest).collect());
        all.extend(shadows.iter().enumerate().map(|(solid, shadow)| ((group, solid), *shadow)));
    }
    all
}

/// Class of each movable group: groups of one class have the same model and the same mass, so two pairs of the same
/// classes have the same limits.
pub(crate) fn classes(setting: &Setting<'_>) -> Vec<usize> {
    let mut known: Vec<(usize, Option<GroupMass>)> = Vec::new();
    let of = |group: usize| {
        let key = (std::ptr::from_ref(setting.scene.body(group)) as usize, setting.masses[group]);
        known.iter().position(|other| *other == key).unwrap_or_else(|| {
            known.push(key);
            known.len() - 1
        })
    };
    (0..setting.scene.group_count()).map(of).collect()
}

impl Setting<'_> {
    /// The contacts that the solids of a pair of movable groups can make at a closing speed (m/s; `None` if it is not
    /// known), and the reasons why some are not known.
    pub(crate) fn known_solids(
        &self,
        pair: &GroupPair,
        mass: f64,
        closing_speed: Option<f64>,
        footprints: &Footprints,
    ) -> (Vec<Known>, Vec<&'static str>) {
        let (mut known, mut causes) = (Vec::new(), Vec::new());
        for meeting in self.scene.solid_meetings(pair) {
            let Some((area, least_masses)) = self.flat_contact(&meeting, footprints) else { continue };
            let props = on_area(meeting.props, area);
            match springs(&props, mass, closing_speed) {
                Ok(springs) => {
                    known.push(Known { springs, surfaces: meeting.surfaces, least_masses, area: Some(area) });
                }
                Err(cause) => causes.push(cause),
            }
        }
        (known, causes)
    }

    /// Area of the contact, m², and its least effective masses along the normal and along the surface, kg.
    fn flat_contact(&self, meeting: &SolidMeeting<'_>, footprints: &Footprints) -> Option<(f64, [f64; 2])> {
        let [a, b] = [meeting.a, meeting.b];
        let shadow = |(group, solid): (usize, Option<usize>)| *footprints.get(&(group, solid?))?;
        let shadow_a = shadow(a)?;
        let area = shadow(b).map_or(shadow_a.area, |shadow_b| shadow_a.area.min(shadow_b.area));
        let compliances = [(a.0, Some(shadow_a)), (b.0, shadow(b))].map(|(group, shadow)| {
            let Some(mobility) = &self.mobilities[group] else { return [0.0; 2] };
            match shadow {
                Some(shadow) => [shadow.compliance(mobility), shadow.compliance_along(mobility)],
                // A plane that yields has levers of any length, which are left out.
                None => [mobility.compliance(mobility.center()); 2],
            }
        });
        let [of_a, of_b] = compliances;
        let shared = if self.share_joints(a.0, b.0) { 2.0 } else { 1.0 };
        Some((area, [0, 1].map(|term| 1.0 / (shared * (of_a[term] + of_b[term])).max(STIFF))))
    }
}

/// Values of a contact of this area, from those per unit area.
fn on_area(props: &PairProps, area: f64) -> PairProps {
    let mut whole = props.clone();
    whole.stiffness *= area;
    match &mut whole.normal {
        NormalProps::Linear { damping, .. } | NormalProps::PowerLaw { damping, .. } => *damping *= area,
        NormalProps::HuntCrossley { .. } | NormalProps::Custom { .. } => {}
    }
    if let FrictionProps::Bristle { stiffness, damping, .. } = &mut whole.friction {
        *stiffness *= area;
        *damping *= area;
    }
    whole
}
