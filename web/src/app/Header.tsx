// The header: connection, role, mode, counters.

import { For, Show, type JSX } from 'solid-js';
import { ConnectionStatus } from './ConnectionStatus';
import { KeyboardHelp } from './KeyboardHelp';
import { PlaceNotice } from '../lab/PlaceNotice';
import { deliveredGoals } from '../lab/deliveries';
import { isLedFromOutside } from '../lab/outside';
import type { Lab, Notices, Session } from '../lab/slices';
import { VIEWS, type View } from '../lab/address';
import { takeControl } from '../lab/takeControl';
import type { PhaseFact, RecordingFact } from '../net/protocol.gen';
import { phaseName, phaseWords, recordingWords } from '../words/facts';
import { TERMS } from '../lab/terms';
import { SmallButton } from '../ui/SmallButton';
import { theme, toggleTheme } from '../ui/theme';
import './Header.css';

function phaseHelp(phase: PhaseFact): string {
  return phase.code === 'holding' ? TERMS.holding : `${phaseWords(phase)}. ${TERMS.phase}`;
}

function Counter(props: { label: string; testid: string; value: number | undefined }): JSX.Element {
  return (
    <div class="counter">
      <dt>{props.label}</dt>
      <dd class="number" data-testid={props.testid}>
        {props.value ?? '–'}
      </dd>
    </div>
  );
}

function RoleBox(props: { lab: Session & Notices }): JSX.Element {
  const { lab } = props;
  const operator = (): boolean => lab.hello()?.role === 'operator';
  return (
    <Show when={lab.connection().kind === 'live' && lab.hello()}>
      <span class="role" data-testid="role">
        {operator() ? 'operator' : 'viewer'}
      </span>
      <SmallButton
        classList={{ primary: !operator() || lab.hello()?.asked === true }}
        onClick={() => {
          if (operator()) void lab.send('session', { type: 'release_control' });
          else void takeControl(lab);
        }}
      >
        {operator() ? 'Release control' : 'Take control'}
      </SmallButton>
      <Show when={operator() && lab.hello()?.asked}>
        <span class="asked" data-testid="asked">
          control requested
        </span>
      </Show>
    </Show>
  );
}

interface HeaderProps {
  readonly lab: Lab;
}

/** Whether everything is recorded. The title has the whole status. */
const recordingState = ({ code }: RecordingFact): 'on' | 'gaps' | 'off' =>
  code === 'on' ? 'on' : code === 'slow' ? 'gaps' : 'off';

export function Header(props: HeaderProps): JSX.Element {
  const { lab } = props;
  const mode = (): number | undefined => {
    const state = lab.state();
    return state && !isLedFromOutside(state) ? state.mode : undefined;
  };
  return (
    <header class="bar top">
      <div class="brand">
        <h1>Ferry</h1>
        <p class="safety">Simulation, not safety-rated</p>
      </div>
      <nav class="views" aria-label="Views">
        <For each={Object.entries(VIEWS) as [View, string][]}>
          {([view, title]) => (
            <a
              href={lab.address.of(view)}
              aria-current={lab.address.view() === view ? 'page' : undefined}
              onClick={(event) => {
                // With a modifier, the browser opens another tab or window.
                if (event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
                event.preventDefault();
                lab.address.show(view);
              }}
            >
              {title}
            </a>
          )}
        </For>
      </nav>
      <div class="session">
        <ConnectionStatus lab={lab} />
        <RoleBox lab={lab} />
        <Show when={lab.state()}>
          {(state) => (
            <span
              class="recording"
              data-recording={recordingState(state().recording)}
              data-testid="recording"
              title={`${recordingWords(state().recording)}; rendered by ${lab.hello()?.adapter ?? 'an unknown adapter'}`}
            >
              rec
              <Show when={recordingState(state().recording) !== 'on'}>
                <span class="visually-hidden">: {recordingWords(state().recording)}</span>
              </Show>
            </span>
          )}
        </Show>
        <PlaceNotice lab={lab} place="session" />
      </div>
      <div class="mode" data-mode={mode() ?? 0} title={TERMS.mode}>
        <span class="mode-label">mode</span>
        <span class="mode-badge number" data-testid="mode">
          {mode() ?? '–'}
        </span>
        <Show when={lab.state()?.phase}>
          {(phase) => (
            <span
              class="phase"
              data-testid="phase"
              data-phase={phase().code}
              title={phaseHelp(phase())}
            >
              {phaseName(phase())}
            </span>
          )}
        </Show>
      </div>
      <dl class="counters">
        <Counter
          label="delivered"
          testid="deliveries"
          value={deliveredGoals(lab.state(), lab.marks())}
        />
        <Counter label="switches" testid="switches" value={lab.state()?.switches} />
        <Counter label="disturbed" testid="disturbances" value={lab.state()?.disturbances} />
        <Counter label="steps" testid="steps" value={lab.state()?.steps} />
      </dl>
      <div class="page-tools">
        <KeyboardHelp lab={lab} />
        <SmallButton
          aria-label={theme() === 'dark' ? 'Use light colours' : 'Use dark colours'}
          onClick={toggleTheme}
        >
          ◐
        </SmallButton>
      </div>
    </header>
  );
}
