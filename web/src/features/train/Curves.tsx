// The curves of the shown training, and of the one beside it.

import { For, Show, type JSX } from 'solid-js';
import type { TrainingPoint } from '../../net/protocol.gen';
import { Keys } from '../../ui/CurvePlot';
import { SeriesPlot } from '../../ui/SeriesPlot';
import { alongUpdates, firstWords, type Kind, KINDS } from './curves';

/** One training of the plots. */
export interface Curve {
  readonly name: string;
  readonly points: readonly TrainingPoint[];
  /** Updates at its end. */
  readonly total: number;
  /** Whether no point follows. */
  readonly isOver: boolean;
}

const STYLES = [
  { color: 'rl', isDashed: false },
  { color: 'ink', isDashed: true },
] as const;

export function Curves(props: {
  /** One or two. Their number does not change. */
  curves: readonly Curve[];
}): JSX.Element {
  const lines = () =>
    STYLES.slice(0, props.curves.length).map((style, index) => ({
      ...style,
      label: props.curves[index]?.name ?? '',
    }));
  const total = (): number => Math.max(...props.curves.map((curve) => curve.total));
  const isOver = (): boolean => props.curves.every((curve) => curve.isOver);
  const isExamined = (): boolean =>
    props.curves.some(({ points }) => points.some(({ examined }) => examined !== null));
  const help = ({ id, help }: Kind): string =>
    id === 'examination' && !isExamined() ? firstWords(total(), isOver()) : help;
  return (
    <>
      <Show when={props.curves.length > 1}>
        <p class="train-keys">
          <Keys lines={lines()} />
        </p>
      </Show>
      <div class="train-curves">
        <For each={KINDS}>
          {(kind) => (
            <SeriesPlot
              class="train-curve"
              measure={kind}
              lines={lines()}
              points={props.curves.map(({ points }) =>
                points.map((point) => [point.update, kind.values(point)]),
              )}
              along={alongUpdates(total)}
              help={help(kind)}
            />
          )}
        </For>
      </div>
    </>
  );
}
