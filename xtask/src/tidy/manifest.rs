//! The dependency lines of a `Cargo.toml`, as far as the house writes them: one line each.

use super::tree::File;

/// A dependency.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dependency {
    /// Name of the package.
    pub name: String,
    /// Its section: `dependencies`, `dev-dependencies`, …
    pub section: String,
    /// File and line.
    pub place: String,
    /// True if a comment follows on the line.
    pub has_reason: bool,
    /// True if it points into this workspace by path.
    pub is_path: bool,
}

/// Every dependency of the manifest, in order.
pub fn dependencies(manifest: &File) -> Vec<Dependency> {
    let mut found = Vec::new();
    let mut section = String::new();
    for (place, line) in manifest.lines() {
        let line = line.trim();
        if let Some(header) = line.strip_prefix('[') {
            section = header.trim_end_matches(']').to_string();
            // `[dependencies.name]` over several lines has no place for a reason: shown as one without.
            if let Some((before, name)) = section.clone().rsplit_once("dependencies.") {
                section = format!("{before}dependencies");
                found.push(Dependency {
                    name: name.into(),
                    section: section.clone(),
                    place,
                    has_reason: false,
                    is_path: false,
                });
                section.push_str(" of one");
            }
            continue;
        }
        if !section.ends_with("dependencies") || line.is_empty() || line.starts_with('#') {
            continue;
        }
        let Some((key, value)) = line.split_once('=') else {
            continue;
        };
        let name = key
            .trim()
            .trim_end_matches(".workspace")
            .trim_matches('"')
            .to_string();
        let is_path = value.contains("path =");
        found.push(Dependency {
            name,
            section: section.clone(),
            place,
            has_reason: has_comment(value),
            is_path,
        });
    }
    found
}

/// True if a `#` stands outside quotes with words behind it.
fn has_comment(value: &str) -> bool {
    let mut quoted = false;
    for (at, c) in value.char_indices() {
        match c {
            '"' => quoted = !quoted,
            '#' if !quoted => return value[at + 1..].trim().len() > 3,
            _ => {}
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_sections_and_reasons_are_read() {
        let text = "[package]\nname = \"x\"\n[dependencies]\na.workspace = true # for this\nb = { version = \"1#2\" }\n[dev-dependencies]\nc = { path = \"../c\" } # tests\n[dependencies.d]\nversion = \"1\"\n";
        let found = dependencies(&File {
            path: "Cargo.toml".into(),
            text: text.into(),
        });
        let short: Vec<_> = found
            .iter()
            .map(|d| (d.name.as_str(), d.section.as_str(), d.has_reason, d.is_path))
            .collect();
        assert_eq!(
            short,
            [
                ("a", "dependencies", true, false),
                ("b", "dependencies", false, false),
                ("c", "dev-dependencies", true, true),
                ("d", "dependencies", false, false)
            ]
        );
        assert_eq!(found[0].place, "Cargo.toml:4");
    }
}
