//! Whole-scene and cross-crate tests: one binary, a module for each subject.

mod bad_scenes; // every bad scene ends with the message it states, in the library and in the command
mod checkpoints; // saved and taken up again: the same bits
mod command; // exit codes and what a run leaves behind
mod good_scenes; // every good scene runs to its end, and its resolved text runs to the same bits
mod machines; // meshes with faults, bodies that move, grains that come and go
mod other_engines; // decks for LAMMPS and LIGGGHTS, and dumps that come back
mod physics; // whole scenes with closed forms
mod properties; // random small scenes: stable when the check says so, invariants, units
mod river; // a bed that rests, moves, and is refused an unstable step
mod same_bits; // threads, vector paths, outputs and batches change no bit
mod seeds; // several seeds in one command, their means, what is refused
mod trouble; // folders that cannot be written, signals, physics that fails
mod tune; // settings that hold, and none
