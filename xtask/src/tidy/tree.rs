//! The sources as one value: paths relative to the root, and the text of those that are text.

use std::path::Path;

/// Folders that hold no sources.
const SKIPPED: [&str; 3] = ["target", ".git", "out"];
/// Endings whose text is read; other files are known by name.
const TEXT: [&str; 10] = [
    "rs", "toml", "md", "ron", "bib", "yml", "yaml", "sh", "lock", "py",
];
/// Files without an ending whose text is read.
const TEXT_NAMES: [&str; 2] = ["run", ".gitignore"];

/// A file.
#[derive(Clone, Debug)]
pub struct File {
    /// From the root, with forward slashes.
    pub path: String,
    /// Its text, empty if it is not text.
    pub text: String,
}

impl File {
    /// True for a Rust file.
    pub fn is_rust(&self) -> bool {
        self.path.ends_with(".rs")
    }

    /// Every line with its place.
    pub fn lines(&self) -> impl Iterator<Item = (String, &str)> {
        self.text
            .lines()
            .enumerate()
            .map(|(number, line)| (format!("{}:{}", self.path, number + 1), line))
    }

    /// Name of the folder under `crates/`, if it lies there.
    pub fn in_crate(&self) -> Option<&str> {
        self.path
            .strip_prefix("crates/")
            .and_then(|rest| rest.split('/').next())
    }
}

/// All files, sorted by path.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// The files.
    pub files: Vec<File>,
}

impl Tree {
    /// Reads the tree at `root`.
    pub fn read(root: &Path) -> Result<Self, String> {
        let mut tree = Self::default();
        tree.add(root, "")?;
        tree.files.sort_by(|a, b| a.path.cmp(&b.path));
        Ok(tree)
    }

    fn add(&mut self, folder: &Path, prefix: &str) -> Result<(), String> {
        let cannot = |e: std::io::Error| format!("cannot read {}: {e}", folder.display());
        for entry in std::fs::read_dir(folder).map_err(cannot)? {
            let entry = entry.map_err(cannot)?;
            let name = entry.file_name().to_string_lossy().into_owned();
            let path = if prefix.is_empty() {
                name.clone()
            } else {
                format!("{prefix}/{name}")
            };
            if entry.file_type().map_err(cannot)?.is_dir() {
                if !SKIPPED.contains(&name.as_str()) {
                    self.add(&entry.path(), &path)?;
                }
                continue;
            }
            let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
            let is_text = TEXT.contains(&ending) || TEXT_NAMES.contains(&name.as_str());
            // Bad scenes may hold bytes that are no text: they are read as far as they go.
            let bytes = if is_text {
                std::fs::read(entry.path()).map_err(|e| format!("cannot read {path}: {e}"))?
            } else {
                Vec::new()
            };
            let text = String::from_utf8_lossy(&bytes).into_owned();
            self.files.push(File { path, text });
        }
        Ok(())
    }

    /// A tree of these files, for the tests of the checks.
    #[cfg(test)]
    pub fn of(files: &[(&str, &str)]) -> Self {
        let file = |(path, text): &(&str, &str)| File {
            path: path.to_string(),
            text: text.to_string(),
        };
        Self {
            files: files.iter().map(file).collect(),
        }
    }

    /// The file at this path.
    pub fn file(&self, path: &str) -> Option<&File> {
        self.files.iter().find(|f| f.path == path)
    }

    /// True if there is a file or a folder of this name.
    pub fn has(&self, path: &str) -> bool {
        let path = path.trim_end_matches('/');
        self.files.iter().any(|f| {
            f.path == path
                || f.path
                    .strip_prefix(path)
                    .is_some_and(|rest| rest.starts_with('/'))
        })
    }

    /// Names of the folders under `crates/` that have a manifest.
    pub fn crates(&self) -> Vec<&str> {
        let manifests = self
            .files
            .iter()
            .filter(|f| f.path.ends_with("/Cargo.toml"));
        manifests.filter_map(File::in_crate).collect()
    }
}
