// Messages and a clock for the unit tests.

import type { Clock } from '../net/limiter';
import type {
  Branch,
  ComparisonMessage,
  MomentMessage,
  SceneMessage,
  StateMessage,
} from '../net/protocol.gen';

export function stateAt(tick: number, change: Partial<StateMessage> = {}): StateMessage {
  return {
    tick,
    sim_time_s: tick * 0.008,
    oldest_tick: 0,
    newest_tick: tick,
    running: true,
    speed_target: 1,
    speed_achieved: 1,
    lateness_ms: 0,
    missed_deadlines: 0,
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
    tool_orientation: 'vertical',
    tool_height_m: 0.1,
    bead_motion: 'sliding',
    friction: 0.2,
    rolling_resistance: 0.01,
    drag_n_s_m: 0.01,
    camera_height_m: 0.3,
    camera_field_of_view_rad: 0.64350289521,
    camera_offset_x_m: 0,
    camera_offset_y_m: 0,
    camera_tilt_x_rad: 0,
    camera_tilt_y_rad: 0,
    camera_sees_magnet: false,
    obstacle_level: 125,
    smallest_block_px: 6,
    threshold_m: 0.1,
    fetch_radius_m: 0.01,
    switching_law: 'hysteresis',
    approach_speed_m_s: 0.25,
    transport_speed_m_s: 0.04,
    tracker_noise_m: 0.001,
    tracker_latency_ticks: 2,
    tracker_dropout: 0,
    rl_policy: 'auto',
    rl_shield: true,
    errt_goal_probability: 0.1,
    errt_waypoint_probability: 0.6,
    errt_waypoints: 200,
    errt_beta_most: 0.65,
    errt_step_m: 0.03,
    errt_clearance_m: 0.012,
    errt_nodes_per_step: 2000,
    errt_ways: 8,
    errt_unseen_weight: 3,
    errt_shortcut: true,
    attractor_law: 'improved',
    attractor_gain: 2,
    attractor_safety_factor: 1.2,
    attractor_reactivity: 1,
    attractor_clearance_m: 0.012,
  };
  return {
    map,
    scenario: {
      map,
      controller: 'attractor',
      positioner: null,
      seed: 1,
      parameters,
      start_m: null,
      goal_m: null,
      disturbances: 0,
      script: [],
    },
    maps: [map],
    positioner: 'arm',
    controllers: ['rl', 'errt', 'attractor'],
    workspace: { x_min_m: -0.3, x_max_m: 0.28, y_min_m: -0.54, y_max_m: -0.21 },
    walls: [],
    seed: 1,
    parameters,
    defaults: parameters,
    bead_radius_m: 0.0025,
    camera_sees_m: [
      [-0.1, -0.1],
      [0.1, -0.1],
      [0.1, 0.1],
      [-0.1, 0.1],
    ],
    trial,
    capture_m: [[0.004, 0.0947], [0.004, null], null],
    tick_s: 0.008,
  };
}

export function branchOf(
  controller: Branch['controller'],
  samples: Branch['samples'],
  change: Partial<Branch> = {},
): Branch {
  return {
    controller,
    samples,
    done: true,
    phase: 'delivered',
    delivered_tick: null,
    tracking_error_mean_m: 0.01,
    tracking_error_max_x_m: 0.02,
    tracking_error_max_y_m: 0.03,
    steps: 1,
    switches: 0,
    ...change,
  };
}

export function comparisonOf(tick: number, branches: Branch[], trial = 0): ComparisonMessage {
  return {
    trial,
    tick,
    sim_time_s: tick * 0.008,
    until_tick: tick + 7500,
    controller: 'attractor',
    ticks_a_sample: 5,
    running: false,
    failed: null,
    branches,
  };
}

export function momentOf(change: Partial<MomentMessage> = {}): MomentMessage {
  return {
    tick: 0,
    sim_time_s: 0,
    mode: 2,
    switched: true,
    reason: '',
    error_m: 0,
    threshold_m: 0.1,
    controller: 'attractor',
    phase: 'transporting',
    tool_m: [0, 0],
    bead_m: [0, 0],
    bead_tracked_m: [0, 0],
    goal_m: null,
    target_m: null,
    refusal: null,
    overlay: {
      tick: 0,
      obstacles: [],
      center_mean: 255,
      patch: { x_min_m: 0, x_max_m: 0, y_min_m: 0, y_max_m: 0 },
      obstacle: false,
      target_m: null,
      picture_from_table: [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ],
      blocks: { origin_m: [0, 0], pixel_m: 0.001, dark: [], free: [], rectangles: [] },
      plan: null,
      judgement: null,
    },
    ...change,
  };
}

/** Stands still unless it is advanced; what comes due on the way happens in its order. */
export function manualClock(): Clock & { advance: (ms: number) => void } {
  let now = 0;
  let waiting: { at: number; action: () => void }[] = [];
  return {
    nowMs: () => now,
    later: (action, ms) => {
      waiting.push({ at: now + ms, action });
    },
    advance: (ms) => {
      const end = now + ms;
      for (;;) {
        waiting.sort((a, b) => a.at - b.at);
        const next = waiting[0];
        if (!next || next.at > end) break;
        waiting = waiting.slice(1);
        now = next.at;
        next.action();
      }
      now = end;
    },
  };
}
