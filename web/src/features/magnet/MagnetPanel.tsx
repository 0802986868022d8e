// What the magnet can do with the current parameters, also while a slider moves.

import { Show, createMemo, createSignal, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import { Magnet as MagnetIcon } from 'lucide';
import { createAnswer } from '../../net/requests';
import { axisLabel, fixed } from '../../ui/format';
import {
  breakaway,
  captureSentence,
  directionOf,
  HEIGHTS_M,
  heldRatio,
  pullQuery,
  pullWords,
  reachQuery,
  reachWords,
  shownOffset,
  type Side,
  SIDES,
} from './magnet';
import type { Parameters, PullCurve, ReachCurve } from '../../net/protocol.gen';
import { CurvePlot } from '../../ui/CurvePlot';
import { Icon } from '../../ui/Icon';
import { Segmented } from '../../ui/Segmented';
import type { CurveContext, Rule } from '../../ui/curve';
import { MagnetControls } from './MagnetControls';
import { MagnetFacts } from './MagnetFacts';
import type { PanelProps } from '../../lab/panel';
import type { Session, Trial } from '../../lab/slices';
import './magnet.css';

const MM = { scale: 1000, dashed: false };

/** A line across the plot at a place in metres, if it is known. */
function upright(
  at_m: number | undefined,
  { scale, ...look }: Omit<Rule, 'axis' | 'at'> & { scale: number },
): Rule[] {
  return at_m === undefined ? [] : [{ ...look, axis: 'x', at: scale * at_m }];
}

function Magnet(props: { lab: Session & Trial; parameters: Parameters }): JSX.Element {
  const { lab } = props;
  const [side, setSide] = createSignal<Side>('x');
  const [pointed, setPointed] = createSignal<string>();
  const direction_rad = createMemo(() => {
    const state = lab.state();
    return state ? directionOf(side(), state.tool_m, state.bead_m) : 0;
  });
  /** In whole millimetres, so that the mark does not tremble. */
  const distance_m = createMemo(() => {
    const error_m = lab.state()?.tracking_error_m;
    return error_m === undefined ? undefined : Math.round(1000 * error_m) / 1000;
  });
  // No request without a connection, so that it is sent again on the next connection.
  const ask = <A,>(path: string, question: (parameters: Parameters) => object) =>
    createAnswer<object, A>(path, () =>
      lab.connection().kind === 'live' ? question(props.parameters) : undefined,
    );
  const pull = ask<PullCurve>('/api/magnetics/pull', (parameters) =>
    pullQuery(parameters, direction_rad()),
  );
  const reachAt = (heights: 'all' | 'here') =>
    ask<ReachCurve>('/api/magnetics/reach', (parameters) =>
      reachQuery(parameters, direction_rad(), heights),
    );
  const [reach, here] = [reachAt('all'), reachAt('here')];
  const error = (): string | undefined => pull().error ?? reach().error ?? here().error;
  const hint = (): string =>
    props.parameters.tool_orientation === 'paper' && lab.scene()?.positioner === 'arm'
      ? 'The curves are for an upright block; the tool is tilted by 3.2°.'
      : 'Point at a curve to read it.';
  const friction = createMemo(() => breakaway(props.parameters));
  const liftOff_m = (): number | undefined => reach().data?.lift_off_m;

  const pullContext: CurveContext = {
    lines: [
      { label: 'lift', color: 'ink' },
      { label: 'pull', color: 'magnet-line' },
      { label: 'friction', color: 'bead-line' },
    ],
    xRange: () => [0, 100 * shownOffset(pull().data?.capture_m ?? null)],
    yRange: (max) => [0, Math.max(1.15, 1.05 * max)],
    xText: (value) => (value === 0 ? '' : `${value} cm`),
    yText: (value) => fixed(value, 1),
    shades: () => {
      const capture_m = pull().data?.capture_m;
      return capture_m
        ? [{ from: 100 * capture_m[0], to: 100 * capture_m[1], color: 'magnet-line' }]
        : [];
    },
    rules: createMemo((): Rule[] => [
      { axis: 'y', at: 1, label: 'lift-off', color: 'danger', dashed: true },
      ...upright(distance_m(), { scale: 100, label: 'bead', color: 'bead-line', dashed: false }),
    ]),
    onCursor: (index) => {
      const curve = pull().data;
      setPointed(index !== undefined && curve ? pullWords(curve, friction(), index) : undefined);
    },
  };
  const pullData = createMemo<uPlot.AlignedData>(() => {
    const curve = pull().data;
    return curve
      ? [
          curve.offset_m.map((offset_m) => 100 * offset_m),
          curve.lift_ratio,
          curve.lateral_ratio,
          heldRatio(curve, friction()),
        ]
      : [[], [], [], []];
  });

  const reachContext: CurveContext = {
    lines: [
      { label: 'outer end', color: 'magnet-line' },
      { label: 'inner end', color: 'magnet-line' },
    ],
    bands: [[0, 1]],
    xRange: () => [1000 * HEIGHTS_M[0], 1000 * HEIGHTS_M[1]],
    yRange: (max) => [0, Math.max(5, 1.1 * max)],
    // All would touch each other.
    xText: (value) => (value % 40 === 20 ? `${value} mm` : ''),
    yText: axisLabel,
    shades: () => {
      const end_m = liftOff_m();
      const [from, to] = [1000 * HEIGHTS_M[0], 1000 * (end_m ?? 0)];
      return to > from ? [{ from, to, color: 'danger' }] : [];
    },
    rules: createMemo(() => [
      ...upright(props.parameters.tool_height_m, { ...MM, label: 'now', color: 'ink' }),
      ...upright(liftOff_m(), { ...MM, label: '', color: 'danger', dashed: true }),
    ]),
    onCursor: (index) => {
      const curve = reach().data;
      setPointed(index !== undefined && curve ? reachWords(curve, index) : undefined);
    },
  };
  const reachData = createMemo<uPlot.AlignedData>(() => {
    const curve = reach().data;
    const column = (end: 0 | 1): (number | null)[] =>
      curve?.capture_m.map((capture_m) => (capture_m ? 100 * capture_m[end] : null)) ?? [];
    return [
      curve?.lower_face_height_m.map((height_m) => 1000 * height_m) ?? [],
      column(1),
      column(0),
    ];
  });

  return (
    <section class="magnet" classList={{ refused: error() !== undefined }}>
      <h3>
        <Icon of={MagnetIcon} />
        Magnet
      </h3>
      <MagnetControls lab={lab} />
      <CurvePlot
        title="Pull"
        unit="of weight"
        name={`Lift, pull and friction over the offset toward ${side()}; the bead is ${fixed(100 * (distance_m() ?? 0), 1)} cm away`}
        keys={pullContext.lines}
        context={pullContext}
        data={pullData()}
      />
      <p class="magnet-sentence" data-testid="magnet-sentence">
        <Show when={pull().data}>{(curve) => captureSentence(curve().capture_m)}</Show>
      </p>
      <CurvePlot
        title="Capture by height"
        unit="cm"
        name="Captured offsets over the height of the block's lower face"
        keys={[{ label: 'lift-off', color: 'danger' }]}
        context={reachContext}
        data={reachData()}
      />
      <div class="magnet-said">
        <div role="alert">
          <Show when={error()}>{(text) => <p class="refusal">{text()}</p>}</Show>
        </div>
        <Show when={!error()}>
          <p class="hint">{pointed() ?? hint()}</p>
        </Show>
      </div>
      <div class="magnet-side">
        <span>Curves toward</span>
        <Segmented
          label="Bead beside the block, toward"
          name="magnet-side"
          value={side()}
          segments={SIDES.map(([value, label]) => ({ value, label }))}
          onChoose={setSide}
        />
      </div>
      <MagnetFacts
        parameters={props.parameters}
        side={side()}
        pull={pull().data}
        reach={here().data}
      />
    </section>
  );
}

export function MagnetPanel(props: PanelProps<Session & Trial>): JSX.Element {
  return (
    <Show
      when={props.lab.edits.shown()}
      fallback={<p class="placeholder">Waiting for the parameters.</p>}
    >
      {(parameters) => <Magnet lab={props.lab} parameters={parameters()} />}
    </Show>
  );
}
