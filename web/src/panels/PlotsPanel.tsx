// The paper's figure, live: positions and tracking errors of the last minute.

import { For, createEffect, createMemo, createSignal, on, onCleanup, onMount } from 'solid-js';
import type { JSX } from 'solid-js';
import type uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { fixed } from '../format';
import type { Lab } from '../lab';
import { Limiter } from '../limiter';
import { createPalette } from '../palette';
import type { Theme } from '../theme';
import { createPlot, type PlotContext, type PlotSpec } from './plot';

const WINDOW_S = 60;
/** A young trial is not squeezed into the first pixels of a minute. */
const LEAST_WINDOW_S = 10;
/** The eye does not follow numbers faster than this, and four plots cost something. */
const REDRAWS_PER_S = 10;

const POSITION = { unit: 'm', scale: 1, digits: 2, grain: 0.05, threshold: false };
const ERROR = { unit: 'cm', scale: 100, digits: 0, grain: 2 };

const SPECS: readonly PlotSpec[] = [
  {
    ...POSITION,
    title: 'x',
    lines: [
      { column: 'tool_x_m', label: 'tool', color: 'tool' },
      { column: 'bead_x_m', label: 'bead', color: 'bead' },
    ],
  },
  {
    ...POSITION,
    title: 'y',
    lines: [
      { column: 'tool_y_m', label: 'tool', color: 'tool' },
      { column: 'bead_y_m', label: 'bead', color: 'bead' },
    ],
  },
  {
    ...ERROR,
    title: 'Tracking error',
    threshold: false,
    lines: [
      { column: 'error_x_m', label: 'x', color: 'error-x' },
      { column: 'error_y_m', label: 'y', color: 'error-y' },
    ],
  },
  {
    ...ERROR,
    title: 'Error norm',
    threshold: true,
    lines: [{ column: 'error_m', label: 'e', color: 'text' }],
  },
];

interface PlotProps {
  readonly lab: Lab;
  readonly spec: PlotSpec;
  readonly context: PlotContext;
  readonly theme: () => Theme;
}

function Plot(props: PlotProps): JSX.Element {
  const { lab, spec } = props;
  let root!: HTMLDivElement;
  let plot: uPlot | undefined;
  const [latest, setLatest] = createSignal<readonly (number | undefined)[]>([]);
  let pointed: number | undefined;

  const read = (): void => {
    if (!plot) return;
    const data = plot.data;
    const index = pointed ?? data[0].length - 1;
    setLatest(spec.lines.map((_line, line) => data[line + 1]?.[index] ?? undefined));
  };
  const redraw = new Limiter<number>(1000 / REDRAWS_PER_S, (now_s) => {
    if (!plot) return;
    const from_s = Math.max(0, now_s - WINDOW_S);
    const [times, ...columns] = lab.history.window(from_s, now_s, [
      'sim_time_s',
      ...spec.lines.map((line) => line.column),
    ]);
    if (!times) return;
    const scaled = columns.map((column) => column.map((value) => value * spec.scale));
    // The times are copied because the history moves under a plot that may draw later.
    const data = [times.slice(), ...scaled] as unknown as uPlot.AlignedData;
    plot.batch(() => {
      plot?.setData(data, false);
      plot?.setScale('x', { min: from_s, max: Math.max(from_s + LEAST_WINDOW_S, now_s) });
    });
    read();
  });

  onMount(() => {
    plot = createPlot(root, spec, props.context, (index) => {
      pointed = index;
      read();
    });
    const observer = new ResizeObserver(() => {
      plot?.setSize({ width: root.clientWidth, height: root.clientHeight });
    });
    observer.observe(root);
    onCleanup(() => {
      observer.disconnect();
      plot?.destroy();
    });
    createEffect(() => {
      const state = lab.state();
      if (state) redraw.offer(state.sim_time_s);
    });
    createEffect(
      on([props.theme, props.context.threshold_m], () => plot?.redraw(true), { defer: true }),
    );
  });

  return (
    <figure class="plot">
      <figcaption>
        <strong>{spec.title}</strong>
        <span class="unit">{spec.unit}</span>
        <For each={spec.lines}>
          {(line, index) => (
            <span class="key" data-color={line.color}>
              {line.label}{' '}
              <span class="number">
                {latest()[index()] === undefined
                  ? '–'
                  : fixed(latest()[index()] ?? 0, spec.digits + 1)}
              </span>
            </span>
          )}
        </For>
      </figcaption>
      <div ref={root} class="plot-area" role="img" aria-label={`${spec.title} against time`} />
    </figure>
  );
}

export function PlotsPanel(props: { lab: Lab; theme: () => Theme }): JSX.Element {
  const { lab } = props;
  const palette = createPalette(() => props.theme());
  const context: PlotContext = {
    palette,
    disturbances: createMemo(() =>
      lab
        .marks()
        .filter((mark) => mark.kind === 'disturbance')
        .map((mark) => mark.sim_time_s),
    ),
    threshold_m: () => lab.scene()?.parameters.threshold_m,
  };
  return (
    <div class="plots">
      <For each={SPECS}>
        {(spec) => <Plot lab={lab} spec={spec} context={context} theme={props.theme} />}
      </For>
    </div>
  );
}
