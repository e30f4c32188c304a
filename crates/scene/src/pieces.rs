//! A text made of pieces that remember where they came from: the file, or a `--set` override.

use std::ops::Range;
use std::sync::Arc;

use crate::error::Place;

/// The text of a scene with the overrides laid over it.
#[derive(Clone, Debug)]
pub(crate) struct Pieces {
    name: String,
    file: Arc<str>,
    sets: Vec<Arc<str>>,
    list: Vec<Piece>,
    text: String,
}

/// A stretch of text of one origin.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    pub text: String,
    pub origin: Origin,
}

/// Where a piece came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// The file, from this byte on.
    File(usize),
    /// The override of this number, from this byte of its text on.
    Set(usize, usize),
    /// Brackets, quotes and commas around the override of this number.
    Glue(usize),
}

impl Pieces {
    pub fn new(name: String, text: String) -> Self {
        let list = vec![Piece {
            text: text.clone(),
            origin: Origin::File(0),
        }];
        Pieces {
            name,
            file: text.as_str().into(),
            sets: Vec::new(),
            list,
            text,
        }
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    /// Announces an override; its number names it as an origin.
    pub fn add_set(&mut self, spec: &str) -> usize {
        self.sets.push(spec.into());
        self.sets.len() - 1
    }

    /// Puts new pieces in the place of a span.
    pub fn replace(&mut self, span: Range<usize>, with: Vec<Piece>) {
        let mut list = Vec::with_capacity(self.list.len() + with.len() + 2);
        let mut with = Some(with);
        let mut start = 0;
        for piece in std::mem::take(&mut self.list) {
            let end = start + piece.text.len();
            let before = span.start.clamp(start, end) - start;
            let after = span.end.clamp(start, end) - start;
            list.push(piece.part(0..before));
            if span.start <= end {
                list.extend(with.take().into_iter().flatten());
            }
            list.push(piece.part(after.max(before)..piece.text.len()));
            start = end;
        }
        list.extend(with.into_iter().flatten());
        list.retain(|piece| !piece.text.is_empty());
        self.text = list.iter().map(|piece| piece.text.as_str()).collect();
        self.list = list;
    }

    /// The override in which a byte of the text stands, if any.
    pub fn set_at(&self, at: usize) -> Option<usize> {
        match self.origin(at)?.0 {
            Origin::File(_) => None,
            Origin::Set(set, _) | Origin::Glue(set) => Some(set),
        }
    }

    /// Where a span of the text stands in the file, or in an override as it was typed.
    pub fn place(&self, span: Range<usize>) -> Place {
        let Some((origin, length)) = self.origin(span.start) else {
            return Place::Whole(self.name.clone());
        };
        let last = self
            .origin(span.end.saturating_sub(1).max(span.start))
            .map_or(origin, |(last, _)| last);
        match origin {
            Origin::File(from) => {
                let to = match last {
                    Origin::File(to) if span.is_empty() => to,
                    Origin::File(to) => to + 1,
                    _ => from + length,
                };
                Place::Part {
                    name: self.name.clone(),
                    text: self.file.clone(),
                    first_line: 1,
                    span: from..to.max(from),
                }
            }
            Origin::Set(set, from) => {
                let to = match last {
                    Origin::Set(other, to) if other == set => to + 1,
                    _ => from + length,
                };
                self.set_place(set, from..to.max(from))
            }
            Origin::Glue(set) => self.set_place(set, 0..self.sets[set].len()),
        }
    }

    /// A part of an override as it was typed.
    pub fn set_place(&self, set: usize, span: Range<usize>) -> Place {
        Place::Part {
            name: "--set".into(),
            text: self.sets[set].clone(),
            first_line: 1,
            span,
        }
    }

    /// The origin of a byte of the text, and the length of the rest of its piece; the end belongs to the last piece.
    fn origin(&self, at: usize) -> Option<(Origin, usize)> {
        let mut start = 0;
        for (i, piece) in self.list.iter().enumerate() {
            let end = start + piece.text.len();
            if at < end || (i + 1 == self.list.len() && at == end) {
                let origin = match piece.origin {
                    Origin::File(from) => Origin::File(from + at - start),
                    Origin::Set(set, from) => Origin::Set(set, from + at - start),
                    glue @ Origin::Glue(_) => glue,
                };
                return Some((origin, end - at));
            }
            start = end;
        }
        None
    }
}

impl Piece {
    fn part(&self, range: Range<usize>) -> Piece {
        let origin = match self.origin {
            Origin::File(from) => Origin::File(from + range.start),
            Origin::Set(set, from) => Origin::Set(set, from + range.start),
            glue @ Origin::Glue(_) => glue,
        };
        Piece {
            text: self.text[range].to_owned(),
            origin,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn origins_survive_edits() {
        let mut pieces = Pieces::new("a".into(), "(aa: 1, bb: 2)".into());
        let set = pieces.add_set("aa=345");
        pieces.replace(
            5..6,
            vec![Piece {
                text: "345".into(),
                origin: Origin::Set(set, 3),
            }],
        );
        assert_eq!(pieces.text(), "(aa: 345, bb: 2)");
        let span = |place| match place {
            Place::Part { name, span, .. } => (name, span),
            Place::Whole(name) => (name, 0..0),
        };
        assert_eq!(span(pieces.place(6..8)), ("--set".into(), 4..6));
        assert_eq!(span(pieces.place(14..15)), ("a".into(), 12..13));
        assert_eq!(span(pieces.place(0..16)), ("a".into(), 0..14));
        pieces.replace(1..8, Vec::new());
        assert_eq!(pieces.text(), "(, bb: 2)");
        assert_eq!(span(pieces.place(7..8)), ("a".into(), 12..13));
    }
}
