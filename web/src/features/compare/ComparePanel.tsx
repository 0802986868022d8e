// The comparison: one moment under several controllers with the same disturbances, and their results.

import { GitCompare, Pause, Play } from 'lucide';
import { For, Show, type JSX } from 'solid-js';
import { centimetres, clock, fixed } from '../../ui/format';
import { controllerLabel } from '../../lab/parameters';
import type { Branch, ComparisonMessage } from '../../net/protocol.gen';
import { Badge } from '../../ui/Badge';
import { Empty } from '../../ui/Empty';
import { Glyph } from '../../ui/Glyph';
import { Icon } from '../../ui/Icon';
import { type Column, Table } from '../../ui/Table';
import { isPhone } from '../../ui/windowSize';
import { PlaceNotice } from '../../lab/PlaceNotice';
import type { PanelProps } from '../../lab/panel';
import type { ByHand, Compared, Events, Notices, Session, Trial } from '../../lab/slices';
import { phaseWords } from '../../words/facts';
import { ComparePlots } from './ComparePlots';
import { CompareStart } from './CompareStart';
import { endTick, ending } from './ending';
import { GhostSlider } from './GhostSlider';
import './compare.css';

interface Shown {
  readonly comparison: ComparisonMessage;
  readonly tick_s: number;
}

function Results(props: Shown): JSX.Element {
  const time_s = (branch: Branch): number =>
    (endTick(props.comparison, branch) - props.comparison.tick) * props.tick_s;
  const columns: readonly Column<Branch>[] = [
    {
      name: 'Controller',
      isHead: true,
      cell: (branch) => (
        <span class="controller">
          <Glyph of={branch.controller} />
          {controllerLabel(branch)}
          <Show when={branch.controller === props.comparison.controller}>
            <small title="The controller in use at that moment">was in use</small>
          </Show>
        </span>
      ),
    },
    {
      name: 'Outcome',
      cell: (branch) => {
        const [word, icon, tone] = ending(props.comparison, branch);
        return (
          <Badge of={icon} tone={tone}>
            {word}
          </Badge>
        );
      },
    },
    { name: 'Time', cell: (branch) => clock(time_s(branch)) },
    { name: 'Steps', cell: ({ steps }) => steps },
  ];
  return (
    <Table
      class="compare-table"
      label="Results of each controller from this moment"
      columns={columns}
      rows={props.comparison.branches}
    />
  );
}

/** Why branches ended without a delivery: one sentence each. */
function Reasons(props: Shown): JSX.Element {
  const stopped = (): readonly Branch[] =>
    props.comparison.branches.filter((one) => one.done && one.delivered_tick === null);
  return (
    <For each={stopped()}>
      {(branch) => (
        <p class="controller">
          <Glyph of={branch.controller} />
          <span>
            {controllerLabel(branch)} {branch.phase && phaseWords(branch.phase)}.
          </span>
        </p>
      )}
    </For>
  );
}

const MEASURES: readonly (readonly [
  name: string,
  help: string,
  text: (branch: Branch) => string,
])[] = [
  [
    'Mean e',
    'Mean distance between tool and bead during transport',
    (branch) => centimetres(branch.tracking_error_mean_m),
  ],
  [
    'Largest x',
    'Largest difference in x during transport',
    (branch) => centimetres(branch.tracking_error_max_x_m),
  ],
  [
    'Largest y',
    'Largest difference in y during transport',
    (branch) => centimetres(branch.tracking_error_max_y_m),
  ],
  ['Switches', 'Between the two sub-controllers', ({ switches }) => String(switches)],
];

/** One column for each controller. */
function Measures(props: Shown): JSX.Element {
  return (
    <table class="table compare-measures" aria-label="Errors during transport">
      <thead>
        <tr>
          <th scope="col">Error during transport</th>
          <For each={props.comparison.branches}>
            {(branch) => (
              <th scope="col">
                <Glyph of={branch.controller} />
                <span class="visually-hidden">{controllerLabel(branch)}</span>
              </th>
            )}
          </For>
        </tr>
      </thead>
      <tbody>
        <For each={MEASURES}>
          {([name, help, text]) => (
            <tr>
              <th scope="row" title={help}>
                {name}
              </th>
              <For each={props.comparison.branches}>{(branch) => <td>{text(branch)}</td>}</For>
            </tr>
          )}
        </For>
      </tbody>
    </table>
  );
}

function Player(props: Shown & { lab: Compared }): JSX.Element {
  const ghosts = props.lab.comparison;
  const since_s = (): number => (ghosts.tick() - props.comparison.tick) * props.tick_s;
  return (
    <div class="compare-player">
      <button
        type="button"
        class="small icon-only"
        aria-label={ghosts.playing() ? 'Pause ghosts' : 'Play ghosts'}
        title={ghosts.playing() ? 'Pause ghosts' : 'Play ghosts'}
        onClick={() => {
          if (ghosts.playing()) ghosts.pause();
          else ghosts.play();
        }}
      >
        <Icon of={ghosts.playing() ? Pause : Play} />
      </button>
      {/* Otherwise it is on the time line. */}
      <Show when={isPhone()}>
        <GhostSlider {...props} />
      </Show>
      <span class="number">+{fixed(since_s(), 1)} s</span>
    </div>
  );
}

export default function ComparePanel(
  props: PanelProps<Session & Trial & Events & Notices & Compared & ByHand>,
): JSX.Element {
  const { lab } = props;
  const tick_s = (): number => lab.scene()?.tick_s ?? 0;
  return (
    <>
      <Show
        when={lab.comparison.shown()}
        fallback={
          <Empty icon={GitCompare} question="Who is faster from here?">
            The controllers run from one moment with the same disturbances, for up to 60 s, beside
            your session.
          </Empty>
        }
      >
        {(comparison) => (
          <>
            <p class="hint" role="status">
              From {clock(comparison().sim_time_s)} of this trial, once under each controller
              <Show when={comparison().running}>: running …</Show>
              <Show when={comparison().failed}>{(reason) => <>: failed: {reason()}</>}</Show>
            </p>
            <Results comparison={comparison()} tick_s={tick_s()} />
            <Player lab={lab} comparison={comparison()} tick_s={tick_s()} />
            <Reasons comparison={comparison()} tick_s={tick_s()} />
            <div class="compare-plots">
              <ComparePlots lab={lab} comparison={comparison()} tick_s={tick_s()} />
            </div>
            <Measures comparison={comparison()} tick_s={tick_s()} />
            <p class="hint">
              Up to the delivery, goals and disturbances come again at their times.
            </p>
          </>
        )}
      </Show>
      <PlaceNotice lab={lab} place="compare" />
      <CompareStart lab={lab} />
    </>
  );
}
