//! Quantile Huber loss (Dabney et al. 2018, equation 3).

use candle_core::{D, Result, Tensor};

/// Where the Huber loss changes from a parabola to a line.
const KAPPA: f64 = 1.0;

/// Loss of each sample: quantiles `[B, N]` at fractions `[B, N]`, targets `[B, M]` → `[B]`.
///
/// ρ = |τ − 1{δ < 0}| · L(δ) / κ for each pair with δ = target − quantile; summed over the quantiles, averaged over the
/// targets.
///
/// # Errors Those of candle, for other shapes.
pub fn quantile_huber(quantiles: &Tensor, fractions: &Tensor, targets: &Tensor) -> Result<Tensor> {
    let delta = targets.unsqueeze(1)?.broadcast_sub(&quantiles.unsqueeze(2)?)?;
    let below = delta.lt(0.0)?.to_dtype(delta.dtype())?.detach();
    let tilt = below.broadcast_sub(&fractions.unsqueeze(2)?)?.abs()?;
    ((huber(&delta)? * tilt)? / KAPPA)?.mean(D::Minus1)?.sum(D::Minus1)
}

/// Huber loss of values `[B, N]` against targets of the same shape, averaged over all but the batch.
///
/// # Errors Those of candle, for other shapes.
pub fn huber_mean(values: &Tensor, targets: &Tensor) -> Result<Tensor> {
    huber(&(targets - values)?)?.mean(D::Minus1)
}

/// ½δ² up to κ, κ(|δ| − ½κ) beyond.
fn huber(delta: &Tensor) -> Result<Tensor> {
    let size = delta.abs()?;
    let inner = size.clamp(0.0, KAPPA)?;
    // κ|δ| − ½κ² beyond κ and ½δ² within κ both equal inner·(|δ| − ½ inner).
    &inner * (size - (&inner * 0.5)?)?
}

#[cfg(test)]
mod tests {
    use candle_core::{Device, Var};

    use super::*;

    fn var<const N: usize>(rows: &[[f32; N]]) -> Var {
        Var::from_slice(rows.as_flattened(), (rows.len(), N), &Device::Cpu).unwrap()
    }

    fn assert_near(found: &Tensor, expected: &[f64]) {
        let found: Vec<f32> = found.flatten_all().unwrap().to_vec1().unwrap();
        assert_eq!(found.len(), expected.len());
        for (&found, &expected) in found.iter().zip(expected) {
            assert!((f64::from(found) - expected).abs() < 1e-6, "{found} {expected}");
        }
    }

    // The expected numbers are from PyTorch in double precision: loops over samples, quantiles and targets written from
    // equation 3 of Dabney et al. 2018, and automatic differentiation.

    #[test]
    fn the_quantile_loss_and_its_gradient_match_the_publication() {
        // δ ranges from −3.7 to 7.1; eight of the 24 are within ±κ.
        let quantiles = var(&[[0.1, -0.7, 2.4], [1.25, 0.0, -3.1]]);
        let fractions = var(&[[0.15, 0.5, 0.93], [0.62, 0.04, 0.31]]);
        let targets = var(&[[0.6, -1.3, 1.85, 0.25], [-0.2, 0.95, 4.0, -2.05]]);
        let losses = quantile_huber(&quantiles, &fractions, &targets).unwrap();
        assert_near(&losses, &[0.788_662_5, 2.140_837_5]);
        let weights = Tensor::new(&[1.0f32, 0.5], &Device::Cpu).unwrap();
        let gradients = (losses * weights).unwrap().sum_all().unwrap().backward().unwrap();
        let expected = [0.150_625, -0.293_75, 0.062_125, 0.031_75, 0.134_25, -0.155];
        assert_near(gradients.get(&quantiles).unwrap(), &expected);
    }

    #[test]
    fn the_plain_loss_and_its_gradient_match_huber() {
        let values = var(&[[0.3, -1.2], [2.0, 0.5]]);
        let targets = var(&[[0.9, 0.4], [-0.5, 0.1]]);
        let losses = huber_mean(&values, &targets).unwrap();
        assert_near(&losses, &[0.5 * (0.18 + 1.1), 0.5 * (2.0 + 0.08)]);
        let gradients = losses.sum_all().unwrap().backward().unwrap();
        assert_near(gradients.get(&values).unwrap(), &[-0.3, -0.5, 0.5, 0.2]);
    }
}
