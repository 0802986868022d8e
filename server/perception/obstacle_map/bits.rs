//! One bit a cell, a row after the other, each row padded to whole words.

use serde::{Deserialize, Serialize};

const WORD_BITS: usize = 64;
const WORD_BYTES: usize = WORD_BITS / 8;

/// Bits of a grid. Bytes rather than words, so that it serialises in one piece: it is hashed at every tick.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub(super) struct BitGrid {
    #[serde(with = "serde_bytes")]
    bytes: Vec<u8>,
}

fn words_a_row(columns: usize) -> usize {
    columns.div_ceil(WORD_BITS)
}

/// The bits of a word from `from` up to, not including, `to`.
fn span(from: usize, to: usize) -> u64 {
    (u64::MAX >> (WORD_BITS - to)) & (u64::MAX << from)
}

impl BitGrid {
    pub fn zero(columns: usize, rows: usize) -> Self {
        Self { bytes: vec![0; words_a_row(columns) * rows * WORD_BYTES] }
    }

    /// Whether it has room for exactly such a grid.
    pub fn fits(&self, columns: usize, rows: usize) -> bool {
        self.bytes.len() == words_a_row(columns) * rows * WORD_BYTES
    }

    fn word(&self, index: usize) -> u64 {
        let bytes = &self.bytes[index * WORD_BYTES..(index + 1) * WORD_BYTES];
        u64::from_le_bytes(bytes.try_into().expect("a word has eight bytes"))
    }
}

/// A grid's bits with its shape.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    pub bits: &'a BitGrid,
    pub columns: usize,
}

impl Rows<'_> {
    pub fn get(&self, column: usize, row: usize) -> bool {
        self.bits.bytes[row * words_a_row(self.columns) * WORD_BYTES + column / 8] >> (column % 8) & 1 == 1
    }

    /// Calls `visit` with each word of a row that has bits in the columns from `from` up to, not including,
    /// `to`: the index of its first column, the word, and which of its bits are meant. Stops when it says so.
    fn any_word(&self, row: usize, from: usize, to: usize, mut test: impl FnMut(u64, u64) -> bool) -> bool {
        let start = row * words_a_row(self.columns);
        (from / WORD_BITS..to.div_ceil(WORD_BITS)).any(|index| {
            let first = index * WORD_BITS;
            let wanted = span(from.saturating_sub(first), (to - first).min(WORD_BITS));
            test(self.bits.word(start + index), wanted)
        })
    }

    /// Whether a bit is set in the columns from `from` up to, not including, `to`.
    pub fn any(&self, row: usize, from: usize, to: usize) -> bool {
        self.any_word(row, from, to, |word, wanted| word & wanted != 0)
    }

    /// Whether every such bit is set.
    pub fn all(&self, row: usize, from: usize, to: usize) -> bool {
        !self.any_word(row, from, to, |word, wanted| !word & wanted != 0)
    }

    /// The set bit nearest to `column` at or after it.
    pub fn next(&self, row: usize, column: usize) -> Option<usize> {
        let start = row * words_a_row(self.columns);
        let mut wanted = u64::MAX << (column % WORD_BITS);
        for index in column / WORD_BITS..words_a_row(self.columns) {
            let word = self.bits.word(start + index) & wanted;
            if word != 0 {
                return Some(index * WORD_BITS + word.trailing_zeros() as usize);
            }
            wanted = u64::MAX;
        }
        None
    }

    /// The set bit nearest to `column` at or before it.
    pub fn previous(&self, row: usize, column: usize) -> Option<usize> {
        let start = row * words_a_row(self.columns);
        let mut wanted = u64::MAX >> (WORD_BITS - 1 - column % WORD_BITS);
        for index in (0..=column / WORD_BITS).rev() {
            let word = self.bits.word(start + index) & wanted;
            if word != 0 {
                return Some(index * WORD_BITS + WORD_BITS - 1 - word.leading_zeros() as usize);
            }
            wanted = u64::MAX;
        }
        None
    }
}

impl BitGrid {
    /// Turns a bit of a grid with so many columns over.
    pub fn flip(&mut self, columns: usize, column: usize, row: usize) {
        self.bytes[row * words_a_row(columns) * WORD_BYTES + column / 8] ^= 1 << (column % 8);
    }
}
