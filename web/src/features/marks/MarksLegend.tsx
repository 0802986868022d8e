// What the marks on the map mean, in one line below it.

import { For, type JSX } from 'solid-js';
import './marks.css';

interface Mark {
  readonly name: string;
  readonly help: string;
  readonly icon: () => JSX.Element;
}

const MARKS: readonly Mark[] = [
  {
    name: 'magnet',
    help: 'The tool with the magnet, seen from above.',
    icon: () => (
      <g class="tool">
        <circle cx="10" cy="8" r="4" />
        <path d="M10 4V1M10 12v3M6 8H3M14 8h3" />
      </g>
    ),
  },
  {
    name: 'bead',
    help: 'The bead, 5 mm wide.',
    icon: () => <circle class="bead" cx="10" cy="8" r="4" />,
  },
  {
    name: 'tracked',
    help: 'Where the tracker sees the bead.',
    icon: () => <path class="tracked" d="M10 4v8M6 8h8" />,
  },
  {
    name: 'goal',
    help: 'The goal: the bead is delivered inside this circle of 20 mm radius.',
    icon: () => (
      <g class="goal">
        <circle cx="10" cy="8" r="6" />
        <path d="M10 5v6M7 8h6" />
      </g>
    ),
  },
  {
    name: 'wall',
    help: 'A wall. The bead cannot pass, the magnet can.',
    icon: () => <rect class="wall" x="3" y="3" width="14" height="10" />,
  },
];

export function MarksLegend(): JSX.Element {
  return (
    <ul class="marks" aria-label="Marks on the map">
      <For each={MARKS}>
        {({ name, help, icon }) => (
          <li title={help}>
            <svg viewBox="0 0 20 16" width="20" height="16" aria-hidden="true">
              {icon()}
            </svg>
            {name}
          </li>
        )}
      </For>
    </ul>
  );
}
