//! `tsubu tune`: finds what holds, says when nothing does, and goes on from finished pilots.

use tsubu_tests::{Scratch, repository, run_in, tree};

/// A bed small enough for a dozen runs.
const BED: &str = "--set initial.bed.layers=3 --set domain.x=Periodic(\"5.35~mm\") --set water.begins=0.06~s --set time.until=0.16~s --set grains.law.constants.cn=0.3 --set time.step=Exactly(\"5~us\")";

fn tune(scratch: &Scratch, more: &str) -> tsubu_tests::Outcome {
    let scene = repository().join("scenarios/movable_bed.ron");
    run_in(
        scratch.path(),
        &format!("tune {} {BED} {more}", scene.display()),
    )
}

/// The centre of mass of a packed bed does not depend on the step, so the longest that is stable is chosen; the tuned scene
/// is a scene, and the same command again finds every pilot done.
#[test]
fn the_cheapest_setting_that_holds_is_chosen_and_pilots_are_kept() {
    let scratch = Scratch::new("tune");
    let line = "--quantity centre_of_mass --tolerance 30% --reference-cost 3 --out t";
    let first = tune(&scratch, line);
    first.is_done();
    assert!(
        first.stdout.contains(" holds: centre_of_mass is "),
        "{first:#?}"
    );
    let files = tree(&scratch.join("t"));
    for name in ["tuned.ron", "tune.md", "tune.csv", "tune.svg", "tune.png"] {
        assert!(
            files.contains_key(name),
            "{name} is missing: {:?}",
            files.keys()
        );
    }
    let csv = String::from_utf8_lossy(&files["tune.csv"]).into_owned();
    let last = csv.lines().last().unwrap_or_default();
    assert!(
        last.ends_with(",true") && csv.matches(",true").count() == 1,
        "{csv}"
    );
    assert!(!last.contains("as it is"), "a cheaper setting holds: {csv}");
    run_in(scratch.path(), "check t/tuned.ron").is_done();
    let again = tune(&scratch, line);
    again.is_done();
    assert_eq!(first.stdout, again.stdout);
    let pilots = |files: &std::collections::BTreeMap<String, Vec<u8>>| -> Vec<(String, Vec<u8>)> {
        let of = files.iter().filter(|f| f.0.contains("pilots"));
        of.map(|(name, text)| (name.clone(), text.clone()))
            .collect()
    };
    // Costs are times of a clock: a pilot that ran again would differ.
    assert_eq!(pilots(&files), pilots(&tree(&scratch.join("t"))));
}

/// Water that flows for 0.1 s carries what chance wants: no setting is surely within a thousandth.
#[test]
fn a_tolerance_that_nothing_meets_is_said() {
    let scratch = Scratch::new("tune-nothing");
    let outcome = tune(
        &scratch,
        "--quantity transport --tolerance 0.1% --reference-cost 2 --out t",
    );
    outcome.is_done();
    assert!(
        outcome
            .stdout
            .starts_with("No setting keeps transport within 0.1 %"),
        "{outcome:#?}"
    );
    assert!(!scratch.join("t/tuned.ron").exists());
}

#[test]
fn what_cannot_be_tuned_is_refused() {
    let scratch = Scratch::new("tune-refused");
    for (more, words) in [
        (
            "--quantity mass_rate --tolerance 5%",
            "this scene does not measure `mass_rate`",
        ),
        (
            "--quantity transport --tolerance 0%",
            "expected a share above 0 %",
        ),
        (
            "--quantity transport --tolerance 5% --reference-cost 1",
            "raise --reference-cost",
        ),
    ] {
        let outcome = tune(&scratch, more);
        assert_eq!(outcome.code, 2, "{outcome:#?}");
        assert!(outcome.stderr.contains(words), "{outcome:#?}");
    }
    assert!(tree(scratch.path()).is_empty());
}
