//! The command `tsubu`.
fn main() {}
