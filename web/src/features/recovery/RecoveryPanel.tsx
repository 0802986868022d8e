// The tab *Recovery*: from where the bead is still delivered after a disturbance.

import { For, Show, createMemo, type JSX } from 'solid-js';
import { labelOf } from '../../lab/parameters';
import type { PanelProps } from '../../lab/panel';
import { PlaceNotice } from '../../lab/PlaceNotice';
import type { ByHand, Notices, Session, Trial } from '../../lab/slices';
import { isActive } from '../../lab/trainingStage';
import type { RecoveryReport, RecoverySummary } from '../../net/protocol.gen';
import { clock, counted } from '../../ui/format';
import { ChoiceField } from '../../ui/fields/fields';
import { CellCard } from './CellCard';
import { basinWords, cellAt, cellWords, looksOf, rowsOf } from './cells';
import { createShown } from './recoveries';
import { RecoveryFigure } from './RecoveryFigure';
import { RecoveryStart } from './RecoveryStart';
import * as store from './store';
import './recovery.css';
import { addressOf } from '../../net/base';

function progressWords({ stage, done, planned, message }: RecoverySummary): string {
  const counts = `${done} of ${counted(planned, 'trial')}`;
  if (stage === 'waiting') return 'waiting for another job';
  if (stage === 'running') return counts;
  if (stage === 'failed') return `failed: ${message ?? ''}`;
  return stage === 'done' ? counted(done, 'trial') : `cancelled after ${counts}`;
}

const titleOf = ({ names }: RecoveryReport, indices: readonly number[]): string =>
  indices.map((index) => labelOf(names[index] ?? '')).join(' minus ');

function Arrange(props: { report: RecoveryReport }): JSX.Element {
  const pairs = (): store.Pair[] =>
    props.report.names.flatMap((_, first, names) =>
      names.slice(first + 1).map((_, after): store.Pair => [first, first + 1 + after]),
    );
  return (
    <ChoiceField<string>
      label="Show"
      value={String(store.pair() ?? '')}
      options={[
        ['', 'each controller'],
        ...pairs().map((pair) => [String(pair), titleOf(props.report, pair)] as const),
      ]}
      onChoose={(value) => store.setPair(pairs().find((pair) => String(pair) === value))}
    />
  );
}

function Legend(props: { isDifference: boolean }): JSX.Element {
  const keys = (): readonly (readonly [string, string])[] =>
    props.isDifference
      ? [
          ['first', 'first better'],
          ['second', 'second better'],
          ['equal', 'equal'],
        ]
      : [
          ['delivered', 'delivered'],
          ['late', 'mostly late'],
          ['lost', 'mostly lost'],
        ];
  return (
    <ul class="recovery-legend" aria-label="Legend">
      <For each={keys()}>
        {([kind, words]) => (
          <li>
            <span class="key" data-kind={kind} />
            {words}
          </li>
        )}
      </For>
    </ul>
  );
}

function Figures(props: { lab: Session & Trial & Notices; report: RecoveryReport }): JSX.Element {
  const { lab } = props;
  const dropped = (): number | undefined => {
    const at = store.dropped();
    return at && lab.scene()?.map === props.report.map ? cellAt(props.report, at) : undefined;
  };
  /** Each controller, or the difference of two: one index or two. */
  const drawn = createMemo((): (readonly number[])[] => {
    const pair = store.pair();
    return pair ? [pair] : props.report.names.map((_, index) => [index]);
  });
  const nameOf = ([first = 0]: readonly number[]): string => props.report.names[first] ?? '';
  const basin = (name: string) => props.report.basins.find((one) => one.controller === name);
  const fell = (name: string): string | undefined => {
    const cell = dropped();
    const row = rowsOf(props.report, name).find((one) => one.cell === cell);
    return row && `Your last drag ended here: ${cellWords(row)}.`;
  };
  return (
    <div class="recovery-figures">
      <For each={drawn()}>
        {(indices) => {
          const name = nameOf(indices);
          const isOne = indices.length === 1;
          const title = titleOf(props.report, indices);
          return (
            <figure data-controller={isOne ? name : undefined}>
              <figcaption>
                <strong>{title}</strong>{' '}
                <Show when={isOne && basin(name)}>
                  {(one) => (
                    <span class="number" title="Share delivered in time, with its 95 % interval">
                      {basinWords(one())}
                    </span>
                  )}
                </Show>
              </figcaption>
              <Show when={lab.scene()}>
                {(scene) => (
                  <RecoveryFigure
                    report={props.report}
                    name={name}
                    label={title}
                    looks={looksOf(props.report, indices)}
                    workspace={scene().workspace}
                    walls={scene().map === props.report.map ? scene().walls : []}
                    chosen={store.chosen()?.cell}
                    dropped={dropped()}
                    onChoose={(cell) => {
                      store.setChosen({ cell, name });
                    }}
                  />
                )}
              </Show>
              <Show when={isOne && fell(name)}>{(text) => <p class="hint">{text()}</p>}</Show>
            </figure>
          );
        }}
      </For>
    </div>
  );
}

/** A recovery map of another map is shown only if it is chosen here. */
function Earlier(props: {
  all: readonly RecoverySummary[];
  shown: string | undefined;
  isHere: (one: RecoverySummary) => boolean;
  onChoose: (id: string) => void;
}): JSX.Element {
  const options = (): (readonly [string, string])[] => [
    ...(props.shown === undefined ? [['', 'choose'] as const] : []),
    ...props.all.map((one) => {
      const where = props.isHere(one) ? one.map : `${one.map}, another map`;
      return [one.id, `${one.id.replace('recovery-', '')}: ${one.kind}, ${where}`] as const;
    }),
  ];
  return (
    <Show when={options().length > 1}>
      <ChoiceField<string>
        label="Recovery map"
        value={props.shown ?? ''}
        options={options()}
        onChoose={props.onChoose}
      />
    </Show>
  );
}

export default function RecoveryPanel(
  props: PanelProps<Session & Trial & Notices & ByHand>,
): JSX.Element {
  const { lab } = props;
  const map = createMemo(() => lab.scene()?.map);
  const shown = createShown(lab.catalog, map);
  const report = (): RecoveryReport | undefined =>
    store.report()?.id === shown()?.id ? store.report() : undefined;
  return (
    <div class="recovery">
      <RecoveryStart lab={lab} shown={shown()} />
      <Earlier
        all={lab.catalog.recoveries() ?? []}
        shown={shown()?.id}
        isHere={(one) => one.map === map()}
        onChoose={(id) => store.setWanted({ id, on: map() })}
      />
      <PlaceNotice lab={lab} place="recovery" />
      <Show
        when={lab.sight() === 'all'}
        fallback={<p class="hint">Hidden in fog: a recovery map shows the walls.</p>}
      >
        <Show
          when={report()}
          fallback={
            <p class="hint">
              From the shown moment, Ferry tries many disturbances under each controller, and paints
              from where the bead is still delivered. Place a goal first. The session goes on.
            </p>
          }
        >
          {(report) => (
            <>
              <div class="recovery-head">
                <span data-testid="recovery-progress" role="status">
                  {report().kind} on {report().map}
                  {report().map === map()
                    ? ''
                    : ', which is another map than that of the session,'}{' '}
                  from {clock(report().tick * (lab.scene()?.tick_s ?? 0))}:{' '}
                  {progressWords(report())}
                </span>
                <Show when={isActive(report())}>
                  <progress
                    max={Math.max(1, report().planned)}
                    value={report().done}
                    aria-label="Progress of the recovery map"
                  />
                </Show>
                <Arrange report={report()} />
                <Legend isDifference={store.pair() !== undefined} />
                <a href={addressOf(`/api/recoveries/${report().id}/map.html`)} download="">
                  HTML
                </a>
                <a href={addressOf(`/api/recoveries/${report().id}/map.csv`)} download="">
                  CSV
                </a>
              </div>
              <div class="recovery-body">
                <Figures lab={lab} report={report()} />
                <Show when={store.chosen()}>
                  {(chosen) => (
                    <CellCard
                      lab={lab}
                      report={report()}
                      chosen={chosen()}
                      label={labelOf(chosen().name)}
                    />
                  )}
                </Show>
              </div>
            </>
          )}
        </Show>
      </Show>
    </div>
  );
}
