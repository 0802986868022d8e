// Generated from server/protocol.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

export * from './parameters.gen';
export * from './protocol/experiment.gen';
export * from './protocol/messages.gen';
export * from './protocol/facts.gen';
export * from './protocol/session.gen';
export * from './protocol/layers.gen';
export * from './protocol/comparison.gen';
export * from './protocol/fields.gen';
export * from './protocol/values.gen';
export * from './protocol/jobs.gen';
export * from './protocol/evaluations.gen';
export * from './protocol/recoveries.gen';
export * from './protocol/report.gen';
export * from './protocol/recordings.gen';
export * from './protocol/maps.gen';
export * from './protocol/trainings.gen';
export * from './protocol/challenges.gen';
export * from './protocol/lumen.gen';
export * from './protocol/programs.gen';
export * from './protocol/robot.gen';
export * from './protocol/policies.gen';

/** Version of the messages. */
export const PROTOCOL_VERSION = 7;

/** First byte of a binary message with a camera image. */
export const BINARY_CAMERA_JPEG = 1;

/** First byte of a binary message with an observation. */
export const BINARY_OBSERVATION = 2;

/** First byte of a binary message with a part of the course. */
export const BINARY_COURSE = 3;

/** Simulated time between control steps. */
export const CONTROL_PERIOD_S = 0.25;

/** Maximum speed of playback. */
export const SPEED_MAX = 64;

/** A goal is reached within this distance. */
export const GOAL_RADIUS_M = 0.02;

/** Parts of the image with a lower mean brightness are obstacles. */
export const OBSTACLE_MEAN = 150;

/** Maximum number of entries in a script. */
export const SCRIPT_LIMIT = 64;

/** Last control step at which a scripted disturbance may begin. */
export const MOST_STEPS = 20000;

/** Strongest kick. */
export const MOST_IMPULSE_N_S = 0.002;

/** Strongest push. */
export const MOST_DRIFT_N = 0.01;

/** Longest push, and longest dropout of the tracker. */
export const MOST_SECONDS = 60;

/** Maximum number of edges of ERRT's tree that are sent. */
export const MOST_EDGES = 4000;

/** Smallest spacing of a flow field. */
export const LEAST_FLOW_SPACING_M = 0.005;

/** Largest spacing of a flow field. */
export const MOST_FLOW_SPACING_M = 0.05;

/** Capture radii are computed up to this distance. */
export const FARTHEST_CAPTURE_M = 0.5;

/** Height of the walls. */
export const WALL_HEIGHT_M = 0.005;

/** Width and height of the camera image. */
export const CAMERA_PX = 480;

/** Width and height of the observation. */
export const OBSERVATION_PX = 84;

/** Largest drawing of a map. */
export const MAX_SVG_BYTES = 1048576;

/** Name of each controller in sentences. */
export const CONTROLLER_LABELS = {
  rl: 'RL',
  errt: 'ERRT',
  attractor: 'Attractor',
  replanner: 'Replanner',
  you: 'You',
  program: 'Program',
  robot: 'Robot client',
} as const;

/** Controllers that the page offers. */
export const CONTROLLERS = ['rl', 'errt', 'attractor'] as const;

/** Maps that every server has. */
export const SHIPPED_MAPS: readonly string[] = ['attractor-example', 'attractor-example-arm', 'colon', 'colon-folds', 'open', 'posts', 'toy', 'u-turn', 'vessels'];
