// What the marks mean that are always on the map.

import { For, type JSX } from 'solid-js';
import './marks.css';

const MARKS: readonly (readonly [name: string, help: string, icon: () => JSX.Element])[] = [
  ['Bead', 'five millimetres wide', () => <circle class="bead" cx="15" cy="8" r="4.5" />],
  [
    'Magnet',
    'the tool, seen from above',
    () => (
      <g class="tool">
        <path class="north" d="M14 2.5a5.6 5.6 0 0 0 0 11" />
        <path class="south" d="M16 2.5a5.6 5.6 0 0 1 0 11" />
      </g>
    ),
  ],
  ['Tracked', 'where the tracker sees the bead', () => <path class="tracked" d="M15 4v8M11 8h8" />],
  [
    'Goal',
    'within 2 cm, the bead is delivered',
    () => (
      <g class="goal">
        <circle cx="15" cy="8" r="6.5" />
        <path class="flag" d="M13.5 11V5l4 1.6-4 1.6" />
      </g>
    ),
  ],
  [
    'Wall',
    'the bead cannot pass; above it, the magnet only flies to a lost bead',
    () => <rect class="wall" width="30" height="16" />,
  ],
];

export function MarksKey(): JSX.Element {
  return (
    <dl class="marks stack" aria-label="Marks on the map">
      <For each={MARKS}>
        {([name, help, icon]) => (
          <div>
            <svg viewBox="0 0 30 16" aria-hidden="true">
              {icon()}
            </svg>
            <dt>{name}</dt>
            <dd>{help}</dd>
          </div>
        )}
      </For>
    </dl>
  );
}
