// A computed curve with its title and the legend of its lines.

import { For, Show, createEffect, on, onCleanup, onMount, untrack, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { createCurve, type CurveContext, type CurveLine, showCursor } from './curve';
import { onSize } from './size';
import { palette } from './palette';
import './plot.css';

/** What the colours of lines mean. */
export function Keys(props: {
  lines: readonly Pick<CurveLine, 'label' | 'color' | 'isDashed'>[];
  values?: readonly string[] | undefined;
}): JSX.Element {
  return (
    <For each={props.lines}>
      {(line, index) => (
        <span class="key" data-color={line.color} data-dashed={line.isDashed ? '' : undefined}>
          {line.label}{' '}
          <Show when={props.values}>
            {(values) => <span class="number">{values()[index()]}</span>}
          </Show>
        </span>
      )}
    </For>
  );
}

export function CurvePlot(props: {
  /** Of a part in a figure. */
  letter?: string;
  title: string;
  unit: string;
  name: string;
  keys?: readonly CurveLine[];
  /** Beside the keys. */
  values?: readonly string[];
  context: CurveContext;
  data: uPlot.AlignedData;
  /** Place of the cursor while the pointer is elsewhere. */
  at?: number | undefined;
}): JSX.Element {
  let root!: HTMLDivElement;
  onMount(() => {
    const plot = createCurve(root, props.context);
    onSize(root, (size) => {
      plot.setSize(size);
    });
    onCleanup(() => {
      plot.destroy();
    });
    createEffect(() => {
      plot.batch(() => {
        plot.setData(props.data);
      });
      // The scale may have changed. Under the pointer, uPlot keeps the cursor.
      const at = untrack(() => props.at);
      if (at !== undefined) showCursor(plot, at);
    });
    createEffect(on(palette, () => plot.redraw(true), { defer: true }));
    // The curve itself does not change.
    createEffect(
      on(
        () => props.context.rules?.(),
        () => plot.redraw(false),
        { defer: true },
      ),
    );
    createEffect(
      on(
        () => props.at,
        (at) => {
          showCursor(plot, at);
        },
        { defer: true },
      ),
    );
  });
  return (
    <figure class="plot" data-part={props.letter}>
      <figcaption>
        <Show when={props.letter}>{(letter) => <span class="letter">{letter()}</span>}</Show>
        <strong>{props.title}</strong>
        <span class="unit">{props.unit}</span>
        <Keys lines={props.keys ?? []} values={props.values} />
      </figcaption>
      <div ref={root} class="plot-area" role="img" aria-label={props.name} />
    </figure>
  );
}
