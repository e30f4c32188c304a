//! Benches live in `benches/`, scenes for side-by-side runs in `scenes/`.
