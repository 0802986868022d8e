// The form for a new evaluation, as it is filled in.

import { createSignal } from 'solid-js';
import { type Draft, PAPERS } from './request';

/** Outside of the component, so that it survives a change to the laboratory and back. */
export const [draft, setDraft] = createSignal<Draft>(PAPERS);

/** Fills in a policy and a map; the rest stays. */
export function fillIn(policy: string, map: string): void {
  setDraft({ ...draft(), controllers: ['rl'], program: '', rl_policy: policy, maps: [map] });
}
