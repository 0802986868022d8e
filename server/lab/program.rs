//! A program outside of Ferry that decides control steps, as sessions and evaluations ask it.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use tokio::sync::{mpsc, oneshot};

use crate::changes::Changes;
use ferry_core::control::transport::program::Answer;
use ferry_core::image::ImageSource;
use ferry_core::trial::{ControlQuery, Seen, Source, TickRecord, Trial, TrialError};

/// An evaluation or a comparison waits this long.
const TRIAL_WITHIN: Duration = Duration::from_secs(10);
/// Questions of all sessions that may wait for one program.
const QUESTIONS_MOST: usize = 64;

/// What a program gets.
#[derive(Debug)]
pub enum Sent {
    Question(Asked),
    /// There are no more questions in the trial of this name.
    Ended(String),
}

/// What a program is asked before a control step.
#[derive(Debug)]
pub struct Asked {
    /// Name of the session, or of the trial of an evaluation.
    pub trial: String,
    pub query: Box<ControlQuery>,
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
    /// Those of the list.
    changes: Changes,
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
        if let Some(query) = trial.control_query(&seen, 0) {
            let answer = self.answer(Box::new(query))?;
            trial.apply_answer(answer)?;
        }
        Ok(seen)
    }

    fn answer(self, query: Box<ControlQuery>) -> Result<Answer, ProgramError> {
        let gone = || ProgramError::NotAsked { program: self.program.name.clone(), error: NotAsked::NotConnected };
        let (asked, answered) = asked(self.trial, query, TRIAL_WITHIN);
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
    /// A program in a list with these changes.
    pub fn new(name: &str, changes: Changes) -> Self {
        Self { name: name.to_owned(), state: Mutex::default(), changes }
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
        drop(state);
        self.changes.note();
        Some(Connection(sent))
    }

    pub fn disconnect(&self) {
        let mut state = self.state();
        state.connection = None;
        state.standing.is_connected = false;
        drop(state);
        self.changes.note();
    }

    pub fn standing(&self) -> Standing {
        self.state().standing
    }

    /// Asks about a control step. `trial` is the name of the session.
    ///
    /// # Errors
    /// [`NotAsked`].
    pub fn ask(
        &self,
        trial: &str,
        query: Box<ControlQuery>,
        within: Duration,
    ) -> Result<oneshot::Receiver<Answer>, NotAsked> {
        let (asked, answered) = asked(trial, query, within);
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
        let mut state = self.state();
        let standing = &mut state.standing;
        match latency {
            Some(latency) => {
                standing.answers += 1;
                standing.latency_s = Some(latency.as_secs_f64());
            }
            None => standing.missed += 1,
        }
        drop(state);
        self.changes.note();
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

fn asked(trial: &str, query: Box<ControlQuery>, within: Duration) -> (Sent, oneshot::Receiver<Answer>) {
    let (reply, answered) = Reply::new();
    (Sent::Question(Asked { trial: trial.to_owned(), query, within, reply }), answered)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_connected_once_at_a_time() {
        let program = Program::new("mine", Changes::default());
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
