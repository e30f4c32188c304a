//! How many copies of the step are compiled: one for each combination of types that `assemble` names.

use std::collections::BTreeSet;
use std::path::Path;

/// The widest vector path is one function for each combination, and never inlined: its symbols are counted.
const SYMBOL: &[u8] = b"run_avx512";

/// The count in the built command, or why it is not known.
pub fn count(root: &Path) -> Result<String, String> {
    for profile in ["release", "debug"] {
        let file = root.join("target").join(profile).join("tsubu");
        if file.is_file() {
            let bytes =
                std::fs::read(&file).map_err(|e| format!("cannot read {}: {e}", file.display()))?;
            return Ok(format!(
                "{} (target/{profile}/tsubu, by its symbols)",
                symbols(&bytes)
            ));
        }
    }
    Ok("unknown: build the command first (cargo build)".into())
}

/// Different zero-ended words that hold the symbol's name. A mangled name holds it behind its length;
/// the same name in the debug tables is the same word.
fn symbols(bytes: &[u8]) -> usize {
    let words = bytes
        .split(|&b| b == 0)
        .filter(|word| word.starts_with(b"_") && word.len() < 4096);
    words
        .filter(|word| word.windows(SYMBOL.len()).any(|w| w == SYMBOL))
        .collect::<BTreeSet<_>>()
        .len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn different_symbols_count_once_each() {
        let bytes = b"\0_ZN5lanes3x8610run_avx51217h01E\0junk\0_ZN5lanes3x8610run_avx51217h02E\0_ZN5lanes3x8610run_avx51217h01E\0run_avx512\0";
        assert_eq!(symbols(bytes), 2);
    }
}
