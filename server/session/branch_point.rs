//! A moment taken out of a session, with the program that can carry the bead from there.

use std::ops::ControlFlow;
use std::sync::Arc;

use ferry_core::image::ImageSource;
use ferry_core::scenario::ControllerName;
use ferry_core::session::{self, Progress};
use ferry_lab::program::{self, Carrier, Program, ProgramError};

/// A snapshot of a session, and the inputs after it.
#[derive(Clone, Debug)]
pub struct BranchPoint {
    pub point: session::BranchPoint,
    /// Name of the session.
    session: String,
    /// The program that was selected last.
    program: Option<Arc<Program>>,
}

impl BranchPoint {
    pub(super) fn new(point: session::BranchPoint, session: &str, program: Option<Arc<Program>>) -> Self {
        Self { point, session: session.to_owned(), program }
    }

    /// The program that can carry the bead in a branch.
    pub fn program(&self) -> Option<&Arc<Program>> {
        self.program.as_ref().filter(|program| program.standing().is_connected)
    }

    /// Continues from here under a controller (see [`session::BranchPoint::branch`]).
    ///
    /// # Errors
    /// [`ProgramError`].
    ///
    /// # Panics
    /// In an asynchronous task.
    pub fn branch(
        &self,
        controller: ControllerName,
        camera: &mut dyn ImageSource,
        watch: &mut dyn FnMut(Progress<'_>) -> ControlFlow<()>,
    ) -> Result<(), ProgramError> {
        let name = format!("{}, comparison", self.session);
        let program = self.program().filter(|_| controller == ControllerName::Program);
        let carrier = program.map(|program| Carrier { program, trial: &name });
        let ran = self.point.branch(controller, &mut |trial| program::tick(trial, carrier, camera), watch);
        if let Some(carrier) = carrier {
            carrier.end();
        }
        ran
    }
}
