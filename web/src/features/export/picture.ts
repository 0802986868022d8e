// A picture of the view with a caption below it.

import { phaseName } from '../../words/facts';
import type { ViewPicture } from '../../plan/viewPicture';
import type { StateMessage } from '../../net/protocol.gen';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { Palette } from '../../ui/palette';

type Moment = Pick<StateMessage, 'controller' | 'sim_time_s' | 'goal_m' | 'phase'>;

/** In CSS pixels. */
const CAPTION_PX = 26;
const INSET_PX = 10;
const FONT_PX = 13;

/** `ferry-colon-rl-12.3s.png` */
export function fileName(map: string, { controller, sim_time_s }: Moment, ending: string): string {
  return `ferry-${map}-${controller}-${sim_time_s.toFixed(1)}s.${ending}`;
}

function outcome({ goal_m, phase }: Moment): string {
  if (phase.code === 'lifted_off') return phaseName(phase);
  if (!goal_m) return 'no goal';
  if (phase.code === 'delivered') return phaseName(phase);
  // The bead still follows.
  if (phase.code === 'settling') return 'goal reached';
  if (phase.code !== 'stopped') return 'on the way';
  return phase.by === 'settle' ? 'reached, not delivered' : 'not reached';
}

export function caption(map: string, moment: Moment): string {
  const { controller, sim_time_s } = moment;
  const parts = [map, CONTROLLER_LABELS[controller], `t = ${sim_time_s.toFixed(1)} s`];
  return [...parts, outcome(moment)].join(' · ');
}

/** A canvas for the view with its caption. Its sides are even, because some video encoders need that. */
export function createSheet(
  { size: { width, height } }: ViewPicture,
  ratio: number,
): HTMLCanvasElement {
  const even = (side: number): number => 2 * Math.max(1, Math.round(side / 2));
  const sheet = document.createElement('canvas');
  sheet.width = even(width * ratio);
  sheet.height = even((height + CAPTION_PX) * ratio);
  return sheet;
}

/**
 * Draws the view and its caption on a sheet. The view may have changed its size since the sheet was made: it is fitted
 * in. Returns whether there was something to draw.
 */
export function fillSheet(
  sheet: HTMLCanvasElement,
  ratio: number,
  view: ViewPicture,
  palette: Palette,
  words: string,
): boolean {
  const drawn = view.draw(ratio);
  const ctx = sheet.getContext('2d');
  if (!drawn || !ctx || drawn.width === 0 || drawn.height === 0) return false;
  const caption_px = CAPTION_PX * ratio;
  const space = sheet.height - caption_px;
  ctx.fillStyle = palette.surface;
  ctx.fillRect(0, 0, sheet.width, sheet.height);
  const scale = Math.min(sheet.width / drawn.width, space / drawn.height);
  const [width, height] = [scale * drawn.width, scale * drawn.height];
  ctx.drawImage(drawn, (sheet.width - width) / 2, (space - height) / 2, width, height);
  ctx.fillStyle = palette.ink;
  ctx.font = `${FONT_PX * ratio}px system-ui, sans-serif`;
  ctx.textBaseline = 'middle';
  const inset = INSET_PX * ratio;
  ctx.fillText(words, inset, space + caption_px / 2, sheet.width - 2 * inset);
  return true;
}
