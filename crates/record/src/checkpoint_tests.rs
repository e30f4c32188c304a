//! Checkpoints come back to the bit or are refused, whatever happens to their files.

use super::*;
use crate::Fault;
use crate::scratch::{Scratch, names};
use proptest::prelude::*;

fn example(step: u64) -> Checkpoint {
    let mut state = Words::new();
    state.put_part("state");
    state.put_number(-0.0);
    (0..40).for_each(|k| state.put_whole(step.wrapping_mul(k)));
    Checkpoint {
        program: "0.1.0".into(),
        scene: "(title: \"ä grain\")".into(),
        files: vec![("meshes/screw.stl".into(), "12ab".into())],
        state,
    }
}

fn folder(scratch: &Scratch) -> Checkpoints {
    Checkpoints::of(&scratch.run_folder()).unwrap()
}

#[test]
fn the_last_two_are_kept_and_the_newest_comes_back() {
    let scratch = Scratch::new();
    let all = folder(&scratch);
    for step in [0, 64, 1000, 99_999] {
        all.write(step, &example(step)).unwrap();
        let newest = all.newest().unwrap();
        assert_eq!(newest.checkpoint, example(step));
        assert!(newest.damaged.is_empty());
    }
    let kept = names(&all.folder);
    assert_eq!(
        kept,
        ["step_000000000001000.tsubu", "step_000000000099999.tsubu"]
    );
}

/// Every byte of a file turned, and every length: never taken, and the one before is.
#[test]
fn a_file_cut_or_flipped_at_any_place_is_set_aside() {
    let scratch = Scratch::new();
    let all = folder(&scratch);
    all.write(1, &example(1)).unwrap();
    let path = all.write(2, &example(2)).unwrap();
    let whole = fs::read(&path).unwrap();
    let mut damages: Vec<Vec<u8>> = (0..whole.len()).map(|n| whole[..n].to_vec()).collect();
    for at in 0..whole.len() {
        let mut flipped = whole.clone();
        flipped[at] ^= 1 << (at % 8);
        damages.push(flipped);
    }
    damages.push([&whole[..], b"x"].concat());
    damages.push([&whole[..], b"12345678"].concat());
    damages.push(b"not one at all, but long enough to be one, which takes some words".to_vec());
    for bytes in damages {
        fs::write(&path, bytes).unwrap();
        let newest = all.newest().unwrap();
        assert_eq!(newest.checkpoint, example(1));
        assert_eq!(newest.damaged.len(), 1);
        assert!(newest.damaged[0].contains("step_000000000000002"));
        assert!(!path.exists(), "the damaged one has another name now");
    }
    fs::write(all.folder.join("step_000000000000001.tsubu"), b"").unwrap();
    let error = all.newest().unwrap_err();
    assert_eq!((error.fault(), error.exit_code()), (Fault::Machine, 4));
    assert!(
        error.to_string().contains("no checkpoint is whole"),
        "{error}"
    );
}

#[test]
fn another_layout_is_refused_in_words() {
    let scratch = Scratch::new();
    let all = folder(&scratch);
    let path = all.folder.join("step_000000000000007.tsubu");
    let mut words = Words::new();
    words.put_whole(LAYOUT + 1);
    words.put_text("9.8.7");
    let mut bytes = FIRST_LINE.to_vec();
    bytes.extend(words.all().iter().flat_map(|word| word.to_le_bytes()));
    bytes.extend(blake3::hash(&bytes).as_bytes());
    fs::write(&path, bytes).unwrap();
    let error = all.newest().unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(
        error
            .to_string()
            .contains("layout 2, written by tsubu 9.8.7; this program reads layout 1"),
        "{error}"
    );
    assert!(path.exists(), "another program can still read it");
}

#[test]
fn without_one_there_is_nothing_to_go_on_from() {
    let scratch = Scratch::new();
    let all = folder(&scratch);
    fs::write(all.path("step_x.tsubu"), "not ours").unwrap();
    let error = all.newest().unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(
        error.to_string().contains("there is no checkpoint"),
        "{error}"
    );
}

/// The part file is a link to the device that is always full.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_keeps_the_former_ones() {
    let scratch = Scratch::new();
    let all = folder(&scratch);
    all.write(1, &example(1)).unwrap();
    all.write(2, &example(2)).unwrap();
    let part = all.path(".step_000000000000003.tsubu.tsubu-part");
    std::os::unix::fs::symlink("/dev/full", part).unwrap();
    let error = all.write(3, &example(3)).unwrap_err();
    assert_eq!(error.exit_code(), 4);
    assert_eq!(all.newest().unwrap().checkpoint, example(2));
    assert_eq!(names(&all.folder).len(), 2);
}

proptest! {
    /// Words with a right checksum but any content: an answer, never a panic, and no more memory than the file has.
    #[test]
    fn any_content_is_read_or_refused(words in prop::collection::vec(any::<u64>(), 1..30), layout in any::<bool>()) {
        let mut words = words;
        if layout {
            words[0] = LAYOUT;
        }
        let read = content(Words::of(words.clone()));
        prop_assert!(read.map_or(true, |c| c.state.left() <= words.len()));
    }
}
