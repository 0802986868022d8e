//! Compares all small masks with an exhaustive search, and larger ones with the formula, whose terms are counted
//! independently.

use pathfinding::matrix::Matrix;
use pathfinding::prelude::{connected_components, kuhn_munkres};
use proptest::prelude::*;

use super::*;
use crate::geometry::Point2;
use crate::perception::test_world::{channel, posts, seen_from, simple};
use crate::perception::{Quadtree, QuadtreeParameters};

fn mask(columns: usize, rows: usize, is_dark: impl Fn(usize, usize) -> bool) -> CellMask {
    let dark = (0..columns * rows).map(|i| is_dark(i % columns, i / columns)).collect();
    CellMask { columns, rows, dark }
}

fn drawn(lines: &[&str]) -> CellMask {
    mask(lines[0].len(), lines.len(), |column, row| lines[row].as_bytes()[column] == b'#')
}

/// The partition, after checks that it is valid.
fn checked(mask: &CellMask) -> Partition {
    let partition = Partition::of(mask);
    let mut covered = CellMask::free(mask.columns, mask.rows);
    let mut area = 0;
    for rect in &partition.rectangles {
        covered.darken(rect);
        area += rect.columns * rect.rows;
    }
    assert_eq!(&covered, mask, "not covered exactly");
    assert_eq!(area, mask.dark.iter().filter(|&&dark| dark).count(), "not disjoint");
    assert_eq!(partition.rectangles.len(), partition.formula(), "{partition:?}");
    partition
}

/// Minimum number of rectangles for every mask of a grid. One of the rectangles has the first dark cell as its upper
/// left cell.
fn exhaustive(columns: usize, rows: usize) -> Vec<u8> {
    let rectangles_at: Vec<Vec<usize>> = (0..columns * rows)
        .map(|first| {
            let (column, row) = (first % columns, first / columns);
            let bits = |width: usize, height: usize| -> usize {
                (row..row + height).map(|r| ((1 << width) - 1) << (r * columns + column)).sum()
            };
            (1..=columns - column).flat_map(|w| (1..=rows - row).map(move |h| bits(w, h))).collect()
        })
        .collect();
    let mut fewest = vec![0u8; 1 << (columns * rows)];
    for cells in 1..fewest.len() {
        let first = cells.trailing_zeros() as usize;
        let fitting = rectangles_at[first].iter().filter(|&&rect| cells & rect == rect);
        fewest[cells] = 1 + fitting.map(|&rect| fewest[cells & !rect]).min().expect("the cell itself fits");
    }
    fewest
}

#[test]
fn every_mask_of_up_to_four_by_five_cells_has_the_minimum() {
    for (columns, rows) in [(1, 1), (2, 3), (3, 3), (4, 4), (4, 5), (5, 4)] {
        for (cells, &fewest) in exhaustive(columns, rows).iter().enumerate() {
            let mask = mask(columns, rows, |column, row| cells >> (row * columns + column) & 1 == 1);
            assert_eq!(checked(&mask).rectangles.len(), usize::from(fewest), "{mask:?}");
        }
    }
}

#[test]
fn random_masks_of_five_by_five_have_the_minimum() {
    let fewest = exhaustive(5, 5);
    let mut cells = 0x5eed_u64;
    for round in 0..200_000 {
        // Knuth's generator; combinations of two draws make some masks dense and some sparse.
        let mut draw = || {
            cells = cells.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (cells >> 33) as usize & 0x1ff_ffff
        };
        let cells = match round % 3 {
            0 => draw(),
            1 => draw() | draw(),
            _ => draw() & draw(),
        };
        let mask = mask(5, 5, |column, row| cells >> (row * 5 + column) & 1 == 1);
        assert_eq!(checked(&mask).rectangles.len(), usize::from(fewest[cells]), "{mask:?}");
    }
}

#[test]
fn degenerate_masks_have_the_documented_terms() {
    let terms = |lines: &[&str]| {
        let p = checked(&drawn(lines));
        [p.rectangles.len(), p.concave_vertices, p.independent_chords, p.holes, p.components]
    };
    assert_eq!(terms(&["..", ".."]), [0, 0, 0, 0, 0]);
    assert_eq!(terms(&["###", "###"]), [1, 0, 0, 0, 1]);
    // Two cells that touch at a corner are two regions.
    assert_eq!(terms(&["#.", ".#"]), [2, 0, 0, 0, 2]);
    assert_eq!(terms(&["###", "#.#", "###"]), [4, 4, 0, 1, 1]);
    // The middle is closed off by a corner only.
    assert_eq!(terms(&["##.", "#.#", "###"]), [4, 3, 0, 0, 1]);
    // A cross: four vertices, two chords per direction; all chords share ends with those of the other direction.
    assert_eq!(terms(&[".#.", "###", ".#."]), [3, 4, 2, 0, 1]);
    // A staircase: no two vertices face each other.
    assert_eq!(terms(&["#..", "##.", "###"]), [3, 2, 0, 0, 1]);
    assert_eq!(checked(&CellMask::free(0, 0)).rectangles, []);
    assert_eq!(checked(&CellMask::free(0, 3)).rectangles, []);
}

/// Independent counts of the formula's terms.
fn independent_terms(mask: &CellMask) -> [usize; 4] {
    let (columns, rows) = (mask.columns as i64, mask.rows as i64);
    let inside = |x: i64, y: i64| (0..columns).contains(&x) && (0..rows).contains(&y);
    let dark = |x: i64, y: i64| inside(x, y) && mask.dark[(y * columns + x) as usize];
    let concave = |x: i64, y: i64| {
        [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)].iter().filter(|&&(x, y)| dark(x, y)).count() == 3
    };
    let corners: Vec<(i64, i64)> = (0..=rows).flat_map(|y| (0..=columns).map(move |x| (x, y))).collect();
    let vertices: Vec<_> = corners.iter().copied().filter(|&(x, y)| concave(x, y)).collect();
    // A chord joins two concave vertices of a line if all cells along both sides of it are dark.
    let (mut across, mut down) = (Vec::new(), Vec::new());
    for &(x, y) in &vertices {
        for &(u, v) in &vertices {
            if y == v && x < u && (x..u).all(|at| dark(at, y - 1) && dark(at, y)) {
                across.push((y, x, u));
            }
            if x == u && y < v && (y..v).all(|at| dark(x - 1, at) && dark(x, at)) {
                down.push((x, y, v));
            }
        }
    }
    let matched = if across.is_empty() || down.is_empty() {
        0
    } else {
        let meet = |&(y, from, to): &(i64, i64, i64), &(x, top, bottom): &(i64, i64, i64)| {
            i32::from((from..=to).contains(&x) && (top..=bottom).contains(&y))
        };
        let (few, many, swapped) =
            if across.len() <= down.len() { (&across, &down, false) } else { (&down, &across, true) };
        let weight = |i: usize, j: usize| if swapped { meet(&many[j], &few[i]) } else { meet(&few[i], &many[j]) };
        let weights = Matrix::from_fn(few.len(), many.len(), |(i, j)| weight(i, j));
        kuhn_munkres(&weights).0 as usize
    };
    let by_edges = [(0, 1), (1, 0), (0, -1), (-1, 0)];
    let by_corners = [(0, 1), (1, 0), (0, -1), (-1, 0), (1, 1), (1, -1), (-1, 1), (-1, -1)];
    let regions = |is_dark: bool, steps: &[(i64, i64)], margin: i64| {
        let cells: Vec<(i64, i64)> = (-margin..rows + margin)
            .flat_map(|y| (-margin..columns + margin).map(move |x| (x, y)))
            .filter(|&(x, y)| dark(x, y) == is_dark)
            .collect();
        let near = |&(x, y): &(i64, i64)| -> Vec<(i64, i64)> {
            let next = steps.iter().map(|(dx, dy)| (x + dx, y + dy));
            let in_range = |&(x, y): &(i64, i64)| {
                (-margin..columns + margin).contains(&x) && (-margin..rows + margin).contains(&y)
            };
            next.filter(in_range).filter(|&(x, y)| dark(x, y) == is_dark).collect()
        };
        connected_components(&cells, near).len()
    };
    let independent = across.len() + down.len() - matched;
    [vertices.len(), independent, regions(false, &by_corners, 1) - 1, regions(true, &by_edges, 0)]
}

#[test]
fn camera_images_have_the_minimum_of_the_formula() {
    let finer = QuadtreeParameters { smallest_px: 3, ..Default::default() };
    for (name, world) in [("simple", simple as fn(_) -> _), ("channel", channel), ("posts", posts)] {
        for center in [Point2::new(-0.2, -0.42), Point2::new(0.013, -0.37), Point2::new(0.2, -0.3)] {
            let gray = seen_from(center, world).gray;
            for parameters in [QuadtreeParameters::default(), QuadtreeParameters::PAPER, finer] {
                let tree = Quadtree::of(&gray, &parameters);
                let p = tree.partition();
                assert_eq!(p, checked(&tree.mask));
                let terms = [p.concave_vertices, p.independent_chords, p.holes, p.components];
                assert_eq!(terms, independent_terms(&tree.mask), "{name} from {center}");
                assert!(p.rectangles.len() <= tree.dark.len());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn the_terms_of_random_masks_match_independent_counts(
        (columns, rows, dark) in (1..16usize, 1..16usize).prop_flat_map(|(w, h)| {
            let cells = (0..=100u32).prop_flat_map(move |share| {
                prop::collection::vec((0..100u32).prop_map(move |draw| draw < share), w * h)
            });
            (Just(w), Just(h), cells)
        }),
    ) {
        let mask = CellMask { columns, rows, dark };
        let p = checked(&mask);
        let terms = [p.concave_vertices, p.independent_chords, p.holes, p.components];
        prop_assert_eq!(terms, independent_terms(&mask));
    }

    #[test]
    fn the_terms_of_masks_of_boxes_match_independent_counts(
        boxes in prop::collection::vec((0..24usize, 0..24usize, 1..14usize, 1..14usize, any::<bool>()), 1..14),
    ) {
        let mut mask = CellMask::free(24, 24);
        for (column, row, columns, rows, is_dark) in boxes {
            for r in row..(row + rows).min(24) {
                mask.dark[r * 24 + column..r * 24 + (column + columns).min(24)].fill(is_dark);
            }
        }
        let p = checked(&mask);
        let terms = [p.concave_vertices, p.independent_chords, p.holes, p.components];
        prop_assert_eq!(terms, independent_terms(&mask));
    }
}
