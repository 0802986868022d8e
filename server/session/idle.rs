//! What a paused session does: it looks at its recording, which may be interrupted meanwhile.

use std::sync::Arc;

use tokio::sync::watch;

use super::View;
use super::worker::Worker;
use crate::camera::ImageSource;

impl<E: ImageSource> Worker<E> {
    /// Publishes a change of the recording's status, unless ticks publish it anyway.
    pub(super) fn look_at_recording(&self, publish: &watch::Sender<Arc<View>>) {
        if !self.running && self.sink.status() != publish.borrow().recording {
            publish.send_replace(Arc::new(self.view()));
        }
    }
}
