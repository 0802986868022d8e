// What the marks on the map mean, in one line below it.

import { For, type JSX } from 'solid-js';
import './marks.css';

interface Mark {
  /** Layer of the mark; without one it is always on the map. */
  readonly layer?: string;
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
        <path class="north" d="M9 2.5a5.6 5.6 0 0 0 0 11" />
        <path class="south" d="M11 2.5a5.6 5.6 0 0 1 0 11" />
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
        <path class="flag" d="M8.5 11V5l4 1.6-4 1.6" />
      </g>
    ),
  },
  {
    name: 'wall',
    help: 'A wall. The bead cannot pass. Above it, the magnet only flies to a lost bead.',
    icon: () => <rect class="wall" x="3" y="3" width="14" height="10" />,
  },
  {
    layer: 'capture',
    name: 'pull',
    help: 'Inside this circle the pull of the magnet moves the bead.',
    icon: () => <circle class="reach" cx="10" cy="8" r="6.5" />,
  },
  {
    layer: 'camera',
    name: 'view',
    help: 'What the camera on the arm sees.',
    icon: () => <path class="view" d="M3 5V2h3M14 2h3v3M17 11v3h-3M6 14H3v-3" />,
  },
  {
    layer: 'sensed',
    name: 'seen',
    help: 'Walls in the present camera picture.',
    icon: () => <path class="sensed" d="M3 12h8V4h6" />,
  },
  {
    layer: 'trail',
    name: 'trails',
    help: 'Where the bead has been, in the colour and dash of the controller that carried it. Thin: the magnet.',
    icon: () => (
      <>
        <path class="tool-trail" d="M2 5h16" />
        <path class="bead-trail" d="M2 11h16" />
      </>
    ),
  },
];

/** `isShown` tells whether a layer is on the map. */
export function MarksLegend(props: { isShown: (layer: string) => boolean }): JSX.Element {
  const marks = (): readonly Mark[] =>
    MARKS.filter(({ layer }) => layer === undefined || props.isShown(layer));
  return (
    <ul class="marks" aria-label="Marks on the map">
      <For each={marks()}>
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
