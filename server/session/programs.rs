//! Programs outside of Ferry that decide control steps, as sessions see them.

use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::{mpsc, oneshot};

use crate::control::transport::program::Answer;
use crate::geometry::Rect;
use crate::perception::Percept;
use crate::scenario::Parameters;
use crate::trial::Question;

/// A live session waits this long for an answer; then the arm holds for this control step.
pub const ANSWER_WITHIN: Duration = Duration::from_millis(100);
/// Questions of all sessions that may wait for one program.
const QUESTIONS_MOST: usize = 64;

/// What a program is asked before a control step.
#[derive(Debug)]
pub struct Asked {
    /// Of a session or another trial.
    pub trial: String,
    pub question: Question,
    /// The camera's image.
    pub percept: Percept,
    /// Dark blocks of the image on the table.
    pub obstacles: Vec<Rect>,
    pub leg: Leg,
    /// Takes the answer; dropping it means that none will come.
    pub answer: oneshot::Sender<Answer>,
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

/// One program, by its name. It stays when the program disconnects, so that sessions find it again.
#[derive(Debug)]
pub struct Program {
    pub name: String,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    questions: Option<mpsc::Sender<Asked>>,
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

impl Program {
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), state: Mutex::default() }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Connects the program; `None` if it is connected already.
    pub fn connect(&self) -> Option<mpsc::Receiver<Asked>> {
        let mut state = self.state();
        if state.standing.is_connected {
            return None;
        }
        let (questions, asked) = mpsc::channel(QUESTIONS_MOST);
        *state = State { questions: Some(questions), standing: Standing { is_connected: true, ..Standing::default() } };
        Some(asked)
    }

    pub fn disconnect(&self) {
        let mut state = self.state();
        state.questions = None;
        state.standing.is_connected = false;
    }

    pub fn standing(&self) -> Standing {
        self.state().standing
    }

    /// # Errors
    /// [`NotAsked`].
    pub fn ask(&self, asked: Asked) -> Result<(), NotAsked> {
        let state = self.state();
        let questions = state.questions.as_ref().ok_or(NotAsked::NotConnected)?;
        questions.try_send(asked).map_err(|error| match error {
            mpsc::error::TrySendError::Full(_) => NotAsked::Busy,
            mpsc::error::TrySendError::Closed(_) => NotAsked::NotConnected,
        })
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
