// The comparison: one moment under several controllers with the same disturbances, and their results.

import { Show, createMemo, type JSX } from 'solid-js';
import type uPlot from 'uplot';
import { axisLabel, centimetres, clock, fixed } from '../../ui/format';
import { errors_m, lastTick } from '../../lab/comparison';
import { COMPARABLE } from '../../lab/offered';
import { controllerLabel } from '../../lab/parameters';
import type { Branch, ComparisonMessage, ControllerName } from '../../net/protocol.gen';
import type { CurveContext, CurveLine } from '../../ui/curve';
import { CurvePlot } from '../../ui/CurvePlot';
import { SmallButton } from '../../ui/SmallButton';
import { type Column, Table } from '../../ui/Table';
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
  const columns: readonly Column<Branch>[] = [
    {
      name: 'Controller',
      isHead: true,
      cell: (branch) => (
        <span class="swatch" data-controller={branch.controller}>
          {controllerLabel(branch)}
          <Show when={branch.controller === props.comparison.controller}>
            <span class="tag" title="The controller in use at that moment">
              was in use
            </span>
          </Show>
        </span>
      ),
    },
    {
      name: 'Outcome',
      cell: (branch) => {
        const words = outcome(props.comparison, branch, props.tick_s);
        return <span title={words}>{words}</span>;
      },
    },
    {
      name: 'mean e',
      title: 'Mean distance between tool and bead during transport',
      cell: (branch) => centimetres(branch.tracking_error_mean_m),
    },
    {
      name: 'max x',
      title: 'Largest difference in x during transport',
      cell: (branch) => centimetres(branch.tracking_error_max_x_m),
    },
    {
      name: 'max y',
      title: 'Largest difference in y during transport',
      cell: (branch) => centimetres(branch.tracking_error_max_y_m),
    },
    { name: 'switches', cell: ({ switches }) => switches },
    { name: 'steps', cell: ({ steps }) => steps },
  ];
  return (
    <Table
      class="compare-table number"
      label="Results of each controller from this moment"
      columns={columns}
      rows={props.comparison.branches}
    />
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
      <SmallButton
        onClick={() => {
          if (ghosts.playing()) ghosts.pause();
          else ghosts.play();
        }}
      >
        {ghosts.playing() ? 'Pause ghosts' : 'Play ghosts'}
      </SmallButton>
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
      <SmallButton
        onClick={() => {
          ghosts.hide();
        }}
      >
        Clear ghosts
      </SmallButton>
    </div>
  );
}

/** Seconds since the moment, then errors in centimetres, one column per controller. */
function columns(
  { branches, ticks_a_sample }: ComparisonMessage,
  tick_s: number,
): uPlot.AlignedData {
  const errors = COMPARABLE.map((name) => {
    const branch = branches.find(({ controller }) => controller === name);
    return branch ? errors_m(branch).map((error_m) => error_m * CM) : [];
  });
  const count = Math.max(0, ...errors.map((column) => column.length));
  const rows = Array.from({ length: count }, (_, row) => row);
  return [
    rows.map((row) => (row + 1) * ticks_a_sample * tick_s),
    ...errors.map((column) => rows.map((row) => column[row] ?? null)),
  ];
}

function Errors(
  props: Omit<PanelProps<Trial & Compared>, 'tools'> & {
    comparison: ComparisonMessage;
    tick_s: number;
  },
): JSX.Element {
  const { lab } = props;
  const threshold_cm = (): number => (lab.scene()?.parameters.threshold_m ?? 0) * CM;
  const shown_s = (): number => (lab.comparison.tick() - props.comparison.tick) * props.tick_s;
  const rules = createMemo(() => [
    { axis: 'y', at: threshold_cm(), label: 'T', color: 'danger', dashed: true } as const,
    { axis: 'x', at: shown_s(), label: '', color: 'ink-3', dashed: false } as const,
  ]);
  const branchOf = (name: ControllerName): Branch | undefined =>
    props.comparison.branches.find(({ controller }) => controller === name);
  /** One for each column. */
  const lines = COMPARABLE.map((name) => ({ label: '', color: name }));
  /** The program's name comes with its branch. */
  const keys = (): CurveLine[] =>
    COMPARABLE.flatMap((name) => {
      const branch = branchOf(name) ?? { controller: name, program: null };
      return name === 'program' && branch.program === null
        ? []
        : [{ label: controllerLabel(branch), color: name }];
    });
  const context: CurveContext = {
    lines,
    xRange: () => [
      0,
      Math.max(1, (lastTick(props.comparison) - props.comparison.tick) * props.tick_s),
    ],
    yRange: (max) => [0, Math.max(1.2 * threshold_cm(), 1.1 * max)],
    xText: (value) => `${value} s`,
    yText: axisLabel,
    rules,
  };
  return (
    <CurvePlot
      title="Error norm"
      unit="cm"
      name="Error norm of each controller over time since the moment"
      keys={keys()}
      context={context}
      data={columns(props.comparison, props.tick_s)}
    />
  );
}

export default function ComparePanel(
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
        {(comparison) => <Errors lab={lab} comparison={comparison()} tick_s={tick_s()} />}
      </Show>
    </div>
  );
}
