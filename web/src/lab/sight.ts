// How much of the table the page shows.

import type { Accessor } from 'solid-js';
import type { Polygon } from '../net/protocol.gen';
import type { Basis } from './basis';

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
  lab: Pick<Basis, 'scene'> & { readonly sight: Accessor<Sight> },
): readonly Polygon[] => (lab.sight() === 'all' ? (lab.scene()?.walls ?? []) : []);
