// The curves of the shown training, and of the one beside it.

import { For, Show, createMemo, createSignal, type JSX } from 'solid-js';
import type { CurveContext, CurveLine } from '../../ui/curve';
import { CurvePlot } from '../../ui/CurvePlot';
import { fixed } from '../../ui/format';
import type { Palette } from '../../ui/palette';
import type { Theme } from '../../ui/theme';
import type { TrainingPoint } from '../../net/protocol.gen';
import {
  columnsOf,
  firstWords,
  type Kind,
  KINDS,
  rangeAround,
  ROOM,
  readWords,
  updateSplits,
  updateText,
} from './curves';

/** One training of the plots. */
export interface Curve {
  readonly name: string;
  readonly points: readonly TrainingPoint[];
  /** Updates at its end. */
  readonly total: number;
  /** Whether no point follows. */
  readonly isOver: boolean;
}

type Style = Required<Pick<CurveLine, 'color' | 'isDashed'>>;

const styleOf = (training: number): Style =>
  training === 0 ? { color: 'tool', isDashed: false } : { color: 'bead', isDashed: true };

interface CurvesProps {
  /** One or two. Their number does not change. */
  readonly curves: readonly Curve[];
  readonly palette: () => Palette;
  readonly theme: () => Theme;
}

function linesOf(kind: Kind, { name }: Curve, training: number): CurveLine[] {
  const { color, isDashed } = styleOf(training);
  const edge = { label: '', color, isEdge: true, joinsGaps: true };
  const hasPoints = kind.isSparse === true;
  return [edge, edge, { label: name, color, isDashed, joinsGaps: true, hasPoints }];
}

function Plot(props: CurvesProps & { kind: Kind }): JSX.Element {
  const { kind } = props;
  const [pointed, setPointed] = createSignal<number>();
  const data = createMemo(() =>
    columnsOf(
      kind,
      props.curves.map(({ points }) => points),
    ),
  );
  const total = (): number => Math.max(...props.curves.map((curve) => curve.total));
  const lines = props.curves.flatMap((curve, training) => linesOf(kind, curve, training));
  const edges = props.curves.map((_, training) => [3 * training, 3 * training + 1] as const);
  const context: CurveContext = {
    palette: () => props.palette(),
    lines,
    bands: edges,
    // A band needs two points.
    ...(kind.isSparse && { bars: edges }),
    xRange: () => [0, ROOM * total()],
    xSplits: (most) => updateSplits(total(), most),
    yRange: (max, min) => (kind.range ? [...kind.range] : rangeAround(max, min)),
    xText: updateText,
    yText: (value) => fixed(value, kind.range ? 0 : 2),
    rules: () => [],
    onCursor: setPointed,
  };
  const names = (): string[] => props.curves.map(({ name }) => name);
  const read = (index: number): string | undefined => readWords(kind, names(), data(), index);
  const last = createMemo(() => {
    const indices = data()[0].map((_, index) => index);
    return indices.reverse().map(read).find(Boolean);
  });
  const words = (): string => {
    if (kind.isSparse && last() === undefined) {
      const isOver = props.curves.every((curve) => curve.isOver);
      return firstWords(total(), isOver);
    }
    const index = pointed();
    return (index === undefined ? undefined : read(index)) ?? kind.help;
  };
  return (
    <div class="train-curve">
      <CurvePlot
        title={kind.title}
        unit={kind.unit}
        name={`${kind.title}, ${kind.unit}, over the updates. ${last() ?? 'No points yet.'}`}
        theme={props.theme}
        keys={[]}
        context={context}
        data={data()}
      />
      <p class="rule">{words()}</p>
    </div>
  );
}

export function Curves(props: CurvesProps): JSX.Element {
  return (
    <>
      <Show when={props.curves.length > 1}>
        <p class="train-keys">
          <For each={props.curves}>
            {(curve, training) => (
              <span
                class="key"
                data-color={styleOf(training()).color}
                data-dashed={styleOf(training()).isDashed ? '' : undefined}
              >
                {curve.name}
              </span>
            )}
          </For>
        </p>
      </Show>
      <div class="train-curves">
        <For each={KINDS}>{(kind) => <Plot {...props} kind={kind} />}</For>
      </div>
    </>
  );
}
