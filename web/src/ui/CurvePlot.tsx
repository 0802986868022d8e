// A computed curve with its title and the legend of its lines.

import { For, createEffect, on, onCleanup, onMount, untrack, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { createCurve, type CurveContext, type CurveLine, showCursor } from './curve';
import { LineKey } from './LineKey';
import { onSize } from './size';
import { palette } from './palette';
import './plot.css';

/** What the colours of lines mean. */
export function Keys(props: {
  lines: readonly Pick<CurveLine, 'label' | 'color' | 'isDashed'>[];
}): JSX.Element {
  return (
    <For each={props.lines}>
      {(line) => (
        <span class="key">
          <LineKey of={line} />
          {line.label}
        </span>
      )}
    </For>
  );
}

/** The plot alone. */
export function Curve(props: {
  name: string;
  context: CurveContext;
  data: uPlot.AlignedData;
  /** Place of the cursor while the pointer is elsewhere. */
  at?: number | undefined;
}): JSX.Element {
  let root!: HTMLDivElement;
  onMount(() => {
    const plot = createCurve(root, props.context);
    onSize(root, (size) => plot.setSize(size));
    onCleanup(() => plot.destroy());
    createEffect(() => {
      plot.batch(() => plot.setData(props.data));
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
        (at) => showCursor(plot, at),
        { defer: true },
      ),
    );
  });
  return <div ref={root} class="plot-area" role="img" aria-label={props.name} />;
}

export function CurvePlot(props: {
  title: string;
  unit: string;
  name: string;
  keys?: readonly CurveLine[];
  context: CurveContext;
  data: uPlot.AlignedData;
}): JSX.Element {
  return (
    <figure class="plot">
      <figcaption>
        <strong>{props.title}</strong>
        <span class="unit">{props.unit}</span>
        <Keys lines={props.keys ?? []} />
      </figcaption>
      <Curve name={props.name} context={props.context} data={props.data} />
    </figure>
  );
}
