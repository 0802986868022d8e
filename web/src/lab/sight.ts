// How much of the table the page shows.

import type { Polygon } from '../net/protocol.gen';
import type { ByHand, Trial } from './slices';

export const SIGHTS = [
  ['all', 'Everything', 'The whole table, as an onlooker sees it.'],
  [
    'seen',
    'What the camera has seen',
    'The rest of the table is in fog. The bead is where the tracker reports it.',
  ],
  ['camera', 'The camera’s picture', 'Only what the camera below the tool sees now.'],
] as const;

export type Sight = (typeof SIGHTS)[number][0];

/** The walls of pictures that have no fog. */
export const shownWalls = (
  lab: Pick<Trial, 'scene'> & Pick<ByHand, 'sight'>,
): readonly Polygon[] => (lab.sight() === 'all' ? (lab.scene()?.walls ?? []) : []);
