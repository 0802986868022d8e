// The challenge in the page's address, `?challenge=NAME`: begun once, and only by the operator.

import { createEffect } from 'solid-js';
import type { Contested, OpenTab, Session, Trial } from './slices';

export function followChallengeLink(
  lab: Session & Trial & Contested & OpenTab,
  { search }: Pick<Location, 'search'>,
): void {
  const name = new URLSearchParams(search).get('challenge');
  if (name === null) return;
  let isDone = false;
  createEffect(() => {
    const scene = lab.scene();
    if (isDone || !scene || !lab.canOperate()) return;
    isDone = true;
    lab.openTab('challenge');
    // A page that is loaded again goes on.
    if (scene.challenge !== name) lab.contest.play(name);
  });
}
