//! Which pixels of an image determine which cells.

use super::ObstacleMap;
use crate::geometry::Point2;
use crate::image::GrayImage;
use crate::perception::{Calibration, DarkPixels};

/// A dark pixel within this distance of a cell's pixels keeps it from being cleared. Pixels are one apart, and the
/// look-up of wall tops rounds by one: so every obstacle in a cell that one image shows is within two pixels in
/// another.
const AROUND_PX: f64 = 2.0;

/// A half-open range of pixels along one axis.
type Span = [usize; 2];

/// The cells along one axis that are completely in view, including wall tops: for each, the pixels with their centre in
/// the cell, and those in or around it.
struct Axis {
    first: usize,
    cells: Vec<(Span, Span)>,
}

/// Displacement of wall tops along one axis of an image: away from the camera's foot by the factor `times`.
struct Spread {
    times: f64,
    foot_px: f64,
    size_px: usize,
}

impl Spread {
    /// Apparent position of the top of a wall at `at_px`.
    fn top_px(&self, at_px: f64) -> f64 {
        self.foot_px + (at_px - self.foot_px) * self.times
    }

    fn is_in_view(&self, at_px: f64) -> bool {
        (0.0..=self.size_px as f64).contains(&at_px)
    }
}

/// An image aligned with a map.
pub(super) struct View {
    standing: DarkPixels,
    columns: Axis,
    rows: Axis,
}

impl View {
    /// `hidden` are the pixels that show neither wall nor floor.
    pub fn of(
        map: &ObstacleMap,
        dark: &DarkPixels,
        hidden: Option<&DarkPixels>,
        calibration: &Calibration,
        spread: f64,
    ) -> Self {
        let (columns, rows) = map.shape();
        let column_px = |i: usize| calibration.image_from_table(Point2::new(map.column_edge_m(i), 0.0)).0;
        let row_px = |i: usize| calibration.image_from_table(Point2::new(0.0, map.row_edge_m(i))).1;
        let foot_px = calibration.image_from_table(calibration.foot_m);
        let across = Spread { times: spread, foot_px: foot_px.0, size_px: dark.width_px() };
        let down = Spread { times: spread, foot_px: foot_px.1, size_px: dark.height_px() };
        Self {
            standing: standing(dark, hidden, &across, &down),
            columns: Axis::of(columns, &across, |i| [column_px(i), column_px(i + 1)]),
            rows: Axis::of(rows, &down, |i| [row_px(i + 1), row_px(i)]),
        }
    }

    /// Column and row of all cells that are completely in view.
    pub fn cells(&self) -> impl Iterator<Item = (usize, usize)> {
        let columns = self.columns.first..self.columns.first + self.columns.cells.len();
        let rows = self.rows.first..self.rows.first + self.rows.cells.len();
        rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
    }

    /// Whether a cell in view contains a wall.
    pub fn is_dark(&self, column: usize, row: usize) -> bool {
        let ((across, _), (down, _)) = self.seen(column, row);
        self.standing.between(across, down) > 0
    }

    /// Whether a wall is in the cell or near it.
    pub fn is_near_dark(&self, column: usize, row: usize) -> bool {
        let ((_, across), (_, down)) = self.seen(column, row);
        self.standing.between(across, down) > 0
    }

    /// Whether more than a quarter of a cell is hidden.
    pub fn is_hidden(&self, column: usize, row: usize, hidden: &DarkPixels) -> bool {
        let ((across, _), (down, _)) = self.seen(column, row);
        4 * hidden.between(across, down) > (across[1] - across[0]) * (down[1] - down[0])
    }

    fn seen(&self, column: usize, row: usize) -> ((Span, Span), (Span, Span)) {
        (self.columns.cells[column - self.columns.first], self.rows.cells[row - self.rows.first])
    }
}

impl Axis {
    /// `edges_px` returns the lower and the upper edge of a cell.
    fn of(count: usize, spread: &Spread, edges_px: impl Fn(usize) -> [f64; 2]) -> Self {
        let seen = |i: usize| {
            let edges_px = edges_px(i);
            let in_view = edges_px.iter().all(|&px| spread.is_in_view(px) && spread.is_in_view(spread.top_px(px)));
            let middles = |margin_px| middles(edges_px, margin_px, spread.size_px);
            in_view.then(|| (middles(0.0), middles(AROUND_PX)))
        };
        let first = (0..count).find(|&i| seen(i).is_some()).unwrap_or(count);
        Self { first, cells: (first..count).map_while(seen).collect() }
    }
}

/// The pixels whose centre is between two places, widened by `margin_px` on both sides; at least the middle one,
/// because a cell may be smaller than a pixel.
fn middles([low_px, high_px]: [f64; 2], margin_px: f64, size_px: usize) -> Span {
    let first = (low_px - margin_px - 0.5).ceil().max(0.0) as usize;
    let end = ((high_px + margin_px - 0.5).ceil().max(0.0) as usize).min(size_px);
    if first < end {
        return [first, end];
    }
    let middle = (((low_px + high_px) / 2.0) as usize).min(size_px - 1);
    [middle, middle + 1]
}

/// The dark pixels where a wall is possible: its top would darken the spread image of the place, for which the four
/// surrounding pixels are tested; they may also be hidden. Places whose spread image is out of view are unchanged.
fn standing(dark: &DarkPixels, hidden: Option<&DarkPixels>, across: &Spread, down: &Spread) -> DarkPixels {
    let (width_px, height_px) = (dark.width_px(), dark.height_px());
    if across.times == 1.0 || width_px < 2 || height_px < 2 {
        return dark.clone();
    }
    let tops = |spread: &Spread| -> Vec<usize> {
        let upper_left = |at: usize| (spread.top_px(at as f64 + 0.5) - 0.5).floor();
        (0..spread.size_px).map(|at| (upper_left(at).max(0.0) as usize).min(spread.size_px - 2)).collect()
    };
    let (lefts, tops) = (tops(across), tops(down));
    let flags = dark.flags();
    let mut may_be_dark = flags.clone();
    if let Some(hidden) = hidden {
        may_be_dark.iter_mut().zip(hidden.flags()).for_each(|(flag, is_hidden)| *flag |= is_hidden);
    }
    // Dark here or to the right; the last column is not used.
    let mut pairs = Vec::with_capacity(flags.len());
    pairs.extend(may_be_dark.windows(2).map(|pair| pair[0] | pair[1]));
    pairs.push(0);
    let mut pixels = Vec::with_capacity(flags.len());
    for (flags, top) in flags.chunks_exact(width_px).zip(tops) {
        let (upper, lower) = pairs[top * width_px..(top + 2) * width_px].split_at(width_px);
        let is_wall = |(flag, &left): (&u8, &usize)| flag & (upper[left] | lower[left]);
        // Gray: 0 is dark.
        pixels.extend(flags.iter().zip(&lefts).map(|seen| 1 - is_wall(seen)));
    }
    DarkPixels::of(&GrayImage { width_px, height_px, pixels }, 0)
}
