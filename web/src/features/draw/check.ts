// What the server says about the drawing, after each change.

import type { Accessor } from 'solid-js';
import { createAnswerFrom } from '../../net/requests';
import type { MapCheck } from '../../net/protocol.gen';
import { checkOf, faultWords, isOutOfReach, reportWords } from '../../lab/maps';

const CHECKS_PER_S = 4;
/** The mazes on which the controllers are tested have no narrower channels. */
export const TESTED_WIDTH_M = 0.035;

export interface Remark {
  readonly text: string;
  readonly isWarning: boolean;
}

export function checkWords(check: MapCheck): Remark[] {
  const faults = faultWords(check);
  const remarks = reportWords(check).map((text) => ({ text, isWarning: faults.includes(text) }));
  if ((check.narrowest?.width_m ?? Infinity) < TESTED_WIDTH_M) {
    const text =
      'The controllers are tested in channels from 35 mm; in narrower ones they may get stuck.';
    remarks.push({ text, isWarning: true });
  }
  return remarks;
}

/** In a few words, and whether it can be used as it is. */
export function verdictOf(check: MapCheck): { readonly text: string; readonly isGood: boolean } {
  const { regions, narrowest } = check;
  if (regions === 0) return { text: 'no room for the bead', isGood: false };
  if (regions > 1) return { text: 'separate parts', isGood: false };
  if (isOutOfReach(check)) return { text: 'out of reach', isGood: false };
  if ((narrowest?.width_m ?? Infinity) < TESTED_WIDTH_M) return { text: 'narrow', isGood: false };
  return { text: 'the bead fits through', isGood: true };
}

/** Asks again when the connection comes back. */
export function createCheck(svg: Accessor<string>, isLive: Accessor<boolean>) {
  const answer = createAnswerFrom(checkOf, () => (isLive() ? svg() : undefined), {
    key: svg,
    perS: CHECKS_PER_S,
  });
  return {
    remarks: (): readonly Remark[] => {
      const { error, data } = answer();
      return error === undefined
        ? data
          ? checkWords(data)
          : []
        : [{ text: error, isWarning: true }];
    },
    /** Of the present drawing; undefined if it is refused, or before it is checked. */
    found: (): MapCheck | undefined => {
      const { error, data, key } = answer();
      return error === undefined && key === svg() ? data : undefined;
    },
  };
}

export type Check = ReturnType<typeof createCheck>;
