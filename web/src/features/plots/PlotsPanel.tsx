// The paper's figure, live: positions and tracking errors over time, and the path in the plane.

import { For, createEffect, createSignal, on, onCleanup, type JSX } from 'solid-js';
import { download, pngOf } from '../../ui/download';
import { LocusPlot } from './LocusPlot';
import { TimePlot } from './TimePlot';
import { createFigure, type Figure } from './figure';
import { FIGURE_PX, figureSvg } from './figureSvg';
import { LOCUS_LETTER, PARTS } from './parts';
import { Rotation } from './rotation';
import { csvOf, type Sample, type WindowChoice, WINDOWS } from './sample';
import { clock } from '../../ui/format';
import type { PanelProps } from '../../lab/panel';
import { shownWalls } from '../../lab/sight';
import type { ByHand, Events, Notices, Trial } from '../../lab/slices';
import { SmallButton } from '../../ui/SmallButton';
import { palette } from '../../ui/palette';
import './plots.css';

const FILES = ['CSV', 'PNG', 'SVG'] as const;

/** Time window and files, in the tab bar. */
function Tools(props: { lab: Trial & Notices & ByHand; figure: Figure }): JSX.Element {
  const { lab, figure } = props;
  const save = async (kind: (typeof FILES)[number]): Promise<void> => {
    const [sample, scene, state] = [figure.take(), lab.scene(), lab.state()];
    if (!sample || !scene || !state) return;
    const put = (content: BlobPart, type: string): void => {
      const name = `ferry-${scene.map}-seed${scene.seed}-tick${state.tick}`;
      download(`${name}.${kind.toLowerCase()}`, new Blob([content], { type }));
    };
    if (kind === 'CSV') {
      put(csvOf(lab.history, sample), 'text/csv');
      return;
    }
    const svg = figureSvg({
      title: `Ferry: map ${scene.map}, ${state.controller}, seed ${scene.seed}, ${clock(sample.from_s)} to ${clock(sample.to_s)}`,
      palette: palette(),
      sample,
      threshold_m: scene.parameters.threshold_m,
      workspace: scene.workspace,
      walls: shownWalls(lab),
      goal_m: lab.goal(),
    });
    if (kind === 'SVG') {
      put(svg, 'image/svg+xml');
      return;
    }
    try {
      put(await pngOf(svg, FIGURE_PX), 'image/png');
    } catch {
      lab.notify('playback', 'This browser could not draw the figure as a PNG.');
    }
  };
  return (
    <div class="plot-tools" role="group" aria-label="Plots">
      <label>
        <span class="unit">Time window</span>
        <select
          aria-label="Time window of the plots"
          onChange={(event) => {
            figure.choose(event.currentTarget.value as WindowChoice);
          }}
        >
          <For each={WINDOWS}>
            {([id, label]) => (
              <option value={id} selected={figure.choice() === id}>
                {label}
              </option>
            )}
          </For>
        </select>
      </label>
      <span class="unit">Save</span>
      <For each={FILES}>
        {(kind) => (
          <SmallButton aria-label={`Save ${kind}`} onClick={() => void save(kind)}>
            {kind}
          </SmallButton>
        )}
      </For>
    </div>
  );
}

export default function PlotsPanel(
  props: PanelProps<Trial & Events & Notices & ByHand>,
): JSX.Element {
  const { lab } = props;
  const figure = createFigure(lab);
  let sample: Sample | undefined;
  const samples = [...PARTS, LOCUS_LETTER].map(() => createSignal<Sample>());
  const rotation = new Rotation(
    samples.length,
    () => {
      sample = figure.take();
    },
    (part) => samples[part]?.[1](sample),
    (work) => requestAnimationFrame(work),
  );
  createEffect(
    on([lab.state, lab.marks, figure.choice], () => {
      rotation.offer();
    }),
  );
  onCleanup(() => {
    rotation.stop();
  });
  return (
    <>
      <Tools lab={lab} figure={figure} />
      <div class="plots">
        <For each={PARTS}>
          {(part, index) => (
            <TimePlot
              part={part}
              figure={figure}
              sample={samples[index()]?.[0]()}
              threshold_m={lab.scene()?.parameters.threshold_m}
            />
          )}
        </For>
        <LocusPlot lab={lab} figure={figure} sample={samples.at(-1)?.[0]()} />
      </div>
    </>
  );
}
