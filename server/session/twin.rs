//! The arm as the twin of a robot outside of Ferry.

use std::sync::Arc;
use std::time::Instant;

use tokio::sync::watch;

use super::worker::Worker;
use super::{Command, View};
use crate::camera::ImageSource;

impl<E: ImageSource> Worker<E> {
    /// Runs at real speed when the robot is connected, and while it is to follow.
    pub(super) fn run_for_twin(&mut self, publish: &watch::Sender<Arc<View>>) {
        let Some(twin) = self.twin.clone().filter(|twin| twin.wants_to_run()) else { return };
        if self.running && self.pace.factor() == 1.0 {
            return;
        }
        for command in [Command::SetSpeed(1.0), Command::Run] {
            if self.obey(command).is_err() {
                twin.let_go();
            }
        }
        publish.send_replace(Arc::new(self.view()));
    }

    /// Puts the arm where the robot is.
    pub(super) fn mirror_robot(&mut self) {
        // While a program is asked, the tick has its place already.
        let Some(twin) = self.twin.clone().filter(|_| self.asking.is_none()) else { return };
        if let Some(input) = twin.next(&self.trial, Instant::now())
            && let Err(error) = self.trial.apply(input)
        {
            twin.refuse(error.to_string());
        }
        self.tell_of_twin();
    }

    /// Reports what has happened to the robot.
    pub(super) fn tell_of_twin(&mut self) {
        if let Some(twin) = self.twin.clone() {
            self.report_news("robot", twin.take_news());
        }
    }

    /// Sends the robot where the controllers want it.
    pub(super) fn lead_twin(&self) {
        if let Some(twin) = &self.twin {
            twin.follow(&self.trial);
        }
    }

    /// Whatever else changes the trial or its pace ends the motion.
    pub(super) fn let_go_for(&self, command: &Command) {
        let is_harmless = match command {
            Command::Input(_) | Command::Run | Command::Attach(_) => true,
            Command::SetSpeed(factor) => *factor == 1.0,
            _ => false,
        };
        if let Some(twin) = self.twin.as_ref().filter(|_| !is_harmless) {
            twin.let_go();
        }
    }
}
