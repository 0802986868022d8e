// The curves of the shown training, and of the one beside it.

import { For, Show, createMemo, createSignal, type JSX } from 'solid-js';
import type { CurveContext, CurveLine } from '../../ui/curve';
import { CurvePlot } from '../../ui/CurvePlot';
import { fixed } from '../../ui/format';
import type { Palette } from '../../ui/palette';
import type { Theme } from '../../ui/theme';
import type { TrainingPoint } from '../../net/protocol.gen';
import { columnsOf, type Kind, KINDS, rangeAround, readWords, updateText } from './curves';

/** One training of the plots. */
export interface Curve {
  readonly name: string;
  readonly points: readonly TrainingPoint[];
  /** Updates at its end. */
  readonly total: number;
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
  const lines = props.curves.flatMap((curve, training) => linesOf(kind, curve, training));
  const context: CurveContext = {
    palette: () => props.palette(),
    lines,
    bands: props.curves.map((_, training) => [3 * training, 3 * training + 1]),
    xRange: () => [0, Math.max(...props.curves.map(({ total }) => total))],
    yRange: (max, min) => (kind.range ? [...kind.range] : rangeAround(max, min)),
    xText: updateText,
    yText: (value) => fixed(value, kind.range ? 0 : 2),
    shades: () => [],
    rules: () => [],
    onCursor: setPointed,
  };
  const names = (): string[] => props.curves.map(({ name }) => name);
  const last = (): string => readWords(kind, names(), data(), data()[0].length - 1);
  const words = (): string => {
    const index = pointed();
    return index === undefined ? kind.help : readWords(kind, names(), data(), index);
  };
  return (
    <div class="train-curve">
      <CurvePlot
        title={kind.title}
        unit={kind.unit}
        name={`${kind.title}, ${kind.unit}, over the updates. ${data()[0].length === 0 ? 'No points yet.' : last()}`}
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
