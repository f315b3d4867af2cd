//! Findings on machines whose files are recorded in `recorded/`.

use pong_doctor::{Files, Finding, State, examine, examine_elsewhere};
use pong_threads::system::Grants;
use std::collections::BTreeMap;

struct Record(BTreeMap<String, String>);

impl Record {
    fn read(name: &str) -> Self {
        let path = format!("{}/tests/recorded/{name}.txt", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let files = text.split("==> ").skip(1).map(|file| {
            let (path, text) = file.split_once('\n').unwrap();
            (path.to_owned(), text.trim_end().to_owned())
        });
        Self(files.collect())
    }

    fn with(mut self, path: &str, text: &str) -> Self {
        self.0.insert(path.to_owned(), text.to_owned());
        self
    }
}

impl Files for Record {
    fn text(&self, path: &str) -> Option<String> {
        self.0.get(path).cloned()
    }
}

fn found(findings: &[Finding], name: &str) -> (State, String) {
    let finding = findings.iter().find(|finding| finding.name == name).unwrap();
    (finding.state, finding.found.clone())
}

fn refused() -> Result<(), String> {
    Err("Operation not permitted (os error 1)".to_owned())
}

fn assert_found(findings: &[Finding], expected: &[(&str, State, &str)]) {
    for (name, state, text) in expected {
        assert_eq!(found(findings, name), (*state, (*text).to_owned()), "{name}");
    }
}

#[test]
fn a_laptop_grants_nothing_that_it_was_not_asked_for() {
    let findings = examine(&Record::read("laptop"), refused());
    let expected = [
        ("cores", State::Good, "8 logical processors on 4 cores (0-7); this process may use 8 (0-7)"),
        ("SMT siblings", State::Advice, "these share a core: 0,4 and 1,5 and 2,6 and 3,7"),
        ("isolated cores", State::Advice, "none"),
        ("cores without tick", State::Advice, "none"),
        ("frequency governor", State::Advice, "powersave"),
        ("idle states", State::Advice, "up to 1048 µs to wake up from the deepest one"),
        ("locked memory", State::Advice, "8192 KiB at most"),
        ("SCHED_FIFO", State::Advice, "refused: Operation not permitted (os error 1) (RLIMIT_RTPRIO is 0)"),
        ("real-time share", State::Advice, "950000 µs of 1000000 µs"),
        ("kernel preemption", State::Advice, "PREEMPT_DYNAMIC, voluntary"),
        ("timer slack", State::Info, "50 µs"),
        ("clock source", State::Advice, "hpet"),
        ("virtual machine", State::Good, "no"),
    ];
    assert_found(&findings, &expected);
}

#[test]
fn a_trainer_that_was_set_up_needs_no_advice() {
    let findings = examine(&Record::read("trainer"), Ok(()));
    let expected = [
        ("cores", State::Good, "8 logical processors on 8 cores (0-7); this process may use 6 (0-5)"),
        ("SMT siblings", State::Good, "no two processors of this process share a core"),
        ("isolated cores", State::Good, "2-5; of these this process may use 2-5"),
        ("cores without tick", State::Good, "2-5"),
        ("frequency governor", State::Good, "performance"),
        // The deeper states are disabled.
        ("idle states", State::Good, "up to 2 µs to wake up from the deepest one"),
        ("locked memory", State::Good, "without limit"),
        ("SCHED_FIFO", State::Good, "granted to a thread that asked for it (RLIMIT_RTPRIO is 99)"),
        ("real-time share", State::Good, "all of a core"),
        ("kernel preemption", State::Good, "PREEMPT_RT"),
        ("clock source", State::Good, "tsc"),
    ];
    assert_found(&findings, &expected);
    assert!(findings.iter().all(|finding| finding.state != State::Advice), "{findings:#?}");
}

#[test]
fn a_container_says_what_it_cannot_know() {
    let findings = examine(&Record::read("container"), refused());
    let expected = [
        ("cores", State::Advice, "16 logical processors on 8 cores (0-15); this process may use 1 (10)"),
        // The sibling of 10 is not available to this process.
        ("SMT siblings", State::Good, "no two processors of this process share a core"),
        ("isolated cores", State::Good, "8-11; of these this process may use 10"),
        ("cores without tick", State::Unknown, "the kernel has no nohz_full"),
        (
            "frequency governor",
            State::Unknown,
            "the kernel does not set frequencies: firmware or a host does",
        ),
        ("idle states", State::Unknown, "the kernel tells of none: firmware or a host decides"),
        // In a80c75fb bit 14, CAP_IPC_LOCK, is set.
        ("locked memory", State::Good, "without limit (CAP_IPC_LOCK)"),
        ("kernel preemption", State::Advice, "not preemptible, or only at chosen places"),
        ("clock source", State::Good, "kvm-clock"),
        ("virtual machine", State::Info, "yes"),
    ];
    assert_found(&findings, &expected);
}

#[test]
fn files_that_make_no_sense_are_unknown() {
    let findings = examine(&Record::read("silent"), refused());
    for name in
        ["isolated cores", "frequency governor", "real-time share", "kernel preemption", "locked memory"]
    {
        assert_eq!(found(&findings, name).0, State::Unknown, "{name}");
    }
    let none = examine(&Record(BTreeMap::new()), refused());
    assert_eq!(none.len(), findings.len());
}

#[test]
fn the_mode_of_a_kernel_that_can_choose_is_the_one_in_use() {
    let dynamic = || Record::read("laptop");
    let in_use = dynamic().with("/sys/kernel/debug/sched/preempt", "none voluntary (full) lazy");
    assert_eq!(found(&examine(&in_use, Ok(())), "kernel preemption").1, "PREEMPT_DYNAMIC, full");
    let not_told = dynamic().with("/proc/cmdline", "ro quiet");
    let model = found(&examine(&not_told, Ok(())), "kernel preemption").1;
    assert_eq!(model, "PREEMPT_DYNAMIC, in the mode that it was built with");
}

#[test]
fn all_advice_has_a_cure() {
    for name in ["laptop", "trainer", "container", "silent"] {
        for finding in examine(&Record::read(name), refused()) {
            assert_eq!(finding.cure.is_some(), finding.state == State::Advice, "{name}: {finding:?}");
        }
    }
}

/// A system that can grant nothing is told in its own words, and what was not looked at is told too.
#[test]
fn a_system_without_proc_tells_what_it_cannot_grant() {
    let grants = Grants { system: "none", no_binding: Some("binds nothing"), no_fifo: Some("no priorities") };
    let findings = examine_elsewhere(&grants, 1, Err("no priorities".to_owned()));
    assert_found(
        &findings,
        &[("core binding", State::Info, "binds nothing"), ("SCHED_FIFO", State::Advice, "no priorities")],
    );
    let advised = |name| findings.iter().any(|found| found.name == name && found.cure.is_some());
    assert!(advised("cores") && advised("SCHED_FIFO") && !advised("core binding"));
    assert!(findings.iter().any(|found| found.state == State::Unknown));
    let grants = Grants { no_binding: None, ..grants };
    let findings = examine_elsewhere(&grants, 4, Ok(()));
    assert!(findings.iter().all(|found| found.cure.is_none()));
}
