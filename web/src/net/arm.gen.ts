// Generated from server/core/robot/ur5.rs, server/camera/robot.rs and server/core/magnetics/force.rs;
// `FERRY_GENERATE=1 cargo test --release protocol` renews it.

/**
 * Rows of the Denavit-Hartenberg table from the base to the flange, classic convention:
 * `[d_m, a_m, alpha_quarter_turns]`.
 */
export const DH = [
  [0.089159, 0, 1],
  [0, -0.425, 0],
  [0, -0.39225, 0],
  [0.10915, 0, 1],
  [0.09465, 0, -1],
  [0.0823, 0, 0],
] as const;

/** From the flange to the tool point. */
export const TOOL_LENGTH_M = 0.18;

/** The block as it hangs on the tool, and the axis from its south pole to its north pole. */
export const BLOCKS = {
  A: { size_m: [0.05, 0.025, 0.01], along: 2 },
  B: { size_m: [0.01, 0.05, 0.025], along: 0 },
  C: { size_m: [0.05, 0.025, 0.01], along: 0 },
} as const;

/** Round solids between two places on a line, fixed to a frame: 0 is the base, 6 the flange. A lid has its rim at the first place. */
export const ARM_SOLIDS = [
  { frame: 0, shape: 'tube', material: 'foot', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0, 0.01], radius_m: 0.086 },
  { frame: 0, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.01, 0.034], radius_m: 0.072 },
  { frame: 0, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.034, 0.04], radius_m: 0.069 },
  { frame: 0, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.04, 0.089159], radius_m: 0.0625 },
  { frame: 1, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0738, -0.062], radius_m: 0.06 },
  { frame: 1, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0798, 0.0738], radius_m: 0.057 },
  { frame: 1, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.062, -0.065], radius_m: 0.0564 },
  { frame: 1, shape: 'tube', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.065, -0.069], radius_m: 0.0582 },
  { frame: 1, shape: 'lid', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.069, -0.08], radius_m: 0.0582 },
  { frame: 1, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0778, 0.1878], radius_m: 0.06 },
  { frame: 1, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0718, 0.0778], radius_m: 0.057 },
  { frame: 1, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.1878, 0.1908], radius_m: 0.0564 },
  { frame: 1, shape: 'tube', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.1908, 0.1948], radius_m: 0.0582 },
  { frame: 1, shape: 'lid', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.1948, 0.2058], radius_m: 0.0582 },
  { frame: 2, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0858, 0.1818], radius_m: 0.051 },
  { frame: 2, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0798, 0.0858], radius_m: 0.04845 },
  { frame: 2, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.1818, 0.1848], radius_m: 0.04794 },
  { frame: 2, shape: 'tube', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.1848, 0.1888], radius_m: 0.04947 },
  { frame: 2, shape: 'lid', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.1888, 0.1998], radius_m: 0.04947 },
  { frame: 2, shape: 'tube', material: 'metal', origin_m: [0.425, 0, 0.1358], along: [-1, 0, 0], places_m: [0, 0.425], radius_m: 0.043 },
  { frame: 2, shape: 'tube', material: 'metal', origin_m: [0.425, 0, 0.1358], along: [-1, 0, 0], places_m: [0, 0.088], radius_m: 0.054 },
  { frame: 2, shape: 'lid', material: 'metal', origin_m: [0.425, 0, 0.1358], along: [-1, 0, 0], places_m: [0.088, 0.104], radius_m: 0.054 },
  { frame: 2, shape: 'tube', material: 'seam', origin_m: [0.425, 0, 0.1358], along: [-1, 0, 0], places_m: [0.1, 0.108], radius_m: 0.0442 },
  { frame: 2, shape: 'tube', material: 'metal', origin_m: [0, 0, 0.1358], along: [1, 0, 0], places_m: [0, 0.076], radius_m: 0.047 },
  { frame: 2, shape: 'lid', material: 'metal', origin_m: [0, 0, 0.1358], along: [1, 0, 0], places_m: [0.076, 0.092], radius_m: 0.047 },
  { frame: 2, shape: 'tube', material: 'seam', origin_m: [0, 0, 0.1358], along: [1, 0, 0], places_m: [0.088, 0.096], radius_m: 0.0442 },
  { frame: 2, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0798, -0.0275], radius_m: 0.051 },
  { frame: 2, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.0858, 0.0798], radius_m: 0.04845 },
  { frame: 2, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.0275, -0.0305], radius_m: 0.04794 },
  { frame: 2, shape: 'tube', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.0305, -0.0345], radius_m: 0.04947 },
  { frame: 2, shape: 'lid', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.0345, -0.0455], radius_m: 0.04947 },
  { frame: 3, shape: 'tube', material: 'metal', origin_m: [0.39225, 0, 0.0165], along: [-1, 0, 0], places_m: [0, 0.39225], radius_m: 0.036 },
  { frame: 3, shape: 'tube', material: 'metal', origin_m: [0.39225, 0, 0.0165], along: [-1, 0, 0], places_m: [0, 0.076], radius_m: 0.046 },
  { frame: 3, shape: 'lid', material: 'metal', origin_m: [0.39225, 0, 0.0165], along: [-1, 0, 0], places_m: [0.076, 0.092], radius_m: 0.046 },
  { frame: 3, shape: 'tube', material: 'seam', origin_m: [0.39225, 0, 0.0165], along: [-1, 0, 0], places_m: [0.088, 0.096], radius_m: 0.0372 },
  { frame: 3, shape: 'tube', material: 'metal', origin_m: [0, 0, 0.0165], along: [1, 0, 0], places_m: [0, 0.06], radius_m: 0.037 },
  { frame: 3, shape: 'lid', material: 'metal', origin_m: [0, 0, 0.0165], along: [1, 0, 0], places_m: [0.06, 0.076], radius_m: 0.037 },
  { frame: 3, shape: 'tube', material: 'seam', origin_m: [0, 0, 0.0165], along: [1, 0, 0], places_m: [0.072, 0.08], radius_m: 0.0372 },
  { frame: 3, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.062, -0.0175], radius_m: 0.0405 },
  { frame: 3, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.068, 0.062], radius_m: 0.038475 },
  { frame: 3, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.0175, -0.0205], radius_m: 0.03807 },
  { frame: 3, shape: 'tube', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.0205, -0.0245], radius_m: 0.039285 },
  { frame: 3, shape: 'lid', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.0245, -0.0355], radius_m: 0.039285 },
  { frame: 3, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.054575, 0.10915], radius_m: 0.036 },
  { frame: 4, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.047325, 0.09465], radius_m: 0.036 },
  { frame: 4, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.047, -0.04], radius_m: 0.0405 },
  { frame: 4, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.053, 0.047], radius_m: 0.038475 },
  { frame: 4, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.04, -0.043], radius_m: 0.03807 },
  { frame: 4, shape: 'tube', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.043, -0.047], radius_m: 0.039285 },
  { frame: 4, shape: 'lid', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.047, -0.058], radius_m: 0.039285 },
  { frame: 5, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.047, -0.04], radius_m: 0.0405 },
  { frame: 5, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.053, 0.047], radius_m: 0.038475 },
  { frame: 5, shape: 'tube', material: 'seam', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.04, -0.043], radius_m: 0.03807 },
  { frame: 5, shape: 'tube', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.043, -0.047], radius_m: 0.039285 },
  { frame: 5, shape: 'lid', material: 'lid', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [-0.047, -0.058], radius_m: 0.039285 },
  { frame: 5, shape: 'tube', material: 'metal', origin_m: [0, 0, 0], along: [0, 0, 1], places_m: [0.047, 0.0823], radius_m: 0.0365 },
] as const;
