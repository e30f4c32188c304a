//! Trouble with a scene: where it is, what is wrong, what to do.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

/// One or several troubles with a scene, its overrides or its grain file; there is always at least one.
///
/// `Display` renders like rustc: the message, the place, the line with carets under the culprit, and the remedy.
#[derive(Clone, Debug)]
pub struct SceneError {
    first: Box<Trouble>,
    more: Vec<Trouble>,
    of_machine: bool,
}

/// One trouble.
#[derive(Clone, Debug)]
pub(crate) struct Trouble {
    /// What is wrong, one sentence without a full stop.
    pub what: String,
    /// What to do; empty when there is nothing to say.
    pub remedy: String,
    /// Where it is.
    pub place: Place,
}

/// Where a trouble is.
#[derive(Clone, Debug)]
pub(crate) enum Place {
    /// A whole file or argument.
    Whole(String),
    /// A part of a text.
    Part {
        /// The file, or the override as it was typed.
        name: String,
        /// The text around, whole lines.
        text: Arc<str>,
        /// The number of the text's first line.
        first_line: usize,
        /// The bytes of the culprit.
        span: Range<usize>,
    },
}

impl SceneError {
    pub(crate) fn new(what: impl Into<String>, remedy: impl Into<String>, place: Place) -> Self {
        SceneError::from(Trouble {
            what: what.into(),
            remedy: remedy.into(),
            place,
        })
    }

    /// All of several troubles; `None` if there are none.
    pub(crate) fn of(troubles: Vec<Trouble>) -> Option<Self> {
        let mut troubles = troubles.into_iter();
        let first = troubles.next()?;
        Some(SceneError {
            first: Box::new(first),
            more: troubles.collect(),
            of_machine: false,
        })
    }

    /// These troubles, and then those of another error.
    #[must_use]
    pub fn and(mut self, other: SceneError) -> Self {
        self.more.push(*other.first);
        self.more.extend(other.more);
        self
    }

    /// The same, where the scene is sound and this machine is too small for it.
    #[must_use]
    pub fn by_machine(mut self) -> Self {
        self.of_machine = true;
        self
    }

    /// True if another machine could run the scene.
    pub fn is_by_machine(&self) -> bool {
        self.of_machine
    }

    /// What is wrong in one line: the first trouble without its place and remedy.
    pub fn headline(&self) -> String {
        self.first.what.clone()
    }

    /// Line and column of the first trouble, both from 1, columns counted in characters; `None` for a whole file.
    pub fn line_column(&self) -> Option<(usize, usize)> {
        match &self.first.place {
            Place::Whole(_) => None,
            Place::Part {
                text,
                first_line,
                span,
                ..
            } => {
                let (line, column) = line_column(text, span.start);
                Some((first_line + line - 1, column))
            }
        }
    }

    /// Every trouble as rustc would show it, with colours or without.
    pub fn render(&self, color: bool) -> String {
        let renderer = if color {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        let troubles = std::iter::once(&*self.first).chain(&self.more);
        troubles
            .map(|trouble| trouble.render(&renderer))
            .collect::<Vec<_>>()
            .join("\n\n")
    }
}

impl From<Trouble> for SceneError {
    fn from(trouble: Trouble) -> Self {
        SceneError {
            first: Box::new(trouble),
            more: Vec::new(),
            of_machine: false,
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for SceneError {}

impl Trouble {
    fn render(&self, renderer: &Renderer) -> String {
        let title = Level::ERROR.primary_title(&self.what);
        let help = (!self.remedy.is_empty()).then(|| Level::HELP.message(&self.remedy));
        match &self.place {
            Place::Whole(name) => {
                let origin = annotate_snippets::Origin::path(name);
                renderer.render(&[title.element(origin).elements(help)])
            }
            Place::Part {
                name,
                text,
                first_line,
                span,
            } => {
                let mark = AnnotationKind::Primary.span(drawable(text, span));
                let snippet = Snippet::source(&**text)
                    .path(name)
                    .line_start(*first_line)
                    .annotation(mark);
                renderer.render(&[title.element(snippet).elements(help)])
            }
        }
    }
}

/// The span inside the text, on character boundaries, and on one line: carets under a whole file help no one.
fn drawable(text: &str, span: &Range<usize>) -> Range<usize> {
    let start = floor_boundary(text, span.start);
    let line_end = text[start..]
        .find(['\n', '\r'])
        .map_or(text.len(), |at| start + at);
    let end = floor_boundary(text, span.end.clamp(start, line_end));
    start..end
}

fn floor_boundary(text: &str, at: usize) -> usize {
    let at = at.min(text.len());
    (0..=at)
        .rev()
        .find(|&at| text.is_char_boundary(at))
        .unwrap_or(0)
}

/// Line and column from 1 of a byte of a text.
fn line_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..floor_boundary(text, at)];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    )
}

/// The name nearest to a misspelt one, if one is near enough to be meant.
pub(crate) fn nearest<'a>(found: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let folded = found.to_lowercase();
    let far = |name: &str| strsim::damerau_levenshtein(&folded, &name.to_lowercase());
    let limit = found.chars().count().div_ceil(3).max(1);
    known
        .map(|name| (far(name), name))
        .filter(|(far, _)| *far <= limit)
        .min_by_key(|(far, _)| *far)
        .map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn it_looks_like_rustc() {
        let text: Arc<str> = "(\n    depth: \"-1 mm\",\n)".into();
        let place = Place::Part {
            name: "a.ron".into(),
            text,
            first_line: 1,
            span: 13..20,
        };
        let error = SceneError::new("the depth is negative", "write a length above zero", place);
        assert_eq!(error.line_column(), Some((2, 12)));
        assert_eq!(
            error.to_string(),
            "error: the depth is negative\n --> a.ron:2:12\n  |\n2 |     depth: \"-1 mm\",\n  |            ^^^^^^^\n  |\n  = help: write a length above zero"
        );
        assert!(error.render(true).contains('\u{1b}'));
    }

    #[test]
    fn nearest_is_near() {
        assert_eq!(
            nearest("fricton", ["friction", "restitution"].into_iter()),
            Some("friction")
        );
        assert_eq!(
            nearest("viscosity", ["friction", "restitution"].into_iter()),
            None
        );
    }

    proptest! {
        #[test]
        fn any_text_and_span_can_be_drawn(text in "(.|\r|\n|\t|\u{200d}|é|粒){0,40}", a in 0_usize..60, b in 0_usize..60) {
            let place = Place::Part { name: "x".into(), text: text.as_str().into(), first_line: 7, span: a..b };
            let error = SceneError::new("what", "remedy", place);
            prop_assert!(!error.to_string().is_empty());
            prop_assert!(error.line_column().is_some());
        }
    }
}
