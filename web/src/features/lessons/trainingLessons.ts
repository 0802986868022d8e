// Lessons about learning, each with trainings of a minute or less.

import type { Examination } from '../../net/protocol.gen';
import type { TrainingLesson } from './lesson';

const UPDATES = 1500;
const MORE_UPDATES = 3000;
const FEW_UPDATES = 500;
/** From this difference on, of 1000 episodes, one training is better. */
const CLEAR = 100;

/** The one that reached clearly more goals. */
function better(one: Examination, other: Examination, names: readonly [string, string]): string {
  const difference = one.reached - other.reached;
  if (Math.abs(difference) < CLEAR) return 'same';
  return difference > 0 ? names[0] : names[1];
}

export const LEARNING_FAILS: TrainingLesson = {
  id: 'learning-fails',
  title: 'Why learning fails',
  aim: 'Take something away from a training that works, three times.',
  minutes: 4,
  question: `With the recipe Quick and ${UPDATES} updates, a policy learns the small maze: about 990 of 1000 episodes of its examination reach the goal. Now three trainings lack something. Which one fails?`,
  choices: {
    exploration: 'The one without random steps and noise: it never tries anything new',
    discount: 'The one with discount 0: it only looks at the next reward',
    sparse: 'The one that is rewarded only at the goal',
  },
  runs: [
    {
      title: 'No random steps and no noise',
      policy: 'lesson-no-exploration',
      settings: { updates: UPDATES, exploration: 0, noisy: false },
      words: [
        'In this training the robot always takes the step that it thinks is best.',
        'Press *Train*. The view *Train* shows the value map and the episodes meanwhile.',
      ],
    },
    {
      title: 'Discount 0',
      policy: 'lesson-no-discount',
      settings: { updates: UPDATES, discount: 0 },
      words: [
        'Here a later reward is worth nothing. Each step is still rewarded when it shortens the path to the goal.',
      ],
    },
    {
      title: 'A reward only at the goal',
      policy: 'lesson-sparse',
      settings: { updates: UPDATES, progress_reward: 0, step_penalty: 0 },
      words: [
        'Here a step has no reward: only reaching the goal counts (+1), and driving into a wall (−1).',
      ],
    },
  ],
  outcome: (exploration, discount, sparse) => {
    const least = Math.min(exploration.reached, discount.reached, sparse.reached);
    if (least === sparse.reached) return 'sparse';
    return least === exploration.reached ? 'exploration' : 'discount';
  },
  why: [
    'When only the goal is rewarded, the first value appears next to the goal. From there it spreads by about one cell each time the network is corrected, and small errors hide it far away. 1500 updates are not enough: the value map stays flat except near the goal. Such rewards are called sparse.',
    'The progress reward says at each step whether it was a good one. It is computed from the true shortest paths, which only the training knows. With it, looking one step ahead is enough, so even discount 0 works here.',
    'Random steps matter less than one may think, because each episode begins at another place and has another goal, and each step is also learned for goals that the episode did not have. Without this, a robot that always starts at the same place would have to find the goal by chance.',
  ],
  paper:
    'Section IV-A gives rewards only at the end of an episode. Ferry adds the progress reward; docs/training.md lists all deviations.',
};

export const FAR_GOAL: TrainingLesson = {
  id: 'discount',
  title: 'How far the goal is felt',
  aim: 'See what the discount does when only the goal is rewarded.',
  minutes: 5,
  question: `Only the goal is rewarded, and there is time for ${MORE_UPDATES} updates. With a discount of .97, the goal is still worth .97²⁰ = .54 from 20 steps away; with .5 it is worth less than a millionth. Which policy reaches more goals?`,
  choices: {
    far: 'The one with discount .97',
    near: 'The one with discount .5: its values are easier to learn',
    same: 'Both reach about as many: the order of the values is the same',
  },
  runs: [
    {
      title: 'Discount .97',
      policy: 'lesson-far',
      settings: { updates: MORE_UPDATES, progress_reward: 0, step_penalty: 0, discount: 0.97 },
      words: ['Press *Train*. In the view *Train*, watch how far from the goal the colours reach.'],
    },
    {
      title: 'Discount .5',
      policy: 'lesson-near',
      settings: { updates: MORE_UPDATES, progress_reward: 0, step_penalty: 0, discount: 0.5 },
      words: ['The same training, but each step halves what the goal is worth.'],
    },
  ],
  outcome: (far, near) => better(far, near, ['far', 'near']),
  why: [
    'In theory the order of the values is the same. But a network is never exact: when two neighbouring cells differ by less than its error, the best step is a matter of chance. With discount .5, this begins a few cells from the goal.',
    'A discount near 1 has a price, too: values need more updates to reach far cells, and errors travel as far as values do.',
  ],
  paper:
    'Section III: the return is the discounted sum of the rewards. The paper does not state its discount.',
};

export const FINE_TUNING: TrainingLesson = {
  id: 'fine-tuning',
  title: 'A head start',
  aim: 'Train a policy further on a map that it has never seen.',
  minutes: 2,
  question: `The policy colon was trained on the map colon only. It is trained further on the small maze, for ${FEW_UPDATES} updates, and so is a network with random weights. Which one reaches more goals?`,
  choices: {
    random: 'The random one: colon has to forget first',
    tuned: 'The one that begins as colon',
    same: 'Both about as many',
  },
  runs: [
    {
      title: 'From random weights',
      policy: 'lesson-random',
      settings: { updates: FEW_UPDATES },
      words: ['A third of the updates that this maze needs. Press *Train*.'],
    },
    {
      title: 'From the policy colon',
      policy: 'lesson-tuned',
      settings: { updates: FEW_UPDATES },
      startFrom: 'colon',
      words: ['The same training, but it begins with the weights of the policy colon.'],
    },
  ],
  outcome: (random, tuned) => better(random, tuned, ['random', 'tuned']),
  why: [
    'The first layers of the network read the image: where walls are, and how near. Walls look the same in every maze, so this part is useful from the start. What the network still has to learn is which way leads to the goal here.',
    'On your own map, choose a policy at *Start from*. It saves most when there is little time; a full training ends equally well from random weights.',
  ],
  paper: 'Not in the paper, which trains once, for one maze.',
};
