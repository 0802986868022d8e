//! Adam (Kingma & Ba 2015) over plain arrays, so that its moments can be saved. Gradient clipping and weight averaging
//! are done in the same pass.

use serde::{Deserialize, Serialize};

const BETA1: f32 = 0.9;
const BETA2: f32 = 0.999;
/// Keeps steps finite when gradients vanish.
const EPSILON: f32 = 1e-8;

/// Moments of all weights.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Adam {
    first: Vec<Vec<f32>>,
    second: Vec<Vec<f32>>,
    steps: i32,
}

impl Adam {
    /// Zero moments for weights of these lengths.
    pub fn new(lengths: impl Iterator<Item = usize>) -> Self {
        let first: Vec<Vec<f32>> = lengths.map(|length| vec![0.0; length]).collect();
        Self { second: first.clone(), first, steps: 0 }
    }

    /// Moves the weights against the gradients, which are clipped to the total norm `gradient_most`. Returns the norm
    /// before clipping.
    pub fn step(
        &mut self,
        weights: &mut [Vec<f32>],
        gradients: &[Vec<f32>],
        learning_rate: f64,
        gradient_most: f64,
    ) -> f64 {
        self.steps = self.steps.saturating_add(1);
        let square: f64 = gradients.iter().map(|g| g.iter().map(|&x| f64::from(x) * f64::from(x)).sum::<f64>()).sum();
        let length = square.sqrt();
        let cut = (gradient_most / length.max(gradient_most)) as f32;
        let rate = (learning_rate / (1.0 - f64::from(BETA1).powi(self.steps))) as f32;
        let correction = (1.0 - f64::from(BETA2).powi(self.steps)).sqrt().recip() as f32;
        let moments = self.first.iter_mut().zip(&mut self.second);
        for ((weights, gradients), (first, second)) in weights.iter_mut().zip(gradients).zip(moments) {
            for (((w, &g), m), v) in weights.iter_mut().zip(gradients).zip(first).zip(second) {
                let g = g * cut;
                *m += (1.0 - BETA1) * (g - *m);
                *v += (1.0 - BETA2) * (g * g - *v);
                *w -= rate * *m / (v.sqrt() * correction + EPSILON);
            }
        }
        length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three steps on f(w) = w₀² + 10·w₁² from (1, −2), learning rate .1; computed separately in double precision.
    #[test]
    fn steps_agree_with_the_publication() {
        let mut adam = Adam::new([2].into_iter());
        let mut weights = vec![vec![1.0f32, -2.0]];
        for _ in 0..3 {
            let gradients = vec![vec![2.0 * weights[0][0], 20.0 * weights[0][1]]];
            adam.step(&mut weights, &gradients, 0.1, 1e9);
        }
        let mut expected = [1.0f64, -2.0];
        let (mut m, mut v) = ([0.0f64; 2], [0.0f64; 2]);
        for t in 1..=3 {
            for i in 0..2 {
                let g = [2.0, 20.0][i] * expected[i];
                m[i] = 0.9 * m[i] + 0.1 * g;
                v[i] = 0.999 * v[i] + 0.001 * g * g;
                let (mh, vh) = (m[i] / (1.0 - 0.9f64.powi(t)), v[i] / (1.0 - 0.999f64.powi(t)));
                expected[i] -= 0.1 * mh / (vh.sqrt() + 1e-8);
            }
        }
        for i in 0..2 {
            assert!((f64::from(weights[0][i]) - expected[i]).abs() < 1e-5, "{weights:?} {expected:?}");
        }
    }

    #[test]
    fn long_gradients_are_clipped() {
        let mut weights = vec![vec![0.0f32; 2]];
        let mut adam = Adam::new([2].into_iter());
        assert_eq!(adam.step(&mut weights, &[vec![30.0, 40.0]], 0.1, 10.0), 50.0);
        assert!((adam.first[0][0] - 0.6).abs() < 1e-6, "a tenth of 30 · 10/50");
    }
}
