//! Which pixels of an image tell of which cells.

use super::ObstacleMap;
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

/// An image laid over a map.
pub(super) struct View {
    standing: DarkPixels,
    columns: Axis,
    rows: Axis,
}

impl View {
    pub fn of(map: &ObstacleMap, dark: &DarkPixels, calibration: &Calibration, spread: f64) -> Self {
        let (columns, rows) = map.shape();
        let center = calibration.center_m;
        let column_px = |i: usize| (map.column_edge_m(i) - center.x) / calibration.m_per_px;
        let row_px = |i: usize| (center.y - map.row_edge_m(i)) / calibration.m_per_px;
        Self {
            standing: standing(dark, spread),
            columns: Axis::of(columns, dark.width_px(), spread, |i| [column_px(i), column_px(i + 1)]),
            rows: Axis::of(rows, dark.height_px(), spread, |i| [row_px(i + 1), row_px(i)]),
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
    /// `edges_px` gives the lesser and the greater edge of a cell, in pixels from the middle of the image.
    fn of(count: usize, size_px: usize, spread: f64, edges_px: impl Fn(usize) -> [f64; 2]) -> Self {
        let half_px = size_px as f64 / 2.0;
        let seen = |i: usize| {
            let [low_px, high_px] = edges_px(i);
            let in_view = |scale: f64| low_px * scale >= -half_px && high_px * scale <= half_px;
            let middles = |margin_px| middles([half_px + low_px, half_px + high_px], margin_px, size_px);
            (in_view(1.0) && in_view(spread)).then(|| (middles(0.0), middles(AROUND_PX)))
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
fn standing(dark: &DarkPixels, spread: f64) -> DarkPixels {
    let (width_px, height_px) = (dark.width_px(), dark.height_px());
    if spread == 1.0 || width_px < 2 || height_px < 2 {
        return dark.clone();
    }
    let tops = |size_px: usize| -> Vec<usize> {
        let half_px = size_px as f64 / 2.0;
        let upper_left = |at: usize| (half_px + (at as f64 + 0.5 - half_px) * spread - 0.5).floor();
        (0..size_px).map(|at| (upper_left(at).max(0.0) as usize).min(size_px - 2)).collect()
    };
    let (lefts, tops) = (tops(width_px), tops(height_px));
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
