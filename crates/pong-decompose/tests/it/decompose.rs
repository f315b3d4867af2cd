//! `pong decompose`: shapes with known pieces, figures with known values, bad input.

use pong_decompose::{DecomposeOptions, Decomposed, Distances, Mass, Method, Report};
use pong_geometry::Vec3;
use pong_geometry::primitive::{Polyhedron, RimEdge};
use pong_import::DefaultSurface;
use pong_model::{Extensions, Model};
use pong_testkit::meshes::{blocks, cube, obj, torus};
use pong_testkit::scratch;
use std::path::PathBuf;

type Triangles = Vec<[[f64; 3]; 3]>;

fn options() -> DecomposeOptions {
    let surface = DefaultSurface { name: "steel".to_owned(), stiffness: 1e6, damping: 0.0, mu: 0.0 };
    DecomposeOptions {
        import: pong_import::Options { surface: Some(surface), ..pong_import::Options::default() },
        resolution: Some(40),
        samples: 5000,
        ..DecomposeOptions::default()
    }
}

fn save(test: &str, triangles: &Triangles) -> PathBuf {
    let path = scratch(env!("CARGO_TARGET_TMPDIR"), &format!("decompose_{test}")).join("shape.obj");
    std::fs::write(&path, obj(triangles)).unwrap();
    path
}

fn attempt(test: &str, triangles: &Triangles, options: &DecomposeOptions) -> Decomposed {
    let path = save(test, triangles);
    pong_decompose::decompose(&path, &path.with_extension("ron"), options, &mut |_| ())
}

/// Figures of a decomposition, and its model as the engine reads it.
fn run(test: &str, triangles: &Triangles, options: &DecomposeOptions) -> (Report, Model, Vec<&'static str>) {
    let Decomposed { report, files, findings } = attempt(test, triangles, options);
    assert!(findings.faults.is_empty(), "{findings}");
    let model = pong_model::load(&files[0], &Extensions::new()).unwrap();
    (report.unwrap(), model, findings.notes.iter().map(|note| note.rule).collect())
}

fn faults(test: &str, triangles: &Triangles, options: &DecomposeOptions) -> Vec<&'static str> {
    let done = attempt(test, triangles, options);
    assert!(done.files.is_empty());
    assert!(!save_path(test).exists(), "nothing is written");
    done.findings.faults.iter().map(|fault| fault.rule).collect()
}

fn save_path(test: &str) -> PathBuf {
    std::path::Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("import")
        .join(format!("decompose_{test}"))
        .join("shape.ron")
}

fn ell() -> Triangles {
    blocks(&[[0, 0, 0], [1, 0, 0], [0, 0, 1]], 1.0)
}

fn tee() -> Triangles {
    blocks(&[[0, 0, 2], [1, 0, 2], [2, 0, 2], [3, 0, 2], [4, 0, 2], [2, 0, 0], [2, 0, 1]], 1.0)
}

fn cup() -> Triangles {
    let is_wall = |x: i32, y: i32, z: i32| z == 0 || [0, 4].contains(&x) || [0, 4].contains(&y);
    let all = (0..100).map(|k| [k % 5, k / 5 % 5, k / 25]);
    blocks(&all.filter(|&[x, y, z]| is_wall(x, y, z)).collect::<Vec<_>>(), 0.1)
}

fn assert_close(a: f64, b: f64, share: f64) {
    assert!((a - b).abs() <= share * b.abs(), "{a} is not {b}");
}

fn assert_exact(report: &Report, volume_m3: f64) {
    assert_close(report.volume_m3, volume_m3, 1e-12);
    assert_close(report.source_volume_m3, volume_m3, 1e-12);
    let pong_decompose::Deviation {
        protrusion,
        deficit,
        inner_deficit_m,
        deficit_share,
        protruding_share,
        ..
    } = report.deviation;
    assert_eq!((protrusion.max_m, deficit.max_m, inner_deficit_m), (0.0, 0.0, 0.0));
    assert_eq!((deficit_share, protruding_share), (0.0, 0.0));
}

fn inactive(model: &Model) -> usize {
    let faces = model.bodies[0].polyhedra.iter().flat_map(|polyhedron| &polyhedron.faces);
    faces.filter(|face| !face.active).count()
}

#[test]
fn a_cube_is_one_exact_piece() {
    let (report, model, notes) = run("cube", &cube(), &options());
    assert!(report.exact && notes.is_empty(), "{notes:?}");
    assert_eq!((report.pieces, report.faces, report.inactive_faces), (1, 6, 0));
    assert_exact(&report, 8.0);
    assert_eq!(model.bodies[0].polyhedra.len(), 1);
}

#[test]
fn an_l_is_two_pieces_with_one_wall_between() {
    let (report, model, notes) = run("ell", &ell(), &options());
    assert!(!report.exact && notes.is_empty(), "{notes:?}");
    assert_eq!((report.pieces, report.inactive_faces), (2, 2));
    assert_exact(&report, 3.0);
    assert_eq!((model.bodies[0].polyhedra.len(), inactive(&model)), (2, 2));
    assert_eq!(model.bodies[0].shell_count, 1, "both are one surface");
}

#[test]
fn a_face_that_is_covered_in_part_is_split() {
    // The bar's lower face is covered by the stem in its middle: open, covered, open.
    let (report, model, notes) = run("tee", &tee(), &options());
    assert!(notes.is_empty(), "{notes:?}");
    assert_eq!((report.pieces, report.faces, report.inactive_faces), (2, 6 + 2 + 6, 2));
    assert_exact(&report, 7.0);
    assert_eq!((inactive(&model), model.bodies[0].shell_count), (2, 1));
}

#[test]
fn a_knob_within_a_plate_leaves_a_ring_and_one_at_its_corner_cuts_it() {
    let plate = |knob: [i32; 2]| {
        let mut cubes: Vec<[i32; 3]> = (0..9).map(|k| [k % 3, k / 3, 0]).collect();
        cubes.push([knob[0], knob[1], 1]);
        blocks(&cubes, 1.0)
    };
    let (report, model, notes) = run("knob", &plate([1, 1]), &options());
    assert_eq!((report.pieces, report.inactive_faces, notes.len()), (2, 2, 0), "{notes:?}");
    assert_eq!(model.bodies[0].shell_count, 1);
    assert_exact(&report, 10.0);
    // The open part would be one L-shaped, non-convex face: the plate is cut in two.
    let (report, model, notes) = run("corner", &plate([2, 2]), &options());
    assert_eq!((report.pieces, report.inactive_faces, notes.len()), (3, 4, 0), "{notes:?}");
    assert_eq!(model.bodies[0].shell_count, 1);
    assert_exact(&report, 10.0);
    // Without room for more pieces the plate's face stays active, which is reported.
    let few = DecomposeOptions { pieces_max: 2, ..options() };
    let (report, _, notes) = run("few", &plate([2, 2]), &few);
    assert_eq!(report.pieces, 2);
    assert!(notes.contains(&"part-covered"), "{notes:?}");
}

#[test]
fn a_cup_and_a_hollow_box_keep_their_cavities() {
    let (report, model, notes) = run("cup", &cup(), &options());
    assert!(notes.is_empty(), "{notes:?}");
    assert_exact(&report, 0.073);
    assert_eq!(model.bodies[0].shell_count, 1);
    let cubes: Vec<[i32; 3]> =
        (0..27).map(|k| [k % 3, k / 3 % 3, k / 9]).filter(|cube| *cube != [1, 1, 1]).collect();
    let (report, _, notes) = run("hollow", &blocks(&cubes, 1.0), &options());
    assert_eq!((report.pieces, notes.len()), (6, 0), "{notes:?}");
    assert_exact(&report, 26.0);
}

#[test]
fn a_torus_protrudes_as_far_as_its_true_distance_says() {
    let (radius, thickness) = (1.0, 0.3);
    let (report, model, _) = run("torus", &torus(radius, thickness, 32, 16), &options());
    let deviation = &report.deviation;
    assert!(report.pieces > 5 && report.pieces <= 64);
    assert_eq!((deviation.deficit.max_m, deviation.inner_deficit_m), (0.0, 0.0), "hulls hold all of it");
    // Disjoint pieces: the protruding volume is the excess of their volumes over the source.
    let excess = report.volume_m3 / report.source_volume_m3 - 1.0;
    assert!((deviation.protruding_share - excess).abs() < 0.01, "{excess} {deviation:?}");
    // Closed-form distance from a torus; the mesh lies inside it by at most its sagitta.
    let sagitta = (radius + thickness) * (1.0 - (std::f64::consts::PI / 32.0).cos())
        + thickness * (1.0 - (std::f64::consts::PI / 16.0).cos());
    let away = |place: Vec3| (place.x.hypot(place.y) - radius).hypot(place.z) - thickness;
    let farthest = model.bodies[0].polyhedra.iter().flat_map(places_on_faces).map(away).fold(0.0, f64::max);
    let found = &deviation.protrusion;
    assert!(farthest <= found.bound_m && found.bound_m < 0.2, "{farthest} {found:?}");
    assert!((farthest - found.max_m).abs() < sagitta, "{farthest} {found:?}");
}

/// Points spread over the active faces.
fn places_on_faces(polyhedron: &Polyhedron) -> Vec<Vec3> {
    let mut places = Vec::new();
    for number in (0..polyhedron.faces.len()).filter(|&number| polyhedron.faces[number].active) {
        let corner = |rim: &RimEdge| polyhedron.vertices[rim.start as usize].position;
        let corners: Vec<Vec3> = polyhedron.rim(number).iter().map(corner).collect();
        for pair in corners.windows(2).skip(1) {
            for (i, j) in (0..=20).flat_map(|i| (0..=20 - i).map(move |j| (f64::from(i), f64::from(j)))) {
                places.push(corners[0] + ((pair[0] - corners[0]) * i + (pair[1] - corners[0]) * j) / 20.0);
            }
        }
    }
    places
}

#[test]
fn too_few_pieces_protrude_and_a_limit_refuses_them() {
    let one = DecomposeOptions { pieces_max: 1, ..options() };
    let (report, _, notes) = run("one", &ell(), &one);
    assert_eq!(report.pieces, 1);
    assert!(notes.contains(&"joined"), "{notes:?}");
    assert_close(report.volume_m3, 3.5, 1e-12);
    let found = &report.deviation.protrusion;
    // The middle of the slope is ½ away from both internal faces.
    assert!(found.max_m <= 0.5 && found.max_m > 0.499 && found.bound_m >= 0.5, "{found:?}");
    assert!((report.deviation.protruding_share - 0.5 / 3.0).abs() < 0.01);
    let limited = DecomposeOptions { within_m: Some(0.4), ..one.clone() };
    assert_eq!(faults("limit", &ell(), &limited), ["protrusion"]);
    let wide = DecomposeOptions { within_m: Some(0.6), ..one };
    assert!(attempt("wide", &ell(), &wide).findings.faults.is_empty());
}

/// A bar of two rows of cubes without the last cube of the upper one.
fn bar_without_a_corner(length: i32) -> Triangles {
    let rows = (0..length).flat_map(|x| [[x, 0, 0], [x, 0, 1]]);
    blocks(&rows.take(2 * length as usize - 1).collect::<Vec<_>>(), 1.0)
}

/// As one piece both bars protrude by ½, the distance of the middle of the slope from both walls of the
/// corner. That is 1.7 % of the size of the short bar, and 0.8 % of that of the long one.
#[test]
fn what_protrudes_by_more_than_a_hundredth_of_the_size_is_told() {
    let one = DecomposeOptions { pieces_max: 1, ..options() };
    let told = |length: i32| {
        let done = attempt(&format!("bar_{length}"), &bar_without_a_corner(length), &one);
        assert!(done.findings.faults.is_empty(), "{}", done.findings);
        let deepest = done.report.unwrap().deviation.protrusion.max_m;
        assert!(deepest <= 0.5 && deepest > 0.49, "{deepest}");
        let notes = done.findings.notes.into_iter().filter(|note| note.rule == "protrusion");
        notes.map(|note| note.cause).collect::<Vec<_>>()
    };
    let short = told(30);
    assert_eq!(short.len(), 1, "{short:?}");
    // By V-HACD with 40 voxels along the size of the bar, which is its diagonal: √(30² + 1² + 2²) = 30.083 m.
    for part in ["1.7 % of the mesh's size", "thinner than a voxel, about 7.5e-1 m,"] {
        assert!(short[0].contains(part), "{short:?}");
    }
    assert_eq!(told(60), Vec::<String>::new());
}

#[test]
fn the_same_file_gives_the_same_bytes() {
    let write = |test: &str| {
        let done = attempt(test, &torus(1.0, 0.3, 24, 12), &options());
        (std::fs::read(&done.files[0]).unwrap(), done.report)
    };
    assert_eq!(write("bytes"), write("bytes_again"));
}

#[test]
fn parts_are_pieces_of_their_own() {
    let apart = blocks(&[[0, 0, 0], [5, 0, 0]], 1.0);
    let (report, model, notes) = run("parts", &apart, &options());
    assert!(report.exact && notes.is_empty());
    assert_eq!((report.pieces, report.inactive_faces, model.bodies[0].shell_count), (2, 0, 2));
    assert_exact(&report, 2.0);
}

#[test]
fn what_has_no_inside_is_refused() {
    let mut open = cube();
    open.pop();
    assert_eq!(faults("open", &open, &options()), ["open-mesh"]);
    let mut wound = cube();
    wound[0].swap(1, 2);
    assert_eq!(faults("wound", &wound, &options()), ["winding"]);
    let turned: Triangles = cube().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    assert_eq!(faults("turned", &turned, &options()), ["inside-out"]);
    let touching = blocks(&[[0, 0, 0], [1, 1, 0]], 1.0);
    assert_eq!(faults("edge", &touching, &options()), ["non-manifold"]);
    let both: Triangles = cube().into_iter().flat_map(|[a, b, c]| [[a, b, c], [a, c, b]]).collect();
    assert_eq!(faults("both", &both, &options()), ["open-mesh"]);
    let none = DecomposeOptions { pieces_max: 0, concavity: Some(2.0), ..options() };
    assert_eq!(faults("options", &cube(), &none), ["option", "option"]);
}

#[test]
fn what_passes_through_itself_is_told() {
    let mut crossing = ell();
    let moved = |[x, y, z]: [f64; 3]| [x * 0.5 + 0.713, y * 0.5 + 0.717, z * 0.5 + 0.719];
    crossing.extend(cube().into_iter().map(|triangle| triangle.map(moved)));
    let done = attempt("crossing", &crossing, &options());
    assert!(done.findings.notes.iter().any(|note| note.rule == "self-intersecting"), "{}", done.findings);
}

#[test]
fn a_missing_coacd_is_named_with_its_cure() {
    let method = Method::Coacd("no-such-python-here".to_owned());
    let coacd = DecomposeOptions { method, resolution: None, ..options() };
    assert_eq!(faults("coacd", &ell(), &coacd), ["coacd-missing"]);
}

/// A part with a dent is imported as a TriangleMesh and, on request, as its hull.
#[test]
fn a_dented_part_becomes_its_hull_if_asked() {
    let path = save("hull", &torus(1.0, 0.3, 12, 8));
    let output = path.with_extension("ron");
    let import = |hull| {
        let surface = options().import.surface;
        let options = pong_import::Options { surface, hull, ..pong_import::Options::default() };
        pong_import::import(&path, &output, &options, &mut |_| ()).unwrap()
    };
    let plain = import(None);
    let noted = plain.findings.notes.iter().any(|note| note.rule == "not-convex");
    assert!(plain.primitives[0].0 == "TriangleMesh" && noted, "{}", plain.findings);
    let hulled = import(Some(pong_decompose::hull_of_mesh));
    assert_eq!(hulled.primitives, [("Polyhedron", 1)]);
    let note = hulled.findings.notes.iter().find(|note| note.rule == "hull").expect("a note");
    assert!(note.cause.contains("became the convex hull"), "{note}");
    let model = pong_model::load(&output, &Extensions::new()).unwrap();
    assert_eq!(model.bodies[0].polyhedra.len(), 1);
}

/// A square plate with a round hole of 16 sides in its middle, thickness 1.
fn plate(half: f64, radius: f64) -> Triangles {
    let sides = 16;
    let ring = |k: usize| {
        let angle = std::f64::consts::TAU * (k % sides) as f64 / sides as f64;
        let (x, y) = (angle.cos(), angle.sin());
        let out = half / x.abs().max(y.abs());
        ([radius * x, radius * y], [out * x, out * y])
    };
    let at = |[x, y]: [f64; 2], z: f64| [x, y, z];
    let mut triangles = Vec::new();
    for k in 0..sides {
        let ((a, b), (c, d)) = (ring(k), ring(k + 1));
        let mut quad =
            |p: [f64; 3], q: [f64; 3], r: [f64; 3], s: [f64; 3]| triangles.extend([[p, q, r], [p, r, s]]);
        quad(at(a, 1.0), at(b, 1.0), at(d, 1.0), at(c, 1.0));
        quad(at(a, 0.0), at(c, 0.0), at(d, 0.0), at(b, 0.0));
        quad(at(b, 0.0), at(d, 0.0), at(d, 1.0), at(b, 1.0));
        quad(at(a, 0.0), at(a, 1.0), at(c, 1.0), at(c, 0.0));
    }
    triangles
}

/// By volume the hole is 0.1 % of the plate, invisible to voxels. In quarters the chords of a hole of radius
/// 1 lie at most 1 − √½ within it; with one more cut each, 1 − cos 30° for a third of a right angle.
#[test]
fn a_small_hole_is_kept_if_pieces_must_fit() {
    // As a plate of 305 mm with a hole of 11 mm.
    let mesh = plate(28.0, 1.0);
    let (report, _, _) = run("hole_filled", &mesh, &options());
    assert!(report.pieces == 1 && report.deviation.protrusion.max_m > 0.95, "{report:?}");
    for (fit_m, most) in [(0.55, 8), (0.3, 8), (0.15, 16)] {
        let fitted = DecomposeOptions { fit_m: Some(fit_m), resolution: None, ..options() };
        let (report, model, notes) = run("hole_kept", &mesh, &fitted);
        assert!(report.pieces >= 4 && report.pieces <= most, "{report:?} {notes:?}");
        let Distances { max_m, .. } = report.deviation.protrusion;
        assert!(max_m <= fit_m && report.deviation.deficit.max_m == 0.0, "{report:?}");
        assert_eq!(model.bodies[0].shell_count, 1, "{notes:?}");
        assert!(!notes.contains(&"not-fitted"), "{notes:?}");
    }
    let few = DecomposeOptions { fit_m: Some(0.3), resolution: None, pieces_max: 2, ..options() };
    let (report, _, notes) = run("hole_few", &mesh, &few);
    assert!(report.pieces <= 2 && notes.contains(&"not-fitted"), "{report:?} {notes:?}");
    let both = DecomposeOptions { fit_m: Some(0.3), ..options() };
    assert_eq!(faults("hole_options", &mesh, &both), ["option"]);
}

/// Boxes, an L and a cup are cut along their faces, exactly, by the same rule.
#[test]
fn what_is_made_of_boxes_fits_exactly() {
    let fitted = DecomposeOptions { fit_m: Some(1e-3), resolution: None, ..options() };
    let (report, _, notes) = run("fit_ell", &ell(), &fitted);
    assert_eq!((report.pieces, notes.len()), (2, 0), "{notes:?}");
    assert_exact(&report, 3.0);
    let (report, _, notes) = run("fit_cup", &cup(), &fitted);
    assert!(report.pieces <= 8, "{report:?} {notes:?}");
    assert_exact(&report, 0.073);
}

fn mass_of(test: &str, triangles: &Triangles, mass: Mass) -> pong_decompose::MassProperties {
    let (found, findings) = pong_decompose::mass_properties(&save(test, triangles), &options().import, mass);
    found.unwrap_or_else(|| panic!("{findings}"))
}

type Matrix = nalgebra::Matrix3<f64>;

fn assert_inertia(found: &Matrix, wanted: &Matrix, share: f64) {
    assert!((found - wanted).norm() <= share * wanted.norm(), "{found} is not {wanted}");
}

fn placed(triangles: &Triangles, place: impl Fn(Vec3) -> Vec3) -> Triangles {
    triangles.iter().map(|triangle| triangle.map(|corner| place(Vec3::from(corner)).into())).collect()
}

#[test]
fn boxes_have_their_mass_center_and_inertia() {
    let (a, b, c): (f64, f64, f64) = (2.0 * 0.3, 2.0 * 0.5, 2.0 * 0.7);
    let half = Vec3::new(0.3, 0.5, 0.7);
    let solid = placed(&cube(), |p| p.component_mul(&half));
    let density = 7850.0;
    let mass = density * a * b * c;
    let tensor =
        Matrix::from_diagonal(&(Vec3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (mass / 12.0)));
    let found = mass_of("box", &solid, Mass::Density(density));
    assert_eq!(found.solids, 1);
    assert_close(found.mass_kg, mass, 1e-14);
    assert!(Vec3::from(found.center_m).norm() < 1e-15);
    assert_inertia(&found.inertia, &tensor, 1e-14);
    // Far away and rotated: the tensor rotates, and stays about the centre of mass.
    let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    let shift = Vec3::new(10.0, -20.0, 30.0);
    let far = placed(&solid, |p| turn * p + shift);
    let found = mass_of("box_far", &far, Mass::Total(5.0));
    assert_close(found.mass_kg, 5.0, 1e-14);
    assert!((Vec3::from(found.center_m) - shift).norm() < 1e-11);
    assert_inertia(
        &found.inertia,
        &(turn.matrix() * tensor * turn.matrix().transpose() * (5.0 / mass)),
        1e-9,
    );
    // A cavity is subtracted, and a second solid counts.
    let inner = placed(&solid, |p| p * 0.5);
    let hollow: Triangles =
        solid.iter().copied().chain(inner.into_iter().map(|[a, b, c]| [a, c, b])).collect();
    let found = mass_of("box_hollow", &hollow, Mass::Density(density));
    assert_eq!(found.solids, 1);
    assert_close(found.mass_kg, mass * (1.0 - 0.125), 1e-14);
    assert_inertia(&found.inertia, &(tensor * (1.0 - 0.03125)), 1e-14);
    let pair: Triangles =
        solid.iter().copied().chain(placed(&solid, |p| p + Vec3::new(4.0, 0.0, 0.0))).collect();
    let found = mass_of("box_pair", &pair, Mass::Density(density));
    let apart = Matrix::from_diagonal(&Vec3::new(0.0, 4.0, 4.0)) * (2.0 * mass);
    assert_eq!((found.solids, found.center_m[0]), (2, 2.0));
    assert_inertia(&found.inertia, &(tensor * 2.0 + apart), 1e-13);
}

/// A tetrahedron on the axes has ∫x² = 1/60 and ∫xy = 1/120, and its centre at a quarter.
#[test]
fn a_tetrahedron_has_its_products_of_inertia() {
    let [o, x, y, z] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let found = mass_of("tetrahedron", &vec![[o, y, x], [o, x, z], [o, z, y], [x, y, z]], Mass::Density(1.0));
    assert_close(found.volume_m3, 1.0 / 6.0, 1e-15);
    assert!((Vec3::from(found.center_m) - Vec3::repeat(0.25)).norm() < 1e-15);
    let wanted = Matrix::from_fn(|i, j| if i == j { 1.0 / 80.0 } else { 1.0 / 480.0 });
    assert_inertia(&found.inertia, &wanted, 1e-14);
}

/// A sphere of flat triangles has less of everything, by a share that decreases as the square of their size.
#[test]
fn a_ball_of_triangles_comes_near_the_ball() {
    let ball = |n: i32| {
        let place = |side: [usize; 4], i: i32, j: i32| {
            let corner = |k: usize| Vec3::from(pong_testkit::meshes::CUBE[k]);
            let (s, t) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            let [a, b, c, d] = side.map(corner);
            let flat = (a * (1.0 - s) + b * s) * (1.0 - t) + (d * (1.0 - s) + c * s) * t;
            // Rounded so that the sides of the cube have bit-equal points along their common edges.
            <[f64; 3]>::from(flat.normalize().map(|x| (x * 1e12).round() / 1e12))
        };
        let mut triangles = Vec::new();
        for side in pong_testkit::meshes::SIDES {
            for (i, j) in (0..n * n).map(|k| (k % n, k / n)) {
                let [a, b, c, d] = [
                    place(side, i, j),
                    place(side, i + 1, j),
                    place(side, i + 1, j + 1),
                    place(side, i, j + 1),
                ];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        mass_of(&format!("ball_{n}"), &triangles, Mass::Density(1.0))
    };
    let volume = 4.0 / 3.0 * std::f64::consts::PI;
    let inertia = 0.4 * volume;
    let short = |n: i32| {
        let found = ball(n);
        assert_inertia(
            &found.inertia,
            &(Matrix::identity() * found.inertia.trace() / 3.0),
            1e-2 / f64::from(n),
        );
        [1.0 - found.volume_m3 / volume, 1.0 - found.inertia.trace() / 3.0 / inertia]
    };
    let (coarse, fine) = (short(8), short(16));
    for k in 0..2 {
        assert!(fine[k] > 0.0 && fine[k] < 0.015, "{fine:?}");
        assert!((coarse[k] / fine[k] - 4.0).abs() < 0.2, "{coarse:?} {fine:?}");
    }
}

#[test]
fn a_mesh_without_an_inside_has_no_mass() {
    let mut open = cube();
    open.pop();
    let path = save("mass_open", &open);
    let told = |options: &pong_import::Options| {
        let (found, findings) = pong_decompose::mass_properties(&path, options, Mass::Density(1.0));
        (
            found.map(|found| found.volume_m3),
            findings.faults.iter().map(|fault| fault.rule).collect::<Vec<_>>(),
        )
    };
    assert_eq!(told(&options().import), (None, vec!["open-mesh"]));
    assert_eq!(told(&pong_import::Options { close: true, ..options().import }), (Some(8.0), vec![]));
}
