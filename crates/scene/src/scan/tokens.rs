//! What stands between brackets: blanks, comments, attributes and texts.

use std::ops::Range;

use super::{Malformed, Scanner, malformed};

impl Scanner<'_> {
    pub(super) fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    /// The span of the next character.
    pub(super) fn one(&self) -> Range<usize> {
        self.at..self.at + self.peek().map_or(0, char::len_utf8)
    }

    pub(super) fn take_while(&mut self, of: impl Fn(char) -> bool) -> Range<usize> {
        let start = self.at;
        self.at += self.rest().find(|c| !of(c)).unwrap_or(self.rest().len());
        start..self.at
    }

    /// Skips white space and comments.
    pub(super) fn blank(&mut self) -> Result<(), Malformed> {
        loop {
            self.take_while(char::is_whitespace);
            if self.rest().starts_with("//") {
                self.take_while(|c| c != '\n');
            } else if self.rest().starts_with("/*") {
                self.block_comment()?;
            } else {
                return Ok(());
            }
        }
    }

    pub(super) fn block_comment(&mut self) -> Result<(), Malformed> {
        let start = self.at;
        let mut depth = 0_usize;
        loop {
            if self.rest().starts_with("/*") {
                depth += 1;
                self.at += 2;
            } else if self.rest().starts_with("*/") {
                depth -= 1;
                self.at += 2;
                if depth == 0 {
                    return Ok(());
                }
            } else if let Some(c) = self.peek() {
                self.at += c.len_utf8();
            } else {
                return Err(malformed(
                    start..start + 2,
                    "this comment is never closed",
                    "close it with */",
                ));
            }
        }
    }

    /// Skips the `#![enable(…)]` lines that RON allows before the value.
    pub(super) fn attributes(&mut self) -> Result<(), Malformed> {
        self.blank()?;
        while self.rest().starts_with("#!") {
            let end = self.rest().find(']').map(|end| self.at + end + 1);
            let Some(end) = end else {
                return Err(malformed(
                    self.at..self.at + 2,
                    "this attribute is never closed",
                    "close it with ]",
                ));
            };
            self.at = end;
            self.blank()?;
        }
        Ok(())
    }

    pub(super) fn string(&mut self) -> Result<usize, Malformed> {
        let start = self.at;
        let mut escaped = false;
        for (at, c) in self.rest().char_indices().skip(1) {
            match c {
                '"' if !escaped => {
                    self.at = start + at + 1;
                    return Ok(self.at);
                }
                '\n' => break,
                '\\' => escaped = !escaped,
                _ => escaped = false,
            }
        }
        let line = self.rest().find(['\n', '\r']).unwrap_or(self.rest().len());
        Err(malformed(
            start..start + line,
            "this text is not closed on its line",
            "close it with \"",
        ))
    }

    pub(super) fn raw_string(&mut self, hashes: usize) -> Result<usize, Malformed> {
        let start = self.at;
        let end = format!("\"{}", "#".repeat(hashes));
        let from = start + 2 + hashes;
        let Some(found) = self.text[from..].find(&end) else {
            return Err(malformed(
                start..from,
                "this text is never closed",
                format!("close it with {end}"),
            ));
        };
        self.at = from + found + end.len();
        Ok(self.at)
    }
}
