//! What a paused session does: it looks at its recording, which may be interrupted meanwhile, and at the robot's clients.

use std::sync::Arc;

use tokio::sync::watch;

use super::View;
use super::worker::Worker;
use crate::camera::ImageSource;

impl<E: ImageSource> Worker<E> {
    /// Publishes a change, unless ticks publish it anyway.
    pub(super) fn look_around(&mut self, publish: &watch::Sender<Arc<View>>) {
        self.tell_of_twin();
        let robot = self.robot.as_ref().map(|robot| robot.standing());
        let twin = self.twin.as_ref().map(|twin| twin.standing());
        let has_changed = {
            let last = publish.borrow();
            self.sink.status() != last.recording || robot != last.robot || twin != last.twin
        };
        if !self.running && has_changed {
            publish.send_replace(Arc::new(self.view()));
        }
    }
}
