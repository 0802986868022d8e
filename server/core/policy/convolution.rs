//! A differentiable 2-D convolution for candle on the CPU.
//!
//! Candle's own `conv2d` works on NCHW tensors and its backward pass is far slower than its forward pass. This one
//! keeps channels last, so the channels of one pixel are contiguous: im2col then copies long runs of memory. The bias,
//! and the ReLU that precedes the convolution in a residual block, need no separate pass over memory.

mod matrix;
#[cfg(test)]
mod tests;
mod windows;

use std::cell::RefCell;

use candle_core::{CpuStorage, CustomOp3, Error, Layout, Result, Shape, Storage, Tensor};
use matrix::{Matrix, add_to, multiply, transpose};
use rayon::prelude::*;

/// Largest number of parts of a batch. It limits the number of useful threads. It also determines the order in which
/// weight gradients are summed, so it must not depend on the number of threads.
const BATCH_PARTS: usize = 16;

/// With fewer multiply-adds (about 50 µs on one core), waking the thread pool costs more than it saves.
const PARALLEL_THRESHOLD: usize = 2_000_000;

/// The shape of a 2-D convolution with a square kernel, without its weights.
///
/// `y[b,i,j,o] = bias[o] + Σ r(x)[b, i·stride+di−padding, j·stride+dj−padding, c] · weight[di,dj,c,o]`, where `x` is
/// zero outside the image and `r` is the ReLU if `rectify_input` is set, otherwise the identity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Convolution {
    /// Height and width of the kernel, at least 1.
    pub kernel: usize,
    /// Step between neighbouring windows, at least 1.
    pub stride: usize,
    /// Rows and columns of zeros added on each side of the image.
    pub padding: usize,
    /// Whether negative inputs are replaced by zero. Their gradient is then zero too, including at exactly 0.
    pub rectify_input: bool,
}

impl Convolution {
    /// Convolves `x` of shape `[batch, height, width, channels_in]` with `weight` of shape `[kernel·kernel·channels_in,
    /// channels_out]`, whose rows are ordered by kernel row, kernel column and input channel, and adds `bias` of shape
    /// `[channels_out]`. All must be f32 on the CPU; they need not be contiguous.
    ///
    /// Returns `[batch, height_out, width_out, channels_out]`, where a side of `n` pixels becomes
    /// `(n + 2·padding − kernel) / stride + 1`, rounded down. Values and gradients are bit-identical for any number of
    /// threads. Arguments that candle does not track get no gradient, and the work for it is skipped.
    ///
    /// # Errors
    ///
    /// An error that names the shape if the shapes do not fit together, if the kernel is larger than the padded image,
    /// or if `kernel` or `stride` is 0; candle's usual errors for another type or device.
    pub fn forward(&self, x: &Tensor, weight: &Tensor, bias: &Tensor) -> Result<Tensor> {
        Geometry::new(*self, x.shape(), weight.shape(), bias.shape())?;
        x.contiguous()?.apply_op3(&weight.contiguous()?, &bias.contiguous()?, *self)
    }
}

impl CustomOp3 for Convolution {
    fn name(&self) -> &'static str {
        "convolution"
    }

    fn cpu_fwd(
        &self,
        x: &CpuStorage,
        x_layout: &Layout,
        weight: &CpuStorage,
        weight_layout: &Layout,
        bias: &CpuStorage,
        bias_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let geometry = Geometry::new(*self, x_layout.shape(), weight_layout.shape(), bias_layout.shape())?;
        let x = contiguous_slice(x, x_layout)?;
        let weight = contiguous_slice(weight, weight_layout)?;
        let bias = contiguous_slice(bias, bias_layout)?;
        let y = geometry.forward(x, weight, bias);
        Ok((CpuStorage::F32(y), geometry.output_shape()))
    }

    fn bwd(
        &self,
        x: &Tensor,
        weight: &Tensor,
        bias: &Tensor,
        _y: &Tensor,
        y_gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let geometry = Geometry::new(*self, x.shape(), weight.shape(), bias.shape())?;
        let y_gradient = y_gradient.contiguous()?;
        let gradients = {
            let (x_storage, x_layout) = x.storage_and_layout();
            let (weight_storage, weight_layout) = weight.storage_and_layout();
            let (y_storage, y_layout) = y_gradient.storage_and_layout();
            geometry.backward(
                contiguous_slice(cpu_storage(&x_storage)?, x_layout)?,
                contiguous_slice(cpu_storage(&weight_storage)?, weight_layout)?,
                contiguous_slice(cpu_storage(&y_storage)?, y_layout)?,
                x.track_op(),
                weight.track_op() || bias.track_op(),
            )
        };
        let tensor = |gradient: Option<Vec<f32>>, like: &Tensor| {
            let wanted = gradient.filter(|_| like.track_op());
            wanted.map(|gradient| Tensor::from_vec(gradient, like.shape(), like.device())).transpose()
        };
        Ok((tensor(gradients.x, x)?, tensor(gradients.weight, weight)?, tensor(gradients.bias, bias)?))
    }
}

fn cpu_storage(storage: &Storage) -> Result<&CpuStorage> {
    match storage {
        Storage::Cpu(storage) => Ok(storage),
        _ => candle_core::bail!("convolution is implemented for the CPU only"),
    }
}

fn contiguous_slice<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let (start, end) =
        layout.contiguous_offsets().ok_or_else(|| Error::RequiresContiguous { op: "convolution" }.bt())?;
    Ok(&storage.as_slice::<f32>()?[start..end])
}

/// The sizes of one call, after the shapes were checked.
#[derive(Clone, Copy)]
struct Geometry {
    convolution: Convolution,
    batch: usize,
    height: usize,
    width: usize,
    channels_in: usize,
    height_out: usize,
    width_out: usize,
    channels_out: usize,
}

struct Gradients {
    x: Option<Vec<f32>>,
    weight: Option<Vec<f32>>,
    bias: Option<Vec<f32>>,
}

/// Buffers for one image, kept per thread: allocating them in each call would cause page faults.
#[derive(Default)]
struct Scratch {
    /// An image with its padding, `[height + 2·padding, width + 2·padding, channels_in]`.
    padded: Vec<f32>,
    /// im2col's matrix, `[height_out·width_out, kernel·kernel·channels_in]`.
    columns: Vec<f32>,
}

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

impl Geometry {
    fn new(convolution: Convolution, x: &Shape, weight: &Shape, bias: &Shape) -> Result<Self> {
        let Convolution { kernel, stride, padding, .. } = convolution;
        if kernel == 0 || stride == 0 {
            candle_core::bail!("convolution: kernel {kernel} and stride {stride} must be positive");
        }
        let (batch, height, width, channels_in) = x.dims4()?;
        let (_, channels_out) = weight.dims2()?;
        let expect = |name: &str, shape: &Shape, expected: Shape| {
            if *shape == expected {
                return Ok(());
            }
            let msg = format!("convolution: {name} does not fit the input {x:?} and {convolution:?}");
            Err(Error::UnexpectedShape { msg, expected, got: shape.clone() }.bt())
        };
        expect("weight", weight, Shape::from((kernel * kernel * channels_in, channels_out)))?;
        expect("bias", bias, Shape::from(channels_out))?;
        let side_out = |side: usize| (side + 2 * padding).checked_sub(kernel).map(|rest| rest / stride + 1);
        let (Some(height_out), Some(width_out)) = (side_out(height), side_out(width)) else {
            candle_core::bail!("convolution: the input {x:?} is smaller than the kernel of {convolution:?}");
        };
        Ok(Self { convolution, batch, height, width, channels_in, height_out, width_out, channels_out })
    }

    fn output_shape(&self) -> Shape {
        Shape::from((self.batch, self.height_out, self.width_out, self.channels_out))
    }

    fn padded_width(&self) -> usize {
        self.width + 2 * self.convolution.padding
    }

    fn padded_len(&self) -> usize {
        (self.height + 2 * self.convolution.padding) * self.padded_width() * self.channels_in
    }

    fn image_len(&self) -> usize {
        self.height * self.width * self.channels_in
    }

    fn pixels_out(&self) -> usize {
        self.height_out * self.width_out
    }

    /// Number of inputs of one output: the rows of the weight matrix.
    fn window_len(&self) -> usize {
        self.convolution.kernel * self.convolution.kernel * self.channels_in
    }

    /// Whether a tensor has no elements, so that there is no work (and chunks would have length zero).
    fn is_empty(&self) -> bool {
        self.batch * self.image_len() * self.channels_out == 0
    }

    fn multiply_adds(&self) -> usize {
        self.batch * self.pixels_out() * self.window_len() * self.channels_out
    }

    /// Images in each part of the batch except the last.
    fn images_per_part(&self) -> usize {
        self.batch.div_ceil(BATCH_PARTS).max(1)
    }

    fn forward(&self, x: &[f32], weight: &[f32], bias: &[f32]) -> Vec<f32> {
        let mut y = bias.repeat(self.batch * self.pixels_out());
        if self.is_empty() {
            return y;
        }
        let images_per_part = self.images_per_part();
        let x_parts = x.chunks(images_per_part * self.image_len());
        let y_parts = y.chunks_mut(images_per_part * self.pixels_out() * self.channels_out);
        for_each_part(x_parts.zip(y_parts).collect(), self.multiply_adds(), |(x, y), scratch| {
            let y_images = y.chunks_exact_mut(self.pixels_out() * self.channels_out);
            for (x, y) in x.chunks_exact(self.image_len()).zip(y_images) {
                let columns = Matrix::new(self.im2col(x, scratch), self.pixels_out(), self.window_len());
                multiply(y, true, columns, Matrix::new(weight, self.window_len(), self.channels_out));
            }
        });
        y
    }

    /// The gradients of a loss whose gradient with respect to the output is `y_gradient`. The gradients of `x` and of
    /// the parameters are computed only if wanted.
    fn backward(
        &self,
        x: &[f32],
        weight: &[f32],
        y_gradient: &[f32],
        x_wanted: bool,
        parameters_wanted: bool,
    ) -> Gradients {
        let (window_len, channels_out) = (self.window_len(), self.channels_out);
        let weight_len = window_len * channels_out;
        let mut x_gradient = vec![0.0; if x_wanted { x.len() } else { 0 }];
        // One row per part of the batch: its sum of weight gradients, then of bias gradients.
        let part_len = if parameters_wanted { weight_len + channels_out } else { 0 };
        let images_per_part = self.images_per_part();
        let parts = if self.is_empty() { 0 } else { self.batch.div_ceil(images_per_part) };
        let mut part_sums = vec![0.0; parts.max(1) * part_len];
        if parts > 0 {
            let transposed_weight = if x_wanted { transpose(weight, window_len, channels_out) } else { Vec::new() };
            let transposed_weight = &transposed_weight[..];
            // Without a wanted gradient the vector is empty, and so is the iterator.
            let mut x_gradients = x_gradient.chunks_mut(images_per_part * self.image_len());
            let mut sums = part_sums.chunks_mut(part_len.max(1));
            let tasks = x
                .chunks(images_per_part * self.image_len())
                .zip(y_gradient.chunks(images_per_part * self.pixels_out() * channels_out))
                .map(|(x, y_gradient)| BackwardPart {
                    x,
                    y_gradient,
                    x_gradient: x_gradients.next(),
                    sums: sums.next(),
                })
                .collect();
            for_each_part(tasks, 2 * self.multiply_adds(), |part, scratch| {
                self.backward_part(part, transposed_weight, scratch);
            });
        }
        let parameters = parameters_wanted.then(|| {
            let mut sums = part_sums.chunks_exact(part_len.max(1));
            let mut total = sums.next().unwrap_or_default().to_vec();
            sums.for_each(|part| add_to(&mut total, part));
            let bias = total.split_off(weight_len);
            (total, bias)
        });
        let (weight, bias) = parameters.unzip();
        Gradients { x: x_wanted.then_some(x_gradient), weight, bias }
    }

    fn backward_part(&self, part: BackwardPart, transposed_weight: &[f32], scratch: &mut Scratch) {
        let BackwardPart { x, y_gradient, mut x_gradient, mut sums } = part;
        let (window_len, channels_out) = (self.window_len(), self.channels_out);
        let images = x.chunks_exact(self.image_len()).zip(y_gradient.chunks_exact(self.pixels_out() * channels_out));
        for (index, (x, y_gradient)) in images.enumerate() {
            let y_matrix = Matrix::new(y_gradient, self.pixels_out(), channels_out);
            if let Some(sums) = &mut sums {
                let (weight_sum, bias_sum) = sums.split_at_mut(window_len * channels_out);
                y_gradient.chunks_exact(channels_out).for_each(|pixel| add_to(bias_sum, pixel));
                let columns = Matrix::new(self.im2col(x, scratch), self.pixels_out(), window_len);
                multiply(weight_sum, true, columns.transposed(), y_matrix);
            }
            if let Some(x_gradient) = &mut x_gradient {
                let transposed_weight = Matrix::new(transposed_weight, channels_out, window_len);
                let x_gradient = &mut x_gradient[index * self.image_len()..(index + 1) * self.image_len()];
                if self.is_pointwise() {
                    multiply(x_gradient, false, y_matrix, transposed_weight);
                    self.rectify_gradient(x, x_gradient);
                    continue;
                }
                scratch.columns.resize(self.pixels_out() * window_len, 0.0);
                multiply(&mut scratch.columns, false, y_matrix, transposed_weight);
                self.col2im(x, x_gradient, scratch);
            }
        }
    }
}

/// Input and output of the backward pass for some images of the batch.
struct BackwardPart<'a> {
    x: &'a [f32],
    y_gradient: &'a [f32],
    x_gradient: Option<&'a mut [f32]>,
    sums: Option<&'a mut [f32]>,
}

/// Runs `task` on each part with the thread's scratch buffers, in parallel on the current rayon pool if that is faster.
fn for_each_part<T: Send>(parts: Vec<T>, multiply_adds: usize, task: impl Fn(T, &mut Scratch) + Sync) {
    let task = |part| SCRATCH.with_borrow_mut(|scratch| task(part, scratch));
    if parts.len() < 2 || multiply_adds < PARALLEL_THRESHOLD {
        parts.into_iter().for_each(task);
    } else {
        parts.into_par_iter().for_each(task);
    }
}
