// The form for a new evaluation, as it is filled in.

import { createDraft } from '../../ui/fields/draft';
import { PAPERS } from './request';

/** Outside of the component, so that it survives a change to the laboratory and back. */
export const { draft, change, edits } = createDraft(PAPERS);

/** Fills in a policy and a map; the rest stays. */
export function fillIn(policy: string, map: string): void {
  change({ controllers: ['rl'], program: '', rl_policy: policy, maps: [map] });
}
