//! What all kinds of training have in common: a run that advances, is watched, and is saved.

use std::path::Path;
use std::time::{Duration, Instant};

use super::curve::Curve;
use super::error::TrainingError;
use super::point::Point;

/// A training in progress, on worlds of one kind.
pub trait Run: Sized {
    type World;

    /// Runs until all updates are done, `goes_on` or `watch` returns false. `goes_on` is asked before each step, `watch` at
    /// the end of each point of the curve. A run that was stopped anywhere continues with the same bits.
    ///
    /// # Errors
    /// [`TrainingError`].
    fn advance(
        &mut self,
        worlds: &[Self::World],
        goes_on: &dyn Fn() -> bool,
        watch: &mut dyn FnMut(&Self) -> bool,
    ) -> Result<(), TrainingError>;

    /// Whether all updates are done.
    fn is_done(&self) -> bool;

    /// The curve so far.
    fn points(&self) -> &[Point];

    /// Saves the run and `spent_s`, the seconds that it took so far.
    ///
    /// # Errors
    /// [`TrainingError::Checkpoint`].
    fn write(&self, path: &Path, spent_s: f64) -> Result<(), TrainingError>;
}

/// Where and how often a run is saved.
#[derive(Clone, Copy, Debug)]
pub struct Saving<'a> {
    pub checkpoint: &'a Path,
    pub period: Duration,
}

/// Advances a run to its end, or until `goes_on` or `watch` returns false, and saves it: now and then, and when it stops. `curve` has
/// the time of earlier parts, and gets that of this one.
///
/// # Errors
/// [`TrainingError`]. A run that cannot be saved stops.
pub fn drive<R: Run>(
    run: &mut R,
    worlds: &[R::World],
    saving: Saving<'_>,
    curve: &mut Curve,
    goes_on: &dyn Fn() -> bool,
    watch: &mut dyn FnMut(&R, &Curve) -> bool,
) -> Result<(), TrainingError> {
    let begun = Instant::now();
    let mut saved = Instant::now();
    let (mut failure, mut is_saved) = (None, false);
    run.advance(worlds, goes_on, &mut |run| {
        curve.time(begun.elapsed().as_secs_f64());
        curve.points = run.points().to_vec();
        let goes_on = watch(run, curve) && !run.is_done();
        is_saved = !goes_on || saved.elapsed() >= saving.period;
        if is_saved {
            failure = run.write(saving.checkpoint, curve.spent_s()).err();
            saved = Instant::now();
        }
        goes_on && failure.is_none()
    })?;
    if !is_saved && !run.is_done() {
        curve.time(begun.elapsed().as_secs_f64());
        failure = run.write(saving.checkpoint, curve.spent_s()).err();
    }
    // Also of a run that was done already.
    curve.points = run.points().to_vec();
    failure.map_or(Ok(()), Err)
}
