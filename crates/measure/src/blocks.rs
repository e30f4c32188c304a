//! The mean of a correlated series with its uncertainty, and where a series becomes steady.

use crate::Line;

/// Blocks that must be left, so that their scatter is worth something: with 8 an error is known to 27 %.
pub(crate) const FEWEST: usize = 8;
/// Looks in a cell of a long series, and the number of looks from which a series is long.
const CELL: usize = 5;
const LONG: usize = 50;
/// A drift smaller than this share of the mean changes nothing that is reported.
const SMALL_DRIFT: f64 = 0.01;
/// Standard errors of its slope by which a drift must stand out.
const CLEAR_DRIFT: f64 = 3.0;
/// The same for fewer than 8 values by their number: Student's t at 99.73 % for two degrees of freedom less.
const CLEAR_AMONG_FEW: [f64; FEWEST] = [
    f64::INFINITY,
    f64::INFINITY,
    f64::INFINITY,
    235.8,
    19.21,
    9.22,
    6.62,
    5.51,
];
/// If dropping the end divides the squared error by more than this, the end is not like the rest.
const END_GAIN: f64 = 1.0 / 3.0;
/// What rounding may do to a constant, as a share of the largest value.
const ROUNDING: f64 = 1e-9;

/// The mean of a series whose neighbours are correlated.
///
/// Blocking: the values are averaged in blocks of b = 1, 2, 4, … neighbours, as long as 8 blocks remain.
/// With s_b the standard deviation of the n_b block means, ε_b = s_b/√n_b estimates the standard error of the
/// mean; it grows with b until blocks are longer than the memory of the series, and is flat from there on.
/// Taken is the first b with b³ > 2 n (ε_b/ε_1)⁴, which balances the bias of short blocks against the
/// scatter of few; if there is none, the longest blocks, whose ε is then too small.
/// A series needs some 30 correlation times for it. Blocks are counted from the end.
///
/// Source: `Flyvbjerg1989` for the blocking.
///
/// ```
/// use tsubu_measure::Blocked;
/// // Eight independent values, by hand: mean 3.5, s² = 6, error √(6/8).
/// let mean = Blocked::of(&[0.0, 7.0, 2.0, 5.0, 4.0, 3.0, 6.0, 1.0]).unwrap();
/// assert_eq!((mean.mean, mean.blocks), (3.5, 8));
/// assert!((mean.uncertainty.unwrap() - 0.75f64.sqrt()).abs() < 1e-12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocked {
    /// Mean of all values.
    pub mean: f64,
    /// Its standard error; `None` for a single value.
    pub uncertainty: Option<f64>,
    /// How many blocks the error comes from.
    pub blocks: usize,
}

impl Blocked {
    /// Mean and error of values at equal distances in time; those that are not finite are left out.
    /// `None` if nothing remains.
    pub fn of(values: &[f64]) -> Option<Self> {
        let values: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
        (!values.is_empty()).then(|| Self::of_cells(&values))
    }

    /// Rate of a count that only grows, such as the mass through an outlet: the slope between the first and the
    /// last look. Its error comes from the slopes between as many edges at equal distances in time as there are
    /// looks, with the count interpolated linearly. `None` for fewer than two moments.
    pub fn of_count(time: &[f64], count: &[f64]) -> Option<Self> {
        let looks = clean(time, count);
        let edges = edges(&looks, looks.len().saturating_sub(1))?;
        Some(Self::of_cells(&slopes(&looks, &edges)))
    }

    fn of_cells(cells: &[f64]) -> Self {
        let size = block_size(cells);
        let blocks = averaged(cells, size);
        Self {
            mean: mean(cells),
            uncertainty: (cells.len() > 1).then(|| error(&blocks)),
            blocks: blocks.len(),
        }
    }
}

/// The steady part of a series: from when on, its mean, and whether it still drifts.
///
/// Where it begins (MSER-5): the series is averaged in cells of 5 looks (of 1 look if there are fewer than 50), and
/// cells are dropped from the front until z(d) = Σ_{i ≥ d} (Y_i − Ȳ_d)²/(n − d)² is least, the squared standard
/// error of the rest if cells were independent. d is sought up to two thirds of n and where 8 cells remain; of equal z
/// the longest rest wins. There is no steady part (`None`) with fewer than 8 cells, or if z is least at two thirds: then it
/// still falls there, and the steady part is too short.
///
/// Whether the rest drifts is asked of its block means ([`Blocked`]). It drifts if a line through them has a slope more
/// than 3 of its standard errors from zero ([`Line`]) that amounts to more than 1 % of the mean over the rest; or if
/// leaving out up to a third of them at the end divides the squared error by more than 3 and moves the mean by more
/// than 1 %, as at the end of a run whose hopper runs empty. Noise is taken for a drift in a few per cent of cases.
///
/// Looks should be at equal distances in time. The end is never cut.
///
/// Source: `White2000`; the two thirds and the tests of drift are choices of this code.
///
/// ```
/// use tsubu_measure::Steady;
/// // It rises for 3 s and then holds 2.0.
/// let time: Vec<f64> = (0..100).map(|i| 0.1 * f64::from(i)).collect();
/// let value: Vec<f64> = time.iter().map(|t| if *t < 3.0 { t / 1.5 } else { 2.0 }).collect();
/// let steady = Steady::of(&time, &value).unwrap();
/// assert!(!steady.drift && (steady.from - 3.0).abs() < 0.01 && (steady.mean - 2.0).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady {
    /// Time at which the steady part begins.
    pub from: f64,
    /// Mean of the steady part.
    pub mean: f64,
    /// Standard error of the mean.
    pub uncertainty: f64,
    /// How many blocks the error comes from.
    pub blocks: usize,
    /// True if the rest still drifts: then it is not steady, and the mean is that of a moment.
    pub drift: bool,
}

impl Steady {
    /// Steady part of values at these times; pairs that are not finite or do not advance in time are left out.
    pub fn of(time: &[f64], values: &[f64]) -> Option<Self> {
        let looks = clean(time, values);
        let size = if looks.len() >= LONG { CELL } else { 1 };
        // Cells are counted from the end, so what does not fill a cell is dropped where the start-up is.
        let skipped = looks.len() % size;
        let cells: Vec<&[(f64, f64)]> = looks[skipped..].chunks(size).collect();
        let begin: Vec<f64> = cells.iter().map(|cell| cell[0].0).collect();
        let cells: Vec<f64> = cells
            .iter()
            .map(|cell| mean(&cell.iter().map(|look| look.1).collect::<Vec<_>>()))
            .collect();
        Self::of_cells(&begin, &cells)
    }

    /// Steady part of the rate of a count that only grows. Cells are slopes between edges at equal distances in
    /// time, five looks apart (one look if there are fewer than 50); the count is interpolated linearly at edges.
    /// So the mean is the slope between `from` and the end, whatever the looks between them.
    ///
    /// ```
    /// use tsubu_measure::Steady;
    /// // Nothing for 2 s, then 3 kg/s.
    /// let time: Vec<f64> = (0..=100).map(|i| 0.1 * f64::from(i)).collect();
    /// let mass: Vec<f64> = time.iter().map(|t| 3.0 * (t - 2.0).max(0.0)).collect();
    /// let steady = Steady::of_count(&time, &mass).unwrap();
    /// assert!((steady.from - 2.0).abs() < 1e-9 && (steady.mean - 3.0).abs() < 1e-9);
    /// ```
    pub fn of_count(time: &[f64], count: &[f64]) -> Option<Self> {
        let looks = clean(time, count);
        let spans = looks.len().saturating_sub(1);
        let edges = edges(&looks, if spans >= LONG { spans / CELL } else { spans })?;
        Self::of_cells(&edges, &slopes(&looks, &edges))
    }

    /// Steady part of the rate of a count that swings with a known period, as what a screw lets fall at
    /// every turn. Cells are whole periods, counted back from the end to `from` at most; the swing is then in no
    /// cell, and a start-up is not lost in it. With 8 periods and more the start is sought as in
    /// [`Steady::of_count`]; with fewer the whole counts, so `from` must lie behind the start-up, and only a slope at
    /// Student's t of 99.73 % is a drift, since chance looks like one among so few. Fewer than two periods are no steady part.
    /// The uncertainty is that of so few: s/√n times Student's t at 68.27 % for n − 1 degrees of freedom (two periods 1.84, three 1.32, five 1.14).
    ///
    /// ```
    /// use tsubu_measure::Steady;
    /// // 3 kg/s, all of it in the second half of every second.
    /// let time: Vec<f64> = (0..=50).map(|i| 0.1 * f64::from(i)).collect();
    /// let mass: Vec<f64> = time.iter().map(|t| 3.0 * (t.floor() + (2.0 * t.fract() - 1.0).max(0.0))).collect();
    /// let steady = Steady::of_periods(&time, &mass, 1.0, 0.5).unwrap();
    /// assert!((steady.from - 1.0).abs() < 1e-9 && (steady.mean - 3.0).abs() < 1e-9 && steady.blocks == 4);
    /// ```
    pub fn of_periods(time: &[f64], count: &[f64], period: f64, from: f64) -> Option<Self> {
        let looks = clean(time, count);
        let (first, end) = (looks.first()?.0.max(from), looks.last()?.0);
        let periods = ((end - first) / period * (1.0 + 1e-9)).floor();
        if !(2.0..1e9).contains(&periods) {
            return None;
        }
        let edges: Vec<f64> = (0..=periods as usize)
            .rev()
            .map(|k| end - k as f64 * period)
            .collect();
        let rates = slopes(&looks, &edges);
        let skipped = if rates.len() < FEWEST {
            0
        } else {
            truncation(&rates)?
        };
        let rest = &rates[skipped..];
        let middle = mean(rest);
        Some(Self {
            from: edges[skipped],
            mean: middle,
            uncertainty: error(rest) * student(rest.len()),
            blocks: rest.len(),
            drift: match CLEAR_AMONG_FEW.get(rest.len()) {
                Some(&clear) => climbs(rest, middle, clear),
                None => drifts(rest, middle),
            },
        })
    }

    /// `begin[i]` is when cell i begins.
    fn of_cells(begin: &[f64], cells: &[f64]) -> Option<Self> {
        let from = truncation(cells)?;
        let rest = &cells[from..];
        let found = Blocked::of_cells(rest);
        Some(Self {
            from: begin[from],
            mean: found.mean,
            uncertainty: found.uncertainty?,
            blocks: found.blocks,
            drift: drifts(rest, found.mean),
        })
    }
}

/// Pairs that are finite and advance in time.
fn clean(time: &[f64], values: &[f64]) -> Vec<(f64, f64)> {
    let mut looks: Vec<(f64, f64)> = Vec::new();
    for (&t, &v) in time.iter().zip(values) {
        let later = looks.last().is_none_or(|last| t > last.0);
        if t.is_finite() && v.is_finite() && later {
            looks.push((t, v));
        }
    }
    looks
}

/// `count` cells of equal width over the looks have `count` + 1 edges.
fn edges(looks: &[(f64, f64)], count: usize) -> Option<Vec<f64>> {
    let (first, last) = (looks.first()?.0, looks.last()?.0);
    let at = |k: usize| first + (last - first) * k as f64 / count as f64;
    (count > 0).then(|| (0..=count).map(at).collect())
}

/// Slopes of a count between edges.
fn slopes(looks: &[(f64, f64)], edges: &[f64]) -> Vec<f64> {
    let at = |t: f64| {
        let next = looks
            .partition_point(|look| look.0 < t)
            .clamp(1, looks.len() - 1);
        let ((t0, c0), (t1, c1)) = (looks[next - 1], looks[next]);
        let share = ((t - t0) / (t1 - t0)).clamp(0.0, 1.0);
        c0 * (1.0 - share) + c1 * share
    };
    edges
        .windows(2)
        .map(|edge| (at(edge[1]) - at(edge[0])) / (edge[1] - edge[0]))
        .collect()
}

/// Mean, exact for constants.
fn mean(values: &[f64]) -> f64 {
    let first = values.first().copied().unwrap_or(f64::NAN);
    first + values.iter().map(|v| v - first).sum::<f64>() / values.len() as f64
}

/// Means of blocks of `size` neighbours, counted from the end.
fn averaged(cells: &[f64], size: usize) -> Vec<f64> {
    cells[cells.len() % size..].chunks(size).map(mean).collect()
}

/// Standard error of the mean of independent values; 0 for one.
fn error(values: &[f64]) -> f64 {
    let (n, middle) = (values.len() as f64, mean(values));
    let square: f64 = values.iter().map(|v| (v - middle).powi(2)).sum();
    if n > 1.0 {
        (square / (n * (n - 1.0))).sqrt()
    } else {
        0.0
    }
}

/// Student's t at 68.27 % for n values, by which their standard error grows: the series of Cornish and Fisher
/// (`Abramowitz1964`, 26.7.5) at one standard deviation, 1.4 % short for two values and 0.1 % for three.
fn student(n: usize) -> f64 {
    let per = 1.0 / (n.max(2) - 1) as f64;
    1.0 + per * (1.0 / 2.0 + per * (1.0 / 4.0 + per / 16.0))
}

/// The rule of [`Blocked`].
fn block_size(cells: &[f64]) -> usize {
    let alone = error(cells);
    let mut size = 1;
    while cells.len() / (2 * size) >= FEWEST && alone > 0.0 {
        let growth = error(&averaged(cells, size)) / alone;
        if (size as f64).powi(3) > 2.0 * cells.len() as f64 * growth.powi(4) {
            break;
        }
        size *= 2;
    }
    size
}

/// The rule of [`Steady`]: how many cells are dropped.
fn truncation(cells: &[f64]) -> Option<usize> {
    let n = cells.len();
    let too_late = 2 * n / 3;
    let latest = too_late.min(n.checked_sub(FEWEST)?);
    let scale = cells.iter().fold(0.0f64, |top, y| top.max(y.abs()));
    // Two constants that differ by rounding are one constant: every cell has at least this variance.
    let floor = (ROUNDING * scale).powi(2);
    let (mut best, mut least) = (0, f64::INFINITY);
    let (mut middle, mut square) = (0.0, 0.0);
    for from in (0..n).rev() {
        let left = (n - from) as f64;
        let apart = cells[from] - middle;
        middle += apart / left;
        square += apart * (cells[from] - middle);
        let z = (square + left * floor) / (left * left);
        if from <= latest && z <= least {
            (best, least) = (from, z);
        }
    }
    (best < too_late).then_some(best)
}

/// The rule of [`Steady`]: the block means climb or fall along a line, or change at the end.
fn drifts(rest: &[f64], mean: f64) -> bool {
    let blocks = averaged(rest, block_size(rest));
    climbs(&blocks, mean, CLEAR_DRIFT) || ends_elsewhere(&blocks, mean)
}

fn climbs(blocks: &[f64], mean: f64, clear: f64) -> bool {
    let number: Vec<f64> = (0..blocks.len()).map(|i| i as f64).collect();
    Line::fit(&number, blocks).is_some_and(|line| {
        let over_all = line.slope.abs() * blocks.len() as f64;
        over_all > SMALL_DRIFT * mean.abs()
            && line
                .slope_error
                .is_some_and(|error| line.slope.abs() > clear * error)
    })
}

/// A long plateau before a short decay has a slope with a large error, but loses its scatter with its end.
fn ends_elsewhere(blocks: &[f64], mean_of_all: f64) -> bool {
    let whole = error(blocks);
    (1..=blocks.len() / 3).any(|cut| {
        let kept = &blocks[..blocks.len() - cut];
        error(kept).powi(2) < END_GAIN * whole.powi(2)
            && (mean(kept) - mean_of_all).abs() > SMALL_DRIFT * mean_of_all.abs()
    })
}
