// The challenge in the page's address, `?challenge=NAME`: begun once, and only by the operator.

import { createEffect, createRoot, type Accessor } from 'solid-js';
import type { Contested, OpenTab, Session, Trial } from './slices';

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
  lab: Session & Trial & Contested & OpenTab,
  page: Pick<Location, 'search'>,
): Promise<void> {
  const name = linkedChallenge(page);
  if (name === undefined) return;
  await until(() => lab.scene() && lab.hello());
  lab.openTab('challenge');
  await until(lab.canOperate);
  // A page that is loaded again goes on.
  if (lab.scene()?.challenge !== name) await lab.contest.play(name);
}
