//! Bad scenes state their own message in place; this holds an error against what its scene states.
//!
//! Under the offending line stands a comment whose first `^` is under the reported column:
//!
//! ```text
//!     soften: 0.5,
//!     //      ^^^ soften is below 1
//! ```
//!
//! A trouble of the whole file is stated in the first line, as `//! message`.
//! A message is a part of the headline. A scene that begins with `// Found when assembled` passes the checks of this crate.

use crate::error::SceneError;

/// What a bad scene states about itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expected {
    /// A part of the headline.
    pub message: String,
    /// Line and column from 1; `None` for the whole file.
    pub place: Option<(usize, usize)>,
    /// Whether a later stage finds the trouble, not this crate.
    pub when_assembled: bool,
}

impl Expected {
    /// Reads the statement in a bad scene; `None` if there is none.
    pub fn read(text: &str) -> Option<Expected> {
        let when_assembled = text.starts_with("// Found when assembled");
        if let Some(message) = text
            .lines()
            .next()
            .and_then(|line| line.strip_prefix("//!"))
        {
            return Some(Expected {
                message: message.trim().into(),
                place: None,
                when_assembled,
            });
        }
        text.lines().enumerate().find_map(|(above, line)| {
            let comment = line.trim_start().strip_prefix("//")?.trim_start();
            let message = comment
                .starts_with('^')
                .then(|| comment.trim_start_matches('^').trim())?;
            let column = line.chars().position(|sign| sign == '^')? + 1;
            Some(Expected {
                message: message.into(),
                place: Some((above, column)),
                when_assembled,
            })
        })
    }

    /// How an error differs from what is stated; `None` if it does not.
    pub fn differs(&self, error: &SceneError) -> Option<String> {
        let same = error.headline().contains(&self.message) && error.line_column() == self.place;
        (!same).then(|| {
            format!(
                "expected “{}” at {:?}, but got at {:?}:\n{error}",
                self.message,
                self.place,
                error.line_column()
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements() {
        let place = |text| Expected::read(text).map(|expected| (expected.message, expected.place));
        assert_eq!(place("//! it is bad\n()"), Some(("it is bad".into(), None)));
        assert_eq!(
            place("(\n  a: 1,\n  // ^^ bad a\n)"),
            Some(("bad a".into(), Some((2, 6))))
        );
        assert_eq!(place("(\n  a: 1, // a note\n)"), None);
    }
}
