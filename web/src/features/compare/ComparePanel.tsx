// The comparison: one moment under several controllers with the same disturbances, and their results.

import { For, Show, createMemo, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import { axisLabel, centimetres, clock, fixed } from '../../ui/format';
import { errors_m, lastTick } from '../../lab/comparison';
import { COMPARABLE } from '../../lab/offered';
import { createPalette } from '../../ui/palette';
import { controllerLabel } from '../../lab/parameters';
import type { Branch, ComparisonMessage } from '../../net/protocol.gen';
import type { CurveContext } from '../../ui/curve';
import { CurvePlot } from '../../ui/CurvePlot';
import { PlaceNotice } from '../../lab/PlaceNotice';
import type { PanelProps } from '../../lab/panel';
import type { Compared, Events, Notices, Session, Trial } from '../../lab/slices';
import { phaseWords } from '../../words/facts';
import { CompareStart } from './CompareStart';
import './compare.css';

const CM = 100;

function outcome(comparison: ComparisonMessage, branch: Branch, tick_s: number): string {
  if (branch.delivered_tick !== null) {
    return `delivered, ${clock((branch.delivered_tick - comparison.tick) * tick_s)}`;
  }
  if (!branch.done) return comparison.running ? 'running' : 'stopped early';
  return branch.phase ? phaseWords(branch.phase) : 'stopped early';
}

function Results(props: { comparison: ComparisonMessage; tick_s: number }): JSX.Element {
  return (
    <table class="compare-table">
      <caption class="visually-hidden">Results of each controller from this moment</caption>
      <thead>
        <tr>
          <th scope="col">Controller</th>
          <th scope="col">Outcome</th>
          <th scope="col" title="Mean distance between tool and bead during transport">
            mean e
          </th>
          <th scope="col" title="Largest difference in x during transport">
            max x
          </th>
          <th scope="col" title="Largest difference in y during transport">
            max y
          </th>
          <th scope="col">switches</th>
          <th scope="col">steps</th>
        </tr>
      </thead>
      <tbody>
        <For each={props.comparison.branches}>
          {(branch) => (
            <tr>
              <th scope="row" class="swatch" data-controller={branch.controller}>
                {controllerLabel(branch)}
                <Show when={branch.controller === props.comparison.controller}>
                  <span class="tag" title="The controller in use at that moment">
                    was in use
                  </span>
                </Show>
              </th>
              <td title={outcome(props.comparison, branch, props.tick_s)}>
                {outcome(props.comparison, branch, props.tick_s)}
              </td>
              <td class="number">{centimetres(branch.tracking_error_mean_m)}</td>
              <td class="number">{centimetres(branch.tracking_error_max_x_m)}</td>
              <td class="number">{centimetres(branch.tracking_error_max_y_m)}</td>
              <td class="number">{branch.switches}</td>
              <td class="number">{branch.steps}</td>
            </tr>
          )}
        </For>
      </tbody>
    </table>
  );
}

function Player(props: {
  lab: Compared;
  comparison: ComparisonMessage;
  tick_s: number;
}): JSX.Element {
  const ghosts = props.lab.comparison;
  const since_s = (): number => (ghosts.tick() - props.comparison.tick) * props.tick_s;
  return (
    <div class="compare-player">
      <button
        type="button"
        class="small"
        onClick={() => {
          if (ghosts.playing()) ghosts.pause();
          else ghosts.play();
        }}
      >
        {ghosts.playing() ? 'Pause ghosts' : 'Play ghosts'}
      </button>
      <input
        type="range"
        aria-label="Time of the ghosts"
        aria-valuetext={`${fixed(since_s(), 1)} seconds after the moment`}
        min={props.comparison.tick}
        max={lastTick(props.comparison)}
        step={props.comparison.ticks_a_sample}
        value={ghosts.tick()}
        onInput={(event) => {
          ghosts.look(event.currentTarget.valueAsNumber);
        }}
      />
      <span class="number compare-time">+{fixed(since_s(), 1)} s</span>
      <button
        type="button"
        class="small"
        onClick={() => {
          ghosts.hide();
        }}
      >
        Clear ghosts
      </button>
    </div>
  );
}

/** Seconds since the moment, then errors in centimetres, one column per controller. */
function columns(comparison: ComparisonMessage, tick_s: number): uPlot.AlignedData {
  const errors = COMPARABLE.map((name) => {
    const branch = comparison.branches.find(({ controller }) => controller === name);
    return branch ? errors_m(branch) : [];
  });
  const count = Math.max(0, ...errors.map((column) => column.length));
  const rows = Array.from({ length: count }, (_, row) => row);
  const sample_s = comparison.ticks_a_sample * tick_s;
  return [
    rows.map((row) => (row + 1) * sample_s),
    ...errors.map((column) =>
      rows.map((row) => {
        const error_m = column[row];
        return error_m === undefined ? null : error_m * CM;
      }),
    ),
  ];
}

function Errors(
  props: Omit<PanelProps<Trial & Compared>, 'tools'> & {
    comparison: ComparisonMessage;
    tick_s: number;
  },
): JSX.Element {
  const { lab } = props;
  const palette = createPalette(() => props.theme());
  const threshold_cm = (): number => (lab.scene()?.parameters.threshold_m ?? 0) * CM;
  const shown_s = (): number => (lab.comparison.tick() - props.comparison.tick) * props.tick_s;
  const rules = createMemo(() => [
    { axis: 'y', at: threshold_cm(), label: 'T', color: 'danger', dashed: true } as const,
    { axis: 'x', at: shown_s(), label: '', color: 'muted', dashed: false } as const,
  ]);
  /** One for each column; the program's name comes with its branch. */
  const lines = COMPARABLE.map((name) => ({
    label: controllerLabel({ controller: name, program: null }),
    color: name,
  }));
  const keys = (): typeof lines => {
    const own = props.comparison.branches.find(({ controller }) => controller === 'program');
    return lines
      .filter(({ color }) => color !== 'program' || own !== undefined)
      .map((one) =>
        one.color === 'program' && own ? { ...one, label: controllerLabel(own) } : one,
      );
  };
  const context: CurveContext = {
    palette,
    lines,
    xRange: () => [
      0,
      Math.max(1, (lastTick(props.comparison) - props.comparison.tick) * props.tick_s),
    ],
    yRange: (max) => [0, Math.max(1.2 * threshold_cm(), 1.1 * max)],
    xText: (value) => `${value} s`,
    yText: axisLabel,
    rules,
    onCursor: () => undefined,
  };
  return (
    <CurvePlot
      title="Error norm"
      unit="cm"
      name="Error norm of each controller over time since the moment"
      keys={keys()}
      theme={props.theme}
      context={context}
      data={columns(props.comparison, props.tick_s)}
    />
  );
}

export function ComparePanel(
  props: PanelProps<Session & Trial & Events & Notices & Compared>,
): JSX.Element {
  const { lab } = props;
  const tick_s = (): number => lab.scene()?.tick_s ?? 0;
  return (
    <div class="compare">
      <div class="compare-main">
        <CompareStart lab={lab} />
        <PlaceNotice lab={lab} place="compare" />
        <Show
          when={lab.comparison.shown()}
          fallback={
            <p class="hint">
              Shows how the controllers differ: continues from the shown moment under each of them,
              for up to 60 s, with the same disturbances. Pause or rewind to just before a
              disturbance, then compare. The session itself does not change.
            </p>
          }
        >
          {(comparison) => (
            <>
              <div class="compare-scroll" tabindex="0" role="group" aria-label="Results">
                <Results comparison={comparison()} tick_s={tick_s()} />
                <p class="hint">
                  Errors during transport. Goals and disturbances come again at their times.
                </p>
              </div>
              <Player lab={lab} comparison={comparison()} tick_s={tick_s()} />
            </>
          )}
        </Show>
      </div>
      <Show when={lab.comparison.shown()}>
        {(comparison) => (
          <Errors lab={lab} theme={props.theme} comparison={comparison()} tick_s={tick_s()} />
        )}
      </Show>
    </div>
  );
}
