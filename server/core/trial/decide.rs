//! A control step: the controllers decide, and the trial carries the decision out.

use std::borrow::Cow;

use super::outcome::GOAL_RADIUS_M;
use super::phase::{LEGS_PER_GOAL, Phase, StopReason};
use super::record::Seen;
use super::{ControllerState, Decision, Event, Happening, Motion, Trial, TrialState, World};
use crate::control::search::{Look, Search, SearchInput};
use crate::control::switching::{self, Mode};
use crate::control::transport::{Carrier, TransportInput};
use crate::control::{CONTROL_PERIOD_S, Refusal, TargetStep};
use crate::facts::Told;
use crate::geometry::{Point2, Point3, Rect};
use crate::image::CameraFrame;
use crate::map::WALL_HEIGHT_M;
use crate::perception::{
    BeadView, CellRect, Observation, ObstacleMap, Percept, Quadtree, QuadtreeParameters, wall_spread,
};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::Parameters;

/// A planner that finds no path between moving walls waits this many times the obstacle map's memory for one.
const MEMORIES_WAITED: f64 = 2.0;
/// A step by hand that is shorter is a rest.
const REST_M: f64 = 1e-3;

/// What a control step is about.
#[derive(Clone, Copy, Debug)]
enum Stage {
    /// The arm looks for the bead.
    TrackerLost {
        is_stopped: bool,
    },
    Hold,
    /// Sub-controller 1 flies to the bead.
    Approach,
    /// The tool is within 2 cm of the goal.
    Settle(Point2<f64>),
    /// Sub-controller 2 steps toward the goal.
    Transport(Point2<f64>),
}

/// What a program gets before a control step in which it decides.
#[derive(Clone, Debug)]
pub struct Question {
    pub tick: u64,
    pub tool_m: Point2<f64>,
    /// The bead as the tracker sees it.
    pub bead_m: Point2<f64>,
    pub goal_m: Point2<f64>,
}

fn update_known(known: &mut ObstacleMap, tick: u64, percept: &Percept, parameters: &Parameters) {
    if parameters.peristalsis_amplitude_m > 0.0 || known.forgets() {
        known.forget(tick, (parameters.obstacle_memory_s / SERVO_PERIOD_S) as u64);
    }
    let (dark, hidden) = (percept.dark(parameters.obstacle_level), percept.hidden());
    let spread = wall_spread(parameters.camera_height_m, WALL_HEIGHT_M);
    known.update_around(&dark, hidden.as_ref(), &percept.calibration, spread);
}

impl Trial {
    /// Decides from a frame and its percept. Changes only the controller state; [`Self::carry_out`] changes the world.
    ///
    /// The phase is the referee's: [`Self::judge`] knows where the bead is. Controllers learn from it only that they must
    /// stop: the bead hangs on the magnet, or a limit was exceeded.
    pub(super) fn decide(&mut self, frame: &CameraFrame, percept: &Percept) -> Decision {
        let tool = self.tool_m();
        let TrialState { world, controller_state, .. } = &mut self.state;
        controller_state.seen = xxhash_rust::xxh3::xxh3_64(&percept.gray.pixels);
        update_known(&mut controller_state.known, world.tick, percept, &world.parameters);
        if self.state.is_led_from_outside() {
            return self.leave_to_robot();
        }
        let (switching, stage) = self.stage(percept);
        if let Stage::TrackerLost { is_stopped } = stage {
            return self.look_for_bead(frame, percept, is_stopped);
        }
        self.state.controller_state.search = Search::default();
        let hold = Decision { switching, motion: Motion::Hold, refusal: None };
        if switching.switched && matches!(stage, Stage::Settle(_) | Stage::Transport(_)) {
            self.state.controller_state.carrier.transport().start_leg();
        }
        let world = &self.state.world;
        let proposed = match stage {
            Stage::TrackerLost { .. } | Stage::Hold => return hold,
            Stage::Approach => {
                return match self.flight_by_hand(tool) {
                    None => Decision { motion: Motion::Track, ..hold },
                    Some(Ok(step)) => Decision { motion: Motion::Segment(step), ..hold },
                    Some(Err(refusal)) => Decision { refusal: Some(refusal), ..hold },
                };
            }
            // Straight onto the goal, so that the bead follows.
            Stage::Settle(goal) => Ok(TargetStep::toward(tool.xy(), goal, world.parameters.transport_speed_m_s)),
            Stage::Transport(goal) => self.propose(percept, goal),
        };
        let world = &self.state.world;
        let limits = self.arena.limits(&world.parameters);
        let seed = &world.reference;
        let admitted = proposed.and_then(|step| limits.step(tool, &step, percept, seed).map(|()| step));
        match admitted {
            Ok(step) => Decision { motion: Motion::Segment(step), ..hold },
            Err(refusal) => Decision { refusal: Some(refusal), ..hold },
        }
    }

    /// No sub-controller does anything.
    fn leave_to_robot(&self) -> Decision {
        let world = &self.state.world;
        let motion = match world.motion {
            Motion::Joints(joints_rad) => Motion::Joints(joints_rad),
            _ => Motion::Hold,
        };
        let switching = switching::Decision { mode: Mode::Transport, switched: false, ..world.switching };
        Decision { switching, motion, refusal: None }
    }

    /// The step that sub-controller 2 proposes.
    fn propose(&mut self, percept: &Percept, goal_m: Point2<f64>) -> Result<TargetStep, Refusal> {
        let tool_m = self.tool_m().xy();
        let parameters = &self.state.world.parameters;
        let ControllerState { carrier, known, closed_steps, .. } = &mut self.state.controller_state;
        let policy = carrier.rl().map(|_| self.arena.policy(&parameters.rl_policy));
        let policy = policy.transpose().map_err(|error| Refusal::Policy(error.to_string()))?;
        let policy = policy.as_deref();
        let input = TransportInput { percept, known, tool_m, goal_m, parameters, policy };
        let answer = carrier.transport().next_step(&input);
        let most_steps = MEMORIES_WAITED * parameters.obstacle_memory_s / CONTROL_PERIOD_S;
        let may_open = known.forgets() && f64::from(*closed_steps) < most_steps;
        if may_open && answer == Err(Refusal::WalledOff) {
            *closed_steps += 1;
            return Err(Refusal::Closed);
        }
        *closed_steps = 0;
        answer
    }

    /// What the next control step is about, and what the switching law says.
    fn stage(&self, percept: &Percept) -> (switching::Decision, Stage) {
        let tool_m = self.tool_m().xy();
        let world = &self.state.world;
        let is_stopped = matches!(
            world.phase,
            Phase::LiftedOff | Phase::Stopped(StopReason::GoalSteps { .. } | StopReason::TrackerLost)
        );
        if world.tracker.is_lost(world.parameters.tracker_timeout_s) {
            return (world.switching, Stage::TrackerLost { is_stopped });
        }
        let bead_m = world.tracker.estimate().position_m;
        let switching = switching::decide(world.switching.mode, tool_m, bead_m, &world.parameters, || {
            percept.wall_between(tool_m, bead_m)
        });
        // A person steers without a goal, too, and out of a goal that is reached.
        let by_hand = self.state.controller_state.carrier.you().is_some();
        let stage = match world.goal_m {
            _ if is_stopped => Stage::Hold,
            _ if switching.mode == Mode::Approach => Stage::Approach,
            _ if matches!(world.phase, Phase::Stopped(_)) && !switching.switched => Stage::Hold,
            Some(goal_m) if !by_hand && (tool_m - goal_m).norm() <= GOAL_RADIUS_M => Stage::Settle(goal_m),
            Some(goal_m) => Stage::Transport(goal_m),
            None if by_hand => Stage::Transport(tool_m),
            None => Stage::Hold,
        };
        (switching, stage)
    }

    /// What the program has to answer before the next tick; `None` if that needs no answer.
    pub fn question(&self, seen: &Seen) -> Option<Question> {
        let has_program = matches!(self.state.controller_state.carrier, Carrier::Program(_));
        let is_asked = has_program && !self.state.is_led_from_outside();
        let Stage::Transport(goal_m) = is_asked.then(|| self.stage(&seen.percept).1)? else { return None };
        let world = &self.state.world;
        let bead_m = world.tracker.estimate().position_m;
        Some(Question { tick: world.tick, tool_m: seen.tool_m, bead_m, goal_m })
    }

    /// The dark blocks of the image on the table, as the smallest number of rectangles.
    pub fn blocks_m(&self, seen: &Seen) -> Vec<Rect> {
        let parameters = &self.state.world.parameters;
        let smallest_px = parameters.smallest_block_px as usize;
        let tree =
            Quadtree::of(&seen.percept.gray, &QuadtreeParameters { threshold: parameters.obstacle_level, smallest_px });
        let calibration = &seen.percept.calibration;
        let on_table = |cells: &CellRect| {
            let block = tree.pixels(cells);
            let (left, top) = (block.column_px as f64, block.row_px as f64);
            let lower = calibration.table_from_image(left, top + block.height_px as f64);
            let upper = calibration.table_from_image(left + block.width_px as f64, top);
            Rect { x_min_m: lower.x, x_max_m: upper.x, y_min_m: lower.y, y_max_m: upper.y }
        };
        tree.partition().rectangles.iter().map(on_table).collect()
    }

    /// What a policy that sees the image would get.
    pub fn observation(&self, seen: &Seen) -> Observation {
        let TrialState { world, controller_state, .. } = &self.state;
        let is_corrected = world.parameters.rl_corrects_image && !seen.percept.is_from_default_camera(seen.tool_m);
        // Only a corrected image shows what was observed before.
        let mut known = Cow::Borrowed(&controller_state.known);
        if is_corrected {
            update_known(known.to_mut(), world.tick, &seen.percept, &world.parameters);
        }
        let gray = seen.percept.for_network(is_corrected, seen.tool_m, &known);
        Observation::new(&gray, world.goal_m, seen.tool_m, known.workspace())
    }

    /// The step of sub-controller 1 if a person steers it, too.
    fn flight_by_hand(&self, tool: Point3<f64>) -> Option<Result<TargetStep, Refusal>> {
        let world = &self.state.world;
        let step = self.state.controller_state.carrier.you()?.flight(tool.xy(), world.parameters.approach_speed_m_s)?;
        let place = Point3::new(step.target_m.x, step.target_m.y, tool.z);
        Some(self.arena.limits(&world.parameters).position(place, &world.reference).map(|_| step))
    }

    /// Without the tracker the active sub-controller stays, and the arm holds or looks for the bead.
    fn look_for_bead(&mut self, frame: &CameraFrame, percept: &Percept, is_stopped: bool) -> Decision {
        let tool = self.tool_m();
        let TrialState { world, controller_state, .. } = &mut self.state;
        let search = &mut controller_state.search;
        let tracked_m = world.tracker.estimate().position_m;
        let parameters = &world.parameters;
        let look = search.next_step(
            &SearchInput {
                view: BeadView::of(frame, percept, search.last_m(tracked_m)),
                calibration: &percept.calibration,
                tool_m: tool.xy(),
                tracked_m,
                threshold_m: parameters.threshold_m,
                fetch_radius_m: parameters.fetch_radius_m,
                speed_m_s: parameters.approach_speed_m_s,
            },
            |place| {
                let limits = self.arena.limits(parameters);
                limits.position(Point3::new(place.x, place.y, tool.z), &world.reference).is_ok()
            },
        );
        let motion = match look {
            Look::Go(step) if !is_stopped => Motion::Segment(step),
            _ => Motion::Hold,
        };
        let is_searching = motion != Motion::Hold || search.has_begun() && !is_stopped;
        let switching = switching::Decision { switched: false, ..world.switching };
        Decision { switching, motion, refusal: Some(Refusal::TrackerLost { is_searching }) }
    }

    /// Carries out a decision: switches, counts, starts the motion and applies due disturbances.
    pub(super) fn carry_out(&mut self, decision: &Decision) {
        let tick = self.state.world.tick;
        let switching = decision.switching;
        if switching.switched {
            self.state.world.counters.switches += 1;
            let (sub_controller, reason) = (switching.mode.index(), switching.reason());
            self.events.push(Event::new(tick, Happening::TookOver { sub_controller, reason }));
        }
        if let Some(refusal) = &decision.refusal {
            // Reported once, not at each step of a long hold.
            let before = &self.state.world.refusal;
            let begins_search =
                matches!(refusal, Refusal::TrackerLost { is_searching: true }) && before.as_ref() != Some(refusal);
            if begins_search || before.is_none() {
                let refusal = Told::of(refusal);
                self.events.push(Event::new(tick, Happening::StepRefused { refusal, is_holding: !begins_search }));
            }
        } else if matches!(self.state.world.refusal, Some(Refusal::TrackerLost { .. })) {
            self.events.push(Event::new(tick, Happening::TrackerBack));
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

    /// Counts the control step, or stops the trial if no step is left. A step without the tracker has its own count.
    fn count(&mut self) {
        if self.state.is_led_from_outside() {
            return;
        }
        // A person may rest: only steps that move the tool count.
        let tool = self.tool_m().xy();
        let rests = self.state.controller_state.carrier.you().is_some()
            && matches!(self.state.world.motion, Motion::Segment(step) if (step.target_m - tool).norm() < REST_M);
        let World { counters, phase, refusal, goal_m, parameters, .. } = &mut self.state.world;
        let is_active = goal_m.is_some() && matches!(phase, Phase::Approaching | Phase::Transporting);
        let limit = parameters.step_limit;
        let goal_limit = LEGS_PER_GOAL * limit;
        if let (Some(Refusal::TrackerLost { .. }), Some(_)) = (&refusal, &goal_m) {
            if !matches!(phase, Phase::Delivered | Phase::LiftedOff | Phase::Stopped(_)) {
                counters.held_steps += 1;
                if counters.held_steps > goal_limit {
                    self.stop(StopReason::TrackerLost);
                }
            }
            return;
        }
        if !is_active || rests {
            return;
        }
        let is_transport = *phase == Phase::Transporting;
        if is_transport && *refusal == Some(Refusal::WalledOff) {
            return self.stop(StopReason::WalledOff);
        }
        // All steps count toward goal and leg, or their counters begin again.
        let counted = counters.steps - self.free_steps;
        if is_transport && counters.leg_steps.min(counted) >= limit {
            return self.stop(StopReason::LegSteps { limit });
        }
        if counters.goal_steps.min(counted) >= goal_limit {
            return self.stop(StopReason::GoalSteps { limit: goal_limit });
        }
        counters.steps += 1;
        counters.goal_steps += 1;
        counters.leg_steps += u32::from(is_transport);
        let (step, leg_step) = (counters.goal_steps, counters.leg_steps);
        if is_transport && self.state.world.script.at_leg_step == Some(leg_step) {
            self.apply_random();
        }
        self.apply_scripted(Some(step));
    }
}
