//! Which grains make up the deposit, and how densely they lie inside it.

use crate::Slices;
use crate::free::free;
use std::collections::BTreeMap;
use tsubu_model::{SpinState, View};

/// The largest connected body of grains and its solid fraction well inside.
///
/// **Which grains count.** The x–z plane is cut into square cells of two largest diameters. A cell is
/// *full* if it holds at least a quarter of the content of the median cell (half of all content lies in
/// cells with more). The deposit is the largest body of full cells joined by sides or corners, with the
/// grains of the cells next to them. So touching grains in full cells are never parted, a single grain or a
/// thin gas more than four diameters away (along x or z) is left out, and contacts are not asked for: in a fast flow many are
/// open. Grains that no contact moves (infinite mass: a frozen floor) are not part of it.
///
/// **Bulk fraction.** φ = mean over the inside cells of V_cell / (cell area × W), where a cell is *inside* if it
/// and its eight neighbours are full: it is half a diameter or more away from walls, floor and free surface. V_cell (m³, in the plane m²) is the content of the grains cut by the sides of the cell, W the
/// depth (m, in the plane 1); overlaps count twice, which is small for hard grains. The neighbours' threshold is low
/// on purpose: asking for half-full neighbours picks dense places (measured: 2 % too much in a loose
/// plane fill). The uncertainty is the standard error of that mean, cells taken as independent. A deposit too
/// thin to have an inside (under about six diameters) falls back to the median cell, without uncertainty and too low.
///
/// ```
/// use tsubu_measure::Slices;
/// // A simple cubic lattice of touching spheres: one sphere per cube of side d, φ = π/6 = 0.5236.
/// assert!((tsubu_model::Space::content(0.5) - 0.5236).abs() < 1e-4);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Deposit {
    /// Indices of its grains in the view that was looked at, ascending.
    pub grains: Vec<usize>,
    /// Indices of those whose centre lies in an inside cell, ascending.
    pub inside: Vec<usize>,
    /// Number of grains left out, not counting those of infinite mass.
    pub left_out: usize,
    /// Extent across the x–z plane in m; 1 in the plane.
    pub depth: f64,
    /// Content of its grains: m³ in space, m² in the plane.
    pub content: f64,
    /// Centre of mass, x in m; NaN if there are no grains.
    pub centre_x: f64,
    /// Centre of mass, z in m; NaN if there are no grains.
    pub centre_z: f64,
    /// Solid fraction well inside; NaN if there are no grains.
    pub bulk_fraction: f64,
    /// Its standard deviation; NaN if not known.
    pub bulk_uncertainty: f64,
}

/// Cell of a centre: number along x, number along z.
type Cell = (i64, i64);

/// Cells beyond this number are nowhere near anything.
const FAR: f64 = 1e15;

impl Deposit {
    /// Looks at the grains of a view. `depth` is the period along y in m, or `None` for a walled or
    /// open scene: then the extent of the deposit's grains is used. The plane ignores it.
    pub fn of<D: Slices, S: SpinState>(view: &dyn View<D, S>, depth: Option<f64>) -> Self {
        let moving: Vec<usize> = free(view).collect();
        let size = 4.0
            * moving
                .iter()
                .map(|&i| view.kind(i).radius)
                .fold(0.0, f64::max);
        let cell_of = |i: usize| -> Option<Cell> {
            let place = D::to_space(view.position(i));
            let (x, z) = ((place.x / size).floor(), (place.z / size).floor());
            (x.abs() < FAR && z.abs() < FAR).then_some((x as i64, z as i64))
        };
        let mut cells: BTreeMap<Cell, (f64, Vec<usize>)> = BTreeMap::new();
        for &i in &moving {
            if let Some(cell) = cell_of(i) {
                let (content, grains) = cells.entry(cell).or_default();
                *content += D::content(view.kind(i).radius);
                grains.push(i);
            }
        }
        let median = median_by_content(cells.values().map(|c| c.0).collect());
        let holds =
            |cell: Cell, share: f64| cells.get(&cell).is_some_and(|c| c.0 >= share * median);

        let body = largest_body(&cells, |cell| holds(cell, 0.25));
        let mut with_rim: Vec<Cell> = body.iter().flat_map(|&cell| around(cell)).collect();
        with_rim.sort_unstable();
        with_rim.dedup();
        let grains_of = |list: &[Cell]| {
            let mut grains: Vec<usize> = list
                .iter()
                .filter_map(|cell| cells.get(cell))
                .flat_map(|c| c.1.iter().copied())
                .collect();
            grains.sort_unstable();
            grains
        };
        let inner: Vec<Cell> = body
            .iter()
            .copied()
            .filter(|&cell| around(cell).all(|near| holds(near, 0.25)))
            .collect();
        let grains = grains_of(&with_rim);

        let mut deposit = Self {
            inside: grains_of(&inner),
            left_out: moving.len() - grains.len(),
            depth: f64::NAN,
            content: 0.0,
            centre_x: f64::NAN,
            centre_z: f64::NAN,
            bulk_fraction: f64::NAN,
            bulk_uncertainty: f64::NAN,
            grains,
        };
        deposit.sum_up(view, depth);
        let area = size * size * deposit.depth;
        let fractions: Vec<f64> = inner
            .iter()
            .map(|&cell| content_within(view, &cells, cell, size) / area)
            .collect();
        if fractions.is_empty() {
            if !deposit.grains.is_empty() {
                deposit.bulk_fraction = median / area;
            }
        } else {
            let n = fractions.len() as f64;
            let mean = fractions.iter().sum::<f64>() / n;
            let square: f64 = fractions.iter().map(|f| (f - mean).powi(2)).sum();
            deposit.bulk_fraction = mean;
            deposit.bulk_uncertainty = (square / ((n - 1.0) * n)).sqrt();
        }
        deposit
    }

    /// Depth, content and centre of mass.
    fn sum_up<D: Slices, S: SpinState>(&mut self, view: &dyn View<D, S>, depth: Option<f64>) {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut mass, mut x, mut z) = (0.0, 0.0, 0.0);
        for &i in &self.grains {
            let (place, kind) = (D::to_space(view.position(i)), view.kind(i));
            low = low.min(place.y - kind.radius);
            high = high.max(place.y + kind.radius);
            self.content += D::content(kind.radius);
            mass += kind.mass;
            x += kind.mass * place.x;
            z += kind.mass * place.z;
        }
        self.depth = <D as Slices>::across(depth, low, high);
        (self.centre_x, self.centre_z) = (x / mass, z / mass);
    }
}

/// The cell and its eight neighbours.
fn around((x, z): Cell) -> impl Iterator<Item = Cell> {
    (-1..=1).flat_map(move |i| (-1..=1).map(move |k| (x + i, z + k)))
}

/// Half of the sum of all values lies in values at or above this one.
fn median_by_content(mut contents: Vec<f64>) -> f64 {
    contents.sort_unstable_by(f64::total_cmp);
    let half = 0.5 * contents.iter().sum::<f64>();
    let mut sum = 0.0;
    contents
        .into_iter()
        .find(|content| {
            sum += content;
            sum >= half
        })
        .unwrap_or(f64::NAN)
}

/// The connected body of full cells with the most content, ascending; of equals the first.
fn largest_body(
    cells: &BTreeMap<Cell, (f64, Vec<usize>)>,
    full: impl Fn(Cell) -> bool,
) -> Vec<Cell> {
    let mut seen = std::collections::BTreeSet::new();
    let (mut best, mut most) = (Vec::new(), 0.0);
    for &start in cells.keys() {
        if !full(start) || !seen.insert(start) {
            continue;
        }
        let (mut body, mut next) = (vec![start], 0);
        while let Some(&cell) = body.get(next) {
            next += 1;
            body.extend(around(cell).filter(|&near| full(near) && seen.insert(near)));
        }
        body.sort_unstable();
        let content = body
            .iter()
            .filter_map(|cell| cells.get(cell))
            .map(|c| c.0)
            .sum();
        if content > most {
            (best, most) = (body, content);
        }
    }
    best
}

/// Content of all grains cut by the sides of one cell.
fn content_within<D: Slices, S: SpinState>(
    view: &dyn View<D, S>,
    cells: &BTreeMap<Cell, (f64, Vec<usize>)>,
    cell: Cell,
    size: f64,
) -> f64 {
    let corner = [cell.0 as f64 * size, cell.1 as f64 * size];
    let mut sum = 0.0;
    for &i in around(cell)
        .filter_map(|near| cells.get(&near))
        .flat_map(|c| &c.1)
    {
        let place = D::to_space(view.position(i));
        let (x, z) = (corner[0] - place.x, corner[1] - place.z);
        sum += D::part(view.kind(i).radius, [x, x + size], [z, z + size]);
    }
    sum
}
