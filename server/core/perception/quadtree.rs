//! Quadtree of a camera image: dark and free blocks (paper, §IV-C; Finkel & Bentley 1974).

use super::dark::{DarkPixels, OBSTACLE_LEVEL, PixelRect};
use super::rectangles::{CellMask, CellRect, Partition};
use crate::image::GrayImage;

/// Parameters set by the operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QuadtreeParameters {
    /// Gray levels at or below this are obstacles.
    pub threshold: u8,
    /// Smallest side of a block. 0 counts as 1; larger than the image counts as the image.
    pub smallest_px: usize,
}

impl Default for QuadtreeParameters {
    fn default() -> Self {
        Self { threshold: OBSTACLE_LEVEL, smallest_px: 6 }
    }
}

impl QuadtreeParameters {
    /// The paper's figures: blocks so large that they close a channel of 4 cm.
    pub const PAPER: Self = Self { threshold: 50, smallest_px: 50 };
}

/// The blocks of an image. A block without dark pixels is free, one without free pixels is dark. Any other is split; if
/// it cannot be split, it counts as dark.
///
/// **How it splits.** The size of an image is rarely a power of two. Each axis is first cut into as many nearly equal
/// cells as fit with `smallest_px` each: 80 of 6 px in 480, or 9 of 53 and 54 px for 50. Blocks consist of whole cells
/// and split at the middle cell line of each axis with at least two cells; for an odd count the first half is smaller.
/// So no block is smaller than `smallest_px`, and the finest grid is regular.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quadtree {
    /// Dark blocks, in the tree's order.
    pub dark: Vec<PixelRect>,
    /// Free blocks, in the tree's order.
    pub free: Vec<PixelRect>,
    /// The dark cells of the finest grid, top row first.
    pub mask: CellMask,
    /// Starts of the cell columns, and the end of the last one.
    column_lines_px: Vec<usize>,
    /// Starts of the cell rows, and the end of the last one.
    row_lines_px: Vec<usize>,
}

impl Quadtree {
    /// The blocks of `gray`.
    pub fn of(gray: &GrayImage, parameters: &QuadtreeParameters) -> Self {
        Self::of_dark(&DarkPixels::of(gray, parameters.threshold), parameters.smallest_px)
    }

    /// The blocks of dark pixels that are already counted.
    pub fn of_dark(dark: &DarkPixels, smallest_px: usize) -> Self {
        let column_lines_px = lines_px(dark.width_px(), smallest_px);
        let row_lines_px = lines_px(dark.height_px(), smallest_px);
        let (columns, rows) = (column_lines_px.len() - 1, row_lines_px.len() - 1);
        let mask = CellMask::free(columns, rows);
        let mut tree = Self { dark: Vec::new(), free: Vec::new(), mask, column_lines_px, row_lines_px };
        if columns > 0 && rows > 0 {
            tree.split(dark, CellRect { column: 0, row: 0, columns, rows });
        }
        tree
    }

    fn split(&mut self, dark: &DarkPixels, cells: CellRect) {
        let block = self.pixels(&cells);
        let CellRect { column, row, columns, rows } = cells;
        match dark.count(&block) {
            0 => self.free.push(block),
            count if count == block.area_px() || (columns == 1 && rows == 1) => {
                self.mask.darken(&cells);
                self.dark.push(block);
            }
            _ => {
                for (row, rows) in halves(row, rows) {
                    for (column, columns) in halves(column, columns) {
                        self.split(dark, CellRect { column, row, columns, rows });
                    }
                }
            }
        }
    }

    /// The pixels of a rectangle of cells.
    pub fn pixels(&self, cells: &CellRect) -> PixelRect {
        let (left, right) = (self.column_lines_px[cells.column], self.column_lines_px[cells.column + cells.columns]);
        let (top, bottom) = (self.row_lines_px[cells.row], self.row_lines_px[cells.row + cells.rows]);
        PixelRect { column_px: left, row_px: top, width_px: right - left, height_px: bottom - top }
    }

    /// The dark blocks merged into the minimum number of rectangles; [`Quadtree::pixels`] gives their positions. The
    /// quadtree alone has `self.dark.len()`.
    pub fn partition(&self) -> Partition {
        Partition::of(&self.mask)
    }

    /// The image at the resolution of its blocks: every pixel of a dark block is dark.
    pub fn dark_pixels(&self) -> DarkPixels {
        let [width_px, height_px] =
            [&self.column_lines_px, &self.row_lines_px].map(|lines| lines.last().copied().unwrap_or(0));
        let mut pixels = vec![u8::MAX; width_px * height_px];
        for block in &self.dark {
            for row in pixels.chunks_exact_mut(width_px).skip(block.row_px).take(block.height_px) {
                row[block.column_px..block.column_px + block.width_px].fill(0);
            }
        }
        DarkPixels::of(&GrayImage { width_px, height_px, pixels }, 0)
    }
}

/// Cuts `size_px` into as many nearly equal parts as fit with `smallest_px` each.
fn lines_px(size_px: usize, smallest_px: usize) -> Vec<usize> {
    let count = (size_px / smallest_px.max(1)).max(size_px.min(1));
    (0..=count).map(|i| i * size_px / count.max(1)).collect()
}

/// First cell and count of each half; a single cell stays whole.
fn halves(first: usize, count: usize) -> impl Iterator<Item = (usize, usize)> {
    let lesser = count / 2;
    [(first, lesser), (first + lesser, count - lesser)].into_iter().filter(|&(_, count)| count > 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn gray(width_px: usize, height_px: usize, is_dark: impl Fn(usize, usize) -> bool) -> GrayImage {
        let pixels =
            (0..width_px * height_px).map(|i| if is_dark(i % width_px, i / width_px) { 20 } else { 230 }).collect();
        GrayImage { width_px, height_px, pixels }
    }

    #[test]
    fn the_finest_grid_is_regular_and_not_finer_than_requested() {
        let steps = |size_px, smallest_px| -> Vec<usize> {
            lines_px(size_px, smallest_px).windows(2).map(|pair| pair[1] - pair[0]).collect()
        };
        assert_eq!(steps(480, 6), [6; 80]);
        assert_eq!(steps(480, 50), [53, 53, 54, 53, 53, 54, 53, 53, 54]);
        assert_eq!(steps(480, 481), [480]);
        assert_eq!(steps(3, 0), [1; 3]);
        assert_eq!(steps(0, 6), [0; 0]);
    }

    #[test]
    fn a_uniform_image_is_one_block_and_one_dark_pixel_is_one_smallest_block() {
        let parameters = QuadtreeParameters::default();
        let whole = PixelRect { column_px: 0, row_px: 0, width_px: 480, height_px: 480 };
        let tree = Quadtree::of(&gray(480, 480, |_, _| true), &parameters);
        assert_eq!((tree.dark.as_slice(), tree.free.len()), ([whole].as_slice(), 0));
        let tree = Quadtree::of(&gray(480, 480, |_, _| false), &parameters);
        assert_eq!((tree.dark.len(), tree.free.as_slice()), (0, [whole].as_slice()));
        let tree = Quadtree::of(&gray(480, 480, |x, y| (x, y) == (100, 200)), &parameters);
        assert_eq!(tree.dark, [PixelRect { column_px: 96, row_px: 198, width_px: 6, height_px: 6 }]);
        let tree = Quadtree::of(&gray(480, 480, |x, y| (x, y) == (100, 200)), &QuadtreeParameters::PAPER);
        assert_eq!(tree.dark, [PixelRect { column_px: 53, row_px: 160, width_px: 53, height_px: 53 }]);
    }

    #[test]
    fn the_threshold_itself_is_dark() {
        let image = GrayImage { width_px: 2, height_px: 1, pixels: vec![50, 51] };
        let tree = Quadtree::of(&image, &QuadtreeParameters { threshold: 50, smallest_px: 1 });
        assert_eq!(tree.mask.dark, [true, false]);
    }

    #[test]
    fn an_empty_image_has_no_blocks() {
        let tree = Quadtree::of(&gray(0, 0, |_, _| true), &QuadtreeParameters::default());
        assert!(tree.dark.is_empty() && tree.free.is_empty() && tree.partition().rectangles.is_empty());
        assert_eq!(tree.dark_pixels(), DarkPixels::of(&gray(0, 0, |_, _| true), 0));
    }

    proptest! {
        #[test]
        fn blocks_tile_the_image_and_are_uniform(
            (width_px, height_px, seeds) in (1..70usize, 1..70usize).prop_flat_map(|(w, h)| {
                (Just(w), Just(h), prop::collection::vec((0..w, 0..h, 1..20usize, 1..20usize), 0..6))
            }),
            smallest_px in 0..12usize,
        ) {
            let dark_at = |x: usize, y: usize| {
                seeds.iter().any(|&(left, top, w, h)| (left..left + w).contains(&x) && (top..top + h).contains(&y))
            };
            let image = gray(width_px, height_px, dark_at);
            let tree = Quadtree::of(&image, &QuadtreeParameters { threshold: 50, smallest_px });
            let mut covered = vec![0; width_px * height_px];
            for (blocks, mark) in [(&tree.dark, 1), (&tree.free, 2)] {
                for block in blocks {
                    prop_assert!(block.width_px >= smallest_px.min(width_px));
                    prop_assert!(block.height_px >= smallest_px.min(height_px));
                    let count = DarkPixels::of(&image, 50).count(block);
                    prop_assert_eq!(count > 0, mark == 1);
                    // Only blocks of the smallest size are mixed.
                    let smallest = block.width_px < 2 * smallest_px.max(1) && block.height_px < 2 * smallest_px.max(1);
                    prop_assert!(count == 0 || count == block.area_px() || smallest);
                    for y in block.row_px..block.row_px + block.height_px {
                        for x in block.column_px..block.column_px + block.width_px {
                            prop_assert_eq!(covered[y * width_px + x], 0);
                            covered[y * width_px + x] = mark;
                        }
                    }
                }
            }
            prop_assert!(covered.iter().all(|&mark| mark != 0));
            // The mask and the coarse image agree with the blocks.
            let coarse = tree.dark_pixels();
            for (cell, &is_dark) in tree.mask.dark.iter().enumerate() {
                let (column, row) = (cell % tree.mask.columns, cell / tree.mask.columns);
                let block = tree.pixels(&CellRect { column, row, columns: 1, rows: 1 });
                prop_assert_eq!(covered[block.row_px * width_px + block.column_px] == 1, is_dark);
                prop_assert_eq!(coarse.count(&block), if is_dark { block.area_px() } else { 0 });
            }
        }
    }
}
