// The paper's figure, live: positions and tracking errors over time, and the path in the plane.

import { For, createEffect, on, onCleanup, type JSX } from 'solid-js';
import { Portal } from 'solid-js/web';
import { download, pngOf } from '../../ui/download';
import { LocusPlot } from './LocusPlot';
import { TimePlot } from './TimePlot';
import { createFigure, type Figure } from './figure';
import { FIGURE_PX, figureSvg } from './figureSvg';
import { PARTS } from './parts';
import { Rotation } from './rotation';
import { csvOf, type WindowChoice, WINDOWS } from './sample';
import type { PlotContext } from './timePlot';
import { clock } from '../../ui/format';
import { createPalette, type Palette } from '../../ui/palette';
import type { PanelProps, TabPanel } from '../../lab/panel';
import { shownWalls } from '../../lab/sight';
import type { ByHand, Events, Notices, Trial } from '../../lab/slices';
import './plots.css';

/** Time window and files, in the tab bar. */
function Tools(props: {
  lab: Trial & Notices & ByHand;
  figure: Figure;
  palette: () => Palette;
}): JSX.Element {
  const { lab, figure } = props;
  /** File name, or undefined while there is no data to save. */
  const name = (): string | undefined => {
    const scene = lab.scene();
    const state = lab.state();
    return scene && state && `ferry-${scene.map}-seed${scene.seed}-tick${state.tick}`;
  };
  const svg = (): string | undefined => {
    figure.renew();
    const sample = figure.sample();
    const scene = lab.scene();
    const state = lab.state();
    if (!sample || !scene || !state) return undefined;
    const { goal_m } = state;
    return figureSvg({
      title: `Ferry: map ${scene.map}, ${state.controller}, seed ${scene.seed}, ${clock(sample.from_s)} to ${clock(sample.to_s)}`,
      palette: props.palette(),
      sample,
      threshold_m: scene.parameters.threshold_m,
      workspace: scene.workspace,
      walls: shownWalls(lab),
      goal_m: goal_m ? [goal_m[0], goal_m[1]] : undefined,
    });
  };
  const saveCsv = (): void => {
    figure.renew();
    const sample = figure.sample();
    const file = name();
    if (!sample || file === undefined) return;
    download(`${file}.csv`, new Blob([csvOf(lab.history, sample)], { type: 'text/csv' }));
  };
  const saveSvg = (): void => {
    const drawing = svg();
    if (drawing === undefined) return;
    download(`${name() ?? 'ferry'}.svg`, new Blob([drawing], { type: 'image/svg+xml' }));
  };
  const savePng = async (): Promise<void> => {
    const drawing = svg();
    const file = name();
    if (drawing === undefined || file === undefined) return;
    try {
      download(`${file}.png`, await pngOf(drawing, FIGURE_PX));
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
      <button type="button" class="small" aria-label="Save CSV" onClick={saveCsv}>
        CSV
      </button>
      <button type="button" class="small" aria-label="Save PNG" onClick={() => void savePng()}>
        PNG
      </button>
      <button type="button" class="small" aria-label="Save SVG" onClick={saveSvg}>
        SVG
      </button>
    </div>
  );
}

function PlotsPanel(props: PanelProps<Trial & Events & Notices & ByHand>): JSX.Element {
  const { lab } = props;
  const palette = createPalette(() => props.theme());
  const figure = createFigure(lab);
  const context: PlotContext = {
    palette,
    sample: figure.sample,
    threshold_m: () => lab.scene()?.parameters.threshold_m,
  };
  const draws: (() => void)[] = [];
  const rotation = new Rotation(
    PARTS.length + 1,
    () => {
      figure.renew();
    },
    (part) => draws[part]?.(),
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
      <Portal mount={props.tools}>
        <Tools lab={lab} figure={figure} palette={palette} />
      </Portal>
      <div class="plots">
        <For each={PARTS}>
          {(part, index) => (
            <TimePlot
              part={part}
              figure={figure}
              context={context}
              theme={props.theme}
              onDraw={(draw) => {
                draws[index()] = draw;
              }}
            />
          )}
        </For>
        <LocusPlot
          lab={lab}
          figure={figure}
          palette={palette}
          onDraw={(draw) => {
            draws[PARTS.length] = draw;
          }}
        />
      </div>
    </>
  );
}

export const PLOTS_TAB: TabPanel = { id: 'plots', title: 'Plots', panel: PlotsPanel };
