//! The ticks of a `Step`, in slices.

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

use tokio::sync::watch;

use super::View;
use super::worker::{DRAIN_EVERY, Worker};
use crate::camera::ImageSource;
use ferry_core::trial::TrialError;

impl<E: ImageSource> Worker<E> {
    /// Runs a slice of a `Step`, and at its end the commands that waited for it.
    pub(super) fn step_on(&mut self, burst: Instant, publish: &watch::Sender<Arc<View>>) -> Result<(), TrialError> {
        while self.stepping > 0 && burst.elapsed() < DRAIN_EVERY {
            if self.interrupted.load(Ordering::Relaxed) {
                // The session ends: the step is not done, and dropping the answer says so.
                (self.stepping, self.stepped) = (0, None);
                self.deferred.clear();
                break;
            }
            if !self.tick()? {
                break;
            }
            self.stepping -= 1;
        }
        while self.stepping == 0 {
            if let Some(answer) = self.stepped.take() {
                self.announce();
                publish.send_replace(Arc::new(self.view()));
                let _ = answer.send(Ok(()));
            }
            let Some(request) = self.deferred.pop_front() else { break };
            self.answer(request, publish)?;
        }
        Ok(())
    }
}
