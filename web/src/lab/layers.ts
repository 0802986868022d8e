// What can be drawn over the workspace, as the person chooses it.

import { recall, remember } from '../ui/storage';

export const LAYER_GROUPS = [
  {
    title: 'Motion',
    layers: [
      ['trail', 'Trails'],
      ['capture', 'Capture'],
      ['field', 'Field and pull'],
      ['ghosts', 'Ghosts'],
    ],
  },
  {
    title: 'Camera',
    layers: [
      ['camera', 'Camera field'],
      ['sensed', 'Sensed'],
      ['seen', 'Seen so far'],
      ['blocks', 'Quadtree'],
      ['rectangles', 'Rectangles'],
    ],
  },
  { title: 'RL', layers: [['value', 'Value']] },
  {
    title: 'ERRT',
    layers: [
      ['plan', 'Plan'],
      ['obstacles', 'Obstacles'],
    ],
  },
  { title: 'Attractor', layers: [['flow', 'Attractor flow']] },
  { title: 'Arm', layers: [['singularity', 'Singularity']] },
] as const;

export type Layer = (typeof LAYER_GROUPS)[number]['layers'][number][0];

const LAYERS: readonly Layer[] = LAYER_GROUPS.flatMap(({ layers }) => layers.map(([id]) => id));
/** Those that cover nothing. */
const FIRST_LAYERS: readonly Layer[] = ['sensed', 'trail', 'camera', 'capture', 'ghosts', 'plan'];
const KEY = 'layers';

/** What was stored, less the layers that are none any more; the first ones when there is no choice in it. */
export function layersFrom(text: string | null): ReadonlySet<Layer> {
  let chosen: unknown;
  try {
    chosen = JSON.parse(text ?? 'null');
  } catch {
    // Not of this page; as good as nothing.
  }
  if (!Array.isArray(chosen)) return new Set(FIRST_LAYERS);
  return new Set(LAYERS.filter((layer) => chosen.includes(layer)));
}

export function storedLayers(): ReadonlySet<Layer> {
  return layersFrom(recall(KEY));
}

export function storeLayers(layers: ReadonlySet<Layer>): void {
  remember(KEY, JSON.stringify([...layers]));
}
