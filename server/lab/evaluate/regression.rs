//! Whether trials deliver less often than when they were stored: a regression gate.

use serde::{Deserialize, Serialize};
use statrs::distribution::{Binomial, DiscreteCDF};

/// Format of a baseline's file.
const FORMAT: u32 = 1;
/// Probability that a check fails although nothing has become worse, over all rows together.
pub const ERROR_RATE: f64 = 0.05;

/// The trials of one row, in a fixed order.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Trials {
    pub row: String,
    /// One character per trial: `1` for a delivery, `0` for none.
    pub delivered: String,
}

impl Trials {
    pub fn of(row: String, delivered: impl Iterator<Item = bool>) -> Self {
        Self { row, delivered: delivered.map(|delivered| if delivered { '1' } else { '0' }).collect() }
    }

    fn count(&self) -> usize {
        self.delivered.matches('1').count()
    }
}

/// What a command gave when it was stored.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Baseline {
    ferry_baseline: u32,
    /// Version of Ferry.
    pub ferry: String,
    /// Graphics adapter.
    pub adapter: String,
    /// The command with its options, without `ferry`.
    pub command: Vec<String>,
    pub rows: Vec<Trials>,
}

/// Why a baseline cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum BaselineError {
    #[error("not a baseline: {0}")]
    Foreign(#[from] serde_json::Error),
    #[error("ferry_baseline is {found}, this Ferry reads {FORMAT}")]
    Format { found: u32 },
    #[error("rows: the command gives {now:?}, the baseline has {before:?}")]
    Rows { now: Vec<String>, before: Vec<String> },
    #[error("row {row:?} has {now} trials, the baseline has {before}")]
    Trials { row: String, now: usize, before: usize },
}

/// How a row has changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    pub row: String,
    pub trials: usize,
    /// Deliveries before and now.
    pub before: usize,
    pub now: usize,
    /// Trials that delivered before, and no longer.
    pub lost: u64,
    /// Trials that deliver only now.
    pub gained: u64,
    /// Probability of at least so many lost among the changed trials, if losing and gaining are equally likely.
    pub p_value: f64,
    /// Whether that is too unlikely.
    pub is_worse: bool,
}

impl Baseline {
    pub fn new(adapter: &str, command: Vec<String>, rows: Vec<Trials>) -> Self {
        let ferry = env!("CARGO_PKG_VERSION").to_owned();
        Self { ferry_baseline: FORMAT, ferry, adapter: adapter.to_owned(), command, rows }
    }

    /// # Errors
    /// [`BaselineError::Foreign`], [`BaselineError::Format`].
    pub fn read(bytes: &[u8]) -> Result<Self, BaselineError> {
        let baseline: Self = serde_json::from_slice(bytes)?;
        match baseline.ferry_baseline {
            FORMAT => Ok(baseline),
            found => Err(BaselineError::Format { found }),
        }
    }

    /// Compares each row with the same trials, run again. A row is worse if its p value is at most [`ERROR_RATE`]
    /// divided by the number of rows (Bonferroni), so that all rows together keep the error rate.
    ///
    /// # Errors
    /// [`BaselineError::Rows`], [`BaselineError::Trials`].
    pub fn compare(&self, now: &[Trials]) -> Result<Vec<Change>, BaselineError> {
        let names = |rows: &[Trials]| rows.iter().map(|trials| trials.row.clone()).collect::<Vec<_>>();
        if names(now) != names(&self.rows) {
            return Err(BaselineError::Rows { now: names(now), before: names(&self.rows) });
        }
        let level = ERROR_RATE / self.rows.len().max(1) as f64;
        self.rows.iter().zip(now).map(|(before, now)| Change::of(before, now, level)).collect()
    }
}

impl Change {
    fn of(before: &Trials, now: &Trials, level: f64) -> Result<Self, BaselineError> {
        let (row, trials) = (before.row.clone(), before.delivered.len());
        if now.delivered.len() != trials {
            return Err(BaselineError::Trials { row, now: now.delivered.len(), before: trials });
        }
        let pairs = || before.delivered.bytes().zip(now.delivered.bytes());
        let lost = pairs().filter(|&pair| pair == (b'1', b'0')).count() as u64;
        let gained = pairs().filter(|&pair| pair == (b'0', b'1')).count() as u64;
        let p_value = sign_test(lost, gained);
        let is_worse = p_value <= level;
        Ok(Self { row, trials, before: before.count(), now: now.count(), lost, gained, p_value, is_worse })
    }
}

/// The exact one-sided sign test, which is McNemar's test for paired trials (McNemar 1947): the probability of at least
/// `lost` of all changed trials, if each is lost or gained with the same probability.
fn sign_test(lost: u64, gained: u64) -> f64 {
    match (lost.checked_sub(1), Binomial::new(0.5, lost + gained)) {
        (Some(fewer), Ok(binomial)) => binomial.sf(fewer),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn the_test_agrees_with_published_values() {
        // scipy.stats.binomtest(k, n, alternative="greater").pvalue
        for (lost, gained, p_value) in
            [(0, 0, 1.0), (0, 4, 1.0), (5, 0, 0.031_25), (8, 2, 0.054_687_5), (15, 5, 0.020_694_733)]
        {
            assert!((sign_test(lost, gained) - p_value).abs() < 1e-8, "{lost} {gained}: {}", sign_test(lost, gained));
        }
    }

    /// How often a check of three controllers fails, over `runs` pairs of a stored and a new run with noise of their own.
    fn failures(runs: u32, trials: u32, before: [f64; 3], now: [f64; 3]) -> u32 {
        let mut rng = ChaCha8Rng::seed_from_u64(26);
        let mut run = |shares: [f64; 3]| {
            shares.map(|share| {
                Trials::of(
                    share.to_string(),
                    (0..trials).map(|_| rng.random::<f64>() < share).collect::<Vec<_>>().into_iter(),
                )
            })
        };
        let names = |mut rows: [Trials; 3]| {
            for (row, name) in rows.iter_mut().zip(["rl", "errt", "attractor"]) {
                row.row = name.to_owned();
            }
            rows
        };
        let check = |_: &u32| {
            let baseline = Baseline::new("", Vec::new(), names(run(before)).to_vec());
            baseline.compare(&names(run(now))).unwrap().iter().any(|change| change.is_worse)
        };
        (0..runs).filter(check).count() as u32
    }

    #[test]
    fn without_a_change_at_most_one_check_in_twenty_fails() {
        for shares in [[0.5; 3], [0.95, 0.8, 0.3], [1.0, 0.99, 0.97]] {
            let failed = failures(200, 700, shares, shares);
            assert!(failed <= 10, "{shares:?}: {failed} of 200");
        }
    }

    /// The budget of the documentation: 700 trials for each of three controllers.
    #[test]
    fn a_drop_of_ten_points_is_found_nine_times_in_ten() {
        for share in [0.99, 0.9, 0.7, 0.55] {
            let found = failures(200, 700, [share, 0.8, 0.8], [share - 0.1, 0.8, 0.8]);
            assert!(found >= 180, "{share}: {found} of 200");
        }
    }

    #[test]
    fn other_rows_or_trials_are_refused() {
        let row = |name: &str, delivered: &str| Trials { row: name.into(), delivered: delivered.into() };
        let baseline = Baseline::new("an adapter", vec!["evaluate".into()], vec![row("rl", "110")]);
        let read = Baseline::read(&serde_json::to_vec(&baseline).unwrap()).unwrap();
        assert_eq!(read, baseline);
        assert_eq!(read.compare(&[row("rl", "101")]).unwrap()[0].lost, 1);
        let error = read.compare(&[row("errt", "110")]).unwrap_err().to_string();
        assert_eq!(error, r#"rows: the command gives ["errt"], the baseline has ["rl"]"#);
        let error = read.compare(&[row("rl", "11")]).unwrap_err().to_string();
        assert_eq!(error, r#"row "rl" has 2 trials, the baseline has 3"#);
        assert!(Baseline::read(b"{}").is_err());
    }
}
