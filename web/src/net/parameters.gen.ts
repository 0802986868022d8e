// Generated from server/core/scenario/parameters/table.rs; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

export type Orientation = "A" | "B" | "C";

export type ToolOrientation = "vertical" | "paper";

export type Parameters = {
  /** How the block magnet on the tool is turned. */
  block_orientation: "A" | "B" | "C";
  /** How the arm holds its flange; the planar stage is always vertical. The paper's rotation vector is 3.2° off the vertical. */
  tool_orientation: "vertical" | "paper";
  /** Lower face of the block above the table. */
  tool_height_m: number;
  /** Slides: the field holds the bead's axis. Rolls: the bead is free to turn. */
  bead_motion: "sliding" | "rolling";
  /** Coulomb friction of the bead on the table. */
  friction: number;
  /** In units of the normal load, for a bead that rolls. At μ or above, the bead slides. */
  rolling_resistance: number;
  /** Drag on the bead. */
  drag_n_s_m: number;
  /** Height of the camera above the table. */
  camera_height_m: number;
  /** Angle across the image. 36.87° shows 20 cm of the table from a height of 30 cm. */
  camera_field_of_view_rad: number;
  /** From the tool's axis to the camera, along x. */
  camera_offset_x_m: number;
  /** From the tool's axis to the camera, along y. */
  camera_offset_y_m: number;
  /** How far the camera leans toward +x. A tilted image is rectified before it is used. */
  camera_tilt_x_rad: number;
  /** How far the camera leans toward +y. */
  camera_tilt_y_rad: number;
  /** Whether the magnet is in the image, as with a real camera. What it hides is not observed. */
  camera_sees_magnet: boolean;
  /** Standard deviation of the brightness of each pixel. */
  camera_noise_levels: number;
  /** Age of the image at a control step, in ticks of 8 ms. Its place is known. */
  camera_latency_ticks: number;
  /** Gray at or below this is an obstacle, for blocks and map. Walls are 50 or darker, floor is 200 or lighter. */
  obstacle_level: number;
  /** Smallest side of the quadtree's blocks. The paper's figures have 50. */
  smallest_block_px: number;
  /** Farther than this from the tool, the bead is lost and sub-controller 1 takes over. */
  threshold_m: number;
  /** Nearer than this, sub-controller 1 has fetched the bead. Never above T. */
  fetch_radius_m: number;
  /** With hysteresis, sub-controller 1 keeps control until the bead is fetched. The paper has one threshold both ways. */
  switching_law: "hysteresis" | "literal";
  /** Speed of the tool while it goes to the bead. */
  approach_speed_m_s: number;
  /** Speed of the tool while it carries the bead. */
  transport_speed_m_s: number;
  /** Control steps that a transport may take after a fetch. A goal may take four times as many. The paper has 150. */
  step_limit: number;
  /** Standard deviation of the tracked position. */
  tracker_noise_m: number;
  /** Age of the tracked position, in ticks of 8 ms. */
  tracker_latency_ticks: number;
  /** Share of lost samples. */
  tracker_dropout: number;
  /** Constant error of the tracked position, along x. */
  tracker_bias_x_m: number;
  /** Constant error of the tracked position, along y. */
  tracker_bias_y_m: number;
  /** Standard deviation of an error that changes within about ten seconds. */
  tracker_drift_m: number;
  /** Whether the tracker loses the bead while the arm is between them. The tracker looks from the right side of the table. */
  tracker_is_hidden_by_arm: boolean;
  /** When no sample has arrived for this long, the arm holds. Latency does not count. */
  tracker_timeout_s: number;
  /** Which trained policy runs. Auto takes the one trained on this map, else the explorer, which remembers what the camera has seen and needs no training on the map. */
  rl_policy: string;
  /** Replaces a best step that comes near a visible wall by the next best. Without it, such a step is refused and the arm holds. */
  rl_shield: boolean;
  /** Subtracted from the value of a step for each earlier visit of its cell since the last fetch or goal. It ends going to and fro. 0 is the paper. */
  rl_visit_penalty: number;
  /** A policy with a memory goes straight over the next cells of its route where the way is known to be clear, instead of step by step along the axes. */
  rl_shortcut: boolean;
  /** The network gets the square of table around the tool, as in training, wherever the camera is. Without it, it gets the camera's own image. */
  rl_corrects_image: boolean;
  /** Share of the extensions that go toward the goal. It limits the share toward waypoints. */
  errt_goal_probability: number;
  /** Share of the extensions that go toward a waypoint of an earlier path. At most what the goal leaves. */
  errt_waypoint_probability: number;
  /** How many waypoints of earlier paths are remembered. 0 turns this off. */
  errt_waypoints: number;
  /** Upper limit of β, the weight of the cost from the root. 0 is the plain nearest neighbour. */
  errt_beta_most: number;
  /** Longest edge of the tree. */
  errt_step_m: number;
  /** Distance that paths keep from walls where there is room. */
  errt_clearance_m: number;
  /** Edges tried in one control step at most. Then the arm holds, and the search continues in the next step. */
  errt_nodes_per_step: number;
  /** Paths planned before the shortest is followed. The publication follows the first. */
  errt_ways: number;
  /** How many times a length through unseen area counts when paths are compared. */
  errt_unseen_weight: number;
  /** Whether corners of a path are cut where there is room. */
  errt_shortcut: boolean;
  /** The literal law can stick behind a flat face. The improved one follows contours and keeps clear. */
  attractor_law: "improved" | "literal";
  /** Feedback gain K = k·I; stable above 1. */
  attractor_gain: number;
  /** Scales the half sides of the superellipse around an obstacle. */
  attractor_safety_factor: number;
  /** How early the motion bends around an obstacle. */
  attractor_reactivity: number;
  /** Distance that the improved law keeps from walls. */
  attractor_clearance_m: number;
  /** How far the walls close in; 0: they are rigid. Narrow places keep room for the bead. At most a quarter of the wavelength. */
  peristalsis_amplitude_m: number;
  /** From one wave to the next along the lumen, or length of a segment. */
  peristalsis_wavelength_m: number;
  /** Duration of a contraction at one place. Another period, wavelength, pause, kind or irregularity begins when the walls are at rest. */
  peristalsis_period_s: number;
  /** Rest between two contractions. */
  peristalsis_pause_s: number;
  /** Waves travel along the lumen. Segments contract in place, every second one in turn. */
  peristalsis_contraction: "travelling" | "segmental";
  /** 0 %: all contractions are equally strong. 100 %: any strength from none to full. */
  peristalsis_irregularity: number;
  /** Speed of the fluid along the lumen. The bead feels drag relative to it. */
  flow_m_s: number;
  /** While the walls move: how long the obstacle map keeps what changes and is out of view. */
  obstacle_memory_s: number;
};

/** The form's fields. Ranges and steps are in the shown unit: shown value = stored value × scale. */
export const GROUPS = [
  {
    title: "RL", controller: "rl", open: true,
    fields: [
      { kind: 'policy', name: "rl_policy", label: "Policy", options: [["auto","Auto: by map"],["colon","Colon"],["general","General"],["explorer","Explorer"]], help: "Which trained policy runs. Auto takes the one trained on this map, else the explorer, which remembers what the camera has seen and needs no training on the map." },
      { kind: 'flag', name: "rl_shield", label: "Shield", help: "Replaces a best step that comes near a visible wall by the next best. Without it, such a step is refused and the arm holds." },
      { kind: 'number', name: "rl_visit_penalty", label: "Visit penalty", unit: "", scale: 1, min: 0, max: 1, step: 0.01, isWhole: false, help: "Subtracted from the value of a step for each earlier visit of its cell since the last fetch or goal. It ends going to and fro. 0 is the paper." },
      { kind: 'flag', name: "rl_shortcut", label: "Shortcuts", help: "A policy with a memory goes straight over the next cells of its route where the way is known to be clear, instead of step by step along the axes." },
      { kind: 'flag', name: "rl_corrects_image", label: "Corrected image", help: "The network gets the square of table around the tool, as in training, wherever the camera is. Without it, it gets the camera's own image." },
    ],
  },
  {
    title: "ERRT", controller: "errt", open: false,
    fields: [
      { kind: 'number', name: "errt_goal_probability", label: "Goal probability", unit: "%", scale: 100, min: 0, max: 90, step: 1, isWhole: false, help: "Share of the extensions that go toward the goal. It limits the share toward waypoints." },
      { kind: 'number', name: "errt_waypoint_probability", label: "Waypoint probability", unit: "%", scale: 100, min: 0, max: 90, step: 1, isWhole: false, bound: { kind: 'remainder', other: 'errt_goal_probability' }, help: "Share of the extensions that go toward a waypoint of an earlier path. At most what the goal leaves." },
      { kind: 'number', name: "errt_waypoints", label: "Waypoints", unit: "", scale: 1, min: 0, max: 1000, step: 10, isWhole: true, help: "How many waypoints of earlier paths are remembered. 0 turns this off." },
      { kind: 'number', name: "errt_beta_most", label: "Most β", unit: "", scale: 1, min: 0, max: 0.95, step: 0.01, isWhole: false, help: "Upper limit of β, the weight of the cost from the root. 0 is the plain nearest neighbour." },
      { kind: 'number', name: "errt_step_m", label: "Edge length", unit: "mm", scale: 1000, min: 5, max: 100, step: 1, isWhole: false, help: "Longest edge of the tree." },
      { kind: 'number', name: "errt_clearance_m", label: "Clearance", unit: "mm", scale: 1000, min: 4, max: 30, step: 0.5, isWhole: false, help: "Distance that paths keep from walls where there is room." },
      { kind: 'number', name: "errt_nodes_per_step", label: "Edges per step", unit: "", scale: 1, min: 10, max: 20000, step: 10, isWhole: true, help: "Edges tried in one control step at most. Then the arm holds, and the search continues in the next step." },
      { kind: 'number', name: "errt_ways", label: "Paths compared", unit: "", scale: 1, min: 1, max: 20, step: 1, isWhole: true, help: "Paths planned before the shortest is followed. The publication follows the first." },
      { kind: 'number', name: "errt_unseen_weight", label: "Unseen weight", unit: "", scale: 1, min: 1, max: 10, step: 0.1, isWhole: false, help: "How many times a length through unseen area counts when paths are compared." },
      { kind: 'flag', name: "errt_shortcut", label: "Shortcuts", help: "Whether corners of a path are cut where there is room." },
    ],
  },
  {
    title: "Attractor dynamics", controller: "attractor", open: false,
    fields: [
      { kind: 'choice', name: "attractor_law", label: "Attractor law", options: [["improved","Improved"],["literal","Literal (paper)"]], help: "The literal law can stick behind a flat face. The improved one follows contours and keeps clear." },
      { kind: 'number', name: "attractor_gain", label: "Gain K", unit: "", scale: 1, min: 1.05, max: 10, step: 0.05, isWhole: false, help: "Feedback gain K = k·I; stable above 1." },
      { kind: 'number', name: "attractor_safety_factor", label: "Safety factor", unit: "", scale: 1, min: 1, max: 2, step: 0.05, isWhole: false, help: "Scales the half sides of the superellipse around an obstacle." },
      { kind: 'number', name: "attractor_reactivity", label: "Reactivity ρ", unit: "", scale: 1, min: 0.2, max: 5, step: 0.1, isWhole: false, help: "How early the motion bends around an obstacle." },
      { kind: 'number', name: "attractor_clearance_m", label: "Clearance", unit: "mm", scale: 1000, min: 0, max: 30, step: 1, isWhole: false, help: "Distance that the improved law keeps from walls." },
    ],
  },
  {
    title: "Switching", open: true,
    fields: [
      { kind: 'number', name: "threshold_m", label: "Threshold T", unit: "cm", scale: 100, min: 2, max: 20, step: 0.1, isWhole: false, help: "Farther than this from the tool, the bead is lost and sub-controller 1 takes over." },
      { kind: 'number', name: "fetch_radius_m", label: "Fetch radius", unit: "cm", scale: 100, min: 0.2, max: 20, step: 0.1, isWhole: false, bound: { kind: 'atMost', other: 'threshold_m' }, help: "Nearer than this, sub-controller 1 has fetched the bead. Never above T." },
      { kind: 'choice', name: "switching_law", label: "Switching law", options: [["hysteresis","Hysteresis"],["literal","Literal (paper)"]], help: "With hysteresis, sub-controller 1 keeps control until the bead is fetched. The paper has one threshold both ways." },
    ],
  },
  {
    title: "Speeds and steps", open: false,
    fields: [
      { kind: 'number', name: "approach_speed_m_s", label: "Approach", unit: "mm/s", scale: 1000, min: 20, max: 250, step: 1, isWhole: false, help: "Speed of the tool while it goes to the bead." },
      { kind: 'number', name: "transport_speed_m_s", label: "Transport", unit: "mm/s", scale: 1000, min: 10, max: 79, step: 1, isWhole: false, help: "Speed of the tool while it carries the bead." },
      { kind: 'number', name: "step_limit", label: "Step limit", unit: "", scale: 1, min: 10, max: 5000, step: 10, isWhole: true, help: "Control steps that a transport may take after a fetch. A goal may take four times as many. The paper has 150." },
    ],
  },
  {
    title: "Camera", open: false,
    fields: [
      { kind: 'number', name: "camera_height_m", label: "Camera height", unit: "cm", scale: 100, min: 10, max: 100, step: 0.1, isWhole: false, help: "Height of the camera above the table." },
      { kind: 'number', name: "camera_field_of_view_rad", label: "Field of view", unit: "°", scale: 57.29577951308232, min: 5.73, max: 68.75, step: 0.01, isWhole: false, help: "Angle across the image. 36.87° shows 20 cm of the table from a height of 30 cm." },
      { kind: 'number', name: "camera_offset_x_m", label: "Offset x", unit: "cm", scale: 100, min: -15, max: 15, step: 0.1, isWhole: false, help: "From the tool's axis to the camera, along x." },
      { kind: 'number', name: "camera_offset_y_m", label: "Offset y", unit: "cm", scale: 100, min: -15, max: 15, step: 0.1, isWhole: false, help: "From the tool's axis to the camera, along y." },
      { kind: 'number', name: "camera_tilt_x_rad", label: "Tilt x", unit: "°", scale: 57.29577951308232, min: -22.9, max: 22.9, step: 0.1, isWhole: false, help: "How far the camera leans toward +x. A tilted image is rectified before it is used." },
      { kind: 'number', name: "camera_tilt_y_rad", label: "Tilt y", unit: "°", scale: 57.29577951308232, min: -22.9, max: 22.9, step: 0.1, isWhole: false, help: "How far the camera leans toward +y." },
      { kind: 'flag', name: "camera_sees_magnet", label: "Magnet in the picture", help: "Whether the magnet is in the image, as with a real camera. What it hides is not observed." },
      { kind: 'number', name: "camera_noise_levels", label: "Image noise σ", unit: "levels", scale: 1, min: 0, max: 40, step: 0.5, isWhole: false, help: "Standard deviation of the brightness of each pixel." },
      { kind: 'number', name: "camera_latency_ticks", label: "Image latency", unit: "ticks", scale: 1, min: 0, max: 50, step: 1, isWhole: true, help: "Age of the image at a control step, in ticks of 8 ms. Its place is known." },
      { kind: 'number', name: "obstacle_level", label: "Obstacle level", unit: "", scale: 1, min: 50, max: 199, step: 1, isWhole: true, help: "Gray at or below this is an obstacle, for blocks and map. Walls are 50 or darker, floor is 200 or lighter." },
      { kind: 'number', name: "smallest_block_px", label: "Smallest block", unit: "px", scale: 1, min: 1, max: 240, step: 1, isWhole: true, help: "Smallest side of the quadtree's blocks. The paper's figures have 50." },
    ],
  },
  {
    title: "Magnet and bead", open: false,
    fields: [
      { kind: 'choice', name: "block_orientation", label: "Block", options: [["A","A: flat, vertical field"],["B","B: on edge"],["C","C: flat, along 50 mm"]], help: "How the block magnet on the tool is turned." },
      { kind: 'choice', name: "tool_orientation", label: "Tool", options: [["vertical","Straight down"],["paper","3.2° off (paper)"]], help: "How the arm holds its flange; the planar stage is always vertical. The paper's rotation vector is 3.2° off the vertical." },
      { kind: 'number', name: "tool_height_m", label: "Tool height", unit: "mm", scale: 1000, min: 90, max: 200, step: 1, isWhole: false, help: "Lower face of the block above the table." },
      { kind: 'choice', name: "bead_motion", label: "Bead", options: [["sliding","Slides"],["rolling","Rolls"]], help: "Slides: the field holds the bead's axis. Rolls: the bead is free to turn." },
      { kind: 'number', name: "friction", label: "Friction μ", unit: "", scale: 1, min: 0, max: 1, step: 0.01, isWhole: false, help: "Coulomb friction of the bead on the table." },
      { kind: 'number', name: "rolling_resistance", label: "Rolling resistance", unit: "", scale: 1, min: 0, max: 0.2, step: 0.005, isWhole: false, help: "In units of the normal load, for a bead that rolls. At μ or above, the bead slides." },
      { kind: 'number', name: "drag_n_s_m", label: "Viscous drag", unit: "mN·s/m", scale: 1000, min: 0, max: 100, step: 1, isWhole: false, help: "Drag on the bead." },
    ],
  },
  {
    title: "Walls and fluid", open: false,
    fields: [
      { kind: 'number', name: "peristalsis_amplitude_m", label: "Amplitude", unit: "mm", scale: 1000, min: 0, max: 40, step: 0.5, isWhole: false, bound: { kind: 'quarter', other: 'peristalsis_wavelength_m' }, help: "How far the walls close in; 0: they are rigid. Narrow places keep room for the bead. At most a quarter of the wavelength." },
      { kind: 'number', name: "peristalsis_wavelength_m", label: "Wavelength", unit: "cm", scale: 100, min: 5, max: 100, step: 1, isWhole: false, help: "From one wave to the next along the lumen, or length of a segment." },
      { kind: 'number', name: "peristalsis_period_s", label: "Period", unit: "s", scale: 1, min: 1, max: 60, step: 0.5, isWhole: false, help: "Duration of a contraction at one place. Another period, wavelength, pause, kind or irregularity begins when the walls are at rest." },
      { kind: 'number', name: "peristalsis_pause_s", label: "Pause", unit: "s", scale: 1, min: 0, max: 60, step: 0.5, isWhole: false, help: "Rest between two contractions." },
      { kind: 'choice', name: "peristalsis_contraction", label: "Kind", options: [["travelling","Waves"],["segmental","Segments"]], help: "Waves travel along the lumen. Segments contract in place, every second one in turn." },
      { kind: 'number', name: "peristalsis_irregularity", label: "Irregularity", unit: "%", scale: 100, min: 0, max: 100, step: 5, isWhole: false, help: "0 %: all contractions are equally strong. 100 %: any strength from none to full." },
      { kind: 'number', name: "flow_m_s", label: "Flow", unit: "mm/s", scale: 1000, min: -100, max: 100, step: 1, isWhole: false, help: "Speed of the fluid along the lumen. The bead feels drag relative to it." },
      { kind: 'number', name: "obstacle_memory_s", label: "Obstacle memory", unit: "s", scale: 1, min: 1, max: 600, step: 1, isWhole: false, help: "While the walls move: how long the obstacle map keeps what changes and is out of view." },
    ],
  },
  {
    title: "Tracker", open: false,
    fields: [
      { kind: 'number', name: "tracker_noise_m", label: "Noise σ", unit: "mm", scale: 1000, min: 0, max: 10, step: 0.1, isWhole: false, help: "Standard deviation of the tracked position." },
      { kind: 'number', name: "tracker_latency_ticks", label: "Latency", unit: "ticks", scale: 1, min: 0, max: 50, step: 1, isWhole: true, help: "Age of the tracked position, in ticks of 8 ms." },
      { kind: 'number', name: "tracker_dropout", label: "Dropout", unit: "%", scale: 100, min: 0, max: 90, step: 1, isWhole: false, help: "Share of lost samples." },
      { kind: 'number', name: "tracker_bias_x_m", label: "Bias x", unit: "mm", scale: 1000, min: -20, max: 20, step: 0.5, isWhole: false, help: "Constant error of the tracked position, along x." },
      { kind: 'number', name: "tracker_bias_y_m", label: "Bias y", unit: "mm", scale: 1000, min: -20, max: 20, step: 0.5, isWhole: false, help: "Constant error of the tracked position, along y." },
      { kind: 'number', name: "tracker_drift_m", label: "Drift σ", unit: "mm", scale: 1000, min: 0, max: 20, step: 0.5, isWhole: false, help: "Standard deviation of an error that changes within about ten seconds." },
      { kind: 'flag', name: "tracker_is_hidden_by_arm", label: "Hidden by the arm", help: "Whether the tracker loses the bead while the arm is between them. The tracker looks from the right side of the table." },
      { kind: 'number', name: "tracker_timeout_s", label: "Timeout", unit: "s", scale: 1, min: 0.05, max: 10, step: 0.05, isWhole: false, help: "When no sample has arrived for this long, the arm holds. Latency does not count." },
    ],
  },
] as const;

/** Named sets of parameters. */
export const PRESETS: readonly { readonly kind: string; readonly label: string; readonly help: string; readonly values: Partial<Parameters> }[] = [
  { kind: "Sensors", label: "Laboratory", help: "A calibrated tracker that sees the bead everywhere, and a camera without noise: the defaults.", values: { camera_noise_levels: 0.0, camera_latency_ticks: 0, tracker_noise_m: 0.001, tracker_latency_ticks: 2, tracker_dropout: 0.0, tracker_bias_x_m: 0.0, tracker_bias_y_m: 0.0, tracker_drift_m: 0.0, tracker_is_hidden_by_arm: false } },
  { kind: "Sensors", label: "Poor sensors", help: "A tracker with noise, bias, drift, losses and latency, which the arm can hide the bead from, and a late camera with noise.", values: { camera_noise_levels: 10.0, camera_latency_ticks: 12, tracker_noise_m: 0.003, tracker_latency_ticks: 12, tracker_dropout: 0.2, tracker_bias_x_m: 0.003, tracker_bias_y_m: -0.002, tracker_drift_m: 0.003, tracker_is_hidden_by_arm: true } },
  { kind: "Camera mount", label: "Ideal", help: "Over the tool, looking straight down through the magnet, which is not in the picture: the default.", values: { camera_offset_x_m: 0.0, camera_tilt_x_rad: 0.0, camera_field_of_view_rad: 0.64350289521, camera_sees_magnet: false } },
  { kind: "Camera mount", label: "Realistic", help: "Beside the tool and leaning toward it, with magnet and gripper in the picture. It sees the tool's next step, and not what is behind the magnet.", values: { camera_offset_x_m: 0.12, camera_tilt_x_rad: -0.38, camera_field_of_view_rad: 0.72, camera_sees_magnet: true } },
  { kind: "Robot", label: "Smooth", help: "The bead slides and trails the magnet by 14 mm: the default.", values: { friction: 0.2 } },
  { kind: "Robot", label: "The paper's robot", help: "A calibration, not a measurement: with this friction the bead sticks and slips, and the mean and largest tracking errors along x come near the paper's .02 and .08 m.", values: { friction: 0.41 } },
  { kind: "Walls", label: "Rigid", help: "The walls do not move: the default.", values: { peristalsis_amplitude_m: 0.0, peristalsis_pause_s: 0.0, peristalsis_irregularity: 0.0, flow_m_s: 0.0, peristalsis_wavelength_m: 0.12, peristalsis_contraction: "travelling" } },
  { kind: "Walls", label: "Peristalsis", help: "Waves of 6 mm travel along the lumen at 2 cm/s.", values: { peristalsis_amplitude_m: 0.006, peristalsis_pause_s: 0.0, peristalsis_irregularity: 0.0, flow_m_s: 0.0, peristalsis_wavelength_m: 0.12, peristalsis_contraction: "travelling" } },
  { kind: "Walls", label: "Strong peristalsis", help: "Waves of up to 14 mm, some stronger than others, with pauses, and a fluid that flows with them.", values: { peristalsis_amplitude_m: 0.014, peristalsis_pause_s: 3.0, peristalsis_irregularity: 0.5, flow_m_s: 0.01, peristalsis_wavelength_m: 0.12, peristalsis_contraction: "travelling" } },
  { kind: "Walls", label: "Segments", help: "Segments of 8 cm contract in place by 12 mm, every second one in turn.", values: { peristalsis_amplitude_m: 0.012, peristalsis_pause_s: 0.0, peristalsis_irregularity: 0.0, flow_m_s: 0.0, peristalsis_wavelength_m: 0.08, peristalsis_contraction: "segmental" } },
];
