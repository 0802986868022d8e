//! Concave vertices, the chords between them, and a largest set of chords that do not meet.

use super::{Grid, Vertex};

/// A straight line through the region from one concave vertex to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chord {
    /// Row of corners of a horizontal chord, column of a vertical one.
    pub line: usize,
    /// Lower end on that line.
    pub from: usize,
    /// Upper end on that line.
    pub to: usize,
    /// In the independent set.
    pub kept: bool,
}

/// The boundary's data for the formula.
pub(super) struct Chords {
    pub concave: Vec<Vertex>,
    pub horizontal: Vec<Chord>,
    pub vertical: Vec<Chord>,
    /// Number of kept chords.
    pub independent: usize,
}

/// Finds all chords of `grid`, and a largest set of them without common points.
pub(super) fn find(grid: &Grid) -> Chords {
    let mut found = all(grid);
    let crossings = crossings(grid, &found);
    let cover = cover(&crossings, found.vertical.len());
    for (chord, covered) in found.horizontal.iter_mut().zip(cover.horizontal) {
        chord.kept = !covered;
    }
    for (chord, covered) in found.vertical.iter_mut().zip(cover.vertical) {
        chord.kept = !covered;
    }
    found.independent = found.horizontal.iter().chain(&found.vertical).filter(|chord| chord.kept).count();
    found
}

/// Visits all corners once. A chord starts at a concave vertex and continues while the four cells around each corner
/// are dark.
fn all(grid: &Grid) -> Chords {
    let (mut concave, mut horizontal, mut vertical) = (Vec::new(), Vec::new(), Vec::new());
    let mut open_above: Vec<Option<usize>> = vec![None; grid.columns + 1];
    for row in 0..=grid.rows {
        let mut open_left: Option<usize> = None;
        for (column, open_above) in open_above.iter_mut().enumerate() {
            let (opens_right, opens_below) = match grid.pattern(column, row) {
                0b1111 => continue,
                0b1110 => (true, true),
                0b1101 => (false, true),
                0b1011 => (true, false),
                0b0111 => (false, false),
                _ => {
                    (open_left, *open_above) = (None, None);
                    continue;
                }
            };
            concave.push(Vertex { column, row, opens_right });
            if let (Some(from), false) = (open_left, opens_right) {
                horizontal.push(Chord { line: row, from, to: column, kept: false });
            }
            if let (Some(from), false) = (*open_above, opens_below) {
                vertical.push(Chord { line: column, from, to: row, kept: false });
            }
            open_left = opens_right.then_some(column);
            *open_above = opens_below.then_some(row);
        }
    }
    Chords { concave, horizontal, vertical, independent: 0 }
}

/// For each horizontal chord, the vertical ones that it meets, including at common ends.
fn crossings(grid: &Grid, chords: &Chords) -> Vec<Vec<usize>> {
    if chords.vertical.is_empty() {
        return vec![Vec::new(); chords.horizontal.len()];
    }
    let stride = grid.columns + 1;
    let mut vertical_at = vec![None; stride * (grid.rows + 1)];
    for (index, chord) in chords.vertical.iter().enumerate() {
        for row in chord.from..=chord.to {
            vertical_at[row * stride + chord.line] = Some(index);
        }
    }
    let met = |chord: &Chord| {
        let row = &vertical_at[chord.line * stride..][chord.from..=chord.to];
        row.iter().copied().flatten().collect()
    };
    chords.horizontal.iter().map(met).collect()
}

/// The smallest set of chords that meets all crossings; the other chords are independent.
struct Cover {
    horizontal: Vec<bool>,
    vertical: Vec<bool>,
}

/// König's cover, by augmenting paths found breadth-first.
///
/// The chords reached by a failed search can be excluded from all later ones. They are the chords of König's theorem:
/// those reached from an unmatched horizontal chord. The cover is every reached vertical chord and every horizontal
/// chord that is not reached.
fn cover(crossings: &[Vec<usize>], verticals: usize) -> Cover {
    let mut mate_of_horizontal: Vec<Option<usize>> = vec![None; crossings.len()];
    let mut mate_of_vertical: Vec<Option<usize>> = vec![None; verticals];
    let mut cover = Cover { horizontal: vec![true; crossings.len()], vertical: vec![false; verticals] };
    // For each vertical chord, the horizontal one from which it was reached.
    let mut reached_from = vec![0; verticals];
    let (mut queue, mut reached) = (Vec::new(), Vec::new());
    for root in 0..crossings.len() {
        queue.clear();
        reached.clear();
        queue.push(root);
        let mut next = 0;
        let mut free_end = None;
        'search: while let Some(&horizontal) = queue.get(next) {
            next += 1;
            for &vertical in &crossings[horizontal] {
                if cover.vertical[vertical] {
                    continue;
                }
                cover.vertical[vertical] = true;
                reached.push(vertical);
                reached_from[vertical] = horizontal;
                match mate_of_vertical[vertical] {
                    Some(mate) => queue.push(mate),
                    None => {
                        free_end = Some(vertical);
                        break 'search;
                    }
                }
            }
        }
        if free_end.is_some() {
            reached.iter().for_each(|&vertical| cover.vertical[vertical] = false);
        } else {
            queue.iter().for_each(|&horizontal| cover.horizontal[horizontal] = false);
        }
        while let Some(vertical) = free_end {
            let horizontal = reached_from[vertical];
            mate_of_vertical[vertical] = Some(horizontal);
            free_end = mate_of_horizontal[horizontal].replace(vertical);
        }
    }
    cover
}
