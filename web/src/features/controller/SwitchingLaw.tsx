// The switching law: the tracked bead, the comparison with T, and the two sub-controllers.

import { For, Show, type JSX } from 'solid-js';
import { ChevronRight, Magnet, Route } from 'lucide';
import { centimetres, fixed, newtons } from '../../ui/format';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { Parameters, SceneMessage, StateMessage } from '../../net/protocol.gen';
import type { Events, Panels, Trial } from '../../lab/slices';
import { TERMS } from '../../lab/terms';
import { isUnseen, trackedWords } from '../../lab/tracked';
import { holdWords, reasonWords } from '../../words/facts';
import { sentence } from '../../lab/eventStory';
import { Fact } from '../../ui/Fact';
import { Icon } from '../../ui/Icon';
import './SwitchingLaw.css';

/** Right end of the bar: the largest T. A fixed scale shows how T moves. */
const FULL_M = 0.2;
/** Above this ratio lift-off is near. */
const LIFT_ALARM = 0.97;

interface Props {
  readonly state: StateMessage;
  readonly scene: SceneMessage;
  readonly lab: Trial & Events & Panels;
}

function ruleText(parameters: Parameters): string {
  const threshold = centimetres(parameters.threshold_m);
  return parameters.switching_law === 'literal'
    ? `2 if e ≤ T = ${threshold}, otherwise 1`
    : `1→2 at e ≤ ${centimetres(parameters.fetch_radius_m)}, 2→1 at e > T = ${threshold}`;
}

/** Where e is between 0, T and the end of the scale, with the limit that matters to the active sub-controller. */
function Bar(props: {
  state: StateMessage;
  parameters: Parameters;
  isUnseen: boolean;
}): JSX.Element {
  const share = (value_m: number): number => 100 * Math.min(1, Math.max(0, value_m / FULL_M));
  const threshold = (): number => share(props.parameters.threshold_m);
  const fetched_m = (): number =>
    props.parameters.switching_law === 'literal'
      ? props.parameters.threshold_m
      : props.parameters.fetch_radius_m;
  const isFetching = (): boolean => props.state.mode === 1;
  const limit_m = (): number => (isFetching() ? fetched_m() : props.parameters.threshold_m);
  /** Its own share of the label's width is left of the place, so that it never leaves the bar. */
  const at = (value_m: number): JSX.CSSProperties => ({
    left: `${share(value_m)}%`,
    translate: `-${share(value_m)}%`,
  });
  return (
    <div class="hold-bar">
      <Show when={!props.isUnseen} fallback={<span class="apart">not seen yet</span>}>
        <span class="number apart" style={at(props.state.tracked_error_m)}>
          {centimetres(props.state.tracked_error_m)} apart
        </span>
      </Show>
      <div class="hold-scale">
        <i class="held" style={{ width: `${threshold()}%` }} />
        <i class="limit" data-limit="fetched" style={at(fetched_m())} />
        <i class="limit" data-limit="threshold" style={at(props.parameters.threshold_m)} />
        <Show when={!props.isUnseen}>
          <i class="now" style={at(props.state.tracked_error_m)} />
        </Show>
      </div>
      <span class="number limit-words" style={at(limit_m())}>
        {centimetres(limit_m())}: {isFetching() ? 'fetched' : 'lost'}
      </span>
    </div>
  );
}

const SUB_CONTROLLERS = [
  { mode: 2, name: 'Carry', icon: Route },
  { mode: 1, name: 'Fetch', icon: Magnet },
] as const;

function SubControllers(props: { state: StateMessage }): JSX.Element {
  const when = (mode: 1 | 2): string => {
    if (mode === 1) return 'when lost';
    const { controller } = props.state;
    return controller === 'you' ? 'by your hand' : `with ${CONTROLLER_LABELS[controller]}`;
  };
  return (
    <ul
      class="sub-controllers plain"
      aria-label={`Switching law: sub-controller ${props.state.mode} is active`}
    >
      <For each={SUB_CONTROLLERS}>
        {({ mode, name, icon }) => (
          <li
            title={TERMS[`sub-controller ${mode}`]}
            data-mode={mode}
            data-active={props.state.mode === mode ? 'true' : 'false'}
          >
            <Icon of={icon} />
            <strong>{name}</strong>
            <span class="which">{mode}</span>
            <span class="when">{when(mode)}</span>
          </li>
        )}
      </For>
    </ul>
  );
}

/** Distances at which the pull is stronger than friction in at least one direction. */
function captureText(capture_m: SceneMessage['capture_m']): string {
  const reaches = capture_m.filter((reach) => reach !== null);
  if (reaches.length === 0) return 'nowhere';
  const near_m = Math.min(...reaches.map(([near]) => near));
  const bounded = reaches.map(([, far]) => far).filter((far) => far !== null);
  if (bounded.length < reaches.length) return `${centimetres(near_m)} and more`;
  const text = `${fixed(near_m * 100, 1)} to ${centimetres(Math.max(...bounded))}`;
  return reaches.length < capture_m.length ? `${text}, some directions` : text;
}

function MagnetAndBead(props: Props): JSX.Element {
  return (
    <section>
      <header>
        <h3>Magnet and bead</h3>
        <button
          type="button"
          class="small ghost"
          title="What the magnet can do at each distance and height"
          onClick={() => props.lab.showPanel('tune')}
        >
          Curves
          <Icon of={ChevronRight} />
        </button>
      </header>
      <dl class="facts">
        <Fact
          name="Captures within"
          value={captureText(props.scene.capture_m)}
          alarm={props.scene.capture_m.every((reach) => reach === null)}
        />
        <Fact
          name="Lift / weight"
          value={fixed(props.state.lift_ratio, 2)}
          alarm={props.state.lift_ratio > LIFT_ALARM}
        />
        <Fact
          name="Distance e, tracked"
          help="Between the tool and the place where the tracker sees the bead"
          value={trackedWords(props.lab)}
        />
        <Fact name="Threshold T" value={centimetres(props.scene.parameters.threshold_m)} />
      </dl>
    </section>
  );
}

export function SwitchingLaw(props: Props): JSX.Element {
  return (
    <>
      <section class="switching">
        <header>
          <h3>Does the magnet hold the bead?</h3>
          <span class="number pull">pull {newtons(props.state.pull_n)}</span>
        </header>
        <Bar
          state={props.state}
          parameters={props.scene.parameters}
          isUnseen={isUnseen(props.lab)}
        />
        <SubControllers state={props.state} />
        <div class="reasons">
          <p data-testid="reason">
            {isUnseen(props.lab)
              ? 'The bead was moved while paused. The tracker sees it again at Run.'
              : sentence(reasonWords(props.state.reason))}
          </p>
          <Show when={props.state.refusal}>
            {(refusal) => <p class="refusal">Holding: {holdWords(refusal())}</p>}
          </Show>
          <p class="rule">{ruleText(props.scene.parameters)}</p>
        </div>
      </section>
      <MagnetAndBead {...props} />
    </>
  );
}
