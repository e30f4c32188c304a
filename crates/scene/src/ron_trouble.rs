//! Reading the raw scene, and turning `ron`'s troubles into sentences at the right place.

use std::ops::Range;

use ron::error::{Position, SpannedError};
use ron::extensions::Extensions;

use crate::error::nearest;
use crate::raw::{CHOICES, RawScene, TOP};
use crate::scan::{Item, Malformed, Node, document};

/// Reads a scene's text: where its values stand, and the raw scene.
pub(crate) fn read(text: &str) -> Result<(Node, RawScene), Malformed> {
    let tree = document(text, TOP)?;
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    match options.from_str(text) {
        Ok(raw) => Ok((tree, raw)),
        Err(error) => Err(translate(text, &tree, error)),
    }
}

fn translate(text: &str, tree: &Node, error: SpannedError) -> Malformed {
    let start = byte_of(text, error.span.start);
    let end = byte_of(text, error.span.end).max(start);
    let (mut what, mut remedy) = sentences(&error.code);
    let span = match &error.code {
        ron::Error::MissingStructField { .. } => block_ending_at(tree, end),
        ron::Error::NoSuchStructField { found, .. } => last_name(text, start..end, found),
        ron::Error::NoSuchEnumVariant { found, .. } => last_name(text, start..end, found),
        ron::Error::DuplicateStructField { field, .. } => last_name(text, start..end, field),
        ron::Error::ExpectedStructLike => {
            let span = name_before(text, start);
            if !span.is_empty() {
                let name = &text[span.clone()];
                what = format!("the choice “{name}” needs its brackets");
                remedy = format!(
                    "write {name}(…) with its values; those with a default may be left out"
                );
            }
            span
        }
        // The scanner has seen to the commas between items: what follows is a bracket.
        ron::Error::ExpectedComma => {
            let span = value_at(tree, text, start..end);
            (what, remedy) =
                if text[span.start..].starts_with(|c: char| c.is_alphabetic() || c == '(') {
                    (
                        "this choice takes no brackets".into(),
                        "write its name alone".into(),
                    )
                } else {
                    (
                        format!("“{}” is no number", &text[span.clone()]),
                        "write a number such as 2 or 0.5".into(),
                    )
                };
            span
        }
        ron::Error::ExpectedIdentifier
        | ron::Error::SuggestRawIdentifier(_)
        | ron::Error::InvalidIdentifier(_) => {
            let span = value_at(tree, text, start..end);
            (what, remedy) = no_choice(tree, text, start);
            span
        }
        // After a word `ron` has already read on to what follows it.
        ron::Error::InvalidValueForType { .. } if !name_before(text, start).is_empty() => {
            name_before(text, start)
        }
        _ => value_at(tree, text, start..end),
    };
    if let ron::Error::InvalidValueForType { expected, .. } = &error.code
        && span.len() < 40
    {
        what = format!(
            "{expected} is expected here, but this is “{}”",
            &text[span.clone()]
        );
    }
    Malformed {
        span,
        what,
        remedy,
        whole: false,
    }
}

/// What is wrong, and what to do.
fn sentences(code: &ron::Error) -> (String, String) {
    let of = |outer: &Option<String>| match outer.as_deref() {
        None | Some("Scene") => String::new(),
        Some(outer) => format!(" in {outer}"),
    };
    let one_of = |found: &str, expected: &[&str], kind: &str| {
        let hint = nearest(found, expected.iter().copied())
            .map_or(String::new(), |near| format!("did you mean “{near}”? "));
        format!("{hint}{kind}: {}", expected.join(", "))
    };
    match code {
        ron::Error::Message(message) => match message.split_once('\n') {
            Some((what, remedy)) => (what.into(), remedy.into()),
            None => (message.clone(), String::new()),
        },
        ron::Error::NoSuchStructField {
            expected,
            found,
            outer,
        } => (
            format!("unknown field “{found}”{}", of(outer)),
            one_of(found, expected, "the fields here are"),
        ),
        ron::Error::NoSuchEnumVariant {
            expected,
            found,
            outer,
        } => (
            format!("unknown choice “{found}”{}", of(outer)),
            one_of(found, expected, "the choices are"),
        ),
        ron::Error::MissingStructField { field, outer } => (
            format!("the field “{field}” is missing{}", of(outer)),
            format!("add {field}: …"),
        ),
        ron::Error::DuplicateStructField { field, outer } => (
            format!("the field “{field}” is given twice{}", of(outer)),
            "keep one of them".into(),
        ),
        ron::Error::InvalidValueForType { expected, found } => (
            format!("{expected} is expected here, but this is {found}"),
            format!("write {expected}"),
        ),
        ron::Error::ExpectedString => (
            "a text is expected here".into(),
            "write it in double quotes".into(),
        ),
        ron::Error::ExpectedBoolean => (
            "true or false is expected here".into(),
            "write true or false".into(),
        ),
        ron::Error::ExpectedArray => (
            "a list is expected here".into(),
            "write its items in [ ]".into(),
        ),
        ron::Error::ExpectedStructLike | ron::Error::ExpectedNamedStructLike(_) => (
            "a block in ( ) is expected here".into(),
            "write its content in ( ); an empty one is ()".into(),
        ),
        ron::Error::ExpectedMapColon => (
            "a colon is missing between a field's name and its value".into(),
            "write name: value".into(),
        ),
        ron::Error::InvalidEscape(_) => (
            "the character after \\ has no meaning in a text".into(),
            "write \\\\ for a backslash, \\\" for a quote".into(),
        ),
        ron::Error::UnexpectedChar(')') => (
            "these brackets lack their value".into(),
            "write the value between them".into(),
        ),
        ron::Error::ExpectedStructLikeEnd => (
            "too much stands in these ( )".into(),
            "it takes a single value".into(),
        ),
        ron::Error::ExpectedDifferentStructName { expected, found } => (
            format!("“{found}” stands where a block in ( ) is expected"),
            format!("write ( ) or {expected}( )"),
        ),
        other => (
            format!(
                "this is no scene in form: {}",
                lower_first(&other.to_string())
            ),
            String::new(),
        ),
    }
}

fn lower_first(text: &str) -> String {
    let mut signs = text.chars();
    signs.next().map_or(String::new(), |first| {
        first.to_lowercase().chain(signs).collect()
    })
}

fn byte_of(text: &str, position: Position) -> usize {
    let mut lines = text.split_inclusive('\n');
    let before: usize = lines
        .by_ref()
        .take(position.line.saturating_sub(1))
        .map(str::len)
        .sum();
    let line = lines.next().unwrap_or_default();
    let column = line.char_indices().nth(position.col.saturating_sub(1));
    before + column.map_or(line.len(), |(at, _)| at)
}

/// `ron` marks what it read last; the name it complains of is the last one of that spelling before the end.
fn last_name(text: &str, span: Range<usize>, name: &str) -> Range<usize> {
    match text[..span.end].rfind(name) {
        Some(start) => start..start + name.len(),
        None => span,
    }
}

/// Something else stands where a choice or a named field is expected.
fn no_choice(tree: &Node, text: &str, at: usize) -> (String, String) {
    let mut key = None;
    let mut node = tree;
    while let Some(item) = node.items.iter().find(|item| item.value.span.contains(&at)) {
        (key, node) = (item.key.clone(), &item.value);
    }
    match key.map(|key| &text[key]) {
        None => (
            "the values here have names".into(),
            "write each as name: value".into(),
        ),
        Some(key) => {
            let choices = CHOICES
                .iter()
                .find(|(field, _)| *field == key)
                .map_or(String::new(), |(_, all)| all.join(", "));
            (
                format!("{key} expects the name of a choice"),
                format!("write one of {choices}, without quotes"),
            )
        }
    }
}

/// The name that ends before a byte of the text.
fn name_before(text: &str, at: usize) -> Range<usize> {
    let before = text[..at].trim_end();
    before
        .trim_end_matches(|c: char| c.is_alphanumeric() || c == '_')
        .len()..before.len()
}

/// The name of the block that `ron` had just read to its end, or its opening bracket if it has none.
fn block_ending_at(tree: &Node, end: usize) -> Range<usize> {
    fn search(item: &Item, end: usize) -> Option<Range<usize>> {
        if !(item.value.span.start..=item.value.span.end).contains(&end) {
            return None;
        }
        let within = item.value.items.iter().find_map(|item| search(item, end));
        let this = || {
            let inside = item.value.inside?;
            Some(item.key.clone().unwrap_or(inside - 1..inside))
        };
        within.or_else(this)
    }
    tree.items
        .iter()
        .find_map(|item| search(item, end))
        .unwrap_or(tree.span.start..tree.span.start + 1)
}

/// The whole value that a span lies in, if it is a single one; `ron` may include the blank around it.
fn value_at(tree: &Node, text: &str, span: Range<usize>) -> Range<usize> {
    let part = &text[span.clone()];
    let start = span.start + (part.len() - part.trim_start().len());
    let mut node = tree;
    while let Some(item) = node
        .items
        .iter()
        .find(|item| item.value.span.contains(&start))
    {
        node = &item.value;
    }
    if node.items.is_empty() || text[start..].starts_with([')', ']']) {
        return node.span.clone();
    }
    start..(span.start + part.trim_end().len()).max(start)
}
