// The challenge in the page's address, `?challenge=NAME`: begun once, and only by the operator.

import { createEffect } from 'solid-js';
import type { Contested, OpenTab, Session, Trial } from './slices';

export const linkedChallenge = ({ search }: Pick<Location, 'search'>): string | undefined =>
  new URLSearchParams(search).get('challenge') ?? undefined;

export function followChallengeLink(
  lab: Session & Trial & Contested & OpenTab,
  page: Pick<Location, 'search'>,
): void {
  const name = linkedChallenge(page);
  if (name === undefined) return;
  let isDone = false;
  let hasOpened = false;
  createEffect(() => {
    const scene = lab.scene();
    if (isDone || !scene || !lab.hello()) return;
    if (!hasOpened) lab.openTab('challenge');
    hasOpened = true;
    if (!lab.canOperate()) return;
    isDone = true;
    // A page that is loaded again goes on.
    if (scene.challenge !== name) void lab.contest.play(name);
  });
}
