// Achieved speed of simulated time, late ticks, and how often the session fell behind.

import { Show, type JSX } from 'solid-js';
import { achievedWords, lateWords, lostWords } from './steps';
import type { Trial } from '../../lab/slices';

const LIMIT_HELP = 'This machine cannot run faster. The result of the trial is the same.';
const LATE_HELP = 'The machine is busy, so the last ticks came late. The result is the same.';

export function Achieved(props: { lab: Trial }): JSX.Element {
  const { lab } = props;
  const achieved = () =>
    achievedWords(lab.state()?.speed_target ?? 1, lab.state()?.speed_achieved ?? 0);
  const late = () => lateWords(lab.state()?.lateness_ms ?? 0);
  const lost = () => lostWords(lab.state()?.missed_deadlines ?? 0);
  return (
    <span
      class="achieved number"
      data-testid="achieved"
      title={['Simulated seconds per second that the server achieves', lost()]
        .filter((words) => words !== undefined)
        .join('; ')}
    >
      <Show when={lab.state()?.running} fallback="paused">
        {achieved().text}
        {/* At the machine's limit ticks are late in any case. */}
        <Show when={achieved().limited ? 'machine limit' : late()}>
          {(words) => (
            <span class="limit" title={achieved().limited ? LIMIT_HELP : LATE_HELP}>
              {words()}
            </span>
          )}
        </Show>
      </Show>
      <Show when={lost()}>{(words) => <span class="visually-hidden">; {words()}</span>}</Show>
    </span>
  );
}
