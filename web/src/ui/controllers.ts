// How each controller looks, wherever it is shown: a colour, and for those who do not see colours a shape and a dash.

import type { Palette } from './palette';

export interface Look {
  /** Its colour beside text and in plots; a token of the style sheet too. */
  readonly colour: keyof Palette;
  /** Its colour on the map. */
  readonly mark: keyof Palette;
  /** Of a line that is `DASHED_PX` wide, with round ends; empty for a solid line. */
  readonly dash: readonly number[];
  /** A filled path in a square of `SHAPE_PX`. */
  readonly shape: string;
}

export const SHAPE_PX = 12;
const DASHED_PX = 2.6;

/** Of each controller of the protocol. */
export const LOOKS = {
  rl: {
    colour: 'rl',
    mark: 'm-rl',
    dash: [],
    shape: 'M6 .6a5.4 5.4 0 0 1 0 10.8a5.4 5.4 0 0 1 0-10.8z',
  },
  errt: { colour: 'errt', mark: 'm-errt', dash: [7, 5], shape: 'M6 0l6 6-6 6-6-6z' },
  attractor: {
    colour: 'attractor',
    mark: 'm-attractor',
    dash: [0.1, 4.4],
    shape: 'M6 .6l6 10.8H0z',
  },
  you: {
    colour: 'you',
    mark: 'm-you',
    dash: [9, 5, 1, 5],
    shape:
      'M3.5 1h5a2.5 2.5 0 0 1 2.5 2.5v5a2.5 2.5 0 0 1-2.5 2.5h-5a2.5 2.5 0 0 1-2.5-2.5v-5a2.5 2.5 0 0 1 2.5-2.5z',
  },
  replanner: {
    colour: 'replanner',
    mark: 'm-replanner',
    dash: [3, 4.6],
    shape: 'M0 .6h12l-6 10.8z',
  },
  program: {
    colour: 'program',
    mark: 'm-program',
    dash: [9, 5, 1, 5, 1, 5],
    shape: 'M4.2.5h3.6v3.7h3.7v3.6h-3.7v3.7h-3.6v-3.7h-3.7v-3.6h3.7z',
  },
  robot: {
    colour: 'robot',
    mark: 'm-robot',
    dash: [14, 5],
    shape: 'M3 .8h6l3 5.2-3 5.2h-6l-3-5.2z',
  },
} as const satisfies Record<string, Look>;

export type Controller = keyof typeof LOOKS;

/** All of them: a number stands for one in columns of samples. */
export const CARRIERS = Object.keys(LOOKS) as readonly Controller[];
export const isController = (name: string): name is Controller => Object.hasOwn(LOOKS, name);

/** The dash of a controller's line of a width. */
export const dashOf = (controller: Controller, width_px: number): number[] =>
  LOOKS[controller].dash.map((part) => (part * width_px) / DASHED_PX);
