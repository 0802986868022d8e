//! Partition of a set of cells into the minimum number of disjoint rectangles (paper, §IV-C, which requires the
//! "minimum number" but gives no method).
//!
//! Consider a rectilinear region with N concave vertices, H holes and C components. Let L be the largest number of
//! chords between concave vertices that do not meet. The minimum is N − L − H + C: Lipski, Lodi, Luccio, Mugnai & Pagli
//! 1979 (Fundamenta Informaticae 2, 245–260); Ohtsuki 1982 (ISCAS, 1210–1213); for digitised images Ferrari, Sankar &
//! Sklansky 1984 (Computer Vision, Graphics, and Image Processing 28, 58–71). Chords of one direction never meet, so L
//! is a maximum independent set of a bipartite graph, which follows from a maximum matching (König 1931).
//!
//! **Degenerate cases.** Dark cells are connected by edges only. Where two dark cells touch at a corner, the vertex is
//! a convex corner of each and not concave. Free cells are connected there too: an area that is closed off only by
//! corners is not a hole. Chords that share an end meet.

mod chords;

#[cfg(test)]
mod tests;

use chords::Chords;

/// A grid of dark and free cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellMask {
    /// Cells across.
    pub columns: usize,
    /// Cells down.
    pub rows: usize,
    /// Row by row, `rows × columns`.
    pub dark: Vec<bool>,
}

/// A rectangle of whole cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellRect {
    pub column: usize,
    pub row: usize,
    /// Cells across.
    pub columns: usize,
    /// Cells down.
    pub rows: usize,
}

impl CellMask {
    /// A grid without dark cells.
    pub fn free(columns: usize, rows: usize) -> Self {
        Self { columns, rows, dark: vec![false; columns * rows] }
    }

    /// Makes the cells of `rect` dark. It must be inside the grid.
    pub fn darken(&mut self, rect: &CellRect) {
        for row in rect.row..rect.row + rect.rows {
            let start = row * self.columns + rect.column;
            self.dark[start..start + rect.columns].fill(true);
        }
    }
}

/// The dark cells as rectangles, and the terms of the formula for their number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Partition {
    /// Disjoint; together exactly the dark cells; sorted by first row, then first column.
    pub rectangles: Vec<CellRect>,
    /// N: corners with three dark cells of four.
    pub concave_vertices: usize,
    /// L: the largest number of chords between concave vertices that do not meet.
    pub independent_chords: usize,
    /// H: free regions enclosed by dark cells.
    pub holes: usize,
    /// C: dark regions.
    pub components: usize,
}

impl Partition {
    /// Splits the dark cells of `mask` into the minimum number of rectangles. The result is deterministic.
    pub fn of(mask: &CellMask) -> Self {
        let mut grid = Grid::of(mask);
        let Chords { concave, horizontal, vertical, independent } = chords::find(&grid);
        for chord in horizontal.iter().filter(|chord| chord.kept) {
            grid.cut_row(chord.line, chord.from, chord.to);
        }
        for chord in vertical.iter().filter(|chord| chord.kept) {
            grid.cut_column(chord.line, chord.from, chord.to);
        }
        // Every concave vertex needs one cut. Vertices without a kept chord get a cut along their row, up to the end of
        // the region or to a chord across it. Two such cuts never meet head-on: together they would be a kept chord.
        for vertex in &concave {
            if !grid.is_cut(vertex.column, vertex.row) {
                grid.cut_from(vertex);
            }
        }
        let components = grid.count_components();
        // Euler: cells − edges between dark cells + vertices amid four dark cells = components − holes.
        let holes = (components as i64 - grid.euler_characteristic()) as usize;
        let rectangles = grid.take_rectangles();
        Self { rectangles, concave_vertices: concave.len(), independent_chords: independent, holes, components }
    }

    /// N − L − H + C, the number of rectangles.
    pub fn formula(&self) -> usize {
        self.concave_vertices + self.components - self.independent_chords - self.holes
    }
}

// Flags of a cell.
const DARK: u8 = 1;
/// A cut runs along its right edge.
const CUT_RIGHT: u8 = 2;
/// A cut runs along its lower edge.
const CUT_BELOW: u8 = 4;
/// Already counted in a component.
const COUNTED: u8 = 8;

/// A corner with exactly one free cell of four. Corners are counted from the upper left one of the grid.
#[derive(Clone, Copy, Debug)]
struct Vertex {
    column: usize,
    row: usize,
    /// The free cell is on the left, so the region continues to the right.
    opens_right: bool,
}

/// The mask with a border of free cells, so that every corner has four cells.
struct Grid {
    columns: usize,
    rows: usize,
    stride: usize,
    cells: Vec<u8>,
}

impl Grid {
    fn of(mask: &CellMask) -> Self {
        let stride = mask.columns + 2;
        let mut cells = vec![0; stride * (mask.rows + 2)];
        if mask.columns > 0 {
            for (row, dark) in mask.dark.chunks_exact(mask.columns).enumerate() {
                let start = (row + 1) * stride + 1;
                for (cell, &dark) in cells[start..].iter_mut().zip(dark) {
                    *cell = u8::from(dark) * DARK;
                }
            }
        }
        Self { columns: mask.columns, rows: mask.rows, stride, cells }
    }

    /// The four cells around a corner: upper left, upper right, lower left, lower right.
    fn around(&self, column: usize, row: usize) -> [usize; 4] {
        let upper_left = row * self.stride + column;
        [upper_left, upper_left + 1, upper_left + self.stride, upper_left + self.stride + 1]
    }

    /// Which of the four are dark, as bits in the same order.
    fn pattern(&self, column: usize, row: usize) -> u8 {
        let [a, b, c, d] = self.around(column, row).map(|cell| self.cells[cell] & DARK);
        a | b << 1 | c << 2 | d << 3
    }

    fn cut_row(&mut self, row: usize, from: usize, to: usize) {
        let above = row * self.stride;
        for cell in &mut self.cells[above + from + 1..=above + to] {
            *cell |= CUT_BELOW;
        }
    }

    fn cut_column(&mut self, column: usize, from: usize, to: usize) {
        for row in from..to {
            self.cells[(row + 1) * self.stride + column] |= CUT_RIGHT;
        }
    }

    /// Whether a cut passes or ends at a corner.
    fn is_cut(&self, column: usize, row: usize) -> bool {
        let [upper_left, upper_right, lower_left, _] = self.around(column, row).map(|cell| self.cells[cell]);
        (upper_left | upper_right) & CUT_BELOW != 0 || (upper_left | lower_left) & CUT_RIGHT != 0
    }

    /// Cuts along the row from a concave vertex into the region.
    fn cut_from(&mut self, vertex: &Vertex) {
        let mut to = vertex.column;
        loop {
            to = if vertex.opens_right { to + 1 } else { to - 1 };
            if self.pattern(to, vertex.row) != 0b1111 || self.is_cut(to, vertex.row) {
                break;
            }
        }
        self.cut_row(vertex.row, to.min(vertex.column), to.max(vertex.column));
    }

    fn count_components(&mut self) -> usize {
        let mut count = 0;
        let mut stack = Vec::new();
        for seed in 0..self.cells.len() {
            if self.cells[seed] & (DARK | COUNTED) != DARK {
                continue;
            }
            count += 1;
            self.cells[seed] |= COUNTED;
            stack.push(seed);
            while let Some(cell) = stack.pop() {
                for next in [cell - self.stride, cell - 1, cell + 1, cell + self.stride] {
                    if self.cells[next] & (DARK | COUNTED) == DARK {
                        self.cells[next] |= COUNTED;
                        stack.push(next);
                    }
                }
            }
        }
        count
    }

    fn euler_characteristic(&self) -> i64 {
        let mut sum = 0;
        for row in 0..=self.rows {
            for column in 0..=self.columns {
                let pattern = self.pattern(column, row);
                // The cell to the upper left, its right and lower edges, and the corner itself.
                sum += i64::from(pattern & 1) - i64::from(pattern & 0b0011 == 0b0011);
                sum += i64::from(pattern == 0b1111) - i64::from(pattern & 0b0101 == 0b0101);
            }
        }
        sum
    }

    /// Removes the rectangles between the cuts and returns them.
    fn take_rectangles(&mut self) -> Vec<CellRect> {
        let mut rectangles = Vec::new();
        for row in 0..self.rows {
            for column in 0..self.columns {
                let first = (row + 1) * self.stride + column + 1;
                if self.cells[first] & DARK == 0 {
                    continue;
                }
                let goes_on =
                    |at: usize, cut: u8, step: usize| self.cells[at] & cut == 0 && self.cells[at + step] & DARK != 0;
                let columns = 1 + (first..).take_while(|&at| goes_on(at, CUT_RIGHT, 1)).count();
                let down = (first..).step_by(self.stride);
                let rows = 1 + down.take_while(|&at| goes_on(at, CUT_BELOW, self.stride)).count();
                for start in (first..).step_by(self.stride).take(rows) {
                    self.cells[start..start + columns].fill(0);
                }
                rectangles.push(CellRect { column, row, columns, rows });
            }
        }
        rectangles
    }
}
