//! Tests of the run folder: numbered, refused, replaced, shared with nobody.

use super::*;
use crate::Fault;
use crate::scratch::{Scratch, names};

fn is_refused(result: Result<RunFolder, RecordError>, words: &str) {
    let error = result.unwrap_err();
    assert_eq!(error.fault(), Fault::Arguments, "{error}");
    assert_eq!(error.exit_code(), 2);
    assert!(error.to_string().contains(words), "{error}");
}

/// A folder as a finished run leaves it, with the user's notes beside.
fn finished_run(path: &Path) {
    let folder = RunFolder::create(Some(path), "unused", false).unwrap();
    for name in ["frames", "figures", "checkpoint"] {
        fs::create_dir(folder.path(name)).unwrap();
        fs::write(folder.path(name).join("a"), "x").unwrap();
    }
    for name in [
        "summary.json",
        "series.csv",
        "frames.pvd",
        "scene.resolved.ron",
        "animation.gif",
        "animation.html",
        ".frames.pvd.tsubu-part",
        "notes.txt",
    ] {
        fs::write(folder.path(name), "x").unwrap();
    }
}

#[test]
fn without_a_request_folders_are_numbered() {
    let scratch = Scratch::new();
    let base = scratch.join("out");
    for name in ["pile", "pile-2", "pile-3"] {
        let folder = RunFolder::numbered(&base, "pile").unwrap();
        assert_eq!(folder.root(), base.join(name));
    }
    // A gap is taken, and a file in the way is no obstacle.
    fs::remove_dir_all(base.join("pile-2")).unwrap();
    fs::write(base.join("pile-4"), "x").unwrap();
    for name in ["pile-2", "pile-5"] {
        let folder = RunFolder::numbered(&base, "pile").unwrap();
        assert_eq!(folder.root(), base.join(name));
    }
}

#[test]
fn a_stem_cannot_lead_out_of_the_base() {
    let scratch = Scratch::new();
    for stem in ["", ".", "..", "a/b", "/a", "a/", "../a"] {
        is_refused(
            RunFolder::numbered(&scratch.join("out"), stem),
            "cannot be the name",
        );
    }
    assert!(names(scratch.path()).is_empty());
}

#[test]
fn a_base_that_fails_leaves_nothing() {
    let scratch = Scratch::new();
    // Longer than any file system allows, so the base is made and the folder in it is not.
    let error = RunFolder::numbered(&scratch.join("out"), &"a".repeat(5000)).unwrap_err();
    assert_eq!(error.fault(), Fault::Machine, "{error}");
    assert!(names(scratch.path()).is_empty());
}

#[test]
fn a_base_that_is_a_file_is_refused() {
    let scratch = Scratch::new();
    fs::write(scratch.join("out"), "x").unwrap();
    is_refused(
        RunFolder::numbered(&scratch.join("out"), "pile"),
        "is not a folder",
    );
}

#[test]
fn an_empty_folder_is_taken_once() {
    let scratch = Scratch::new();
    let path = scratch.join("a");
    fs::create_dir(&path).unwrap();
    let folder = RunFolder::create(Some(&path), "unused", false).unwrap();
    assert_eq!(folder.path("summary.json"), path.join("summary.json"));
    is_refused(
        RunFolder::create(Some(&path), "unused", false),
        "already holds a run",
    );
}

#[test]
fn an_earlier_run_is_refused_and_kept_whole() {
    let scratch = Scratch::new();
    let path = scratch.join("a");
    finished_run(&path);
    let before = names(&path);
    let refused = RunFolder::create(Some(&path), "unused", false);
    assert!(refused.as_ref().unwrap_err().remedy().contains("--force"));
    is_refused(refused, "already holds a run");
    assert_eq!(names(&path), before);
}

#[test]
fn force_removes_the_earlier_run_and_nothing_else() {
    let scratch = Scratch::new();
    let path = scratch.join("a");
    finished_run(&path);
    RunFolder::create(Some(&path), "unused", true).unwrap();
    assert_eq!(names(&path), [CLAIM, "notes.txt"]);
}

#[test]
fn force_leaves_a_foreign_folder_alone() {
    let scratch = Scratch::new();
    let path = scratch.join("paper");
    // Names a run would use too, but nothing that proves a run wrote them.
    fs::create_dir_all(path.join("figures")).unwrap();
    fs::write(path.join("figures/map.pdf"), "x").unwrap();
    fs::write(path.join("summary.json"), "{}").unwrap();
    for force in [false, true] {
        is_refused(
            RunFolder::create(Some(&path), "unused", force),
            "even --force",
        );
    }
    assert_eq!(names(&path), ["figures", "summary.json"]);
    assert_eq!(names(&path.join("figures")), ["map.pdf"]);
}

#[cfg(unix)]
#[test]
fn force_removes_a_link_and_not_what_it_leads_to() {
    let scratch = Scratch::new();
    let (path, big_disk) = (scratch.join("a"), scratch.join("big_disk"));
    RunFolder::create(Some(&path), "unused", false).unwrap();
    fs::create_dir(&big_disk).unwrap();
    fs::write(big_disk.join("precious"), "x").unwrap();
    std::os::unix::fs::symlink(&big_disk, path.join("frames")).unwrap();
    RunFolder::create(Some(&path), "unused", true).unwrap();
    assert_eq!(names(&path), [CLAIM]);
    assert_eq!(names(&big_disk), ["precious"]);
}

#[test]
fn paths_that_cannot_be_folders_are_refused_and_leave_nothing() {
    let scratch = Scratch::new();
    fs::write(scratch.join("file"), "x").unwrap();
    for force in [false, true] {
        let try_it = |name| RunFolder::create(Some(&scratch.join(name)), "unused", force);
        is_refused(try_it("file"), "is not a folder");
        is_refused(try_it("file/a"), "is a file, not a folder");
        is_refused(try_it("missing/a"), "does not exist");
        is_refused(
            RunFolder::create(Some(Path::new("")), "unused", force),
            "does not exist",
        );
    }
    assert_eq!(names(scratch.path()), ["file"]);
}

#[cfg(unix)]
#[test]
fn a_folder_without_write_permission_is_the_machines_fault() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = Scratch::new();
    let path = scratch.join("locked");
    fs::create_dir(&path).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o555)).unwrap();
    if fs::write(path.join("probe"), "x").is_ok() {
        eprintln!("not checked: this user (root?) may write to a folder without write permission");
        return;
    }
    // As the folder itself, as its parent, and as the base of numbered ones.
    for result in [
        RunFolder::create(Some(&path), "unused", false),
        RunFolder::create(Some(&path.join("a")), "unused", false),
        RunFolder::numbered(&path, "pile"),
    ] {
        let error = result.unwrap_err();
        assert_eq!(error.exit_code(), 4);
        assert!(error.remedy().contains("you may write to"), "{error}");
    }
    assert!(names(&path).is_empty());
}

#[test]
fn runs_started_at_once_never_share() {
    let scratch = Scratch::new();
    let base = scratch.join("out");
    let shared = scratch.join("shared");
    fs::create_dir(&shared).unwrap();
    let (mut roots, winners) = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8)
            .map(|_| {
                scope.spawn(|| {
                    let root = RunFolder::numbered(&base, "pile").unwrap().root;
                    (
                        root,
                        RunFolder::create(Some(&shared), "unused", false).is_ok(),
                    )
                })
            })
            .collect();
        let results: Vec<_> = threads.into_iter().map(|t| t.join().unwrap()).collect();
        let winners = results.iter().filter(|(_, won)| *won).count();
        let roots: Vec<_> = results.into_iter().map(|(root, _)| root).collect();
        (roots, winners)
    });
    roots.sort();
    roots.dedup();
    assert_eq!(roots.len(), 8);
    assert_eq!(winners, 1);
}

#[test]
fn the_runs_of_seeds_go_with_their_folder_and_notes_in_them_stay() {
    let scratch = Scratch::new();
    let path = scratch.join("bed");
    let folder = RunFolder::create(Some(&path), "unused", false).unwrap();
    for seed in [1, 2] {
        let run = folder.of_seed(seed).unwrap();
        fs::write(run.path("summary.json"), "x").unwrap();
    }
    fs::write(folder.path("seed-2/notes.txt"), "mine").unwrap();
    // Not ours: no run claimed it, or its name is no seed's.
    fs::create_dir(folder.path("seed-3")).unwrap();
    fs::create_dir(folder.path("seed-bank")).unwrap();
    is_refused(
        RunFolder::create(Some(&path), "unused", false),
        "already holds",
    );
    // Neither the whole nor one of its runs is replaced while a run holds it.
    is_refused(
        RunFolder::create(Some(&path), "unused", true),
        "another run is writing",
    );
    drop(folder);
    let one = RunFolder::reopen(&path.join("seed-1")).unwrap();
    is_refused(
        RunFolder::create(Some(&path), "unused", true),
        "another run is writing",
    );
    drop(one);
    let folder = RunFolder::create(Some(&path), "unused", true).unwrap();
    assert_eq!(names(&path), [CLAIM, "seed-2", "seed-3", "seed-bank"]);
    let again = folder.of_seed(2).unwrap();
    assert_eq!(names(again.root()), [CLAIM, "notes.txt"]);
    // A later run of one seed alone replaces them all the same.
    drop((folder, again));
    RunFolder::create(Some(&path), "unused", true).unwrap();
    assert_eq!(names(&path), [CLAIM, "seed-2", "seed-3", "seed-bank"]);
}
