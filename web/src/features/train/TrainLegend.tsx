// What the colours and marks of the plan mean, and which of them are shown.

import { For, type JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import type { Layers } from './drawFrame';
import { layers, setLayers } from './state';
import '../../ui/legend.css';

export function ValueScale(props: {
  range: readonly [number, number] | undefined;
  /** Whether more value maps follow. */
  isGrowing: boolean;
}): JSX.Element {
  const text = (end: 0 | 1): string => (props.range ? fixed(props.range[end], 2) : '–');
  return (
    <div class="map-legend" role="group" aria-label="Values">
      <span>Value</span>
      <span class="number">{text(0)}</span>
      <span class="heat-ramp" aria-hidden="true" />
      <span class="number">{text(1)}</span>
      <span class="aside">
        the same colours for all value maps{props.isGrowing ? ' so far' : ''}
      </span>
    </div>
  );
}

const LAYERS: readonly (readonly [keyof Layers, label: string, title: string])[] = [
  ['values', 'Values', 'What the policy expects from each cell'],
  ['arrows', 'Best steps', 'The step with the highest value at each cell'],
  ['starts', 'Failing starts', 'Cells from which the best steps do not lead to the shown goal'],
  ['episodes', 'Episodes', 'Some episodes to the goal, again and again; dotted: with random steps'],
];

export function LayerToggles(): JSX.Element {
  return (
    <fieldset class="train-layers" aria-label="Layers">
      <For each={LAYERS}>
        {([id, label, title]) => (
          <label title={title}>
            <input
              type="checkbox"
              checked={layers()[id]}
              onChange={({ currentTarget }) => {
                setLayers({ ...layers(), [id]: currentTarget.checked });
              }}
            />
            {label}
          </label>
        )}
      </For>
    </fieldset>
  );
}

/** The marks, drawn as on the plan. */
const MARKS: readonly (readonly [kind: string, path: string, words: string])[] = [
  ['goal', 'M5 0A5 5 0 1 1 -5 0A5 5 0 1 1 5 0M-3 0H3M0-3V3', 'goal'],
  ['failed', 'M-4-4L4 4M-4 4L4-4', 'start that fails: into a wall'],
  ['failed', 'M4 0A4 4 0 1 1 -4 0A4 4 0 1 1 4 0', 'start that fails: out of steps'],
  ['greedy', 'M4.5 0A4.5 4.5 0 1 1 -4.5 0A4.5 4.5 0 1 1 4.5 0', 'episode with the best steps'],
  ['exploring', 'M4.5 0A4.5 4.5 0 1 1 -4.5 0A4.5 4.5 0 1 1 4.5 0', 'episode with random steps too'],
];

export function Marks(): JSX.Element {
  return (
    <ul class="train-marks" aria-label="Marks">
      <For each={MARKS}>
        {([kind, path, words]) => (
          <li>
            <svg viewBox="-7 -7 14 14" aria-hidden="true">
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
    <>
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
    </>
  );
}
