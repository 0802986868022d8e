// One part of the figure over time, with its caption.

import { For, createEffect, createSignal, on, onCleanup, onMount, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { clock, fixed } from '../../ui/format';
import type { Theme } from '../../ui/theme';
import type { Figure } from './figure';
import type { Part } from './parts';
import { nearestIndex } from './sample';
import { createTimePlot, type PlotContext, showCursor, showSample } from './timePlot';
import '../../ui/plot.css';

interface TimePlotProps {
  readonly part: Part;
  readonly figure: Figure;
  readonly context: PlotContext;
  readonly theme: () => Theme;
  /** Registers the function that draws the part. */
  readonly onDraw: (draw: () => void) => void;
}

export function TimePlot(props: TimePlotProps): JSX.Element {
  const { part, figure } = props;
  let root!: HTMLDivElement;
  let plot: uPlot | undefined;
  let isPointed = false;
  const [values, setValues] = createSignal<readonly (number | undefined)[]>([]);
  const [read_s, setRead] = createSignal<number>();

  /** The values at the cursor, otherwise at the present time. */
  const read = (): void => {
    const sample = figure.sample();
    if (!sample) return;
    const times = sample.columns.sim_time_s;
    const index = nearestIndex(times, figure.pointed_s() ?? sample.at_s);
    setRead(index === undefined ? undefined : times[index]);
    setValues(
      part.lines.map(({ column }) =>
        index === undefined ? undefined : (sample.columns[column][index] ?? 0) * part.scale,
      ),
    );
  };
  const words = (): string => {
    const at_s = read_s();
    const lines = part.lines.map(({ label }, index) => {
      const value = values()[index];
      return value === undefined ? '' : `${label} ${fixed(value, part.digits + 1)} ${part.unit}`;
    });
    return at_s === undefined
      ? `${part.title} over time: no data yet`
      : `${part.title} over time, at ${clock(at_s)}: ${lines.join(', ')}`;
  };

  onMount(() => {
    const made = createTimePlot(root, part, props.context, (time_s) => {
      isPointed = time_s !== undefined;
      figure.point(time_s);
    });
    plot = made;
    const observer = new ResizeObserver(() => {
      made.setSize({ width: root.clientWidth, height: root.clientHeight });
    });
    observer.observe(root);
    onCleanup(() => {
      observer.disconnect();
      made.destroy();
    });
    props.onDraw(() => {
      const sample = figure.sample();
      if (!sample) return;
      showSample(made, part, sample);
      // The window moved under a pointer that did not move.
      if (isPointed) figure.point(made.posToVal(made.cursor.left ?? 0, 'x'));
      else showCursor(made, figure.pointed_s());
      read();
    });
    createEffect(
      on([props.theme, props.context.threshold_m], () => plot?.redraw(true), { defer: true }),
    );
    createEffect(
      on(
        figure.pointed_s,
        (time_s) => {
          if (!isPointed) showCursor(made, time_s);
          read();
        },
        { defer: true },
      ),
    );
  });

  return (
    <figure class="plot" data-part={part.letter}>
      <figcaption>
        <span class="letter">{part.letter}</span>
        <strong>{part.title}</strong>
        <span class="unit">{part.unit}</span>
        <For each={part.lines}>
          {(line, index) => (
            <span class="key" data-color={line.color}>
              <span class="key-label">{line.label}</span>{' '}
              <span class="number">
                {values()[index()] === undefined
                  ? '–'
                  : fixed(values()[index()] ?? 0, part.digits + 1)}
              </span>
            </span>
          )}
        </For>
      </figcaption>
      <div ref={root} class="plot-area" role="img" aria-label={words()} />
    </figure>
  );
}
