//! Every bad input is told with thing, cause and cure.

use crate::common;
use crate::synthetic::{records, times, tosses};
use pong_executive::scene::Scene;
use pong_executive::{Pose, Vec3};
use pong_fit::{Batch, Data, Free, Quantity, Settings, Starts, check, fit, parse};
use std::ops::ControlFlow;

fn told(text: &str) -> String {
    parse(text, "toss.csv", &["cube".to_owned()]).unwrap_err().to_string()
}

const HEAD: &str = "record,time,x,y,z\n";

#[test]
fn faults_of_the_text_are_told_with_their_lines() {
    let cases = [
        ("", "no line with the names of the columns"),
        ("time,x,y,z\n", "no measurement"),
        ("time,x,y\n0,1,2\n", "columns x, y are there, z are not"),
        ("x,y,z\n1,2,3\n", "no column `time`"),
        ("time,x,y,z,height\n", "no column `height`; name columns among: record, time"),
        ("time,time\n", "`time` is given twice"),
        ("time;x;y;z\n0;1;2;3\n", "toss.csv:1: its columns are separated by ';'"),
        ("time,x,y,z\n0,1,2\n", "toss.csv:2: the line has 3 cells for 4 columns"),
        ("time,x,y,z\n0,1,2,nan\n", "toss.csv:2: `z` is `nan`"),
        ("time,x,y,z\n0,1,,3\n", "`y` is ``"),
        ("time,x,y,z\n,1,2,3\n", "the line has no time"),
        ("time,x,y,z\n1,1,2,3\n0.5,1,2,3\n", "toss.csv:3: the time 0.5 s"),
        ("time,x,y,z\n1,1,2,3\n1,1,2,3\n", "body `cube` twice at 1 s"),
        ("time,body,x,y,z\n1,ball,1,2,3\n", "there is no body `ball`; name one of: cube"),
        ("time,qw,qx,qy,qz\n1,2,0,0,0\n", "the quaternion has norm 2.0000"),
        ("# noise.position = -1\ntime,x,y,z\n0,1,2,3\n", "toss.csv:1: the noise of position is `-1`"),
        ("# noise.place = 1\ntime,x,y,z\n0,1,2,3\n", "no quantity `place`; name one of: position"),
        ("# angular_velocity = table\ntime,x,y,z\n0,1,2,3\n", "write body (axes of the body) or common"),
        ("# angular_velocity = body\ntime,wx,wy,wz\n0,1,2,3\n", "has no orientation beside it"),
    ];
    for (text, part) in cases {
        let told = told(text);
        assert!(told.contains(part) && told.contains("; "), "{text:?}: {told}");
    }
    let split = format!("{HEAD}a,0,1,2,3\nb,0,1,2,3\na,1,1,2,3\n");
    assert!(told(&split).contains("record `a` goes on after another one"));
    assert!(told(&format!("{HEAD}{}", "a,0,1,2\n".repeat(50))).contains("30 more faults"));
}

#[test]
fn a_text_is_read_as_written() {
    let text = "# tosses of one cube\n# noise.position = 0.0005\n# angular_velocity = body\n\
                record,time,x,y,z,qx,qy,qz,qw,wx,wy,wz\n\
                a,0.0,1,2,3,0,0,1,0,1,0,0\na,0.1,,,,,,,,,,\nb,0,1,2,3,0,0,0,1,0,0,0\n";
    let data = parse(text, "toss.csv", &["cube".to_owned()]).unwrap();
    assert_eq!(data.records.len(), 2);
    assert_eq!(data.noise[Quantity::Position as usize], Some(5e-4));
    let row = &data.records[0].rows[0];
    assert_eq!(row.position, Some(Vec3::new(1.0, 2.0, 3.0)));
    assert!(
        (row.angular_velocity.unwrap() - Vec3::new(-1.0, 0.0, 0.0)).norm() < 1e-15,
        "half a turn about z"
    );
    assert_eq!(data.records[0].rows[1].position, None);
}

fn tossed(test: &str) -> (Scene, Data) {
    let scene = common::tossed(test);
    let mut batch = Batch::new(&scene, &[], 1).unwrap();
    let data = records(&mut batch, &[], &tosses(8, 4), &times(20, 1.0 / 148.0), 1);
    (scene, data)
}

fn faults(scene: &Scene, data: &Data) -> String {
    check(data, scene).unwrap().faults.join("\n")
}

fn noted(scene: &Scene, data: &Data) -> String {
    check(data, scene).unwrap().notes.join("\n")
}

fn each(data: &Data, change: impl Fn(&mut pong_fit::Row)) -> Data {
    let mut data = data.clone();
    data.records.iter_mut().flat_map(|record| &mut record.rows).for_each(change);
    data
}

#[test]
fn units_are_told_by_kinematics() {
    let (scene, data) = tossed("units");
    assert_eq!(faults(&scene, &data), "");
    let millimetres = each(&data, |row| row.position = row.position.map(|p| p * 1e3));
    assert!(faults(&scene, &millimetres).contains("positions in mm"), "{}", faults(&scene, &millimetres));
    let degrees = each(&data, |row| row.angular_velocity = row.angular_velocity.map(|w| w * 57.29578));
    assert!(faults(&scene, &degrees).contains("degrees/s"), "{}", faults(&scene, &degrees));
    let mut late = data.clone();
    late.records.iter_mut().flat_map(|record| &mut record.times).for_each(|time| *time *= 1e3);
    assert!(faults(&scene, &late).contains("times in ms"), "{}", faults(&scene, &late));
    let poses_alone = each(&data, |row| {
        (row.velocity, row.angular_velocity) = (None, None);
        row.position = row.position.map(|p| p * 1e3);
    });
    assert!(faults(&scene, &poses_alone).contains("positions in mm"), "{}", faults(&scene, &poses_alone));
}

#[test]
fn order_of_quaternions_and_axes_of_angular_velocities_are_told() {
    let (scene, data) = tossed("orders");
    let along_body = |row: &mut pong_fit::Row| {
        row.angular_velocity = row.orientation.zip(row.angular_velocity).map(|(q, w)| q.inverse() * w);
    };
    let order = "the quaternions are in the order x, y, z, w";
    let axes = "write `# angular_velocity = body`";
    let wrong_order = faults(&scene, &each(&data, reordered));
    assert!(wrong_order.contains(order) && !wrong_order.contains(axes), "{wrong_order}");
    let wrong_axes = faults(&scene, &each(&data, along_body));
    assert!(wrong_axes.contains(axes) && !wrong_axes.contains(order), "{wrong_axes}");
    let inverse = |row: &mut pong_fit::Row| row.orientation = row.orientation.map(|q| q.inverse());
    let turned_back = faults(&scene, &each(&data, inverse));
    assert!(turned_back.contains("change the sign of qx, qy and qz"), "{turned_back}");
    assert!(!turned_back.contains(order) && !turned_back.contains(axes), "{turned_back}");
    let both = faults(&scene, &each(&each(&data, along_body), reordered));
    assert!(both.contains(axes) && both.contains(order), "{both}");
    let mut said_body = each(&data, |row| {
        row.angular_velocity = row.orientation.zip(row.angular_velocity).map(|(q, w)| q * w);
    });
    said_body.along_body = true;
    assert!(
        faults(&scene, &said_body).contains("write `# angular_velocity = common`"),
        "{}",
        faults(&scene, &said_body)
    );
}

#[test]
fn an_angular_velocity_that_no_reading_explains_is_noted() {
    let (scene, data) = tossed("mounted_askew");
    let askew =
        each(&data, |row| row.angular_velocity = row.angular_velocity.map(|w| Vec3::new(w.y, w.z, w.x)));
    let notes = noted(&scene, &askew);
    assert!(notes.contains("no other order or axes fit"), "{notes}");
    assert!(!noted(&scene, &data).contains("no other order"));
}

#[test]
fn data_that_the_scene_cannot_have_made_are_noted() {
    let (scene, data) = tossed("far_off");
    // Positions and velocities in mm agree with each other.
    let millimetres = each(&data, |row| {
        row.position = row.position.map(|p| p * 1e3);
        row.velocity = row.velocity.map(|v| v * 1e3);
    });
    assert!(faults(&scene, &millimetres).contains("positions in mm"), "records that begin with a fall");
    let late = Settings {
        free: vec![free("surface.cube.acrylic.friction.mu", None)],
        horizon: Some(0.05),
        tries: 1,
        profiles: false,
        starts: Starts::Measured,
        ..Settings::default()
    };
    let lifted = each(&data, |row| row.position = row.position.map(|p| p - Vec3::new(0.0, 0.0, 0.05)));
    let fit = fit(&scene, &lifted, &late, &mut |_| ControlFlow::Continue(())).unwrap();
    assert!(fit.notes.join("\n").contains("standard deviations of the sensors"), "{:?}", fit.notes);
}

#[test]
fn gaps_are_noted() {
    let (scene, mut data) = tossed("gaps");
    let mut emptied = data.clone();
    for row in emptied.records[3].rows.iter_mut().filter(|row| (8..12).contains(&row.time)) {
        (row.position, row.orientation, row.velocity, row.angular_velocity) = (None, None, None, None);
    }
    let notes = noted(&scene, &emptied);
    assert!(notes.contains("record `3`: a gap of 0.0338 s"), "empty cells: {notes}");
    data.records[2].rows.retain(|row| !(8..12).contains(&row.time));
    for row in &mut data.records[2].rows {
        row.time -= if row.time >= 12 { 4 } else { 0 };
    }
    data.records[2].times.drain(8..12);
    let notes = noted(&scene, &data);
    assert!(notes.contains("record `2`: a gap of 0.0338 s"), "{notes}");
}

fn free(name: &str, bounds: Option<(f64, f64)>) -> Free {
    Free { name: name.to_owned(), bounds }
}

fn error(scene: &Scene, data: &Data, settings: &Settings) -> String {
    fit(scene, data, settings, &mut |_| ControlFlow::Continue(())).unwrap_err().to_string()
}

#[test]
fn settings_and_data_that_cannot_be_used_are_refused() {
    let (scene, data) = tossed("settings");
    let mu = || vec![free("surface.cube.acrylic.friction.mu", None)];
    let good = Settings { free: mu(), ..Settings::default() };
    let none = Settings::default();
    assert!(error(&scene, &data, &none).contains("free parameters: there are none"));
    let wrong = Settings {
        test: 1.5,
        horizon: Some(-1.0),
        tries: 0,
        threads: 0,
        confidence: 2.0,
        from: -1.0,
        ..good.clone()
    };
    assert_eq!(error(&scene, &data, &wrong).lines().count(), 6);
    let unknown = Settings { free: vec![free("surface.cube.acrylic.friction.nu", None)], ..good.clone() };
    assert!(error(&scene, &data, &unknown).contains("it has: stiffness"));
    let unbounded = Settings { free: vec![free("ground.position.z", None)], ..good.clone() };
    assert!(error(&scene, &data, &unbounded).contains("write ground.position.z=LOW..HIGH"));
    let reversed = Settings { free: vec![free("body.cube.mass", Some((2.0, 1.0)))], ..good.clone() };
    assert!(error(&scene, &data, &reversed).contains("the lower first"));
    let mut silent = data.clone();
    silent.noise[0] = None;
    assert!(error(&scene, &silent, &good).contains("position: the noise of its sensor is not known"));
    let forces = Settings { of: vec![Quantity::Force], ..good.clone() };
    assert!(error(&scene, &data, &forces).contains("force: it counts, but no row has it"));
    let no_start = each(&data, |row| row.position = row.position.filter(|_| row.time > 0));
    assert!(error(&scene, &no_start, &good).contains("no whole pose of the body"));
    let still = each(&data, |row| row.velocity = None);
    let as_measured = Settings { starts: Starts::Measured, ..good.clone() };
    assert!(
        error(&scene, &still, &as_measured)
            .contains("is not measured; measure them, or let starts be fitted")
    );
    let short = Settings { horizon: Some(1e-3), ..good.clone() };
    assert!(error(&scene, &data, &short).contains("no record has two times that count"));
    let strange = each(&data, |row| row.body = "ball".to_owned());
    assert!(error(&scene, &strange, &good).contains("there is no body `ball`; name one of: cube, ground"));
    let ended = fit(&scene, &data, &good, &mut |_| ControlFlow::Break(())).unwrap_err();
    assert!(ended.to_string().contains("was ended"));
}

#[test]
fn what_the_data_cannot_tell_is_told() {
    let (scene, mut data) = tossed("shortfalls");
    // Only the flight counts: no law of contact has an effect.
    for record in &mut data.records {
        record.times.truncate(3);
        record.rows.retain(|row| row.time < 3);
    }
    let settings = Settings {
        free: vec![free("surface.cube.acrylic.friction.mu", None), free("gravity.z", Some((-9.0, -5.0)))],
        tries: 2,
        ..Settings::default()
    };
    let fit = fit(&scene, &data, &settings, &mut |_| ControlFlow::Continue(())).unwrap();
    let notes = fit.notes.join("\n");
    assert!(!fit.parameters[0].moved && notes.contains("friction.mu`: the data do not move it"), "{notes}");
    assert!(notes.contains("`gravity.z`: the optimum is at its bound of -9 m/s²"), "{notes}");
    let page = pong_fit::report::markdown(&fit);
    assert!(page.contains("not moved by the data") && page.contains("(bound)"), "{page}");
}

#[test]
fn parameters_that_move_together_are_told() {
    let (scene, data) = tossed("together");
    let settings = Settings {
        free: vec![
            free("body.cube.mass", Some((0.1, 2.0))),
            free("surface.cube.acrylic.stiffness", Some((2e3, 1e5))),
        ],
        of: vec![Quantity::Position],
        horizon: Some(0.06),
        tries: 1,
        profiles: false,
        ..Settings::default()
    };
    let fit = fit(&scene, &data, &settings, &mut |_| ControlFlow::Continue(())).unwrap();
    let notes = fit.notes.join("\n");
    assert!(notes.contains("they move together"), "{notes} {:?}", fit.correlations);
}

/// Orientations with the quaternion's components x, y, z, w in the columns of w, x, y, z.
fn reordered(row: &mut pong_fit::Row) {
    row.orientation = row.orientation.map(|q| Pose::new(Vec3::zeros(), [q.i, q.j, q.k, q.w]).orientation);
}

fn turned_back(row: &mut pong_fit::Row) {
    row.orientation = row.orientation.map(|q| q.inverse());
}

/// Poses of 20 tosses over a time, without velocities.
fn poses(scene: &Scene, count: usize, height: f64) -> Data {
    let mut starts = tosses(20, 4);
    starts.iter_mut().for_each(|(pose, _)| pose.position.z += height);
    let data = records(&mut Batch::new(scene, &[], 1).unwrap(), &[], &starts, &times(count, 1.0 / 148.0), 1);
    each(&data, |row| (row.velocity, row.angular_velocity) = (None, None))
}

const ORDER: &str = "the quaternions are in the order x, y, z, w";
const INVERSE: &str = "change the sign of qx, qy and qz";

#[test]
fn poses_alone_tell_the_order_of_their_quaternions_by_contacts() {
    let scene = common::tossed("poses_in_contact");
    let data = poses(&scene, 40, 0.0);
    assert!(!noted(&scene, &data).contains("another reading"), "{}", noted(&scene, &data));
    assert_eq!(faults(&scene, &data), "");
    let wrong = faults(&scene, &each(&data, reordered));
    assert!(
        wrong.contains("sinks into others") && wrong.contains(ORDER) && !wrong.contains(INVERSE),
        "{wrong}"
    );
    let wrong = faults(&scene, &each(&data, turned_back));
    assert!(wrong.contains(INVERSE) && !wrong.contains(ORDER), "{wrong}");
}

#[test]
fn poses_alone_tell_the_order_of_their_quaternions_by_free_flight() {
    let scene = common::rod("poses_in_flight");
    let data = poses(&scene, 40, 2.0);
    assert_eq!(faults(&scene, &data), "");
    let wrong = faults(&scene, &each(&data, reordered));
    assert!(wrong.contains("the angular momentum changes by") && wrong.contains(ORDER), "{wrong}");
    assert!(!noted(&scene, &data).contains("another reading"), "{}", noted(&scene, &data));
}

#[test]
fn an_order_that_nothing_tells_is_noted() {
    // Even rotations without a touch.
    let scene = common::tossed("even_flight");
    for data in [poses(&scene, 10, 2.0), each(&poses(&scene, 10, 2.0), reordered)] {
        assert_eq!(faults(&scene, &data), "");
        let notes = noted(&scene, &data);
        assert!(
            notes.contains("another reading") && notes.contains(ORDER) && notes.contains(INVERSE),
            "{notes}"
        );
    }
}
