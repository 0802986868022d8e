// A computed curve with its title and the legend of its lines.

import { For, createEffect, on, onCleanup, onMount, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { createCurve, type CurveContext, type CurveLine } from './curve';
import './plot.css';

/** What the colours of lines mean. */
export function Keys(props: {
  lines: readonly Pick<CurveLine, 'label' | 'color' | 'isDashed'>[];
}): JSX.Element {
  return (
    <For each={props.lines}>
      {(line) => (
        <span class="key" data-color={line.color} data-dashed={line.isDashed ? '' : undefined}>
          {line.label}
        </span>
      )}
    </For>
  );
}

export function CurvePlot(props: {
  title: string;
  unit: string;
  name: string;
  keys?: readonly CurveLine[];
  context: CurveContext;
  data: uPlot.AlignedData;
}): JSX.Element {
  let root!: HTMLDivElement;
  onMount(() => {
    const plot = createCurve(root, props.context);
    const observer = new ResizeObserver(() => {
      plot.setSize({ width: root.clientWidth, height: root.clientHeight });
    });
    observer.observe(root);
    onCleanup(() => {
      observer.disconnect();
      plot.destroy();
    });
    createEffect(() => {
      plot.setData(props.data);
    });
    createEffect(on(props.context.palette, () => plot.redraw(true), { defer: true }));
    // The curve itself does not change.
    createEffect(
      on(
        () => props.context.rules?.(),
        () => plot.redraw(false),
        { defer: true },
      ),
    );
  });
  return (
    <figure class="plot">
      <figcaption>
        <strong>{props.title}</strong>
        <span class="unit">{props.unit}</span>
        <Keys lines={props.keys ?? []} />
      </figcaption>
      <div ref={root} class="plot-area" role="img" aria-label={props.name} />
    </figure>
  );
}
