// The challenge in the page's address, `?challenge=NAME`: begun once, and only by the operator.

import { createEffect, createRoot, type Accessor } from 'solid-js';
import { leaveAddress } from './address';
import type { Contested, Panels, Session, Trial } from './slices';

export const linkedChallenge = ({ search }: Pick<Location, 'search'>): string | undefined =>
  new URLSearchParams(search).get('challenge') ?? undefined;

/** Settles as soon as the condition holds. */
function until(condition: Accessor<unknown>): Promise<void> {
  return new Promise((settle) => {
    createRoot((dispose) => {
      createEffect(() => {
        if (!condition()) return;
        dispose();
        settle();
      });
    });
  });
}

export async function followChallengeLink(
  lab: Session & Trial & Contested & Panels,
  page: Window,
): Promise<void> {
  const name = linkedChallenge(page.location);
  if (name === undefined) return;
  await until(() => lab.scene() && lab.hello());
  lab.showPanel('play');
  await until(lab.canOperate);
  // A page that is loaded again goes on.
  const { kind } = await lab.contest.play(name);
  if (kind === 'done') leaveAddress(page, 'search');
}
