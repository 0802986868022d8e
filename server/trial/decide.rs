//! A control step: the controllers decide, and the trial carries the decision out.

use super::outcome::GOAL_RADIUS_M;
use super::phase::{GOAL_STEP_LIMIT, LEG_STEP_LIMIT, Phase, StopReason};
use super::{ControllerState, Decision, Event, EventKind, Motion, Trial, World};
use crate::control::switching::{self, Mode};
use crate::control::transport::{Carrier, TransportInput};
use crate::control::{CONTROL_PERIOD_S, Refusal, TargetStep};
use crate::geometry::{Point2, Vector2};
use crate::map::WALL_HEIGHT_M;
use crate::perception::{DarkPixels, Percept, wall_spread};

impl Trial {
    /// Decides from a frame. Changes only the controller state; [`Self::carry_out`] changes the world.
    pub(super) fn decide(&mut self, percept: &Percept) -> Decision {
        let world = &self.state.world;
        let controller_state = &mut self.state.controller_state;
        controller_state.seen = xxhash_rust::xxh3::xxh3_64(&percept.gray.pixels);
        let dark = DarkPixels::of(&percept.gray, world.parameters.obstacle_level);
        let spread = wall_spread(world.parameters.camera_height_m, WALL_HEIGHT_M);
        controller_state.known.update(&dark, &percept.calibration, spread);
        let tool = self.tool_m();
        let bead = world.tracker.estimate().position_m;
        let switching = switching::decide(world.switching.mode, tool.xy(), bead, &world.parameters, || {
            percept.wall_between(tool.xy(), bead)
        });
        let hold = Decision { switching, motion: Motion::Hold, refusal: None };
        if world.plant.bead.lifted_off || world.phase == Phase::Stopped(StopReason::GoalSteps) {
            return hold;
        }
        if switching.mode == Mode::Approach {
            return Decision { motion: Motion::Track, ..hold };
        }
        let fetched = switching.switched;
        let (Some(goal), false) = (world.goal_m, matches!(world.phase, Phase::Stopped(_)) && !fetched) else {
            return hold;
        };
        if fetched {
            self.state.controller_state.carrier.transport().start_leg();
        }
        let world = &self.state.world;
        let proposed = if (tool.xy() - goal).norm() <= GOAL_RADIUS_M {
            Ok(settle_step(tool.xy(), goal, world.parameters.transport_speed_m_s))
        } else {
            let ControllerState { carrier, known, .. } = &mut self.state.controller_state;
            let parameters = &world.parameters;
            let policy = match carrier {
                Carrier::Rl(_) => Some(self.arena.policy(parameters.rl_policy)),
                Carrier::Errt(_) | Carrier::Attractor(_) => None,
            };
            match policy.transpose() {
                Ok(policy) => {
                    let policy = policy.as_deref();
                    let input = TransportInput { percept, known, tool_m: tool.xy(), goal_m: goal, parameters, policy };
                    carrier.transport().next_step(&input)
                }
                Err(error) => Err(Refusal::Policy(error.to_string())),
            }
        };
        let limits = self.arena.limits(&world.parameters);
        let seed = &world.reference;
        let admitted = proposed.and_then(|step| limits.step(tool, &step, percept, seed).map(|()| step));
        match admitted {
            Ok(step) => Decision { motion: Motion::Segment(step), ..hold },
            Err(refusal) => Decision { refusal: Some(refusal), ..hold },
        }
    }

    /// Carries out a decision: switches, counts, starts the motion and applies due disturbances.
    pub(super) fn carry_out(&mut self, decision: &Decision) {
        let tick = self.state.world.tick;
        let switching = decision.switching;
        if switching.switched {
            self.state.world.counters.switches += 1;
            let to = switching.mode.index();
            let text = format!("sub-controller {to} takes over: {}", switching.reason());
            self.events.push(Event::new(tick, EventKind::Switch, text));
        }
        if let Some(refusal) = &decision.refusal {
            // Reported once, not at each step of a long hold.
            if self.state.world.refusal.is_none() {
                self.events.push(Event::new(tick, EventKind::Refused, format!("the arm holds: {refusal}")));
            }
        }
        let fetched = switching.switched && switching.mode == Mode::Transport;
        if fetched {
            self.start_leg();
        }
        if fetched && self.state.world.phase == Phase::Approaching {
            self.state.world.phase = Phase::Transporting;
        }
        let tool = self.tool_m().xy();
        let world = &mut self.state.world;
        world.switching = switching;
        world.motion = decision.motion;
        world.refusal.clone_from(&decision.refusal);
        let at_goal = world.goal_m.is_some_and(|goal| (tool - goal).norm() <= GOAL_RADIUS_M);
        self.progress(switching.mode, at_goal);
        self.count();
    }

    fn count(&mut self) {
        let world = &mut self.state.world;
        let active = world.goal_m.is_some() && matches!(world.phase, Phase::Approaching | Phase::Transporting);
        if !active {
            return;
        }
        world.counters.steps += 1;
        world.counters.goal_steps += 1;
        if world.phase == Phase::Transporting {
            world.counters.leg_steps += 1;
            if world.script.at_leg_step == Some(world.counters.leg_steps) {
                self.apply_random();
            }
        }
        let step = self.state.world.counters.goal_steps;
        self.apply_scripted(Some(step));
        let World { counters, phase, refusal, .. } = &self.state.world;
        if *phase == Phase::Transporting && *refusal == Some(Refusal::WalledOff) {
            self.stop(StopReason::WalledOff);
        } else if *phase == Phase::Transporting && counters.leg_steps > LEG_STEP_LIMIT {
            self.stop(StopReason::LegSteps);
        } else if counters.goal_steps > GOAL_STEP_LIMIT {
            self.stop(StopReason::GoalSteps);
        }
    }
}

/// Within 2 cm of the goal the tool goes straight onto it, so that the bead follows.
fn settle_step(tool: Point2<f64>, goal: Point2<f64>, speed_m_s: f64) -> TargetStep {
    let way: Vector2<f64> = (goal - tool).cap_magnitude(speed_m_s * CONTROL_PERIOD_S);
    TargetStep { target_m: tool + way, speed_m_s }
}
