//! Quantile Huber loss (Dabney et al. 2018, equation 3).

use candle_core::{D, Result, Tensor};

/// Where the Huber loss turns from a parabola to a line.
const KAPPA: f64 = 1.0;

/// Loss of each sample: quantiles `[B, N]` at fractions `[B, N]`, targets `[B, M]` → `[B]`.
///
/// ρ = |τ − 1{δ < 0}| · L(δ) / κ for each pair with δ = target − quantile; summed over the quantiles, averaged over the
/// targets.
///
/// # Errors
/// Of candle, for other shapes.
pub fn quantile_huber(quantiles: &Tensor, fractions: &Tensor, targets: &Tensor) -> Result<Tensor> {
    let delta = targets.unsqueeze(1)?.broadcast_sub(&quantiles.unsqueeze(2)?)?;
    let below = delta.lt(0.0)?.to_dtype(delta.dtype())?.detach();
    let tilt = below.broadcast_sub(&fractions.unsqueeze(2)?)?.abs()?;
    ((huber(&delta)? * tilt)? / KAPPA)?.mean(D::Minus1)?.sum(D::Minus1)
}

/// Huber loss of values `[B, N]` against targets of the same shape, averaged over all but the batch.
///
/// # Errors
/// Of candle, for other shapes.
pub fn huber_mean(values: &Tensor, targets: &Tensor) -> Result<Tensor> {
    huber(&(targets - values)?)?.mean(D::Minus1)
}

/// ½δ² up to κ, κ(|δ| − ½κ) beyond.
fn huber(delta: &Tensor) -> Result<Tensor> {
    let size = delta.abs()?;
    let inner = size.clamp(0.0, KAPPA)?;
    // κ|δ| − ½κ² beyond and ½δ² within are both inner·(|δ| − ½ inner).
    &inner * (size - (&inner * 0.5)?)?
}
