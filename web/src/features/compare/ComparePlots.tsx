// Each branch over the time since the moment: its way left to the goal, and its error.

import { Show, createMemo, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import { errors_m, lastTick } from '../../lab/comparison';
import { COMPARABLE } from '../../lab/offered';
import type { ByHand, Compared, Events, Trial } from '../../lab/slices';
import type { Branch, ComparisonMessage } from '../../net/protocol.gen';
import type { CurveContext } from '../../ui/curve';
import { CurvePlot } from '../../ui/CurvePlot';
import { axisLabel } from '../../ui/format';
import { goalAt, waysTo } from './way';

const CM = 100;

interface Props {
  readonly lab: Trial & Events & Compared & ByHand;
  readonly comparison: ComparisonMessage;
  readonly tick_s: number;
}

/** Seconds since the moment, then lengths in centimetres, one column for each controller. */
function columns(
  { branches, ticks_a_sample }: ComparisonMessage,
  tick_s: number,
  lengths_m: (branch: Branch) => readonly number[],
): uPlot.AlignedData {
  const columns = COMPARABLE.map((name) => {
    const branch = branches.find(({ controller }) => controller === name);
    return branch ? lengths_m(branch) : [];
  });
  const count = Math.max(0, ...columns.map((column) => column.length));
  const rows = Array.from({ length: count }, (_, row) => row);
  return [
    rows.map((row) => (row + 1) * ticks_a_sample * tick_s),
    ...columns.map((column) =>
      rows.map((row) => {
        const length_m = column[row] ?? Infinity;
        return Number.isFinite(length_m) ? length_m * CM : null;
      }),
    ),
  ];
}

function Curves(
  props: Props & {
    title: string;
    name: string;
    /** A dashed line, in centimetres. */
    limit_cm?: number;
    lengths_m: (branch: Branch) => readonly number[];
  },
): JSX.Element {
  const shown_s = (): number =>
    (props.lab.comparison.tick() - props.comparison.tick) * props.tick_s;
  const rules = createMemo(() => [
    ...(props.limit_cm === undefined
      ? []
      : [{ axis: 'y', at: props.limit_cm, label: 'T', color: 'danger', dashed: true } as const]),
    { axis: 'x', at: shown_s(), label: '', color: 'ink', dashed: false } as const,
  ]);
  const context: CurveContext = {
    lines: COMPARABLE.map((name) => ({ label: '', color: name })),
    xRange: () => [
      0,
      Math.max(1, (lastTick(props.comparison) - props.comparison.tick) * props.tick_s),
    ],
    yRange: (max) => [0, Math.max(1, 1.2 * (props.limit_cm ?? 0), 1.1 * max)],
    xText: (value) => `${value} s`,
    yText: axisLabel,
    rules,
  };
  return (
    <CurvePlot
      title={props.title}
      unit="cm"
      name={props.name}
      context={context}
      data={columns(props.comparison, props.tick_s, props.lengths_m)}
    />
  );
}

function Ways(props: Props): JSX.Element {
  const { lab } = props;
  const walls = createMemo(() => lab.scene()?.walls ?? []);
  const ways = new Map<string, ReturnType<typeof waysTo>>();
  /** The goals of the session come again in each branch. */
  const left_m = ({ samples }: Branch): number[] => {
    const scene = lab.scene();
    if (!scene) return [];
    return samples.map(([, , x_m, y_m], index) => {
      const tick = props.comparison.tick + (index + 1) * props.comparison.ticks_a_sample;
      const goal_m = goalAt(lab.marks(), tick, lab.goal());
      if (!goal_m) return Infinity;
      const key = [scene.trial, ...goal_m].join();
      const known = ways.get(key) ?? waysTo(goal_m, walls(), scene.workspace);
      ways.set(key, known);
      return known([x_m, y_m]);
    });
  };
  return (
    <Curves
      {...props}
      title="Way left to the goal"
      name="Way left to the goal of each controller over time since the moment"
      lengths_m={left_m}
    />
  );
}

export function ComparePlots(props: Props): JSX.Element {
  return (
    <>
      {/* In fog the page tells no walls. */}
      <Show when={props.lab.sight() === 'all'}>
        <Ways {...props} />
      </Show>
      <Curves
        {...props}
        title="Distance e, true"
        name="Distance e of each controller over time since the moment"
        limit_cm={(props.lab.scene()?.parameters.threshold_m ?? 0) * CM}
        lengths_m={errors_m}
      />
    </>
  );
}
