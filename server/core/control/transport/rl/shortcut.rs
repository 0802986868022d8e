//! A shortcut over the next cells of the policy's route, where the obstacle map shows it clear.

use super::{Rl, beside};
use crate::control::transport::TransportInput;
use crate::geometry::Point2;
use crate::perception::Area;
use crate::policy::{Cell, Lattice, Planned, PolicyError, Survey};

/// Cells of the route that are looked at. The camera shows some ten to each side.
const CELLS_AHEAD: usize = 8;

/// The cells to which the policy would go with its present memory.
pub struct Route<'a> {
    pub rl: &'a Rl,
    pub planned: &'a Planned<'a>,
    pub survey: &'a Survey,
    pub lattice: &'a Lattice,
    pub input: &'a TransportInput<'a>,
    pub clearance_m: f64,
}

impl Route<'_> {
    /// The centre of the last cell of the route from `here` over `next` up to which a straight line from the tool to each
    /// cell is observed and clear; `None` if it is not clear to `next`. The route ends before a cell that it has passed.
    ///
    /// # Errors
    /// [`PolicyError`].
    pub fn farthest_clear_m(&self, here: Cell, mut next: Cell) -> Result<Option<Point2<f64>>, PolicyError> {
        let mut clear = Vec::with_capacity(CELLS_AHEAD);
        while clear.len() < CELLS_AHEAD && next != here && !clear.contains(&next) && self.is_clear_to(next) {
            clear.push(next);
            let Some(cell) = self.survey.cell_at(next).filter(|&cell| cell != self.survey.goal) else { break };
            let judgement = self.planned.judge(&[cell])?.remove(0);
            next = beside(next, self.rl.ranking(&judgement, self.input, next)[0]);
        }
        Ok(clear.last().map(|&cell| self.lattice.center_m(cell)))
    }

    fn is_clear_to(&self, cell: Cell) -> bool {
        let center_m = self.lattice.center_m(cell);
        self.input.known.corridor(self.input.tool_m, center_m, self.clearance_m) == Area::Free
    }
}
