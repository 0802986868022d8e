//! The Rainbow-IQN policy as a transport (paper, §IV-A): one step along an axis per decision, greedy.
//!
//! In training the tool was only at the centres of the sweep's cells. So the tool first goes to a nearby cell that
//! keeps training's distance from walls, and then from cell to cell. Between two cells the network does not run: a slow
//! tool needs several control steps for one action.
//!
//! A policy with a memory does not depend on the image, so the tool may be between cells. It takes a shortcut over the
//! cells to which the policy would go, where a straight line over them is clear.

mod shortcut;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::planning::LEAST_CLEARANCE_M;
use super::progress::{Progress, Standstill};
use super::{Transport, TransportInput, Trouble};
use crate::control::{CONTROL_PERIOD_S, Refusal, TargetStep};
use crate::geometry::{Point2, Vector2};
use crate::perception::{Area, Observation, Percept};
use crate::policy::{Action, Cell, Judgement, Lattice, Policy, PolicyError, Survey};

/// Share of a step within which the tool counts as over a cell.
const OVER: f64 = 0.35;
/// Distance, in cells, within which the tool looks for a cell to enter the lattice.
const ENTRY_CELLS: i64 = 2;

fn is_over(lattice: &Lattice, place: Point2<f64>, cell: Cell) -> bool {
    (lattice.center_m(cell) - place).norm() <= OVER * lattice.step_m
}

/// What the policy decided over a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decision {
    cell: Cell,
    /// The network's result.
    pub judgement: Judgement,
    /// The action taken: the best one, or the next best that the shield allows.
    pub action: Action,
    /// What the policy saw, if it has a memory.
    pub survey: Option<Survey>,
    /// Whether what the policy saw shows no route to the goal, even through unseen cells.
    is_walled_off: bool,
    /// Where the tool goes straight to, over several cells of the route that begins with the action.
    pub shortcut_m: Option<Point2<f64>>,
}

/// The transport and its memory.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rl {
    /// The cell that the tool is over or moves to; `None` on a shortcut.
    cell: Option<Cell>,
    /// The last decision.
    decision: Option<Decision>,
    /// How often the tool chose an action over each cell on this leg.
    visits: BTreeMap<Cell, u32>,
    progress: Progress,
}

impl Rl {
    /// The last decision.
    pub fn decision(&self) -> Option<&Decision> {
        self.decision.as_ref()
    }

    /// What a policy with a memory saw at its last decision; `None` for one that sees the image.
    pub fn survey(&self) -> Option<&Survey> {
        self.decision()?.survey.as_ref()
    }

    /// What a policy with a memory sees over a cell.
    fn survey_over(&self, policy: &Policy, input: &TransportInput<'_>, lattice: &Lattice, here: Cell) -> Survey {
        let ends_m = [lattice.center_m(here), input.goal_m];
        let clearance_m = policy.manifest().clearance_m;
        let mut survey = Survey::over(input.known, lattice.step_m, clearance_m, ends_m);
        // Walls that have closed in leave less room than the policy was trained with.
        if survey.is_walled_off() && input.known.forgets() {
            survey = Survey::over(input.known, lattice.step_m, clearance_m.min(LEAST_CLEARANCE_M), ends_m);
        }
        for (&place, &visits) in &self.visits {
            if let Some(cell) = survey.cell_at(place) {
                survey.set_visits(cell, visits);
            }
        }
        survey
    }

    /// Asks the policy. With a memory, a shortcut is looked for if `takes_shortcuts`.
    fn decide(
        &self,
        policy: &Policy,
        input: &TransportInput<'_>,
        lattice: &Lattice,
        cell: Cell,
        takes_shortcuts: bool,
    ) -> Result<Decision, PolicyError> {
        let take = |judgement: &Judgement| choose(lattice, input, policy, self.ranking(judgement, input, cell), cell);
        if !policy.has_memory() {
            let gray = input.percept.for_network(input.parameters.rl_corrects_image, input.tool_m, input.known);
            let seen = Observation::new(&gray, Some(input.goal_m), input.tool_m, &lattice.workspace);
            let judgement = policy.judge(&seen)?;
            let action = take(&judgement);
            return Ok(Decision { cell, judgement, action, survey: None, is_walled_off: false, shortcut_m: None });
        }
        let survey = self.survey_over(policy, input, lattice, cell);
        let planned = policy.plan(&survey)?;
        let judgement = planned.judge(&[survey.tool])?.remove(0);
        let action = take(&judgement);
        let clearance_m = policy.manifest().clearance_m;
        let route = shortcut::Route { rl: self, planned: &planned, survey: &survey, lattice, input, clearance_m };
        let ahead_m = if takes_shortcuts { route.farthest_clear_m(cell, beside(cell, action))? } else { None };
        let shortcut_m = ahead_m.filter(|&ahead_m| !is_blocked(input, Self::toward(input, ahead_m).target_m));
        drop(planned);
        let is_walled_off = survey.is_walled_off();
        Ok(Decision { cell, judgement, action, survey: Some(survey), is_walled_off, shortcut_m })
    }

    /// Actions, best first, by the network's value minus the penalty for earlier visits of the cell ahead. A cell that
    /// the tool comes back to gets worse each time, so that going to and fro ends, as in learning real-time A*
    /// (Korf 1990, Artificial Intelligence 42, 189–211).
    fn ranking(&self, judgement: &Judgement, input: &TransportInput<'_>, here: Cell) -> [Action; 4] {
        let penalty = input.parameters.rl_visit_penalty as f32;
        let visits = Action::ALL.map(|action| self.visits.get(&beside(here, action)).copied().unwrap_or_default());
        judgement.ranking_with(visits.map(|count| penalty * count as f32))
    }

    /// The nearest cell that keeps the clearance with no obstacle before it; if none keeps the clearance, the cell with
    /// the most.
    fn entry(lattice: &Lattice, input: &TransportInput<'_>, clearance_m: f64) -> Option<Cell> {
        let [column, row] = lattice.cell_at(input.tool_m);
        let around = |middle: i64| middle - ENTRY_CELLS..=middle + ENTRY_CELLS;
        let mut best: Option<((f64, f64), Cell)> = None;
        for cell in around(row).flat_map(|row| around(column).map(move |column| [column, row])) {
            let center_m = lattice.center_m(cell);
            let percept = input.percept;
            let blocked =
                percept.wall_between(input.tool_m, center_m) && !percept.obstacle() || is_blocked(input, center_m);
            if blocked || !lattice.workspace.contains(center_m) {
                continue;
            }
            let lacking_m = clearance_m - wall_distance_m(percept, center_m, clearance_m);
            let rank = (lacking_m, (center_m - input.tool_m).norm());
            if best.is_none_or(|(best_rank, _)| rank < best_rank) {
                best = Some((rank, cell));
            }
        }
        best.map(|(_, cell)| cell)
    }

    /// A control step toward a place.
    fn toward(input: &TransportInput<'_>, place_m: Point2<f64>) -> TargetStep {
        let limit_m_s = input.parameters.transport_speed_m_s;
        let offset: Vector2<f64> = (place_m - input.tool_m).cap_magnitude(limit_m_s * CONTROL_PERIOD_S);
        let speed_m_s = (offset.norm() / CONTROL_PERIOD_S).min(limit_m_s);
        TargetStep { target_m: input.tool_m + offset, speed_m_s }
    }
}

/// Distance to the nearest wall in view, capped at `max_m`.
fn wall_distance_m(percept: &Percept, place: Point2<f64>, max_m: f64) -> f64 {
    percept.wall_distance_m(place, max_m).unwrap_or(max_m)
}

fn is_blocked(input: &TransportInput<'_>, target_m: Point2<f64>) -> bool {
    input.percept.obstacle_on_step(input.tool_m, target_m).is_some()
}

/// The best action. With the shield: the best one whose step keeps training's distance from the walls in view, or else
/// the best one whose step is free of obstacles.
fn choose(lattice: &Lattice, input: &TransportInput<'_>, policy: &Policy, ranking: [Action; 4], here: Cell) -> Action {
    let clearance_m = policy.manifest().clearance_m;
    let target_m = |action: &Action| lattice.center_m(beside(here, *action));
    let is_free =
        |action: &Action| lattice.workspace.contains(target_m(action)) && !is_blocked(input, target_m(action));
    let keeps = |action: &Action| wall_distance_m(input.percept, target_m(action), clearance_m) >= clearance_m;
    let best = ranking[0];
    if !input.parameters.rl_shield {
        return best;
    }
    let free = || ranking.into_iter().filter(is_free);
    free().find(keeps).or_else(|| free().next()).unwrap_or(best)
}

fn beside([column, row]: Cell, action: Action) -> Cell {
    let (x, y) = action.offset();
    [column + x as i64, row + y as i64]
}

impl Transport for Rl {
    fn start_leg(&mut self) {
        *self = Self::default();
    }

    fn next_step(&mut self, input: &TransportInput<'_>) -> Result<TargetStep, Refusal> {
        let Some(policy) = input.policy else { return Err(Refusal::Policy("none is loaded".to_owned())) };
        let lattice = Lattice { workspace: *input.known.workspace(), step_m: policy.manifest().step_m };
        let takes_shortcuts = policy.has_memory() && input.parameters.rl_shortcut;
        self.progress.note(input.tool_m);
        let here = match self.cell {
            Some(cell) => cell,
            None => {
                let (near, clearance_m) = (lattice.cell_at(input.tool_m), policy.manifest().clearance_m);
                let is_free = || input.known.disc(lattice.center_m(near), clearance_m) == Area::Free;
                match takes_shortcuts && is_free() {
                    true => near,
                    false => Self::entry(&lattice, input, clearance_m).unwrap_or(near),
                }
            }
        };
        let is_over_cell = is_over(&lattice, input.tool_m, here);
        // The tool is still moving to its cell.
        if !is_over_cell && (self.cell.is_some() || !takes_shortcuts) {
            self.cell = Some(here);
            return Ok(Self::toward(input, lattice.center_m(here)));
        }
        let decision = self
            .decide(policy, input, &lattice, here, takes_shortcuts)
            .map_err(|error| Refusal::Policy(error.to_string()))?;
        let step = if let Some(ahead_m) = decision.shortcut_m {
            // Between two cells it decides over the same cell again.
            let was_here = self.cell.is_none() && self.decision.as_ref().is_some_and(|last| last.cell == here);
            *self.visits.entry(here).or_default() += u32::from(!was_here);
            self.cell = None;
            Self::toward(input, ahead_m)
        } else if !is_over_cell {
            self.cell = Some(here);
            return Ok(Self::toward(input, lattice.center_m(here)));
        } else {
            *self.visits.entry(here).or_default() += 1;
            let next = beside(here, decision.action);
            let step = Self::toward(input, lattice.center_m(next));
            // A step that the limits refuse is not taken. The policy decides again from here.
            let is_taken = lattice.workspace.contains(lattice.center_m(next)) && !is_blocked(input, step.target_m);
            self.cell = Some(if is_taken { next } else { here });
            step
        };
        self.decision = Some(decision);
        Ok(step)
    }

    fn trouble(&self) -> Option<Trouble> {
        if self.decision().is_some_and(|decision| decision.is_walled_off) {
            return Some(Trouble::WalledOff);
        }
        self.progress.standstill().map(|standstill| match standstill {
            Standstill::Still => Trouble::Refused,
            Standstill::Around => Trouble::Circling,
        })
    }
}

#[cfg(test)]
mod tests;
