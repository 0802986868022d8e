// The switching law as a diagram: the tracked bead, the comparison with T, the two sub-controllers.

import { For, Show, type JSX } from 'solid-js';
import { centimetres, fixed, newtons } from '../../ui/format';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type {
  Parameters,
  PositionerKind,
  SceneMessage,
  StateMessage,
} from '../../net/protocol.gen';
import { TERMS } from '../../lab/terms';
import { holdWords, reasonWords } from '../../words/facts';
import { Fact } from '../../ui/Fact';
import '../../ui/Fact.css';
import './SwitchingLaw.css';

const GAUGE_WIDTH = 272;
const GAUGE_LEFT = 4;
/** Right end of the gauge: the largest T. A fixed scale shows how T moves. */
const GAUGE_FULL_M = 0.2;
/** Above this ratio lift-off is near. */
const LIFT_ALARM = 0.97;

interface Props {
  readonly state: StateMessage;
  readonly parameters: Parameters;
}

function ruleText(parameters: Parameters): string {
  const threshold = centimetres(parameters.threshold_m);
  return parameters.switching_law === 'literal'
    ? `2 if e ≤ T = ${threshold}, otherwise 1`
    : `1→2 at e ≤ ${centimetres(parameters.fetch_radius_m)}, 2→1 at e > T = ${threshold}`;
}

/** The two sub-controllers, and where the wires to and from them are. */
const BRANCHES = [
  { mode: 1, top: 6, into: 'M100 25h10', lever: 'M83 52 100 25', out: 'M228 25h9v20h7' },
  { mode: 2, top: 60, into: 'M100 79h10', lever: 'M83 52 100 79', out: 'M228 79h9v-20h7' },
] as const;

type Branch = (typeof BRANCHES)[number];

function SubController(props: Props & { branch: Branch }): JSX.Element {
  const { mode, top, into, lever, out } = props.branch;
  const isActive = (): boolean => props.state.mode === mode;
  const does = (): string =>
    mode === 1 ? 'fetch the bead' : `transport: ${CONTROLLER_LABELS[props.state.controller]}`;
  const wire = (): string => (isActive() ? `wire active m${mode}` : 'wire');
  return (
    <>
      <g
        class="block"
        classList={{ active: isActive() }}
        data-mode={mode}
        data-active={isActive() ? 'true' : 'false'}
      >
        <title>{TERMS[`sub-controller ${mode}`]}</title>
        <rect x="112" y={top} width="116" height="38" rx="5" />
        <text class="name" x="170" y={top + 16}>
          Sub-controller {mode}
        </text>
        <text class="does" x="170" y={top + 30}>
          {does()}
        </text>
      </g>
      <path class={wire()} d={into} />
      <path class={wire()} d={out} marker-end="url(#arrow)" />
      <Show when={isActive()}>
        <path class="lever" data-mode={mode} d={lever} />
      </Show>
    </>
  );
}

function Diagram(props: Props & { positioner: PositionerKind }): JSX.Element {
  return (
    <svg
      class="law"
      viewBox="0 0 280 128"
      role="img"
      aria-label={`Switching law: sub-controller ${props.state.mode} is active`}
    >
      <defs>
        <marker id="arrow" viewBox="0 0 6 6" refX="5" refY="3" markerWidth="6" markerHeight="6">
          <path d="M0 0 6 3 0 6z" class="arrow" />
        </marker>
      </defs>
      <g class="block fixed">
        <rect x="1" y="33" width="62" height="38" rx="5" />
        <text class="name" x="32" y="49">
          e
        </text>
        <text class="does" x="32" y="63">
          tool − bead
        </text>
      </g>
      <g class="block fixed">
        <rect x="246" y="33" width="33" height="38" rx="5" />
        <text class="name narrow" x="262.5" y="56">
          {props.positioner === 'arm' ? 'arm' : 'stage'}
        </text>
      </g>
      <path class="wire" d="M63 52h18" />
      <circle class="pivot" cx="83" cy="52" r="3" />
      <For each={BRANCHES}>{(branch) => <SubController {...props} branch={branch} />}</For>
      <path class="wire back" d="M262 71v44H32v-42" marker-end="url(#arrow)" />
      <text class="does" x="147" y="111">
        {props.parameters.switching_law === 'literal' ? 'literal law' : 'magnet, bead, tracker'}
      </text>
    </svg>
  );
}

function Gauge(props: Props): JSX.Element {
  const at = (value_m: number): number =>
    GAUGE_LEFT + Math.min(1, Math.max(0, value_m / GAUGE_FULL_M)) * GAUGE_WIDTH;
  const threshold = (): number => at(props.parameters.threshold_m);
  const fetch = (): number =>
    props.parameters.switching_law === 'literal'
      ? threshold()
      : at(props.parameters.fetch_radius_m);
  const needle = (): number => at(props.state.tracked_error_m);
  return (
    <svg class="gauge" viewBox="0 0 280 22" aria-hidden="true">
      <rect class="zone m2" x={GAUGE_LEFT} y="8" width={fetch() - GAUGE_LEFT} height="6" />
      <rect class="zone between" x={fetch()} y="8" width={threshold() - fetch()} height="6" />
      <rect
        class="zone m1"
        x={threshold()}
        y="8"
        width={GAUGE_LEFT + GAUGE_WIDTH - threshold()}
        height="6"
      />
      <path class="mark" d={`M${threshold()} 4v14`} />
      <path
        class="needle"
        data-mode={props.state.mode}
        d={`M${needle()} 8l-5-8h10zM${needle()} 14l-5 8h10z`}
      />
    </svg>
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

export function SwitchingLaw(props: { state: StateMessage; scene: SceneMessage }): JSX.Element {
  return (
    <div class="switching">
      <Diagram
        state={props.state}
        parameters={props.scene.parameters}
        positioner={props.scene.positioner}
      />
      <Gauge state={props.state} parameters={props.scene.parameters} />
      <dl class="margins">
        <Fact name="e" value={centimetres(props.state.tracked_error_m)} />
        <Fact name="T" value={centimetres(props.scene.parameters.threshold_m)} />
        <Fact
          name="lift / weight"
          value={fixed(props.state.lift_ratio, 2)}
          alarm={props.state.lift_ratio > LIFT_ALARM}
        />
        <Fact name="pull" value={newtons(props.state.pull_n)} />
        <Fact
          name="captures at"
          value={captureText(props.scene.capture_m)}
          alarm={props.scene.capture_m.every((reach) => reach === null)}
        />
      </dl>
      <p class="reason" data-testid="reason">
        {reasonWords(props.state.reason)}
      </p>
      <Show when={props.state.refusal}>
        {(refusal) => <p class="refusal">Holding: {holdWords(refusal())}</p>}
      </Show>
      <p class="rule">{ruleText(props.scene.parameters)}</p>
    </div>
  );
}
