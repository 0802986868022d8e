// What the colours and marks of the plan mean.

import { For, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import '../../ui/legend.css';
import './legend.css';

export function ValueScale(props: {
  range: readonly [number, number] | undefined;
  /** Whether more value maps follow. */
  isGrowing: boolean;
}): JSX.Element {
  const text = (share: number): string => {
    const { range } = props;
    return range ? fixed(range[0] + share * (range[1] - range[0]), 2) : '–';
  };
  return (
    <div class="train-scale" role="group" aria-label="Values">
      <span class="heat-ramp train-ramp" aria-hidden="true" />
      <span class="number">{text(0)} far</span>
      <span class="number">{text(0.5)}</span>
      <span class="number">{text(1)} at the goal</span>
      <p class="rule">
        The same colours for all value maps{props.isGrowing ? ' so far' : ''}. Arrows show the best
        steps.
      </p>
    </div>
  );
}

/** The marks, drawn as on the plan. */
const MARKS: readonly (readonly [kind: string, path: string, words: string])[] = [
  ['goal', 'M5 0A5 5 0 1 1 -5 0A5 5 0 1 1 5 0', 'goal'],
  ['failed', 'M-4-4L4 4M-4 4L4-4', 'start that fails: into a wall'],
  ['failed', 'M4 0A4 4 0 1 1 -4 0A4 4 0 1 1 4 0', 'start that fails: out of steps'],
  ['episode', 'M-7 0H7', 'episode with the best steps'],
  ['episode exploring', 'M-7 0H7', 'episode with random steps too'],
];

export function Marks(): JSX.Element {
  return (
    <ul class="train-marks plain" aria-label="Marks">
      <For each={MARKS}>
        {([kind, path, words]) => (
          <li>
            <svg viewBox="-9 -7 18 14" aria-hidden="true">
              <path class="casing" d={path} />
              <path class={kind} d={path} />
            </svg>
            {words}
          </li>
        )}
      </For>
    </ul>
  );
}

/** How to read the numbers and the marks. */
export function Readings(): JSX.Element {
  return (
    <details class="train-readings">
      <summary>How to read it</summary>
      <p class="hint">
        A start fails if the best steps from there end at a wall, or go back and forth between two
        places until the steps run out. In the laboratory a policy that goes back and forth may
        still deliver: there, steps to places that it has visited before count less (parameter{' '}
        <em>Visit penalty</em>).
      </p>
      <p class="hint">
        Rank correlation 1: the order of the values is exactly that of the true distances. 0: they
        have nothing in common. Negative: the opposite order. It can be low although the best steps
        are right.
      </p>
    </details>
  );
}
