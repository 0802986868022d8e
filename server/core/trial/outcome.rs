//! Progress of the task, and when it ends.

use super::{Event, Happening, Motion, Phase, SETTLE_S, StopReason, Trial, World};
use crate::control::Refusal;
use crate::control::switching::Mode;
use crate::facts::Told;
use crate::robot::ur5::SERVO_PERIOD_S;

/// The goal is *reached* when the tool is within this distance (the paper's test), and *delivered* when the
/// bead is.
pub const GOAL_RADIUS_M: f64 = 0.02;
/// A delivered bead counts as moved away beyond this distance. It is a little larger than [`GOAL_RADIUS_M`], so
/// that the phase does not flicker.
const LEFT_RADIUS_M: f64 = 0.025;
impl Trial {
    /// Updates the phase after a tick: delivered, lifted off, or stopped by a limit.
    pub(super) fn judge(&mut self) {
        let tick = self.state.world.tick;
        let world = &mut self.state.world;
        if world.plant.bead.lifted_off {
            if world.phase != Phase::LiftedOff {
                world.phase = Phase::LiftedOff;
                world.motion = Motion::Hold;
                self.events.push(Event::new(tick, Happening::LiftedOff));
            }
            return;
        }
        if world.phase == Phase::LiftedOff {
            world.phase = Phase::Holding;
        }
        let Some(goal) = world.goal_m else { return };
        let left_m = (world.plant.bead.position_m - goal).norm();
        match world.phase {
            // Pulled off the goal, but not so far that a fetch is needed: the magnet pulls it back.
            Phase::Delivered if left_m > LEFT_RADIUS_M => world.phase = Phase::Settling { since_tick: tick },
            // Time during which a hand holds the bead, or the tracker is lost and the arm holds, does not count.
            Phase::Settling { .. }
                if left_m > GOAL_RADIUS_M && matches!(world.refusal, Some(Refusal::TrackerLost { .. }))
                    || world.plant.hand.is_some() =>
            {
                world.phase = Phase::Settling { since_tick: tick };
            }
            Phase::Settling { .. } | Phase::Stopped(StopReason::Settle)
                if left_m <= GOAL_RADIUS_M && world.plant.hand.is_none() =>
            {
                world.phase = Phase::Delivered;
                world.counters.deliveries += 1;
                world.counters.goal_steps = 0;
                world.counters.leg_steps = 0;
                self.events.push(Event::new(tick, Happening::Delivered { distance_m: left_m }));
            }
            Phase::Settling { since_tick } if tick.saturating_sub(since_tick) as f64 * SERVO_PERIOD_S > SETTLE_S => {
                self.stop(StopReason::Settle);
            }
            _ => {}
        }
    }

    pub(super) fn stop(&mut self, reason: StopReason) {
        let world = &mut self.state.world;
        world.phase = Phase::Stopped(reason);
        world.motion = Motion::Hold;
        self.events.push(Event::new(world.tick, Happening::Stopped { phase: Told::of(&world.phase) }));
    }

    /// From now on, leg and goal have all their steps again, also if they ran out. The counters go on, because scripts
    /// refer to them.
    pub(crate) fn renew_steps(&mut self) {
        let World { counters, phase, .. } = &mut self.state.world;
        self.free_steps = counters.steps;
        counters.held_steps = 0;
        if let Phase::Stopped(StopReason::LegSteps { .. } | StopReason::GoalSteps { .. } | StopReason::TrackerLost) =
            phase
        {
            *phase = Phase::Transporting;
        }
    }

    /// Begins a new leg, because the goal moved or the bead was fetched.
    pub(super) fn start_leg(&mut self) {
        let tool = self.tool_m().xy();
        let world = &mut self.state.world;
        world.counters.leg_steps = 0;
        world.script.at_leg_step = None;
        if let (Some(goal), true) = (world.goal_m, world.script.remaining > 0) {
            // No path is shorter than the straight line, so the leg has at least this many steps.
            let step_m = world.parameters.transport_speed_m_s * crate::control::CONTROL_PERIOD_S;
            let least_steps = (((goal - tool).norm() - GOAL_RADIUS_M) / step_m).floor().max(1.0) as u32;
            world.script.draw_step(self.scenario.seed, least_steps);
        }
    }

    /// Updates the phase from mode and goal at a control step, with its events.
    pub(super) fn progress(&mut self, mode: Mode, at_goal: bool) {
        let world = &mut self.state.world;
        let tick = world.tick;
        // Only a new goal, a reset or a hand ends these phases.
        if matches!(
            world.phase,
            Phase::LiftedOff | Phase::Stopped(StopReason::GoalSteps { .. } | StopReason::TrackerLost)
        ) {
            return;
        }
        match (mode, world.goal_m) {
            (Mode::Approach, _) => world.phase = Phase::Approaching,
            (Mode::Transport, None) => world.phase = Phase::Holding,
            (Mode::Transport, Some(_)) if at_goal => {
                if !matches!(world.phase, Phase::Settling { .. } | Phase::Delivered | Phase::Stopped(_)) {
                    world.phase = Phase::Settling { since_tick: tick };
                }
                if world.reached_tick.is_none() {
                    world.reached_tick = Some(tick);
                    self.events.push(Event::new(tick, Happening::Reached));
                }
            }
            (Mode::Transport, Some(_)) => {
                if !matches!(world.phase, Phase::Stopped(_)) {
                    world.phase = Phase::Transporting;
                }
            }
        }
    }
}
