// The live region for screen readers: switches, deliveries, disturbances, connection, role.

import { createEffect, createSignal, on, type JSX } from 'solid-js';
import { createAnnouncer, lastLine, newsOf, roleWords } from './announce';
import type { Events, Session } from '../lab/slices';

export function LiveRegion(props: { lab: Session & Events }): JSX.Element {
  const { lab } = props;
  const [said, setSaid] = createSignal('');
  const say = createAnnouncer(setSaid);
  let announced = lastLine(lab.log());
  createEffect(
    on(lab.log, (log) => {
      const news = newsOf(log, announced);
      announced = lastLine(log);
      if (news !== undefined) say(news);
    }),
  );
  createEffect(
    on(lab.hello, (now, before) => {
      const words = roleWords(before, now);
      if (words !== undefined) say(words);
    }),
  );
  return (
    <div class="visually-hidden" role="status" aria-live="polite" data-testid="live-region">
      {said()}
    </div>
  );
}
