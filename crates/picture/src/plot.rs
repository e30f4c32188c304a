//! Plots of values beside theory: axes with units, points with error bars, bands, and the command that made the figure.
//!
//! Nothing here can panic on numbers: what is not finite, or not positive on a logarithmic axis, is left out, and the figure says how many values that were.

use std::path::{Path, PathBuf};

use crate::PictureError;

mod axis;
mod draw;
mod frame;
mod legend;
mod marks;

/// A plot in the making; every method returns it, so calls follow each other.
///
/// Slices of different length are read up to the shortest.
/// Series of the same label share a colour and one entry of the legend, so a band, its line and its points belong together; without a label there is no entry.
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    caption: String,
    x: Axis,
    y: Axis,
    equal_aspect: bool,
    series: Vec<Series>,
}

#[derive(Clone, Debug)]
struct Axis {
    label: String,
    log: bool,
    range: Option<(f64, f64)>,
}

#[derive(Clone, Debug)]
struct Series {
    label: String,
    kind: Kind,
    places: Vec<Place>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Theory,
    Line,
    Points,
    Band,
    Measured,
}

/// One x with the value there and the span from `low` to `high` drawn around it.
#[derive(Clone, Copy, Debug)]
struct Place {
    x: f64,
    y: f64,
    low: f64,
    high: f64,
}

impl Figure {
    /// An empty figure; labels carry their units: `"impact speed (m/s)"`.
    pub fn new(title: &str, x_label: &str, y_label: &str) -> Self {
        let axis = |label: &str| Axis {
            label: label.to_string(),
            log: false,
            range: None,
        };
        Self {
            title: title.to_string(),
            caption: String::new(),
            x: axis(x_label),
            y: axis(y_label),
            equal_aspect: false,
            series: Vec::new(),
        }
    }

    /// Small text under the plot: by house rule the command that made the figure.
    #[must_use]
    pub fn caption(mut self, caption: &str) -> Self {
        self.caption = caption.to_string();
        self
    }

    /// Makes the x axis logarithmic.
    #[must_use]
    pub fn log_x(mut self) -> Self {
        self.x.log = true;
        self
    }

    /// Makes the y axis logarithmic.
    #[must_use]
    pub fn log_y(mut self) -> Self {
        self.y.log = true;
        self
    }

    /// Shows x from `low` to `high`; an impossible range is not used, and the figure says so.
    #[must_use]
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x.range = Some((low, high));
        self
    }

    /// Shows y from `low` to `high`; an impossible range is not used, and the figure says so.
    #[must_use]
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.y.range = Some((low, high));
        self
    }

    /// Gives one unit the same length on both axes, if both are linear.
    #[must_use]
    pub fn equal_aspect(mut self) -> Self {
        self.equal_aspect = true;
        self
    }

    /// A dark line: what theory says. The first is solid, others are broken.
    #[must_use]
    pub fn theory(self, label: &str, x: &[f64], y: &[f64]) -> Self {
        self.plain(Kind::Theory, label, x, y)
    }

    /// A coloured line; a value that cannot be drawn leaves a gap.
    #[must_use]
    pub fn line(self, label: &str, x: &[f64], y: &[f64]) -> Self {
        self.plain(Kind::Line, label, x, y)
    }

    /// Coloured points, with the uncertainty of y, if known, as a bar on both sides.
    #[must_use]
    pub fn points(self, label: &str, x: &[f64], y: &[f64], uncertainty: Option<&[f64]>) -> Self {
        let Some(uncertainty) = uncertainty else {
            return self.plain(Kind::Points, label, x, y);
        };
        let places = x.iter().zip(y).zip(uncertainty);
        self.with(
            Kind::Points,
            label,
            places.map(|((&x, &y), &e)| {
                let e = if e.is_finite() { e.abs() } else { 0.0 };
                Place {
                    x,
                    y,
                    low: y - e,
                    high: y + e,
                }
            }),
        )
    }

    /// A translucent band between two curves.
    #[must_use]
    pub fn band(self, label: &str, x: &[f64], low: &[f64], high: &[f64]) -> Self {
        let places = x.iter().zip(low).zip(high);
        self.with(
            Kind::Band,
            label,
            places.map(|((&x, &low), &high)| Place {
                x,
                y: low / 2.0 + high / 2.0,
                low,
                high,
            }),
        )
    }

    /// Grey points: values measured by others, in a laboratory or with another code; sets differ in shape and shade.
    #[must_use]
    pub fn measured(self, label: &str, x: &[f64], y: &[f64]) -> Self {
        self.plain(Kind::Measured, label, x, y)
    }

    /// The figure as SVG, 900 × 600, scaling with its frame.
    pub fn svg(&self) -> String {
        draw::svg(self)
    }

    /// Writes `<stem>.svg` and `<stem>.png` and returns both paths; the folder must exist.
    pub fn save(&self, stem: &Path) -> Result<[PathBuf; 2], PictureError> {
        let named = |end: &str| {
            // A stem may hold a dot ("mu_0.5"), so the ending is appended, never replaced.
            let mut name = stem.as_os_str().to_os_string();
            name.push(end);
            PathBuf::from(name)
        };
        let [svg, png] = [named(".svg"), named(".png")];
        let bytes = draw::png(self).map_err(|reason| PictureError::format(&png, reason))?;
        crate::whole::write(&svg, self.svg())?;
        crate::whole::write(&png, bytes)?;
        Ok([svg, png])
    }

    fn plain(self, kind: Kind, label: &str, x: &[f64], y: &[f64]) -> Self {
        self.with(
            kind,
            label,
            x.iter().zip(y).map(|(&x, &y)| Place {
                x,
                y,
                low: y,
                high: y,
            }),
        )
    }

    fn with(mut self, kind: Kind, label: &str, places: impl Iterator<Item = Place>) -> Self {
        self.series.push(Series {
            label: label.to_string(),
            kind,
            places: places.collect(),
        });
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn numbers() -> impl Strategy<Value = Vec<f64>> {
        let nasty = prop_oneof![
            Just(0.0),
            Just(-0.0),
            Just(f64::NAN),
            Just(f64::INFINITY),
            Just(f64::NEG_INFINITY),
            Just(f64::MAX),
            Just(f64::MIN),
            Just(5e-324),
            Just(1e-17),
            Just(1.0),
            Just(1.0 + f64::EPSILON),
            any::<f64>(),
            -10.0..10.0,
        ];
        prop::collection::vec(nasty, 0..9)
    }

    fn whole(svg: &str) -> bool {
        let undrawable = ["NaN", "inf\"", "inf "].iter().any(|bad| svg.contains(bad));
        svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && !undrawable
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]
        #[test]
        fn no_number_panics_or_reaches_the_drawing_undrawable(
            x in numbers(), y in numbers(), e in numbers(), log_x: bool, log_y: bool, equal: bool,
            range in prop::option::of((any::<f64>(), any::<f64>())),
        ) {
            let mut figure = Figure::new("t", "x", "y").theory("a", &x, &y).line("b", &y, &x)
                .points("c", &x, &y, Some(&e)).band("d", &x, &y, &e).measured("e", &e, &x);
            if log_x { figure = figure.log_x(); }
            if log_y { figure = figure.log_y(); }
            if equal { figure = figure.equal_aspect(); }
            if let Some((low, high)) = range { figure = figure.x_range(low, high).y_range(high, low); }
            prop_assert!(whole(&figure.svg()));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 40, ..ProptestConfig::default() })]
        #[test]
        fn no_number_panics_the_bitmap(x in numbers(), y in numbers(), e in numbers(), log: bool, range in (any::<f64>(), any::<f64>())) {
            let figure = Figure::new("t", "x", "y").line("b", &x, &y).points("c", &x, &y, Some(&e)).band("d", &x, &y, &e);
            let figure = if log { figure.log_x().log_y() } else { figure.y_range(range.0, range.1) };
            prop_assert!(draw::png(&figure).is_ok());
        }
    }

    #[test]
    fn every_word_is_in_the_drawing_as_it_was_given() {
        let svg = Figure::new("Rise & fall", "t (s)", "T < 1 (J)")
            .caption("tsubu run a.ron --set cost=$5 --until $6")
            .points(
                "series one",
                &[1.0, 2.0],
                &[1.0, 3.0],
                Some(&[0.1, f64::NAN]),
            )
            .band("spread", &[1.0, 2.0], &[0.5, 2.0], &[1.5, 4.0])
            .svg();
        for word in [
            "Rise &amp; fall",
            "t (s)",
            "T &lt; 1 (J)",
            "cost=$5 --until $6",
            "series one",
            "spread",
        ] {
            assert!(svg.contains(word), "{word} is missing");
        }
    }

    /// Several curves of theory and several sets of measurements can be told apart without their labels; one looks as ever.
    #[test]
    fn theories_and_measurements_differ_among_themselves() {
        let (x, y) = ([1.0, 2.0], [1.0, 3.0]);
        let one = Figure::new("t", "x", "y")
            .theory("a", &x, &y)
            .measured("c", &x, &y);
        assert!(!one.svg().contains("stroke-dasharray") && one.svg().contains("#8c8c8c"));
        let two = one.theory("b", &x, &y).measured("d", &x, &y).svg();
        assert!(two.contains("stroke-dasharray") && two.contains("#4d4d4d"));
    }

    #[test]
    fn what_is_left_out_is_said() {
        let drawn = Figure::new("", "x", "y").line("a", &[1.0, 2.0, 3.0], &[1.0, f64::NAN, 2.0]);
        assert!(drawn.svg().contains("1 value left out"));
        assert!(!drawn.clone().log_x().svg().contains("2 values"));
        let on_log =
            Figure::new("", "x", "y")
                .log_y()
                .measured("a", &[1.0, 2.0, 3.0], &[0.0, -1.0, 2.0]);
        assert!(on_log.svg().contains("2 values left out"));
        assert!(
            Figure::new("", "x", "y")
                .svg()
                .contains("no values to draw")
        );
        assert!(
            Figure::new("", "x", "y")
                .log_x()
                .x_range(-1.0, 1.0)
                .svg()
                .contains("x range")
        );
    }

    #[test]
    fn series_of_one_label_share_colour_and_legend() {
        let (x, y) = ([1.0, 2.0], [1.0, 2.0]);
        let svg = Figure::new("", "", "")
            .band("run", &x, &y, &[2.0, 3.0])
            .line("run", &x, &y)
            .line("other", &x, &y)
            .svg();
        assert_eq!(svg.matches(">run<").count(), 1);
        // Drawn and explained: one band and two lines, two swatches of the first colour and one of the second.
        assert_eq!(
            (
                svg.matches("#0072b2").count(),
                svg.matches("#d55e00").count()
            ),
            (4, 2)
        );
    }

    #[test]
    fn the_same_figure_gives_the_same_bytes() {
        let figure = Figure::new("a", "b", "c").line("d", &[1.0, 2.0], &[3.0, 4.0]);
        assert_eq!(figure.svg(), figure.svg());
    }

    #[test]
    fn both_files_appear_and_a_missing_folder_is_named() {
        let stem = std::env::temp_dir().join(format!("tsubu-figure-0.5-{}", std::process::id()));
        let files = Figure::new("a", "b", "c").save(&stem).unwrap();
        assert!(
            files[0].to_string_lossy().ends_with(".svg")
                && files[1].to_string_lossy().ends_with(".png")
        );
        for file in files {
            assert!(std::fs::metadata(&file).unwrap().len() > 500);
            std::fs::remove_file(file).unwrap();
        }
        let error = Figure::new("a", "b", "c")
            .save(Path::new("no/such/folder/plot"))
            .unwrap_err();
        assert_eq!(error.path(), Path::new("no/such/folder/plot.svg"));
    }
}
