//! How trials are run: with the bead lifted by a script and the tool above the bead at the start, or as a person does it.
//!
//! A person acts through the inputs of an operator, so a recording replays without the person.

use std::sync::Arc;

use rand::RngExt;
use serde::{Deserialize, Serialize};

use ferry_core::control::CONTROL_PERIOD_S;
use ferry_core::geometry::Point2;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::{RandomTrialError, Scenario, Stream};
use ferry_core::trial::{Arena, Input, Phase, Trial, TrialError, far_point};

/// Speed of a person's hand that draws the bead through a maze.
const HAND_SPEED_M_S: f64 = 0.2;
/// The hand holds the bead at the end of its path for this long.
const HOLD_S: f64 = 0.5;
/// Attempts to find a place for the tool.
const DRAWS: usize = 200;

/// How trials are run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manner {
    /// Disturbances are made by a hand that draws the bead through free space; otherwise the bead is lifted.
    pub by_hand: bool,
    /// At the start the tool is at least 15 cm from the bead, so that the trial begins with a fetch; otherwise it is
    /// above the bead.
    pub tool_apart: bool,
}

impl Manner {
    /// The trial of a scenario, and the person who acts in it.
    ///
    /// # Errors
    /// The scenario is impossible, or the tool finds no place apart from the bead.
    pub fn begin(self, scenario: &Scenario, arena: &Arc<Arena>) -> Result<(Trial, Person), TrialError> {
        let hand = if self.by_hand { scenario.disturbances } else { 0 };
        let script = scenario.disturbances - hand;
        let scenario = Scenario { disturbances: script, ..scenario.clone() };
        let person = Person { remaining: hand, struck: 0, strike_at: None, drag: None };
        let Some(bead_m) = scenario.start_m.filter(|_| self.tool_apart) else {
            return Ok((Trial::new(scenario, arena.clone())?, person));
        };
        let mut rng = Stream::ToolStart.rng(scenario.seed);
        for _ in 0..DRAWS {
            let tool_m = far_point(&arena.map, &arena.space, None, bead_m, &mut rng);
            // The arm may not reach the place.
            let apart = Scenario { start_m: tool_m, ..scenario.clone() };
            if let (Some(_), Ok(mut trial)) = (tool_m, Trial::new(apart, arena.clone())) {
                trial.apply(Input::Place { x_m: bead_m.x, y_m: bead_m.y })?;
                return Ok((trial, person));
            }
        }
        Err(RandomTrialError { map: scenario.map }.into())
    }
}

/// A person who draws the bead away.
#[derive(Clone, Debug)]
pub struct Person {
    /// Disturbances that are left.
    remaining: u32,
    /// Disturbances so far.
    struck: u32,
    /// Step of the present leg at which the hand takes the bead.
    strike_at: Option<u32>,
    drag: Option<Drag>,
}

/// A pointer on its way.
#[derive(Clone, Debug)]
struct Drag {
    /// Corners of the path that are left, the next one last.
    path: Vec<Point2<f64>>,
    at_m: Point2<f64>,
    held_s: f64,
}

impl Drag {
    /// Moves the pointer for one tick; `false` when it has been at its end for long enough.
    fn advance(&mut self) -> bool {
        let mut left_m = HAND_SPEED_M_S * SERVO_PERIOD_S;
        while let Some(&corner) = self.path.last() {
            let offset = corner - self.at_m;
            if offset.norm() > left_m {
                self.at_m += offset.normalize() * left_m;
                return true;
            }
            left_m -= offset.norm();
            self.at_m = corner;
            self.path.pop();
        }
        self.held_s += SERVO_PERIOD_S;
        self.held_s < HOLD_S
    }
}

impl Person {
    /// Acts before a tick.
    pub fn act(&mut self, trial: &mut Trial) -> Result<(), TrialError> {
        if let Some(drag) = &mut self.drag {
            let input = match drag.advance() {
                true => Input::Drag { x_m: drag.at_m.x, y_m: drag.at_m.y, lift: false },
                false => {
                    self.drag = None;
                    Input::Release
                }
            };
            return Ok(trial.apply(input)?);
        }
        let world = &trial.state().world;
        let Some(goal) = world.goal_m.filter(|_| self.remaining > 0 && world.phase == Phase::Transporting) else {
            return Ok(());
        };
        let step = world.counters.leg_steps;
        let seed = trial.scenario().seed;
        let strike_at = *self.strike_at.get_or_insert_with(|| {
            // As for lifted beads: no path is shorter than the straight line, so the leg has at least this many steps.
            let step_m = world.parameters.transport_speed_m_s * CONTROL_PERIOD_S;
            let least_steps = ((goal - trial.tool_m().xy()).norm() / step_m).floor().max(1.0);
            let share: f64 = Stream::DisturbanceStep(self.struck).rng(seed).random();
            step + 1 + (share * least_steps) as u32
        });
        if step < strike_at {
            return Ok(());
        }
        let bead_m = world.plant.bead.position_m;
        let arena = trial.arena();
        let mut rng = Stream::DisturbancePlace(self.struck).rng(seed);
        let component = arena.space.component_at(bead_m);
        let path = far_point(&arena.map, &arena.space, component, bead_m, &mut rng)
            .and_then(|to| arena.space.taut_path(bead_m, to));
        (self.remaining, self.struck, self.strike_at) = (self.remaining - 1, self.struck + 1, None);
        if let Some(mut path) = path {
            path.reverse();
            self.drag = Some(Drag { path, at_m: bead_m, held_s: 0.0 });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ferry_core::plant::BEAD_RADIUS_M;
    use ferry_core::scenario::ControllerName;

    #[test]
    fn a_pointer_moves_at_its_speed_and_stays_at_its_end() {
        let path = vec![Point2::new(0.1, 0.05), Point2::new(0.1, 0.0)];
        let mut drag = Drag { path, at_m: Point2::origin(), held_s: 0.0 };
        let (mut ticks, mut last) = (0, drag.at_m);
        while drag.advance() {
            assert!((drag.at_m - last).norm() <= HAND_SPEED_M_S * SERVO_PERIOD_S + 1e-12);
            (ticks, last) = (ticks + 1, drag.at_m);
        }
        assert_eq!(last, Point2::new(0.1, 0.05));
        let expected_s = 0.15 / HAND_SPEED_M_S + HOLD_S;
        assert!((f64::from(ticks) * SERVO_PERIOD_S - expected_s).abs() < 3.0 * SERVO_PERIOD_S, "{ticks}");
    }

    #[test]
    fn a_trial_may_begin_apart_and_the_bead_is_where_it_would_be() {
        let arena = Arena::shipped("colon").unwrap();
        for index in 0..20 {
            let scenario = arena.random("colon", ControllerName::Errt, 2, 1, index).unwrap();
            let manner = Manner { by_hand: true, tool_apart: true };
            let (trial, person) = manner.begin(&scenario, &arena).unwrap();
            assert_eq!(person.remaining, 2);
            assert_eq!(trial.scenario().disturbances, 0);
            let bead_m = trial.state().world.plant.bead.position_m;
            assert!((bead_m - scenario.start_m.unwrap()).norm() < BEAD_RADIUS_M);
            assert!((trial.tool_m().xy() - bead_m).norm() >= 0.149);
            let (plain, person) = Manner::default().begin(&scenario, &arena).unwrap();
            assert_eq!((plain.scenario(), person.remaining), (&scenario, 0));
        }
    }
}
