//! Which pixels of an image tell of which cells.

use super::ObstacleMap;
use crate::geometry::Point2;
use crate::image::GrayImage;
use crate::perception::{Calibration, DarkPixels};

/// How far from a cell's middles a dark pixel keeps it from being cleared. Pixels are sampled one apart, and the
/// look at wall tops rounds by one: two apart, what one image shows in a cell no other leaves out.
const AROUND_PX: f64 = 2.0;

/// Pixels along one axis, from the first bound up to, not including, the second.
type Span = [usize; 2];

/// The cells along one axis that are wholly in view, wall tops included: which pixels have their middle in the cell,
/// and which in or around it.
struct Axis {
    first: usize,
    cells: Vec<(Span, Span)>,
}

/// How wall tops seem to move along one axis of an image: so many times farther from the camera's foot.
struct Spread {
    times: f64,
    foot_px: f64,
    size_px: usize,
}

impl Spread {
    /// Where the top of what stands at a place seems to be.
    fn top_px(&self, at_px: f64) -> f64 {
        self.foot_px + (at_px - self.foot_px) * self.times
    }

    fn is_in_view(&self, at_px: f64) -> bool {
        (0.0..=self.size_px as f64).contains(&at_px)
    }
}

/// An image laid over a map.
pub(super) struct View {
    standing: DarkPixels,
    columns: Axis,
    rows: Axis,
}

impl View {
    pub fn of(map: &ObstacleMap, dark: &DarkPixels, calibration: &Calibration, spread: f64) -> Self {
        let (columns, rows) = map.shape();
        let column_px = |i: usize| calibration.image_from_table(Point2::new(map.column_edge_m(i), 0.0)).0;
        let row_px = |i: usize| calibration.image_from_table(Point2::new(0.0, map.row_edge_m(i))).1;
        let foot_px = calibration.image_from_table(calibration.foot_m);
        let across = Spread { times: spread, foot_px: foot_px.0, size_px: dark.width_px() };
        let down = Spread { times: spread, foot_px: foot_px.1, size_px: dark.height_px() };
        Self {
            standing: standing(dark, &across, &down),
            columns: Axis::of(columns, &across, |i| [column_px(i), column_px(i + 1)]),
            rows: Axis::of(rows, &down, |i| [row_px(i + 1), row_px(i)]),
        }
    }

    /// Column and row of all cells that are wholly in view.
    pub fn cells(&self) -> impl Iterator<Item = (usize, usize)> {
        let columns = self.columns.first..self.columns.first + self.columns.cells.len();
        let rows = self.rows.first..self.rows.first + self.rows.cells.len();
        rows.flat_map(move |row| columns.clone().map(move |column| (column, row)))
    }

    /// Whether something stands on a cell in view.
    pub fn is_dark(&self, column: usize, row: usize) -> bool {
        let ((across, _), (down, _)) = self.seen(column, row);
        self.standing.between(across, down) > 0
    }

    /// Whether something stands on it or near it.
    pub fn is_near_dark(&self, column: usize, row: usize) -> bool {
        let ((_, across), (_, down)) = self.seen(column, row);
        self.standing.between(across, down) > 0
    }

    fn seen(&self, column: usize, row: usize) -> ((Span, Span), (Span, Span)) {
        (self.columns.cells[column - self.columns.first], self.rows.cells[row - self.rows.first])
    }
}

impl Axis {
    /// `edges_px` gives the lesser and the greater edge of a cell.
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

/// The pixels whose middle is between two places, widened by `margin_px` on both sides; at least the one in the
/// middle, since a cell may be smaller than a pixel.
fn middles([low_px, high_px]: [f64; 2], margin_px: f64, size_px: usize) -> Span {
    let first = (low_px - margin_px - 0.5).ceil().max(0.0) as usize;
    let end = ((high_px + margin_px - 0.5).ceil().max(0.0) as usize).min(size_px);
    if first < end {
        return [first, end];
    }
    let middle = (((low_px + high_px) / 2.0) as usize).min(size_px - 1);
    [middle, middle + 1]
}

/// The dark pixels on whose place of the table something can stand: the top of it would darken the place spread, of
/// which the four pixels around are asked. What would be out of view is left as it is.
fn standing(dark: &DarkPixels, across: &Spread, down: &Spread) -> DarkPixels {
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
    // Dark here or to the right; nothing asks the last column.
    let mut pairs = Vec::with_capacity(flags.len());
    pairs.extend(flags.windows(2).map(|pair| pair[0] | pair[1]));
    pairs.push(0);
    let mut pixels = Vec::with_capacity(flags.len());
    for (flags, top) in flags.chunks_exact(width_px).zip(tops) {
        let (upper, lower) = pairs[top * width_px..(top + 2) * width_px].split_at(width_px);
        let stands = |(flag, &left): (&u8, &usize)| flag & (upper[left] | lower[left]);
        // Gray: 0 is dark.
        pixels.extend(flags.iter().zip(&lefts).map(|seen| 1 - stands(seen)));
    }
    DarkPixels::of(&GrayImage { width_px, height_px, pixels }, 0)
}
