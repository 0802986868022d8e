// What a training is, for a user who has never seen one.

import type { JSX } from 'solid-js';

function HowItLearns(): JSX.Element {
  return (
    <>
      <p>
        A <strong>policy</strong> is a neural network that looks at the camera image and chooses the
        next step of the tool: right, left, up or down. At first it knows nothing.
      </p>
      <ol>
        <li>
          The robot <strong>tries</strong>. An episode begins at a random place and ends at the
          goal, at a wall, or after too many steps. Some steps are random, so that it finds new
          routes.
        </li>
        <li>
          Each step gives a <strong>reward</strong>: reaching the goal counts most, a step toward it
          counts a little, a wall costs.
        </li>
        <li>
          From the rewards, the network learns the <strong>value</strong> of each place: what is
          still to come from there. First only the places beside the goal are worth something. Then
          the values grow from the goal along the channels, until the best steps lead to it from
          everywhere.
        </li>
      </ol>
    </>
  );
}

export function Intro(): JSX.Element {
  return (
    <div class="train-intro stack" role="region" aria-label="What happens here">
      <HowItLearns />
      <p>
        Press <strong>Train</strong>. With the recipe <em>Quick</em> it takes a few minutes, and you
        can watch it here. The finished policy carries the bead in the laboratory.
      </p>
    </div>
  );
}

/** The same after the first training. */
export function FoldedIntro(): JSX.Element {
  return (
    <div class="train-intro stack" role="region" aria-label="What happens here">
      <details>
        <summary>How does it learn?</summary>
        <HowItLearns />
      </details>
    </div>
  );
}
