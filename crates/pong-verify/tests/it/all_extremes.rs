//! One test per extreme. `bash ci/extremes` prints the margins and checks `docs/extremes.md`.

use pong_verify::extremes::{Length, extremes, text};

fn holds(id: &str) {
    let extreme = extremes().into_iter().find(|extreme| extreme.id == id).expect("there is such an extreme");
    let finding = extreme.run(Length::default());
    assert!(finding.passes(), "\n{}", text(std::slice::from_ref(&finding)));
}

macro_rules! one_test_each {
    ($($test:ident => $id:literal),* $(,)?) => {
        $(
            #[test]
            fn $test() {
                holds($id);
            }
        )*

        #[test]
        fn each_has_a_test() {
            let ids: Vec<_> = extremes().iter().map(|extreme| extreme.id).collect();
            assert_eq!(ids, [$($id),*]);
        }
    };
}

one_test_each! {
    e1_far_and_fast_frames => "E1",
    e2_sizes_and_stiffness => "E2",
    e3_mass_ratios => "E3",
    e4_bad_shapes => "E4",
    e5_rounded_shapes => "E5",
    e6_grazing => "E6",
    e7_coincident => "E7",
    e8_bad_states => "E8",
    e9_steps_too_long => "E9",
    e10_deep_overlap => "E10",
    e11_thin_walls => "E11",
    e12_near_misses => "E12",
    e13_crowd => "E13",
    e14_rest => "E14",
    e15_friction_over_facets => "E15",
    e16_loads_that_drop => "E16",
    e17_drops => "E17",
    e18_held_wrench => "E18",
}
