//! An image and its windows (im2col, col2im).

use std::ops::Range;

use super::matrix::add_to;
use super::{Convolution, Geometry, Scratch};

impl Geometry {
    /// The range of the padded image that window `(i, j)` covers in its row `di`.
    fn window_row(&self, i: usize, j: usize, di: usize) -> Range<usize> {
        let Convolution { kernel, stride, .. } = self.convolution;
        let start = ((i * stride + di) * self.padded_width() + j * stride) * self.channels_in;
        start..start + kernel * self.channels_in
    }

    /// The range of the padded image that contains row `i` of the image.
    fn inner_row(&self, i: usize) -> Range<usize> {
        let padding = self.convolution.padding;
        let start = ((i + padding) * self.padded_width() + padding) * self.channels_in;
        start..start + self.width * self.channels_in
    }

    /// Whether the windows are exactly the pixels in order.
    pub(super) fn is_pointwise(&self) -> bool {
        matches!(self.convolution, Convolution { kernel: 1, stride: 1, padding: 0, .. })
    }

    /// The windows of the image `x`, one per row; rectified if `rectify_input` is set.
    pub(super) fn im2col<'a>(&self, x: &'a [f32], scratch: &'a mut Scratch) -> &'a [f32] {
        let Convolution { kernel, padding, rectify_input, .. } = self.convolution;
        if self.is_pointwise() && !rectify_input {
            return x;
        }
        if self.is_pointwise() {
            scratch.columns.clear();
            scratch.columns.extend(x.iter().map(|&from| rectified(from)));
            return &scratch.columns;
        }
        // A padded and rectified copy (in L1 cache) makes the overlapping windows plain copies without branches.
        let padded = if padding == 0 && !rectify_input {
            x
        } else {
            scratch.padded.clear();
            scratch.padded.resize(self.padded_len(), 0.0);
            for (i, row) in x.chunks_exact(self.width * self.channels_in).enumerate() {
                let padded_row = &mut scratch.padded[self.inner_row(i)];
                if rectify_input {
                    padded_row.iter_mut().zip(row).for_each(|(to, &from)| *to = rectified(from));
                } else {
                    padded_row.copy_from_slice(row);
                }
            }
            &scratch.padded
        };
        scratch.columns.resize(self.pixels_out() * self.window_len(), 0.0);
        let mut runs = scratch.columns.chunks_exact_mut(kernel * self.channels_in);
        for i in 0..self.height_out {
            for j in 0..self.width_out {
                for (di, run) in (0..kernel).zip(&mut runs) {
                    run.copy_from_slice(&padded[self.window_row(i, j, di)]);
                }
            }
        }
        &scratch.columns
    }

    /// Adds the window gradients in `scratch.columns` to the gradient of the image `x`.
    pub(super) fn col2im(&self, x: &[f32], x_gradient: &mut [f32], scratch: &mut Scratch) {
        let Convolution { kernel, .. } = self.convolution;
        scratch.padded.clear();
        scratch.padded.resize(self.padded_len(), 0.0);
        let mut runs = scratch.columns.chunks_exact(kernel * self.channels_in);
        for i in 0..self.height_out {
            for j in 0..self.width_out {
                for (di, run) in (0..kernel).zip(&mut runs) {
                    add_to(&mut scratch.padded[self.window_row(i, j, di)], run);
                }
            }
        }
        let row_len = self.width * self.channels_in;
        for (i, x_gradient) in x_gradient.chunks_exact_mut(row_len).enumerate() {
            x_gradient.copy_from_slice(&scratch.padded[self.inner_row(i)]);
        }
        self.rectify_gradient(x, x_gradient);
    }

    /// Sets the gradient to zero where the input was rectified to zero.
    pub(super) fn rectify_gradient(&self, x: &[f32], x_gradient: &mut [f32]) {
        if self.convolution.rectify_input {
            x_gradient.iter_mut().zip(x).for_each(|(to, &x)| *to = if x <= 0.0 { 0.0 } else { *to });
        }
    }
}

/// Keeps NaN, unlike `max`.
fn rectified(x: f32) -> f32 {
    if x < 0.0 { 0.0 } else { x }
}
