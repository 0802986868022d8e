// The menu of the top bar: who steers, what is recorded, and what is seldom needed.

import { Show, createEffect, onCleanup, type JSX } from 'solid-js';
import { Ellipsis, LogOut, Presentation } from 'lucide';
import type { Addressed, Notices, Session, Trial } from '../lab/slices';
import { addressOf, pathOf } from '../net/base';
import type { RecordingFact } from '../net/protocol.gen';
import { MAIN } from '../net/session';
import { Icon } from '../ui/Icon';
import { createPopover } from '../ui/popover';
import { recordingWords } from '../words/facts';
import '../ui/Fact.css';
import './MoreMenu.css';

/** Whether everything is recorded. The menu has the whole status. */
const recordingState = ({ code }: RecordingFact): 'on' | 'gaps' | 'off' =>
  code === 'on' ? 'on' : code === 'slow' ? 'gaps' : 'off';

/** Puts the session's name in the browser tab, because several sessions may be open side by side. */
function nameTab(session: string): void {
  createEffect(() => {
    const before = document.title;
    document.title = `${session} – ${before}`;
    onCleanup(() => {
      document.title = before;
    });
  });
}

export function MoreMenu(props: { lab: Session & Trial & Notices & Addressed }): JSX.Element {
  const { lab } = props;
  const popover = createPopover('more');
  if (lab.session !== MAIN) nameTab(lab.session);
  const isOperator = (): boolean => lab.hello()?.role === 'operator';
  /** In the laboratory, the dock has the button. */
  const passes = (): boolean =>
    lab.address.view() !== 'laboratory' && (!isOperator() || lab.hello()?.asked === true);
  const isLive = (): boolean => lab.connection().kind === 'live';
  const link = (): string => (lab.ended() ? 'ended' : lab.connection().kind);
  const recording = () => lab.state()?.recording;
  return (
    <div
      {...popover.box}
      class="more"
      data-testid="connection"
      data-link={link()}
      data-role={lab.hello()?.role}
    >
      <Show when={isLive() && lab.hello() && passes()}>
        <button
          type="button"
          class="primary"
          onClick={() => {
            if (isOperator()) void lab.send('session', { type: 'release_control' });
            else void lab.send('session', { type: 'take_control' });
          }}
        >
          {isOperator() ? 'Give control' : 'Take control'}
        </button>
      </Show>
      <button {...popover.button} class="ghost icon-only" aria-label="More" title="More">
        <Icon of={Ellipsis} />
      </button>
      <Show when={popover.open()}>
        <div id="more" class="popover of-top more-box" role="group" aria-label="More">
          <h2>Actions</h2>
          <a
            class="button"
            // The demonstration returns to this page.
            href={`${addressOf('/demo')}#${pathOf(window.location.pathname)}`}
            title="A demonstration that runs by itself. F11 gives it the whole screen, Esc returns."
          >
            <Icon of={Presentation} />
            Present
          </a>
          <Show when={isLive() && isOperator()}>
            <button
              type="button"
              onClick={() => {
                void lab.send('session', { type: 'release_control' });
                popover.close();
              }}
            >
              <Icon of={LogOut} />
              Release control
            </button>
          </Show>
          <h2 class="more-facts">This session</h2>
          <dl class="facts">
            <div>
              <dt>You are</dt>
              <dd data-testid="role">{isOperator() ? 'operator' : 'viewer'}</dd>
            </div>
            <div>
              <dt>Session</dt>
              <dd data-testid="session-name">{lab.session}</dd>
            </div>
            <div>
              <dt>Time of the session</dt>
              <dd class="number" data-testid="tick">
                tick {lab.state()?.tick ?? 0}
              </dd>
            </div>
            <div>
              <dt>Camera’s picture by</dt>
              <dd>{lab.hello()?.adapter ?? 'unknown'}</dd>
            </div>
            <Show when={recording()}>
              {(fact) => (
                <div>
                  <dt>Recording</dt>
                  <dd data-testid="recording" data-recording={recordingState(fact())}>
                    {recordingWords(fact())}
                  </dd>
                </div>
              )}
            </Show>
          </dl>
        </div>
      </Show>
    </div>
  );
}
