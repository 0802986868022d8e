//! The arm in the hands of a robot client.

use std::sync::Arc;

use tokio::sync::watch;

use super::worker::Worker;
use super::{Command, View};
use crate::camera::ImageSource;
use crate::ur::news::Item;
use ferry_core::scenario::ControllerName;
use ferry_core::trial::{Event, EventKind, Input};

impl<E: ImageSource> Worker<E> {
    /// Gives the arm to a program that a client has sent to the robot: the session runs, at real speed.
    pub(super) fn give_arm(&mut self, publish: &watch::Sender<Arc<View>>) {
        let Some(robot) = self.robot.clone().filter(|robot| robot.controller().wants_arm()) else { return };
        robot.controller().give_arm();
        let select = Command::Input(Input::SelectController(ControllerName::Robot));
        for command in [select, Command::SetSpeed(1.0), Command::Run] {
            if let Err(error) = self.obey(command) {
                robot.controller().refuse("a program", &error.to_string());
                break;
            }
        }
        publish.send_replace(Arc::new(self.view()));
    }

    /// Asks the robot's program for the joints of the next tick. What violates a limit puts the arm into a protective stop.
    pub(super) fn ask_robot(&mut self) {
        let Some(robot) = self.robot.clone() else { return };
        if let Some(input) = robot.next(&self.trial)
            && let Err(error) = self.trial.apply(input)
        {
            robot.stop(&error);
        }
        let news = robot.controller().take_news();
        self.report_news("robot client", news);
    }

    /// `whom` is what they are about.
    pub(super) fn report_news(&mut self, whom: &str, news: Vec<Item>) {
        let tick = self.trial.state().world.tick;
        for Item { is_refused, text } in news {
            let kind = if is_refused { EventKind::Refused } else { EventKind::Session };
            self.report(Event::new(tick, kind, format!("{whom}: {text}")));
        }
    }

    /// Reports where the arm is, if it is reported.
    pub(super) fn report_arm(&self) {
        if let Some(robot) = &self.robot {
            robot.note(&self.trial);
        }
    }
}
