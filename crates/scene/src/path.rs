//! Paths to a value of a scene, such as `grains.coarse`, `walls[0].friction` or `walls.floor.friction`.

use std::ops::Range;

use crate::scan::{Item, Node};

/// The parts of a path with their places in it; `None` if a part is empty.
pub(crate) fn segments(path: &str) -> Option<Vec<Range<usize>>> {
    let mut parts = Vec::new();
    let mut start = 0;
    for (at, sign) in path.char_indices().chain([(path.len(), '.')]) {
        if !matches!(sign, '.' | '[' | ']') {
            continue;
        }
        let part = start..at;
        start = at + 1;
        // `]` is followed by `.`, `[` or the end: the empty part between belongs to the index before.
        let after_index = part.start > 0 && path.as_bytes()[part.start - 1] == b']';
        match (part.is_empty(), after_index) {
            (false, false) => parts.push(part),
            (true, true) => {}
            _ => return None,
        }
    }
    Some(parts)
}

/// How far a path leads into the text.
pub(crate) struct Reached<'a> {
    /// The last value that exists.
    pub node: &'a Node,
    /// The item that it is, unless it is the whole scene.
    pub item: Option<&'a Item>,
    /// How many parts of the path lead to it.
    pub parts: usize,
}

/// Follows a path as far as it leads.
pub(crate) fn follow<'a, 'p>(
    root: &'a Node,
    text: &str,
    path: impl Iterator<Item = &'p str>,
) -> Reached<'a> {
    let mut reached = Reached {
        node: root,
        item: None,
        parts: 0,
    };
    for part in path {
        let Some(item) = child(reached.node, text, part) else {
            break;
        };
        reached = Reached {
            node: &item.value,
            item: Some(item),
            parts: reached.parts + 1,
        };
    }
    reached
}

/// The field, the item of this number, or the item whose `name` this is.
fn child<'a>(node: &'a Node, text: &str, part: &str) -> Option<&'a Item> {
    let key_is = |item: &&Item, key: &str| item.key.clone().is_some_and(|span| &text[span] == key);
    let named = || node.items.iter().find(|item| key_is(item, part));
    let numbered = || {
        node.items
            .get(part.parse::<usize>().ok()?)
            .filter(|item| item.key.is_none())
    };
    let called = || {
        node.items.iter().find(|item| {
            let name = item.value.items.iter().find(|field| key_is(field, "name"));
            item.key.is_none()
                && name.is_some_and(|name| text[name.value.span.clone()].trim_matches('"') == part)
        })
    };
    named().or_else(numbered).or_else(called)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_path() {
        let parts = |path: &str| {
            segments(path).map(|parts| {
                parts
                    .into_iter()
                    .map(|part| path[part].to_owned())
                    .collect::<Vec<_>>()
            })
        };
        assert_eq!(
            parts("walls[10].friction"),
            Some(vec!["walls".into(), "10".into(), "friction".into()])
        );
        assert_eq!(
            parts("a[1][2]"),
            Some(vec!["a".into(), "1".into(), "2".into()])
        );
        assert_eq!(
            parts("walls.left wall.friction").map(|parts| parts.len()),
            Some(3)
        );
        for bad in ["", ".", "a.", "a..b", "a[]", ".a", "a[1]b"] {
            assert_eq!(parts(bad), None, "{bad}");
        }
    }
}
