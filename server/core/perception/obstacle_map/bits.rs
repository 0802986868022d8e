//! A grid with one bit per cell.

use serde::{Deserialize, Serialize};

const WORD_BITS: usize = 64;
const WORD_BYTES: usize = WORD_BITS / 8;

/// Bits of a grid, row by row, each row padded to whole words. Stored as bytes, which serialise in one piece: the map
/// is hashed at every tick.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct BitGrid {
    pub columns: usize,
    pub rows: usize,
    #[serde(with = "serde_bytes")]
    bytes: Vec<u8>,
}

impl BitGrid {
    pub fn zero(columns: usize, rows: usize) -> Self {
        let bytes = vec![0; columns.div_ceil(WORD_BITS) * rows * WORD_BYTES];
        Self { columns, rows, bytes }
    }

    /// Whether the number of bytes matches the shape; data from a file may not.
    pub fn is_whole(&self) -> bool {
        let bytes = self.columns.div_ceil(WORD_BITS).checked_mul(self.rows).and_then(|n| n.checked_mul(WORD_BYTES));
        bytes == Some(self.bytes.len())
    }

    pub fn get(&self, column: usize, row: usize) -> bool {
        self.bytes[self.byte(column, row)] >> (column % 8) & 1 == 1
    }

    pub fn flip(&mut self, column: usize, row: usize) {
        let byte = self.byte(column, row);
        self.bytes[byte] ^= 1 << (column % 8);
    }

    /// Whether any bit of the row is set in the half-open column range.
    pub fn any(&self, row: usize, from: usize, to: usize) -> bool {
        self.words(row, from, to).any(|(_, word, mask)| word & mask != 0)
    }

    /// Whether all bits of the row are set in the half-open column range.
    pub fn all(&self, row: usize, from: usize, to: usize) -> bool {
        self.words(row, from, to).all(|(_, word, mask)| !word & mask == 0)
    }

    /// The nearest set bit of the row at `column` or after it.
    pub fn next(&self, row: usize, column: usize) -> Option<usize> {
        let mut words = self.words(row, column, self.columns).map(|(first, word, mask)| (first, word & mask));
        words.find(|&(_, word)| word != 0).map(|(first, word)| first + word.trailing_zeros() as usize)
    }

    /// The nearest set bit of the row at `column` or before it.
    pub fn previous(&self, row: usize, column: usize) -> Option<usize> {
        let mut words = self.words(row, 0, column + 1).rev().map(|(first, word, mask)| (first, word & mask));
        words.find(|&(_, word)| word != 0).map(|(first, word)| first + word.ilog2() as usize)
    }

    /// The words of a row for a half-open column range, which must be inside the grid. Each comes with its first column
    /// and with a mask of the bits in the range.
    fn words(&self, row: usize, from: usize, to: usize) -> impl DoubleEndedIterator<Item = (usize, u64, u64)> {
        let start = row * self.columns.div_ceil(WORD_BITS);
        (from / WORD_BITS..to.div_ceil(WORD_BITS)).map(move |index| {
            let first = index * WORD_BITS;
            let mask = u64::MAX << from.saturating_sub(first) & u64::MAX >> (first + WORD_BITS).saturating_sub(to);
            let at = (start + index) * WORD_BYTES;
            let bytes = self.bytes[at..at + WORD_BYTES].try_into().expect("a word has eight bytes");
            (first, u64::from_le_bytes(bytes), mask)
        })
    }

    fn byte(&self, column: usize, row: usize) -> usize {
        row * self.columns.div_ceil(WORD_BITS) * WORD_BYTES + column / 8
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rows_agree_with_a_list_of_flags(
            (flags, from, to) in prop::collection::vec(any::<bool>(), 1..200).prop_flat_map(|flags| {
                let columns = flags.len();
                (Just(flags), 0..columns, 0..=columns)
            }),
        ) {
            // The middle row must not depend on its neighbours.
            let mut grid = BitGrid::zero(flags.len(), 3);
            for (column, &flag) in flags.iter().enumerate() {
                grid.flip(column, 0);
                grid.flip(column, 2);
                if flag {
                    grid.flip(column, 1);
                }
            }
            prop_assert!(grid.is_whole());
            prop_assert!((0..flags.len()).all(|column| grid.get(column, 1) == flags[column]));
            prop_assert_eq!(grid.next(1, from), (from..flags.len()).find(|&column| flags[column]));
            prop_assert_eq!(grid.previous(1, from), (0..=from).rev().find(|&column| flags[column]));
            if from < to {
                prop_assert_eq!(grid.any(1, from, to), flags[from..to].iter().any(|&flag| flag));
                prop_assert_eq!(grid.all(1, from, to), flags[from..to].iter().all(|&flag| flag));
            }
        }
    }
}
