// Generated from server/lab; `FERRY_GENERATE=1 cargo test --release protocol` renews it.

/** What a client may change of a recipe. */
export const TRAINING_SETTINGS = {
  updates: { kind: 'number', name: "updates", label: "Updates", unit: "", scale: 1, min: 1, max: 20000, step: 500, isWhole: true, help: "How often the network is corrected: more updates take longer and end better." },
  learning_rate: { kind: 'number', name: "learning_rate", label: "Learning rate", unit: "", scale: 1, min: 0, max: 0.1, step: 0.0001, isWhole: false, help: "How far each update moves the network in the first half: too small is slow, too large forgets." },
  discount: { kind: 'number', name: "discount", label: "Discount", unit: "", scale: 1, min: 0, max: 1, step: 0.01, isWhole: false, help: "How much a reward counts one step later: near 1, the goal is felt from far away." },
  exploration: { kind: 'number', name: "exploration", label: "Exploration", unit: "", scale: 1, min: 0, max: 1, step: 0.01, isWhole: false, help: "The share of steps in a random direction, so that the robot finds new routes." },
  noisy: { kind: 'flag', name: "noisy", label: "Noisy layers", help: "Noise inside the network makes it try other steps where it is not sure." },
  progress_reward: { kind: 'number', name: "progress_reward", label: "Progress reward", unit: "", scale: 1, min: 0, max: 1, step: 0.05, isWhole: false, help: "Reward for each step that shortens the path to the goal: it shows the direction early." },
  step_penalty: { kind: 'number', name: "step_penalty", label: "Step penalty", unit: "", scale: 1, min: 0, max: 1, step: 0.05, isWhole: false, help: "Subtracted at each step, so that short paths are worth more." },
  n_step: { kind: 'number', name: "n_step", label: "Steps of a return", unit: "", scale: 1, min: 1, max: 20, step: 1, isWhole: true, help: "How many real rewards are added up before the network’s own estimate takes over." },
  fusion: { kind: 'choice', name: "fusion", label: "Fusion", options: [["late","Late"],["early","Early"]], help: "Where the network joins image and goal: early is that of the paper, late learns faster." },
} as const;

/** The recipes of trainings, with their settings. */
export const RECIPES = [
  { name: "quick", label: 'Quick', help: 'Learns one map in minutes.', settings: {"discount":0.96,"exploration":0.05,"fusion":"late","learning_rate":0.001,"n_step":1,"noisy":true,"progress_reward":0.1,"step_penalty":0.1,"updates":10000} },
  { name: "full", label: 'Full', help: 'That of the shipped policies. It takes half as long again.', settings: {"discount":0.9,"exploration":0.05,"fusion":"late","learning_rate":0.001,"n_step":1,"noisy":true,"progress_reward":0.1,"step_penalty":0.0,"updates":12000} },
  { name: "paper", label: 'Paper', help: 'Rewards, fusion and returns of the paper: slower to learn.', settings: {"discount":0.99,"exploration":0.0,"fusion":"early","learning_rate":0.0001,"n_step":3,"noisy":true,"progress_reward":0.0,"step_penalty":0.0,"updates":12000} },
  { name: "toy", label: 'Toy', help: 'Learns the map toy in 15 seconds. Larger maps need another recipe.', settings: {"discount":0.8,"exploration":0.3,"fusion":"late","learning_rate":0.003,"n_step":1,"noisy":true,"progress_reward":0.3,"step_penalty":0.3,"updates":1000} },
] as const;

/** The numbers of an evaluation. */
export const EVALUATION_FIELDS = {
  episodes: { kind: 'number', name: "episodes", label: "Episodes per cell", unit: "", scale: 1, min: 1, max: 1000, step: 10, isWhole: true, help: "Trials of each controller on each map: more of them narrow the intervals." },
} as const;

/** The numbers of a recovery map. */
export const RECOVERY_FIELDS = {
  grid: { kind: 'number', name: "grid", label: "Columns", unit: "", scale: 1, min: 4, max: 96, step: 1, isWhole: true, help: "Of the finest grid: places, directions or times." },
  repeats: { kind: 'number', name: "repeats", label: "Repeats", unit: "", scale: 1, min: 1, max: 100, step: 1, isWhole: true, help: "Trials per cell and controller, each with its own noise." },
  within_s: { kind: 'number', name: "within_s", label: "In time", unit: "s", scale: 1, min: 1, max: 600, step: 1, isWhole: false, help: "A later delivery is late; simulated time." },
} as const;

/** Those that a recovery map has without others. */
export const RECOVERY_DEFAULTS = {"grid":24,"repeats":3,"seed":1,"within_s":60.0} as const;
