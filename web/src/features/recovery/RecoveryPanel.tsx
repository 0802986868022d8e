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

/** Every pair of controllers, as an index list. */
function pairsOf(names: readonly string[]): (readonly [number, number])[] {
  return names.flatMap((_, first) =>
    names.slice(first + 1).map((_, after) => [first, first + 1 + after] as const),
  );
}

function Arrange(props: { report: RecoveryReport }): JSX.Element {
  const options = createMemo(() => {
    const names = props.report.names.map(labelOf);
    const pairs = pairsOf(names).map((pair): [store.Arrangement, string] => [
      pair,
      `${names[pair[0]] ?? ''} minus ${names[pair[1]] ?? ''}`,
    ]);
    return [['each', 'each controller'] as [store.Arrangement, string], ...pairs];
  });
  return (
    <ChoiceField<string>
      label="Show"
      value={String(store.arrangement())}
      options={options().map(([one, words]) => [String(one), words] as const)}
      onChoose={(value) => {
        const found = options().find(([one]) => String(one) === value);
        if (found) store.setArrangement(found[0]);
      }}
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
  const drawn = createMemo(() => {
    const arrangement = store.arrangement();
    if (arrangement === 'each') {
      return props.report.names.map((name, index) => ({ name, pair: [index] as number[] }));
    }
    const [first, second] = arrangement;
    return [{ name: props.report.names[first] ?? '', pair: [first, second] }];
  });
  const basin = (name: string) => props.report.basins.find((one) => one.controller === name);
  const title = (pair: readonly number[]): string =>
    pair.map((index) => labelOf(props.report.names[index] ?? '')).join(' minus ');
  const fell = (name: string): string | undefined => {
    const cell = dropped();
    const row = rowsOf(props.report, name).find((one) => one.cell === cell);
    return row && `Your last drag ended here: ${cellWords(row)}.`;
  };
  return (
    <div class="recovery-figures">
      <For each={drawn()}>
        {({ name, pair }) => (
          <figure data-controller={pair.length === 1 ? name : undefined}>
            <figcaption>
              <strong>{title(pair)}</strong>{' '}
              <Show when={pair.length === 1 && basin(name)}>
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
                  label={title(pair)}
                  looks={looksOf(props.report, pair)}
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
            <Show when={pair.length === 1 && fell(name)}>
              {(text) => <p class="hint">{text()}</p>}
            </Show>
          </figure>
        )}
      </For>
    </div>
  );
}

/** A recovery map of another map is shown only if it is chosen here. */
function Earlier(props: {
  all: readonly RecoverySummary[];
  shown: string | undefined;
  isHere: (one: RecoverySummary) => boolean;
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
        onChoose={store.showRecovery}
      />
    </Show>
  );
}

export function RecoveryPanel(props: PanelProps<Session & Trial & Notices & ByHand>): JSX.Element {
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
                <Legend isDifference={store.arrangement() !== 'each'} />
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
