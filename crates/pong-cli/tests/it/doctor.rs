//! `pong doctor` works on any machine; its findings are tested on records of machines in `pong-doctor`.

use crate::common;
use crate::common::pong;
use serde_json::Value;

#[test]
fn text_and_json_have_the_same_findings() {
    let folder = common::folder("doctor", &[]);
    let (code, text, _) = pong(&folder, &["doctor", "--seconds", "0"]);
    assert_eq!(code, 0);
    let (code, json, _) = pong(&folder, &["doctor", "--seconds", "0", "--json"]);
    assert_eq!(code, 0);
    let report: Value = serde_json::from_str(&json).unwrap();
    assert_eq!((&report["format"], &report["version"]), (&Value::from("pong-doctor"), &Value::from(1)));
    let findings = report["findings"].as_array().unwrap();
    assert!(findings.len() > if cfg!(target_os = "linux") { 10 } else { 4 });
    for finding in findings {
        let word = |name: &str| finding[name].as_str().unwrap().to_owned();
        assert!(text.lines().any(|line| line.contains(&word("name"))), "{finding}");
        assert!(text.contains(&word("found")) && text.contains(&word("meaning")), "{finding}");
        assert_eq!(finding["cure"].is_string(), word("state") == "advice", "{finding}");
    }
    assert!(report["latencies"].as_array().unwrap().is_empty());

    // Advice is a failure only on request.
    let is_advised = findings.iter().any(|finding| finding["state"] == "advice");
    assert_eq!(pong(&folder, &["doctor", "--seconds", "0", "--strict"]).0, i32::from(is_advised));
}

#[test]
fn what_was_measured_is_told_with_its_histogram() {
    let folder = common::folder("doctor_measured", &[]);
    let (code, json, told) = pong(&folder, &["doctor", "--seconds", "0.05", "--json"]);
    assert_eq!(code, 0, "{told}");
    let report: Value = serde_json::from_str(&json).unwrap();
    let bounds = report["bin_bounds_us"].as_array().unwrap().len();
    let latencies = report["latencies"].as_array().unwrap();
    assert!(latencies.len() >= 3);
    for latency in latencies {
        let bins = latency["bins"].as_array().unwrap();
        assert_eq!(bins.len(), bounds + 1);
        let counted: u64 = bins.iter().map(|bin| bin.as_u64().unwrap()).sum();
        assert_eq!(counted, latency["samples"].as_u64().unwrap());
    }
    let (_, text, _) = pong(&folder, &["doctor", "--seconds", "0.05"]);
    assert!(latencies.iter().all(|latency| text.contains(latency["what"].as_str().unwrap())), "{text}");
}

#[test]
fn times_that_make_no_sense_are_refused() {
    let folder = common::folder("doctor_usage", &[]);
    for seconds in ["-1", "nan", "inf", "1e9", "soon"] {
        let (code, _, told) = pong(&folder, &["doctor", &format!("--seconds={seconds}")]);
        assert_eq!(code, 2);
        assert!(told.contains("must be a number of seconds from 0 to 3600"), "{told}");
    }
}
