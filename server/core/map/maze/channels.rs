//! Mazes that are cut out: tubes and trees on a grid, and spirals.

use kurbo::{Cap, Point, Vec2};
use rand::RngExt;
use rand::seq::IndexedRandom;
use rand_chacha::ChaCha8Rng;

use super::between;
use super::ink::{Ink, PAGE_MM};

/// Thickness of the walls between channels.
const WALLS_MM: [f64; 2] = [10.0, 30.0];
/// The wall between two channels that come near each other.
const THINNEST_MM: f64 = 8.0;
/// Share of the grid's cells that a tree grows over.
const GROWTH: [f64; 2] = [0.6, 1.0];
const FOLD_MM: f64 = 8.0;
/// Distance from one fold to the next.
const FOLDS_MM: [f64; 2] = [50.0, 140.0];
/// A fold leaves at least this share of the channel open, and never less than this.
const OPEN_SHARE: f64 = 0.55;
const OPEN_MM: f64 = 32.0;
const BEYOND_MM: f64 = 1.0;
/// Corners are cut this many times.
const ROUNDINGS: usize = 3;

/// Cells in rows and columns, each with a place, and a tree that connects them.
struct Grid {
    columns: usize,
    places: Vec<Point>,
    /// Cells that the tree connects to each cell.
    links: Vec<Vec<usize>>,
}

impl Grid {
    /// Grows a random tree over some of the cells.
    fn grow(width_mm: f64, growth: f64, rng: &mut ChaCha8Rng) -> Self {
        let [left, top, page_width, page_height] = PAGE_MM;
        let wall_mm = between(WALLS_MM[0], WALLS_MM[1], rng);
        let fit = |side_mm: f64| ((side_mm - wall_mm) / (width_mm + wall_mm)).floor().max(1.0);
        let (columns, rows) = (fit(page_width), fit(page_height));
        let pitch = Vec2::new((page_width - wall_mm) / columns, (page_height - wall_mm) / rows);
        let slack = |pitch_mm: f64| 0.5 * (pitch_mm - width_mm - THINNEST_MM).max(0.0);
        let (columns, rows) = (columns as usize, rows as usize);
        let places = (0..columns * rows).map(|cell| {
            let (column, row) = ((cell % columns) as f64, (cell / columns) as f64);
            let shift = Vec2::new(between(-1.0, 1.0, rng) * slack(pitch.x), between(-1.0, 1.0, rng) * slack(pitch.y));
            let corner = Point::new(left + 0.5 * wall_mm, top + 0.5 * wall_mm);
            corner + Vec2::new((column + 0.5) * pitch.x, (row + 0.5) * pitch.y) + shift
        });
        let places: Vec<Point> = places.collect();
        let mut grid = Self { columns, links: vec![Vec::new(); places.len()], places };
        let wanted = ((growth * grid.places.len() as f64).ceil() as usize).max(2.min(grid.places.len()));
        let mut grown = vec![rng.random_range(0..grid.places.len())];
        let mut open = grown.clone();
        while grown.len() < wanted && !open.is_empty() {
            // Mostly the newest cell, which gives long branches; sometimes any, which gives many.
            let index = if rng.random_bool(0.8) { open.len() - 1 } else { rng.random_range(0..open.len()) };
            let free: Vec<usize> = grid.neighbors(open[index]).filter(|cell| !grown.contains(cell)).collect();
            let Some(&next) = free.choose(rng) else {
                open.swap_remove(index);
                continue;
            };
            let from = open[index];
            grid.links[from].push(next);
            grid.links[next].push(from);
            grown.push(next);
            open.push(next);
        }
        grid
    }

    fn neighbors(&self, cell: usize) -> impl Iterator<Item = usize> + use<> {
        let (column, columns, count) = (cell % self.columns, self.columns, self.places.len());
        [
            (column > 0).then(|| cell - 1),
            (column + 1 < columns).then(|| cell + 1),
            cell.checked_sub(columns),
            Some(cell + columns).filter(|&below| below < count),
        ]
        .into_iter()
        .flatten()
    }

    /// The path from a cell to the farthest one of its tree.
    fn farthest(&self, from: usize) -> Vec<usize> {
        let mut paths = vec![vec![from]];
        let mut next = 0;
        while let Some(path) = paths.get(next).cloned() {
            let here = path[path.len() - 1];
            for &cell in self.links[here].iter().filter(|cell| !path.contains(cell)) {
                paths.push([&path[..], &[cell]].concat());
            }
            next += 1;
        }
        // Breadth first: the last one is among the longest.
        paths.pop().unwrap_or_default()
    }

    /// The longest path of the tree.
    fn longest(&self) -> Vec<usize> {
        let grown = self.links.iter().position(|links| !links.is_empty()).unwrap_or_default();
        let end = self.farthest(grown);
        self.farthest(end[end.len() - 1])
    }
}

/// Cuts the corners of a line (Chaikin 1974).
fn rounded(mut line: Vec<Point>) -> Vec<Point> {
    for _ in 0..ROUNDINGS {
        let (Some(&first), Some(&last)) = (line.first(), line.last()) else { return line };
        let cut = line.windows(2).flat_map(|pair| [pair[0].lerp(pair[1], 0.25), pair[0].lerp(pair[1], 0.75)]);
        line = std::iter::once(first).chain(cut).chain(std::iter::once(last)).collect();
    }
    line
}

/// One wandering channel, narrowed by folds.
pub fn tube(width_mm: f64, rng: &mut ChaCha8Rng) -> Ink {
    let grid = Grid::grow(width_mm, 1.0, rng);
    let line = rounded(grid.longest().into_iter().map(|cell| grid.places[cell]).collect());
    let mut ink = Ink::default();
    ink.channel(&line, width_mm);
    let longest_mm = width_mm - OPEN_MM.max(OPEN_SHARE * width_mm);
    let mut ahead_mm = between(FOLDS_MM[0], FOLDS_MM[1], rng);
    for pair in line.windows(2) {
        let along = pair[1] - pair[0];
        ahead_mm -= along.hypot();
        if ahead_mm > 0.0 || along.hypot() == 0.0 {
            continue;
        }
        ahead_mm = between(FOLDS_MM[0], FOLDS_MM[1], rng);
        let side = if rng.random_bool(0.5) { 1.0 } else { -1.0 };
        let across = Vec2::new(-along.y, along.x).normalize() * side;
        let length_mm = between(0.3, 1.0, rng) * longest_mm - 0.5 * FOLD_MM;
        if length_mm > 0.0 {
            let [root, tip] =
                [0.5 * width_mm + 1.0, 0.5 * width_mm - length_mm].map(|far_mm| pair[0] + across * far_mm);
            ink.wall(&[root, tip], FOLD_MM, Cap::Round);
        }
    }
    ink
}

/// A channel that branches.
pub fn tree(width_mm: f64, rng: &mut ChaCha8Rng) -> Ink {
    let growth = between(GROWTH[0], GROWTH[1], rng);
    let grid = Grid::grow(width_mm, growth, rng);
    let mut ink = Ink::default();
    for (cell, links) in grid.links.iter().enumerate() {
        for &next in links.iter().filter(|&&next| next > cell) {
            ink.channel(&[grid.places[cell], grid.places[next]], width_mm);
        }
    }
    ink
}

/// A channel that winds to the middle.
pub fn spiral(width_mm: f64, rng: &mut ChaCha8Rng) -> Ink {
    let wall_mm = between(WALLS_MM[0], 0.5 * WALLS_MM[1], rng);
    let pitch_mm = width_mm + wall_mm;
    let [x, y, width, height] = PAGE_MM;
    // Cut a little beyond the border, so that no outline touches it.
    let inset_mm = 0.5 * width_mm - BEYOND_MM;
    let (mut left, mut right) = (x + inset_mm, x + width - inset_mm);
    let (mut top, mut bottom) = (y + inset_mm, y + height - inset_mm);
    let mut line = vec![Point::new(left, top)];
    loop {
        line.push(Point::new(right, top));
        top += pitch_mm;
        if top > bottom {
            break;
        }
        line.push(Point::new(right, bottom));
        right -= pitch_mm;
        if right < left {
            break;
        }
        line.push(Point::new(left, bottom));
        bottom -= pitch_mm;
        if bottom < top {
            break;
        }
        line.push(Point::new(left, top));
        left += pitch_mm;
        if left > right {
            break;
        }
    }
    let mirrored = [rng.random_bool(0.5), rng.random_bool(0.5)];
    for point in &mut line {
        if mirrored[0] {
            point.x = 2.0 * x + width - point.x;
        }
        if mirrored[1] {
            point.y = 2.0 * y + height - point.y;
        }
    }
    let mut ink = Ink::default();
    ink.channel(&line, width_mm);
    ink
}
