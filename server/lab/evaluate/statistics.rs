//! Confidence intervals for shares and means.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// Share of intervals that contain the true value.
pub const LEVEL: f64 = 0.95;

/// The level of each of `count` intervals that all contain their true values with the level `LEVEL` together (Bonferroni;
/// Dunn 1961, "Multiple comparisons among means").
pub fn corrected_level(count: usize) -> f64 {
    1.0 - (1.0 - LEVEL) / count.max(1) as f64
}

/// Wilson's score interval at 95 % for `k` of `n` (Wilson 1927).
pub fn wilson95(k: u32, n: u32) -> [f64; 2] {
    wilson(f64::from(k), f64::from(n), LEVEL)
}

/// Wilson's score interval for `k` of `n`.
pub fn wilson(k: f64, n: f64, level: f64) -> [f64; 2] {
    let z = Normal::standard().inverse_cdf(0.5 + 0.5 * level);
    let (p, z2) = (k / n, z * z);
    let center = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let half = z / (1.0 + z2 / n) * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    [(center - half).max(0.0), (center + half).min(1.0)]
}

/// Counts of paired successes and failures at the same trials.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairedCounts {
    /// Both succeeded.
    pub both: f64,
    /// Only the first succeeded.
    pub first: f64,
    /// Only the second succeeded.
    pub second: f64,
    /// Both failed.
    pub neither: f64,
}

impl PairedCounts {
    /// Success share of the first minus that of the second, and its interval (Newcombe 1998,
    /// "Improved confidence intervals for the difference between binomial proportions based on paired data", method
    /// 10: Wilson's intervals joined, with a correlation corrected for continuity).
    pub fn difference(self, level: f64) -> (f64, [f64; 2]) {
        let Self { both: a, first: b, second: c, neither: d } = self;
        let n = a + b + c + d;
        let (p1, p2) = ((a + b) / n, (a + c) / n);
        let [l1, u1] = wilson(a + b, n, level);
        let [l2, u2] = wilson(a + c, n, level);
        let product = (a + b) * (c + d) * (a + c) * (b + d);
        let correlation = match a * d - b * c {
            _ if product == 0.0 => 0.0,
            excess if excess > n / 2.0 => (excess - n / 2.0) / product.sqrt(),
            excess if excess >= 0.0 => 0.0,
            excess => excess / product.sqrt(),
        };
        let joined = |x: f64, y: f64| (x * x - 2.0 * correlation * x * y + y * y).max(0.0).sqrt();
        let difference = p1 - p2;
        let [low, high] = [difference - joined(p1 - l1, u2 - p2), difference + joined(u1 - p1, p2 - l2)];
        (difference, [low.max(-1.0), high.min(1.0)])
    }
}

/// Mean of differences and its interval by Student's t; `None` for fewer than two values.
pub fn mean(values: &[f64], level: f64) -> Option<(f64, [f64; 2])> {
    let n = values.len() as f64;
    if values.len() < 2 {
        return None;
    }
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let t = StudentsT::new(0.0, 1.0, n - 1.0).ok()?.inverse_cdf(0.5 + 0.5 * level);
    let half = t * (variance / n).sqrt();
    Some((mean, [mean - half, mean + half]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_agrees_with_published_values() {
        // statsmodels proportion_confint(29, 30, method="wilson"); Brown, Cai & DasGupta (2001).
        let [low, high] = wilson95(29, 30);
        assert!((low - 0.83329).abs() < 1e-4 && (high - 0.99409).abs() < 1e-4, "{low} {high}");
        let [low, high] = wilson95(30, 30);
        assert!((low - 0.88649).abs() < 1e-4 && (high - 1.0).abs() < 1e-12, "{low} {high}");
    }

    #[test]
    fn newcombe_agrees_with_published_values() {
        // The worked example of Altman et al., "Statistics with Confidence" (2000), §6: 0.20 (0.056 to 0.329).
        let counts = PairedCounts { both: 20.0, first: 12.0, second: 2.0, neither: 16.0 };
        let (difference, [low, high]) = counts.difference(LEVEL);
        assert!((difference - 0.2).abs() < 1e-12);
        assert!((low - 0.056).abs() < 5e-4 && (high - 0.329).abs() < 5e-4, "{low} {high}");
    }

    #[test]
    fn swapping_the_pair_negates_the_difference_and_zero_is_not_certain() {
        let counts = PairedCounts { both: 150.0, first: 30.0, second: 3.0, neither: 17.0 };
        let turned = PairedCounts { first: counts.second, second: counts.first, ..counts };
        let ((d, [low, high]), (t, [t_low, t_high])) = (counts.difference(LEVEL), turned.difference(LEVEL));
        assert!((d + t).abs() < 1e-12 && (low + t_high).abs() < 1e-12 && (high + t_low).abs() < 1e-12);
        assert!(low < d && d < high && low > 0.0);
        // 200 of 200 delivered by both says little about differences below 2 %.
        let (d, [low, high]) = PairedCounts { both: 200.0, ..PairedCounts::default() }.difference(LEVEL);
        assert!(d == 0.0 && (-0.03..-0.01).contains(&low) && (low + high).abs() < 1e-12, "{low} {high}");
    }

    #[test]
    fn corrected_intervals_are_wider_and_one_comparison_needs_no_correction() {
        assert_eq!(corrected_level(1), LEVEL);
        assert!((corrected_level(12) - (1.0 - 0.05 / 12.0)).abs() < 1e-15);
        // t of 1 − 0.05 / 24 with 4 degrees of freedom is 5.8853, from numerical integration of the density.
        let (_, [low, high]) = mean(&[1.0, 2.0, 3.0, 4.0, 5.0], corrected_level(12)).unwrap();
        assert!((0.5 * (high - low) - 5.885_305 * 0.5_f64.sqrt()).abs() < 1e-5, "{low} {high}");
    }

    #[test]
    fn means_agree_with_students_table() {
        // t of 0.975 with 4 degrees of freedom is 2.776.
        let (mean, [low, high]) = mean(&[1.0, 2.0, 3.0, 4.0, 5.0], LEVEL).unwrap();
        let half = 2.776_445 * (2.5_f64 / 5.0).sqrt();
        assert!((mean - 3.0).abs() < 1e-12 && (low - (3.0 - half)).abs() < 1e-5 && (high - (3.0 + half)).abs() < 1e-5);
        assert_eq!(super::mean(&[1.0], LEVEL), None);
    }
}
