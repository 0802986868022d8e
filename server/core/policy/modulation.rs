//! The product of the embeddings of quantile fractions and states (Dabney et al. 2018, §3.1), as one differentiable
//! operation. Broadcast and summed by candle, it would cost more than the layers around it.

use candle_core::{CpuStorage, CustomOp2, Error, Layout, Result, Shape, Storage, Tensor};
use rayon::prelude::*;

/// Fewer products than this are computed without the thread pool.
const PARALLEL_THRESHOLD: usize = 100_000;

/// `y[b,g,n,h] = r(state)[b,g,h] · r(fraction)[b,n,h]` with the ReLU r: `[B, G, H]` and `[B, N, H]` of f32 →
/// `[B, G, N, H]`.
///
/// # Errors
/// An error that names the shapes if they do not fit together; candle's own for another type or device.
pub fn modulate(states: &Tensor, fractions: &Tensor) -> Result<Tensor> {
    let (batch, _, width) = states.dims3()?;
    let (other_batch, _, other_width) = fractions.dims3()?;
    if (batch, width) != (other_batch, other_width) {
        candle_core::bail!("modulate: fractions of shape {:?} with states of {:?}", fractions.shape(), states.shape());
    }
    states.contiguous()?.apply_op2(&fractions.contiguous()?, Modulation)
}

struct Modulation;

/// States, fractions and the gradient of their product, for one batch entry.
type Given<'a> = ((&'a [f32], &'a [f32]), &'a [f32]);

/// Sizes of one batch entry.
#[derive(Clone, Copy)]
struct Sizes {
    goals: usize,
    count: usize,
    width: usize,
}

impl Sizes {
    fn of(states: &Shape, fractions: &Shape) -> Result<Self> {
        let (_, goals, width) = states.dims3()?;
        let (_, count, _) = fractions.dims3()?;
        Ok(Self { goals, count, width })
    }

    fn forward(self, states: &[f32], fractions: &[f32], y: &mut [f32]) {
        let Self { count, width, .. } = self;
        for (rows, state) in y.chunks_exact_mut(count * width).zip(states.chunks_exact(width)) {
            for (row, fraction) in rows.chunks_exact_mut(width).zip(fractions.chunks_exact(width)) {
                for ((y, &s), &f) in row.iter_mut().zip(state).zip(fraction) {
                    *y = s.max(0.0) * f.max(0.0);
                }
            }
        }
    }

    /// Adds to gradients that are initially zero.
    fn backward(self, states: &[f32], fractions: &[f32], dy: &[f32], ds: &mut [f32], df: &mut [f32]) {
        let Self { count, width, .. } = self;
        let by_goal = states.chunks_exact(width).zip(ds.chunks_exact_mut(width)).zip(dy.chunks_exact(count * width));
        for ((state, ds), rows) in by_goal {
            let by_fraction =
                fractions.chunks_exact(width).zip(df.chunks_exact_mut(width)).zip(rows.chunks_exact(width));
            for ((fraction, df), row) in by_fraction {
                let numbers = state.iter().zip(ds.iter_mut()).zip(fraction.iter().zip(df)).zip(row);
                for (((&s, ds), (&f, df)), &dy) in numbers {
                    *ds += if s > 0.0 { dy * f.max(0.0) } else { 0.0 };
                    *df += if f > 0.0 { dy * s.max(0.0) } else { 0.0 };
                }
            }
        }
    }
}

fn slice<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let (start, end) =
        layout.contiguous_offsets().ok_or_else(|| Error::RequiresContiguous { op: "modulation" }.bt())?;
    Ok(&storage.as_slice::<f32>()?[start..end])
}

fn on_cpu(storage: &Storage) -> Result<&CpuStorage> {
    match storage {
        Storage::Cpu(storage) => Ok(storage),
        _ => candle_core::bail!("modulation is implemented for the CPU only"),
    }
}

impl CustomOp2 for Modulation {
    fn name(&self) -> &'static str {
        "modulation"
    }

    fn cpu_fwd(
        &self,
        states: &CpuStorage,
        states_layout: &Layout,
        fractions: &CpuStorage,
        fractions_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let sizes = Sizes::of(states_layout.shape(), fractions_layout.shape())?;
        let Sizes { goals, count, width } = sizes;
        let batch = states_layout.shape().dims()[0];
        let mut y = vec![0.0; batch * goals * count * width];
        if !y.is_empty() {
            let (states, fractions) = (slice(states, states_layout)?, slice(fractions, fractions_layout)?);
            let one = |((y, states), fractions): ((&mut [f32], &[f32]), &[f32])| sizes.forward(states, fractions, y);
            let states = || states.chunks_exact(goals * width);
            let fractions = || fractions.chunks_exact(count * width);
            if y.len() < PARALLEL_THRESHOLD {
                y.chunks_exact_mut(goals * count * width).zip(states()).zip(fractions()).for_each(one);
            } else {
                let all: Vec<_> = y.chunks_exact_mut(goals * count * width).zip(states()).zip(fractions()).collect();
                all.into_par_iter().for_each(one);
            }
        }
        Ok((CpuStorage::F32(y), Shape::from((batch, goals, count, width))))
    }

    fn bwd(
        &self,
        states: &Tensor,
        fractions: &Tensor,
        _y: &Tensor,
        y_gradient: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let sizes = Sizes::of(states.shape(), fractions.shape())?;
        let Sizes { goals, count, width } = sizes;
        let y_gradient = y_gradient.contiguous()?;
        let mut ds = vec![0.0; states.elem_count()];
        let mut df = vec![0.0; fractions.elem_count()];
        if y_gradient.elem_count() > 0 {
            let (states_storage, states_layout) = states.storage_and_layout();
            let (fractions_storage, fractions_layout) = fractions.storage_and_layout();
            let (y_storage, y_layout) = y_gradient.storage_and_layout();
            let states = slice(on_cpu(&states_storage)?, states_layout)?;
            let fractions = slice(on_cpu(&fractions_storage)?, fractions_layout)?;
            let dy = slice(on_cpu(&y_storage)?, y_layout)?;
            let parts: Vec<_> = states
                .chunks_exact(goals * width)
                .zip(fractions.chunks_exact(count * width))
                .zip(dy.chunks_exact(goals * count * width))
                .zip(ds.chunks_exact_mut(goals * width).zip(df.chunks_exact_mut(count * width)))
                .collect();
            let is_small = dy.len() < PARALLEL_THRESHOLD;
            let one = |(((states, fractions), dy), (ds, df)): (Given<'_>, (&mut [f32], &mut [f32]))| {
                sizes.backward(states, fractions, dy, ds, df);
            };
            if is_small { parts.into_iter().for_each(one) } else { parts.into_par_iter().for_each(one) }
        }
        let ds = Tensor::from_vec(ds, states.shape(), states.device())?;
        let df = Tensor::from_vec(df, fractions.shape(), fractions.device())?;
        Ok((Some(ds), Some(df)))
    }
}

#[cfg(test)]
mod tests {
    use candle_core::{Device, Var};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use rand_distr::StandardNormal;

    use super::*;

    #[test]
    fn product_and_gradients_agree_with_candle() {
        let mut rng = ChaCha8Rng::seed_from_u64(4);
        // The second case is large enough for the thread pool.
        for (batch, goals, count, width) in [(3, 2, 5, 7), (9, 13, 8, 128)] {
            let mut draw = |shape: &[usize]| {
                let values: Vec<f32> =
                    (0..shape.iter().product()).map(|_| rng.sample::<f32, _>(StandardNormal)).collect();
                Var::from_slice(&values, shape, &Device::Cpu).unwrap()
            };
            let (states, fractions) = (draw(&[batch, goals, width]), draw(&[batch, count, width]));
            let weights = draw(&[batch, goals, count, width]);
            let ours = modulate(&states, &fractions).unwrap();
            let rectified = |x: &Var, at: usize| x.relu().unwrap().unsqueeze(at).unwrap();
            let theirs = rectified(&states, 2).broadcast_mul(&rectified(&fractions, 1)).unwrap();
            let both = [ours, theirs].map(|y| {
                let gradients = (&y * weights.as_tensor()).unwrap().sum_all().unwrap().backward().unwrap();
                let flat = |x: &Tensor| x.flatten_all().unwrap().to_vec1::<f32>().unwrap();
                [flat(&y), flat(gradients.get(&states).unwrap()), flat(gradients.get(&fractions).unwrap())].concat()
            });
            assert_eq!(both[0].len(), both[1].len());
            for (ours, theirs) in both[0].iter().zip(&both[1]) {
                assert!((ours - theirs).abs() < 1e-4, "{ours} {theirs}");
            }
        }
    }

    #[test]
    fn names_shapes_that_do_not_fit() {
        let zeros = |shape: (usize, usize, usize)| Tensor::zeros(shape, candle_core::DType::F32, &Device::Cpu).unwrap();
        let error = modulate(&zeros((2, 3, 4)), &zeros((2, 3, 5))).unwrap_err();
        assert!(error.to_string().contains("[2, 3, 5]"), "{error}");
    }
}
