//! What the whole-scene tests share: scratch folders, scenes run through the library, the command and what it leaves.

mod command;
mod scenes;
mod scratch;

pub use command::{Outcome, kill, run_in, start_in, tsubu};
pub use scenes::{Bits, assemble, bits, check, good_scene, repository, run_out, scene_files};
pub use scratch::{Scratch, tree};
