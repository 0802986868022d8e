//! A program outside of Ferry that decides control steps, as sessions and evaluations ask it.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use tokio::sync::{mpsc, oneshot};

use ferry_core::control::transport::program::Answer;
use ferry_core::geometry::Rect;
use ferry_core::image::ImageSource;
use ferry_core::perception::Percept;
use ferry_core::scenario::Parameters;
use ferry_core::trial::{Input, Question, REASON_BYTES_MOST, Seen, Source, TickRecord, Trial, TrialError};

/// A live session waits this long for an answer; then the arm holds for this control step.
pub const LIVE_WITHIN: Duration = Duration::from_millis(100);
/// An evaluation or a comparison waits this long.
const TRIAL_WITHIN: Duration = Duration::from_secs(10);
/// Questions of all sessions that may wait for one program.
const QUESTIONS_MOST: usize = 64;

/// What a program gets.
#[derive(Debug)]
pub enum Sent {
    Question(Box<Asked>),
    /// There are no more questions in the trial of this name.
    Ended(String),
}

/// What a program is asked before a control step.
#[derive(Debug)]
pub struct Asked {
    /// Name of the session, or of the trial of an evaluation.
    pub trial: String,
    pub question: Question,
    /// The camera's image.
    pub percept: Percept,
    /// Dark blocks of the image on the table.
    pub obstacles: Vec<Rect>,
    pub leg: Leg,
    /// How long the answer is waited for.
    pub within: Duration,
    pub reply: Reply,
}

/// Takes the answer to a question; dropping it means that none will come.
#[derive(Debug)]
pub struct Reply(oneshot::Sender<Answer>);

impl Reply {
    /// A reply, and where its answer arrives.
    pub fn new() -> (Self, oneshot::Receiver<Answer>) {
        let (reply, answered) = oneshot::channel();
        (Self(reply), answered)
    }

    /// Whether the answer is still waited for.
    pub fn is_open(&self) -> bool {
        !self.0.is_closed()
    }

    /// Returns false if the answer is no longer waited for.
    pub fn give(self, answer: Answer) -> bool {
        self.0.send(answer).is_ok()
    }
}

/// The part of a trial between two fetches or goals.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// Counts the trials of a session.
    pub trial: u64,
    /// Counts switches within a trial.
    pub switches: u32,
    pub map: String,
    pub workspace: Rect,
    pub parameters: Parameters,
}

/// The trial in which a program is asked.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// Name of the session, or of the trial of an evaluation.
    pub name: &'a str,
    /// Counts the trials of a session.
    pub number: u64,
}

/// What a connected program gets; `None` when it was disconnected.
#[derive(Debug)]
pub struct Connection(mpsc::Receiver<Sent>);

impl Connection {
    pub async fn next(&mut self) -> Option<Sent> {
        self.0.recv().await
    }

    /// Questions that are waiting, and later ones, will have no answer.
    pub fn close(&mut self) {
        self.0.close();
        while self.0.try_recv().is_ok() {}
    }

    /// # Panics
    /// In an asynchronous task.
    pub fn wait(&mut self) -> Option<Sent> {
        self.0.blocking_recv()
    }
}

/// One program, by its name. It stays when the program disconnects, so that sessions find it again.
#[derive(Debug)]
pub struct Program {
    pub name: String,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    connection: Option<mpsc::Sender<Sent>>,
    standing: Standing,
}

/// How a program does, over all sessions since it connected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Standing {
    pub is_connected: bool,
    pub answers: u64,
    /// Control steps for which no usable answer came in time.
    pub missed: u64,
    /// Time to the last answer.
    pub latency_s: Option<f64>,
}

/// Why a program was not asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotAsked {
    #[error("is not connected")]
    NotConnected,
    #[error("has {QUESTIONS_MOST} questions to answer already")]
    Busy,
}

/// Why a program did not decide a control step of a trial that waits for it.
#[derive(Debug, thiserror::Error)]
pub enum ProgramError {
    #[error("{program} {error}")]
    NotAsked { program: String, error: NotAsked },
    #[error("a clock could not start: {0}")]
    Clock(#[from] std::io::Error),
    #[error(transparent)]
    Trial(#[from] TrialError),
}

/// A program that carries the bead in a trial that waits for its answers.
#[derive(Clone, Copy)]
pub struct Carrier<'a> {
    pub program: &'a Program,
    /// Name of the trial.
    pub trial: &'a str,
}

impl Carrier<'_> {
    /// Sees and decides the control step that is due. A late answer holds the arm.
    ///
    /// # Errors
    /// [`ProgramError`]; the program is gone, or the camera failed.
    ///
    /// # Panics
    /// In an asynchronous task.
    pub fn decide(self, trial: &mut Trial, camera: &mut dyn ImageSource) -> Result<Seen, ProgramError> {
        let seen = trial.see(camera).map_err(TrialError::from)?;
        if let Some(question) = trial.question(&seen) {
            let answer = self.answer(trial, &seen, question)?;
            give(trial, answer)?;
        }
        Ok(seen)
    }

    fn answer(self, trial: &Trial, seen: &Seen, question: Question) -> Result<Answer, ProgramError> {
        let gone = || ProgramError::NotAsked { program: self.program.name.clone(), error: NotAsked::NotConnected };
        let place = Place { name: self.trial, number: 0 };
        let (asked, answered) = asked(place, trial, seen, question, TRIAL_WITHIN);
        let began = Instant::now();
        let connection = self.program.connection().map_err(|_| gone())?;
        connection.blocking_send(asked).map_err(|_| gone())?;
        let clock = tokio::runtime::Builder::new_current_thread().enable_time().build()?;
        let answer = match clock.block_on(async { tokio::time::timeout(TRIAL_WITHIN, answered).await }) {
            Ok(answer) => Some(answer.map_err(|_| gone())?),
            Err(_) => None,
        };
        self.program.note(answer.is_some().then(|| began.elapsed()));
        Ok(answer.unwrap_or_else(|| self.program.no_answer(Some(TRIAL_WITHIN))))
    }

    /// There are no more questions in the trial.
    pub fn end(self) {
        self.program.end(self.trial);
    }
}

impl Program {
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), state: Mutex::default() }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Connects the program; `None` if it is connected already.
    pub fn connect(&self) -> Option<Connection> {
        let mut state = self.state();
        if state.standing.is_connected {
            return None;
        }
        let (connection, sent) = mpsc::channel(QUESTIONS_MOST);
        let standing = Standing { is_connected: true, ..Standing::default() };
        *state = State { connection: Some(connection), standing };
        Some(Connection(sent))
    }

    pub fn disconnect(&self) {
        let mut state = self.state();
        state.connection = None;
        state.standing.is_connected = false;
    }

    pub fn standing(&self) -> Standing {
        self.state().standing
    }

    /// Asks about the control step that is due.
    ///
    /// # Errors
    /// [`NotAsked`].
    pub fn ask(
        &self,
        place: Place<'_>,
        trial: &Trial,
        seen: &Seen,
        question: Question,
    ) -> Result<oneshot::Receiver<Answer>, NotAsked> {
        let (asked, answered) = asked(place, trial, seen, question, LIVE_WITHIN);
        self.connection()?.try_send(asked).map_err(|error| match error {
            mpsc::error::TrySendError::Full(_) => NotAsked::Busy,
            mpsc::error::TrySendError::Closed(_) => NotAsked::NotConnected,
        })?;
        Ok(answered)
    }

    /// Says that there are no more questions in a trial. A program that is gone or busy does not learn it.
    pub fn end(&self, trial: &str) {
        if let Ok(connection) = self.connection() {
            let _ = connection.try_send(Sent::Ended(trial.to_owned()));
        }
    }

    fn connection(&self) -> Result<mpsc::Sender<Sent>, NotAsked> {
        self.state().connection.clone().ok_or(NotAsked::NotConnected)
    }

    /// Counts a control step: with the time to its answer, or without a usable one.
    pub fn note(&self, latency: Option<Duration>) {
        let standing = &mut self.state().standing;
        match latency {
            Some(latency) => {
                standing.answers += 1;
                standing.latency_s = Some(latency.as_secs_f64());
            }
            None => standing.missed += 1,
        }
    }

    /// What is done without an answer: none came `within` this time, or none that can be used.
    pub fn no_answer(&self, within: Option<Duration>) -> Answer {
        let why = match within {
            Some(within) => format!("gave no answer within {} ms", within.as_millis()),
            None => "gave no usable answer".to_owned(),
        };
        Answer::Hold { reason: format!("{} {why}", self.name) }
    }
}

fn asked(
    place: Place<'_>,
    trial: &Trial,
    seen: &Seen,
    question: Question,
    within: Duration,
) -> (Sent, oneshot::Receiver<Answer>) {
    let world = &trial.state().world;
    let leg = Leg {
        trial: place.number,
        switches: world.counters.switches,
        map: trial.scenario().map.clone(),
        workspace: *trial.arena().map.workspace(),
        parameters: world.parameters.clone(),
    };
    let (reply, answered) = Reply::new();
    let (percept, obstacles) = (seen.percept.clone(), trial.blocks_m(seen));
    let asked = Asked { trial: place.name.to_owned(), question, percept, obstacles, leg, within, reply };
    (Sent::Question(Box::new(asked)), answered)
}

/// A tick of a trial; a carrier decides its control steps.
///
/// # Errors
/// [`ProgramError`].
///
/// # Panics
/// With a carrier, in an asynchronous task.
pub fn tick(
    trial: &mut Trial,
    carrier: Option<Carrier<'_>>,
    camera: &mut dyn ImageSource,
) -> Result<TickRecord, ProgramError> {
    let source = match carrier.filter(|_| trial.step_is_due()) {
        Some(carrier) => Source::Seen(Box::new(carrier.decide(trial, camera)?)),
        None => Source::Camera(camera),
    };
    Ok(trial.tick(source)?)
}

/// Gives an answer to the trial; one that the trial refuses is a hold that says so.
pub fn give(trial: &mut Trial, answer: Answer) -> Result<(), TrialError> {
    let input = match answer {
        Answer::Go { target_m } => Input::Go { x_m: target_m.x, y_m: target_m.y },
        Answer::Hold { reason } => Input::Hold { reason },
    };
    if let Err(error) = trial.apply(input) {
        let mut reason = error.to_string();
        reason.truncate(reason.floor_char_boundary(REASON_BYTES_MOST));
        trial.apply(Input::Hold { reason })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_connected_once_at_a_time() {
        let program = Program::new("mine");
        let asked = program.connect().unwrap();
        assert!(program.connect().is_none() && program.standing().is_connected);
        program.note(Some(Duration::from_millis(5)));
        program.note(None);
        assert_eq!((program.standing().answers, program.standing().missed), (1, 1));
        drop(asked);
        program.disconnect();
        assert!(!program.standing().is_connected && program.connect().is_some());
        assert_eq!(program.standing().answers, 0, "it counts from its connection");
    }
}
