//! Where each value of a scene's text stands: a small scanner of RON that keeps spans and no values.
//!
//! serde and `ron` read the values, but forget where they were; this remembers, so that a later check can point at
//! a field and an override can replace it. It also finds the bracket that was never closed, which a parser cannot.

mod tokens;

use std::ops::Range;

use crate::error::{Place, SceneError};
use crate::pieces::Pieces;

/// A value of the text.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// From the first byte of the value (the name of an enum variant included) to the last.
    pub span: Range<usize>,
    /// Where the content begins, after the opening bracket.
    pub inside: Option<usize>,
    /// What stands in the brackets.
    pub items: Vec<Item>,
}

/// One item in brackets.
#[derive(Clone, Debug)]
pub(crate) struct Item {
    /// The field's name, if it has one.
    pub key: Option<Range<usize>>,
    /// The value.
    pub value: Node,
}

/// Why a text is not a scene in form.
#[derive(Clone, Debug)]
pub(crate) struct Malformed {
    pub span: Range<usize>,
    pub what: String,
    pub remedy: String,
    /// Whether no place in the text is to blame.
    pub whole: bool,
}

impl Malformed {
    /// The error at its place.
    pub fn error(self, pieces: &Pieces) -> SceneError {
        let place = if self.whole {
            Place::Whole(pieces.name().into())
        } else {
            pieces.place(self.span)
        };
        SceneError::new(self.what, self.remedy, place)
    }
}

/// Brackets inside brackets; a scene needs seven.
const DEEPEST: usize = 40;

/// Scans a whole scene. `top` are the names of its fields that belong to no inner bracket.
pub(crate) fn document(text: &str, top: &[&str]) -> Result<Node, Malformed> {
    let mut scanner = Scanner {
        text,
        at: 0,
        open: Vec::new(),
        suspect: None,
        top,
    };
    scanner.attributes()?;
    if scanner.at == text.len() {
        let remedy = "`tsubu init` copies a shipped scene to begin with";
        return Err(Malformed {
            whole: true,
            ..malformed(0..0, "the scene is empty", remedy)
        });
    }
    if scanner.peek() != Some('(') && !scanner.rest().starts_with("Scene") {
        return Err(malformed(
            scanner.one(),
            "a scene begins with a bracket",
            "put ( ) around the whole scene",
        ));
    }
    let node = scanner.value()?;
    scanner.blank()?;
    if scanner.at == text.len() {
        return Ok(node);
    }
    let what = "the whole scene ends here, but more follows";
    Err(malformed(
        node.span.end - 1..node.span.end,
        what,
        "is this bracket one too many, or one above?",
    ))
}

/// Whether the text is exactly one RON value in form.
pub(crate) fn is_value(text: &str) -> bool {
    let mut scanner = Scanner {
        text,
        at: 0,
        open: Vec::new(),
        suspect: None,
        top: &[],
    };
    scanner.blank().is_ok() && scanner.value().is_ok() && text[scanner.at..].trim().is_empty()
}

fn malformed(span: Range<usize>, what: impl Into<String>, remedy: impl Into<String>) -> Malformed {
    Malformed {
        span,
        what: what.into(),
        remedy: remedy.into(),
        whole: false,
    }
}

struct Scanner<'a> {
    text: &'a str,
    at: usize,
    /// Where the brackets opened that are not closed yet.
    open: Vec<usize>,
    /// The bracket in which a field of the top level stands, and the field: likely not closed before it.
    suspect: Option<(usize, Range<usize>)>,
    top: &'a [&'a str],
}

impl Scanner<'_> {
    fn value(&mut self) -> Result<Node, Malformed> {
        let start = self.at;
        let leaf = |end: usize| Node {
            span: start..end,
            inside: None,
            items: Vec::new(),
        };
        match self.peek() {
            Some('"') => self.string().map(leaf),
            Some('\'') => Err(malformed(
                self.one(),
                "a text stands in double quotes",
                "write \"…\" for '…'",
            )),
            Some('(' | '[' | '{') => self.brackets(start),
            Some(c) if c.is_ascii_digit() || matches!(c, '+' | '-' | '.') => {
                let number =
                    self.take_while(|c| c.is_alphanumeric() || matches!(c, '+' | '-' | '.' | '_'));
                Ok(leaf(number.end))
            }
            Some(c) if c.is_alphabetic() || c == '_' => {
                let after = self.rest().strip_prefix('r').unwrap_or_default();
                let hashes = after.len() - after.trim_start_matches('#').len();
                if after[hashes..].starts_with('"') {
                    return self.raw_string(hashes).map(leaf);
                }
                let name = self.take_while(is_name);
                self.blank()?;
                if self.peek() == Some('(') {
                    return self.brackets(start);
                }
                self.at = name.end;
                Ok(leaf(name.end))
            }
            Some(',' | ')' | ']' | '}' | ':') => Err(malformed(
                self.one(),
                "a value is missing here",
                "write the value, or remove the field",
            )),
            Some(c) => Err(malformed(
                self.one(),
                format!("“{c}” is no value"),
                "texts and quantities stand in quotes",
            )),
            None => Err(self.unclosed()),
        }
    }

    /// Items up to the closing bracket; `start` is where the variant's name before the bracket began.
    fn brackets(&mut self, start: usize) -> Result<Node, Malformed> {
        if self.open.len() == DEEPEST {
            return Err(malformed(
                self.one(),
                "too many brackets inside brackets",
                "a scene needs no more than seven",
            ));
        }
        let opening = self.at;
        let closing = match self.peek() {
            Some('[') => ']',
            Some('{') => '}',
            _ => ')',
        };
        self.open.push(opening);
        self.at += 1;
        let inside = self.at;
        let mut items = Vec::new();
        loop {
            self.blank()?;
            match self.peek() {
                Some(c) if c == closing => break,
                Some(c @ (')' | ']' | '}')) => return Err(self.mismatch(c, closing)),
                _ => items.push(self.item(closing)?),
            }
            let end = self.at;
            self.blank()?;
            match self.peek() {
                Some(',') => self.at += 1,
                Some(')' | ']' | '}') => {}
                None => return Err(self.unclosed()),
                Some(_) => return Err(self.no_comma(end)),
            }
        }
        self.at += 1;
        self.open.pop();
        Ok(Node {
            span: start..self.at,
            inside: Some(inside),
            items,
        })
    }

    fn item(&mut self, closing: char) -> Result<Item, Malformed> {
        let start = self.at;
        let name = self.take_while(is_name);
        self.blank()?;
        if name.is_empty() || self.peek() != Some(':') {
            self.at = start;
            let value = self.value()?;
            self.blank()?;
            if closing == '}' && self.peek() == Some(':') {
                self.at += 1;
                self.blank()?;
                self.value()?;
            }
            return Ok(Item { key: None, value });
        }
        if self.suspect.is_none()
            && self.open.len() > 1
            && self.top.contains(&&self.text[name.clone()])
        {
            self.suspect = self.open.last().map(|opening| (*opening, name.clone()));
        }
        if closing == ']' {
            return Err(match self.suspect {
                Some(_) => self.unclosed(),
                None => malformed(
                    name,
                    "a list has no named fields",
                    "put ( ) around the fields of each item",
                ),
            });
        }
        self.at += 1;
        self.blank()?;
        let value = self.value()?;
        Ok(Item {
            key: Some(name),
            value,
        })
    }

    /// A bracket is missing: point at the one that a field of the top level gives away, else at the innermost.
    fn unclosed(&self) -> Malformed {
        if let Some((opening, field)) = &self.suspect {
            let field = &self.text[field.clone()];
            let what =
                format!("this bracket is not closed before “{field}”, a field of the whole scene");
            return malformed(
                *opening..opening + 1,
                what,
                "close it at the end of its block",
            );
        }
        let opening = self.open.last().copied().unwrap_or(self.at);
        malformed(
            opening..opening + 1,
            "this bracket is never closed",
            "close it at the end of its block",
        )
    }

    fn mismatch(&self, found: char, closing: char) -> Malformed {
        let opening = self.open.last().copied().unwrap_or(0);
        let line = self.text[..opening].matches('\n').count() + 1;
        let what =
            format!("“{found}” stands where “{closing}” should close the bracket of line {line}");
        malformed(
            self.one(),
            what,
            format!("close the bracket of line {line} before"),
        )
    }

    fn no_comma(&self, end: usize) -> Malformed {
        if self.peek() == Some('=') {
            return malformed(
                self.one(),
                "a field's name and its value are parted by a colon",
                "write name: value",
            );
        }
        let before = self.text[..end].chars().next_back();
        let same_line = !self.text[end..self.at].contains('\n');
        if before.is_some_and(|c| c.is_ascii_digit())
            && same_line
            && self.peek().is_some_and(char::is_alphabetic)
        {
            let what = "a quantity with its unit stands in quotes";
            return malformed(self.one(), what, "write it as \"1.35 mm\"");
        }
        malformed(
            end..end,
            "a comma is missing here",
            "separate fields and items by commas",
        )
    }
}

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn complaint(text: &str) -> (usize, String) {
        let bad = document(text, &["time", "walls"]).expect_err(text);
        (bad.span.start, bad.what)
    }

    #[test]
    fn spans_of_values() {
        let text = "/* a /* b */ ( */ #![enable(implicit_some)] (a: \"x)\\\"\", // )\n b: Big(c: [1, r#\"]\"#], d: Small), )";
        let node = document(text, &[]).expect("in form");
        let part = |node: &Node| text[node.span.clone()].to_owned();
        assert_eq!(part(&node.items[0].value), "\"x)\\\"\"");
        assert_eq!(
            part(&node.items[1].value),
            "Big(c: [1, r#\"]\"#], d: Small)"
        );
        assert_eq!(
            part(&node.items[1].value.items[0].value.items[1].value),
            "r#\"]\"#"
        );
        assert_eq!(part(&node.items[1].value.items[1].value), "Small");
    }

    #[test]
    fn the_bracket_to_blame() {
        assert_eq!(complaint("(a: (b: 1, walls: [], time: 2)").0, 4);
        assert_eq!(complaint("(walls: [(a: 1), time: (b: 2))").0, 8);
        assert_eq!(complaint("(a: (b: 1").0, 4);
        assert_eq!(complaint("(a: [1)").0, 6);
        assert_eq!(complaint("(a: 1))").0, 5);
        assert_eq!(complaint("(a: 1 b: 2)").0, 6);
        assert_eq!(complaint("(a: 1\n b: 2)").0, 5);
        assert_eq!(complaint("(a: \"x)").0, 4);
        assert_eq!(complaint("(a: /* x)").0, 4);
        assert!(complaint(&"(".repeat(100_000)).1.contains("too many"));
        assert!(complaint(" // nothing").1.contains("empty"));
    }

    proptest! {
        #[test]
        fn any_text_is_scanned(text in "([(){}\\[\\],:\"'/*#r!a1. \n]|.){0,60}") {
            let _ = document(&text, &["a"]);
            let _ = is_value(&text);
        }
    }
}
