//! Rank correlation.

/// Ranks from 0; equal values share the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut first = 0;
    for equal in order.chunk_by(|&a, &b| values[a] == values[b]) {
        let mean = first as f64 + (equal.len() - 1) as f64 / 2.0;
        equal.iter().for_each(|&index| ranks[index] = mean);
        first += equal.len();
    }
    ranks
}

/// Spearman's rank correlation of two lists of the same length: the correlation of their ranks, from −1 to 1; `None` if
/// all values of a list are equal.
pub fn rank_correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    let middle = a.len().saturating_sub(1) as f64 / 2.0;
    let [a, b] = [a, b].map(|values| ranks(values).into_iter().map(|rank| rank - middle).collect::<Vec<_>>());
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = (product(&a, &a) * product(&b, &b)).sqrt();
    (size > 0.0).then(|| product(&a, &b) / size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_sees_only_the_order() {
        let squares: Vec<f64> = (0..9).map(|x| f64::from(x * x)).collect();
        let falling: Vec<f64> = squares.iter().map(|x| -x).collect();
        let steps: Vec<f64> = (0..9).map(f64::from).collect();
        assert_eq!(rank_correlation(&steps, &squares), Some(1.0));
        assert_eq!(rank_correlation(&steps, &falling), Some(-1.0));
        assert_eq!(rank_correlation(&steps, &[1.0; 9]), None);
        assert_eq!(rank_correlation(&[], &[]), None);
        // Ranks 0, 1.5, 1.5, 3 against 0, 1, 2, 3: 4.5 / √(4.5 · 5).
        let tied = rank_correlation(&[1.0, 2.0, 2.0, 3.0], &[1.0, 2.0, 3.0, 4.0]).unwrap();
        assert!((tied - 0.948_683_298).abs() < 1e-8, "{tied}");
    }
}
