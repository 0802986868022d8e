//! Runs a comparison: continues from a moment under several controllers and sends their progress.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::protocol::{Branch, ComparisonMessage};
use crate::session::BranchPoint;
use ferry_camera::{Camera, Gpu};
use ferry_core::scenario::ControllerName;
use ferry_core::trial::TrialError;
use ferry_lab::program::ProgramError;

/// Interval of progress messages.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(250);

/// Blocks until all branches have ended, or until `is_wanted` returns false. Then it sends no more messages.
pub fn compare(
    point: &BranchPoint,
    trial: u64,
    controllers: &[ControllerName],
    gpu: &Arc<Gpu>,
    is_wanted: &dyn Fn() -> bool,
    send: &dyn Fn(ComparisonMessage),
) {
    let mut comparison = ComparisonMessage::begin(trial, &point.point);
    send(comparison.clone());
    let run = || -> Result<(), ProgramError> {
        let scene = point.point.arena().static_scene();
        let mut camera = Camera::of(gpu, scene).map_err(TrialError::from)?;
        for &controller in controllers {
            comparison.branches.push(Branch::begin(controller, point.program().map(|program| &**program)));
            let mut told = Instant::now();
            point.branch(controller, &mut camera, &mut |progress| {
                if let Some(branch) = comparison.branches.last_mut() {
                    branch.follow(&point.point, &progress);
                }
                if !is_wanted() {
                    return ControlFlow::Break(());
                }
                if told.elapsed() >= PROGRESS_INTERVAL {
                    told = Instant::now();
                    send(comparison.clone());
                }
                ControlFlow::Continue(())
            })?;
            if !is_wanted() {
                break;
            }
        }
        Ok(())
    };
    // A panic in a controller only ends the comparison, with a message.
    let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(run));
    comparison.running = false;
    comparison.failed = match outcome {
        Ok(Ok(())) => None,
        Ok(Err(error)) => Some(error.to_string()),
        Err(_) => Some("a controller failed; see the server's log".to_owned()),
    };
    if is_wanted() {
        send(comparison);
    }
}
