//! The program that a session asks.

use std::sync::Arc;
use std::time::Instant;

use tokio::sync::oneshot::{self, error::TryRecvError};

use ferry_core::control::transport::program::Answer;
use ferry_core::image::ImageSource;
use ferry_core::session::{PROGRAM_ANSWER_WITHIN, Session};
use ferry_core::trial::ControlQuery;
use ferry_lab::program::Program;

#[derive(Default)]
pub struct ProgramLink {
    /// The program that was selected last.
    selected: Option<Arc<Program>>,
    open: Option<OpenQuestion>,
}

/// A question that has been sent.
struct OpenQuestion {
    number: u64,
    program: Arc<Program>,
    answer: oneshot::Receiver<Answer>,
    since: Instant,
}

impl ProgramLink {
    pub fn selected(&self) -> Option<&Arc<Program>> {
        self.selected.as_ref()
    }

    /// The next questions of this session go to this program.
    pub fn select(&mut self, program: Arc<Program>, session: &str) {
        self.end(session);
        self.selected = Some(program);
    }

    /// There are no more questions.
    pub fn end(&mut self, session: &str) {
        if let Some(program) = self.selected.take() {
            program.end(session);
        }
    }

    /// Sends a question; if that fails, the session learns it.
    pub fn ask<E: ImageSource>(&mut self, name: &str, number: u64, query: Box<ControlQuery>, session: &mut Session<E>) {
        let Some(program) = self.selected.clone() else {
            return session.answer(number, Answer::Hold { reason: "none is selected".to_owned() });
        };
        match program.ask(name, query, PROGRAM_ANSWER_WITHIN) {
            Ok(answer) => self.open = Some(OpenQuestion { number, program, answer, since: Instant::now() }),
            Err(error) => {
                program.note(None);
                session.answer(number, Answer::Hold { reason: format!("{} {error}", program.name) });
            }
        }
    }

    /// Passes on the answer, if it has come. Returns whether one is waited for.
    pub fn look<E: ImageSource>(&mut self, session: &mut Session<E>) -> bool {
        let Some(mut open) = self.open.take().filter(|open| session.awaits(open.number)) else { return false };
        match open.answer.try_recv() {
            Ok(answer) => {
                open.program.note(Some(open.since.elapsed()));
                session.answer(open.number, answer);
            }
            Err(TryRecvError::Closed) => {
                open.program.note(None);
                session.answer(open.number, open.program.no_answer(None));
            }
            Err(TryRecvError::Empty) => self.open = Some(open),
        }
        self.open.is_some()
    }

    /// No answer has come in time.
    pub fn missed(&mut self, number: u64) {
        if let Some(open) = self.open.take().filter(|open| open.number == number) {
            open.program.note(None);
        }
    }
}
