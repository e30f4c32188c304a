//! Overrides: `path=value` laid over the text of a scene, at the level of the text.

use std::ops::Range;
use std::path::Path;

use crate::error::{Place, SceneError};
use crate::path::{follow, segments};
use crate::pieces::{Origin, Piece, Pieces};
use crate::raw::{ONE_OF, TOP};
use crate::scan::{Node, document, is_value};
use crate::source::Source;

/// An override taken apart.
struct Override<'a> {
    spec: &'a str,
    /// The parts of the path, as spans of the override.
    parts: Vec<Range<usize>>,
    /// Where the value begins.
    value: usize,
}

pub(crate) fn set(source: &mut Source, spec: &str) -> Result<(), SceneError> {
    let mut pieces = source.pieces.clone();
    let number = pieces.add_set(spec);
    let bad = |pieces: &Pieces, span: Range<usize>, what: &str, remedy: &str| {
        Err(SceneError::new(
            what,
            remedy,
            pieces.set_place(number, span),
        ))
    };
    let Some((path, value)) = spec.split_once('=') else {
        return bad(
            &pieces,
            0..spec.len(),
            "an override without “=”",
            "write path=value, as in grains.coarse=3",
        );
    };
    let blank = path.len() - path.trim_start().len();
    let Some(parts) = segments(path.trim()) else {
        let remedy =
            "name fields from the top, parted by dots, as in grains.coarse or walls.floor.friction";
        return bad(
            &pieces,
            0..path.len(),
            "this path has an empty part",
            remedy,
        );
    };
    if value.trim().is_empty() {
        return bad(
            &pieces,
            spec.len()..spec.len(),
            "this override has no value",
            "write the value after the “=”",
        );
    }
    let parts = parts
        .into_iter()
        .map(|part| part.start + blank..part.end + blank)
        .collect();
    let value = spec.len() - value.trim_start().len();
    let change = Override { spec, parts, value };

    remove_excluded(&mut pieces, &change)?;
    let spliced = |value: Vec<Piece>| {
        let mut pieces = pieces.clone();
        change.splice(&mut pieces, number, value).map(|()| pieces)
    };
    let quoted = || spliced(change.quoted(number));
    let raw = if is_value(change.value()) && !change.is_file() {
        spliced(change.raw(number))?
    } else {
        quoted()?
    };
    // A text may go without its quotes even where it looks like another value: try what reads.
    source.pieces = if complains(&raw, number) {
        let quoted = quoted()?;
        if complains(&quoted, number) {
            raw
        } else {
            quoted
        }
    } else {
        raw
    };
    Ok(())
}

/// Whether reading the scene fails at this override.
fn complains(pieces: &Pieces, number: usize) -> bool {
    match crate::ron_trouble::read(pieces.text()) {
        Ok(_) => false,
        Err(bad) => pieces.set_at(bad.span.start) == Some(number),
    }
}

/// The text's tree; an error if its brackets do not match.
fn scan(pieces: &Pieces) -> Result<Node, SceneError> {
    document(pieces.text(), TOP).map_err(|bad| bad.error(pieces))
}

/// Removes the fields that exclude the one that is set.
fn remove_excluded(pieces: &mut Pieces, change: &Override<'_>) -> Result<(), SceneError> {
    let names: Vec<_> = change
        .parts
        .iter()
        .map(|part| &change.spec[part.clone()])
        .collect();
    let group = ONE_OF.iter().find(|(block, fields)| matches!(names[..], [first, second] if first == *block && fields.contains(&second)));
    let Some((block, fields)) = group else {
        return Ok(());
    };
    for other in fields.iter().filter(|field| names.last() != Some(*field)) {
        let tree = scan(pieces)?;
        let reached = follow(&tree, pieces.text(), [*block, other].into_iter());
        let Some(item) = reached.item.filter(|_| reached.parts == 2) else {
            continue;
        };
        let start = item
            .key
            .clone()
            .map_or(item.value.span.start, |key| key.start);
        let rest = &pieces.text()[item.value.span.end..];
        let comma = rest.trim_start().starts_with(',');
        let end = item.value.span.end
            + if comma {
                rest.len() - rest.trim_start().len() + 1
            } else {
                0
            };
        pieces.replace(start..end, Vec::new());
    }
    Ok(())
}

impl Override<'_> {
    fn value(&self) -> &str {
        self.spec[self.value..].trim_end()
    }

    fn raw(&self, number: usize) -> Vec<Piece> {
        vec![Piece {
            text: self.value().into(),
            origin: Origin::Set(number, self.value),
        }]
    }

    /// Whether this names a file: of grains, or of a mesh.
    fn is_file(&self) -> bool {
        self.parts
            .last()
            .is_some_and(|part| &self.spec[part.clone()] == "file")
    }

    fn quoted(&self, number: usize) -> Vec<Piece> {
        let typed = self.value();
        // The quotes stand for the first and the last byte of what was typed.
        let quote = |at: usize| Piece {
            text: "\"".into(),
            origin: Origin::Set(number, at),
        };
        let unquoted = typed
            .strip_prefix('"')
            .and_then(|typed| typed.strip_suffix('"'))
            .unwrap_or(typed);
        let value = if self.is_file() {
            from_here(unquoted)
        } else {
            typed.into()
        };
        let escaped = crate::resolved::text(&value);
        let inner = escaped[1..escaped.len() - 1].to_owned();
        let origin = if inner == typed {
            Origin::Set(number, self.value)
        } else {
            Origin::Glue(number)
        };
        vec![
            quote(self.value),
            Piece {
                text: inner,
                origin,
            },
            quote(self.value + typed.len() - 1),
        ]
    }

    /// Puts the value where the path leads: in the place of a value, or as a new field.
    fn splice(
        &self,
        pieces: &mut Pieces,
        number: usize,
        value: Vec<Piece>,
    ) -> Result<(), SceneError> {
        let tree = scan(pieces)?;
        let text = pieces.text();
        let reached = follow(
            &tree,
            text,
            self.parts.iter().map(|part| &self.spec[part.clone()]),
        );
        let missing = &self.parts[reached.parts..];
        let node = reached.node;
        let Some(first) = missing.first() else {
            let span = node.span.clone();
            pieces.replace(span, value);
            return Ok(());
        };
        let glue = |text: &str| Piece {
            text: text.into(),
            origin: Origin::Glue(number),
        };
        let opening = node.inside.map(|inside| &text[inside - 1..inside]);
        let is_name = text[node.span.clone()].starts_with(|c: char| c.is_alphabetic());
        let is_index = self.spec[first.clone()].parse::<usize>().is_ok();
        let positional = node.items.iter().any(|item| item.key.is_none());
        if opening == Some("[") || is_index || positional || (opening.is_none() && !is_name) {
            return Err(self.astray(pieces, number, node, first.clone()));
        }
        // `a.b=1` becomes `a: (b: 1), ` after the opening bracket.
        let mut new = Vec::new();
        for (i, part) in missing.iter().enumerate() {
            if i > 0 || opening.is_none() {
                new.push(glue("("));
            }
            new.push(Piece {
                text: self.spec[part.clone()].into(),
                origin: Origin::Set(number, part.start),
            });
            new.push(glue(": "));
        }
        new.extend(value);
        let closings = missing.len() - usize::from(opening.is_some());
        new.push(glue(&")".repeat(closings)));
        if opening.is_some() {
            new.push(glue(", "));
        }
        let at = node.inside.unwrap_or(node.span.end);
        pieces.replace(at..at, new);
        Ok(())
    }

    /// The path leads into a list that lacks the item, or into a value that has no parts.
    fn astray(
        &self,
        pieces: &Pieces,
        number: usize,
        node: &Node,
        part: Range<usize>,
    ) -> SceneError {
        let text = pieces.text();
        let name = &self.spec[part.clone()];
        let place: Place = pieces.set_place(number, part);
        if node.inside.is_none() {
            let what = format!("“{}” has no part “{name}”", &text[node.span.clone()]);
            return SceneError::new(what, "end the path before it", place);
        }
        let names: Vec<_> = node
            .items
            .iter()
            .flat_map(|item| &item.value.items)
            .filter(|field| field.key.clone().is_some_and(|key| &text[key] == "name"))
            .map(|field| text[field.value.span.clone()].trim_matches('"'))
            .collect();
        let what = format!("this list has no item “{name}”");
        let remedy = match (node.items.len(), names.is_empty()) {
            (0, _) => "the list is empty".into(),
            (1, true) => "it has the item 0".into(),
            (count, true) => format!("it has the items 0 to {}", count - 1),
            (_, false) => format!("its items are {}", names.join(", ")),
        };
        SceneError::new(what, remedy, place)
    }
}

/// A path as typed in a shell: from the current folder if the file is there, else from the scene's.
fn from_here(typed: &str) -> String {
    let here = std::path::absolute(typed)
        .ok()
        .filter(|path| Path::new(typed).is_relative() && path.exists());
    here.and_then(|path| path.to_str().map(str::to_owned))
        .unwrap_or_else(|| typed.to_owned())
}
