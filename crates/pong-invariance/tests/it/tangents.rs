//! Tangents of every family of scenes against central differences.

use pong_invariance::make;
use pong_invariance::{Order, Survey};

#[test]
fn every_family() {
    let scenes = std::env::var("SCENES").map_or(200, |s| s.parse().unwrap());
    let only = std::env::var("FAMILY").ok();
    for family in make::families().filter(|f| only.as_deref().is_none_or(|o| o == *f)) {
        let order = Order { seed: 1, first: std::env::var("FIRST").map_or(0, |s| s.parse().unwrap()), scenes, only: vec!["tangent".into()], family: Some(family.into()), threads: 1, kept: 5 };
        let survey = Survey::run(&order, &|_| ());
        let t = survey.tallies.get("tangent").cloned().unwrap_or_default();
        println!("{family:<18} compared {:>6} differ {:>6} worst {:.1e}", t.compared, t.differ, t.worst);
        if only.is_some() { for f in &survey.found { println!("{}\n{}", f.finding.says, f.again); println!("{}", pong_invariance::text::scene(&f.scene));
            let mut base = pong_invariance::base::Base::new(f.scene.clone()).unwrap();
            for (i, a) in base.answers.iter().enumerate() { println!("-- frame {i}"); for c in &a.contacts { println!("{c:?}"); } }
            let _ = &mut base; } print!("{}", survey.list()); }
    }
}
