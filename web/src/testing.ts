// Messages for the unit tests.

import type { SceneMessage, StateMessage } from './protocol.gen';

export function stateAt(tick: number, change: Partial<StateMessage> = {}): StateMessage {
  return {
    tick,
    sim_time_s: tick * 0.008,
    oldest_tick: 0,
    newest_tick: tick,
    running: true,
    speed_target: 1,
    speed_achieved: 1,
    tool_m: [tick, 0, 0.1],
    bead_m: [-tick, 0, 0.0025],
    bead_tracked_m: [-tick, 0],
    goal_m: null,
    hand_m: null,
    hand_force_n: 0,
    joints_rad: [0, 0, 0, 0, 0, 0],
    mode: 1,
    reason: 'No goal.',
    refusal: null,
    controller: 'attractor',
    phase: 'holding',
    tracking_error_x_m: 2 * tick,
    tracking_error_y_m: 0,
    tracking_error_m: 2 * tick,
    goal_distance_m: null,
    pull_n: 0,
    lift_ratio: 0,
    leg_steps: 0,
    steps: 0,
    switches: 0,
    deliveries: 0,
    disturbances: 0,
    world_hash: '',
    recording: '',
    ended: null,
    ...change,
  };
}

export function sceneOf(map: string, trial = 0): SceneMessage {
  const parameters: SceneMessage['parameters'] = {
    block_orientation: 'A',
    tool_height_m: 0.1,
    friction: 0.2,
    drag_n_s_m: 0.01,
    threshold_m: 0.1,
    fetch_radius_m: 0.01,
    switching_law: 'hysteresis',
    approach_speed_m_s: 0.25,
    transport_speed_m_s: 0.04,
    tracker_noise_m: 0.001,
    tracker_latency_ticks: 2,
    tracker_dropout: 0,
    attractor_law: 'improved',
    attractor_gain: 2,
    attractor_safety_factor: 1.2,
    attractor_reactivity: 1,
    attractor_clearance_m: 0.012,
  };
  return {
    map,
    maps: [map],
    controllers: ['attractor'],
    workspace: { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 },
    walls: [],
    seed: 1,
    parameters,
    defaults: parameters,
    bead_radius_m: 0.0025,
    camera_span_m: 0.2,
    trial,
    capture_m: [[0.004, 0.0947], [0.004, null], null],
    tick_s: 0.008,
  };
}
