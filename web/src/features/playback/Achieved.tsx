// What the speed is if it is not the requested one, late ticks, and how often the session fell behind.

import { Show, createMemo, type JSX } from 'solid-js';
import { lateWords, limitWords, lostWords } from './steps';
import type { Trial } from '../../lab/slices';

const LIMIT_HELP = 'This machine cannot run faster. The result of the trial is the same.';
const LATE_HELP = 'The machine is busy, so the last ticks came late. The result is the same.';

export function Achieved(props: { lab: Trial }): JSX.Element {
  const { lab } = props;
  const lost = createMemo(() => lostWords(lab.state()?.missed_deadlines ?? 0));
  const shown = createMemo(() => {
    const state = lab.state();
    if (!state?.running) return undefined;
    const limit = limitWords(state.speed_target, state.speed_achieved);
    // At the machine's limit ticks are late in any case.
    if (limit !== undefined) return { text: limit, help: LIMIT_HELP };
    const late = lateWords(state.lateness_ms);
    return late === undefined ? undefined : { text: late, help: LATE_HELP };
  });
  return (
    <span class="achieved number" data-testid="achieved" title={lost()}>
      <Show when={shown()}>{(now) => <span title={now().help}>{now().text}</span>}</Show>
      <Show when={lost()}>{(words) => <span class="visually-hidden">; {words()}</span>}</Show>
    </span>
  );
}
