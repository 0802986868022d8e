//! The robots of a session: the one whose clients may command the arm, and the one outside of Ferry that it mirrors.

use std::sync::Arc;
use std::time::Instant;

use ferry_core::image::ImageSource;
use ferry_core::scenario::ControllerName;
use ferry_core::session::{Command, Session};
use ferry_core::trial::{Event, Happening, Input};
use ferry_ur::news::Item;
use ferry_ur::{Robot, Standing, Twin, TwinStanding};

#[derive(Default)]
pub struct RobotLink {
    robot: Option<Arc<Robot>>,
    twin: Option<Arc<Twin>>,
}

impl RobotLink {
    pub fn connect_robot(&mut self, robot: Arc<Robot>) {
        self.robot = Some(robot);
    }

    pub fn connect_twin(&mut self, twin: Arc<Twin>) {
        self.twin = Some(twin);
    }

    pub fn robot_standing(&self) -> Option<Standing> {
        self.robot.as_ref().map(|robot| robot.standing())
    }

    pub fn twin_standing(&self) -> Option<TwinStanding> {
        self.twin.as_ref().map(|twin| twin.standing())
    }

    pub fn robot_that_wants_the_arm(&self) -> Option<Arc<Robot>> {
        self.robot.clone().filter(|robot| robot.controller().wants_arm())
    }

    /// What gives the arm to the robot's program.
    pub fn commands_of_robot() -> [Command; 3] {
        let select = Command::Input(Input::SelectController(ControllerName::Robot));
        [select, Command::SetSpeed(1.0), Command::Run]
    }

    pub fn twin_that_wants_to_run(&self) -> Option<Arc<Twin>> {
        self.twin.clone().filter(|twin| twin.wants_to_run())
    }

    /// What lets the arm mirror the robot.
    pub fn commands_of_twin() -> [Command; 2] {
        [Command::SetSpeed(1.0), Command::Run]
    }

    /// A command that changes the trial or its pace ends the motion of the robot outside.
    pub fn before_command(&self, command: &Command) {
        let is_harmless = match command {
            Command::Input(_) | Command::Run | Command::Attach(_) => true,
            Command::SetSpeed(factor) => *factor == 1.0,
            _ => false,
        };
        if let Some(twin) = self.twin.as_ref().filter(|_| !is_harmless) {
            twin.let_go();
        }
    }

    /// Asks the robot's program for the joints of the next tick, and puts the arm where the robot outside is.
    pub fn before_tick<E: ImageSource>(&self, session: &mut Session<E>) {
        if let Some(robot) = &self.robot {
            // What violates a limit puts the arm into a protective stop.
            if let Some(input) = robot.next(session.trial())
                && let Err(error) = session.follow(input)
            {
                robot.stop(&error);
            }
            let news = robot.controller().take_news();
            report(session, true, news);
        }
        // While a program is asked, the tick has its place already.
        if let Some(twin) = self.twin.as_ref().filter(|_| !session.asks()) {
            if let Some(input) = twin.next(session.trial(), Instant::now())
                && let Err(error) = session.follow(input)
            {
                twin.refuse(error.to_string());
            }
            self.report_news(session);
        }
    }

    /// Sends the robot outside where the controllers want it, and reports where the arm is.
    pub fn after_tick<E: ImageSource>(&self, session: &Session<E>) {
        if let Some(twin) = &self.twin {
            twin.follow(session.trial());
        }
        self.report_arm(session);
    }

    /// Reports where the arm is, if it is reported.
    pub fn report_arm<E: ImageSource>(&self, session: &Session<E>) {
        if let Some(robot) = &self.robot {
            robot.note(session.trial());
        }
    }

    /// Reports what has happened to the robot outside.
    pub fn report_news<E: ImageSource>(&self, session: &mut Session<E>) {
        if let Some(twin) = &self.twin {
            report(session, false, twin.take_news());
        }
    }
}

fn report<E: ImageSource>(session: &mut Session<E>, is_client: bool, news: Vec<Item>) {
    let tick = session.trial().state().world.tick;
    for Item { is_refused, text: detail } in news {
        session.report(Event::new(tick, Happening::Robot { is_client, is_refused, detail }));
    }
}
