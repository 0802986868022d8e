// The cells of a recovery map: a thumbnail for each controller, and one of them, or the difference of two, to choose from.

import { For, Show, type JSX } from 'solid-js';
import { labelOf } from '../../lab/parameters';
import type { Notices, Session, Trial } from '../../lab/slices';
import type { Basin, RecoveryCell, RecoveryReport } from '../../net/protocol.gen';
import { Glyph } from '../../ui/Glyph';
import { Interval } from '../../ui/Interval';
import { cellAt, cellWords, looksOf, rowsOf, squareCentimetres, titleOf } from './cells';
import { RecoveryFigure } from './RecoveryFigure';
import * as store from './store';

const percent = (share: number): string => String(Math.round(100 * share));

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
          ['late', 'late'],
          ['lost', 'not delivered'],
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

/** Chooses the controller whose cells are shown, here and on the map. */
export function Thumbnails(props: {
  lab: Trial;
  report: RecoveryReport;
  shown: string;
}): JSX.Element {
  return (
    <div class="recovery-thumbs" role="group" aria-label="Controller">
      <For each={props.report.names}>
        {(name, index) => (
          <button
            type="button"
            class="recovery-thumb"
            aria-pressed={store.pair() === undefined && props.shown === name}
            onClick={() => {
              store.setPair(undefined);
              store.setChosen({ ...store.chosen(), name });
            }}
          >
            <Show when={props.lab.scene()}>
              {(scene) => (
                <RecoveryFigure
                  report={props.report}
                  name={name}
                  label=""
                  looks={looksOf(props.report, [index()])}
                  workspace={scene().workspace}
                  walls={scene().map === props.report.map ? scene().walls : []}
                  chosen={undefined}
                  dropped={undefined}
                />
              )}
            </Show>
            <span class="recovery-name">
              <Show when={props.report.controllers[index()]}>{(one) => <Glyph of={one()} />}</Show>
              {labelOf(name)}
            </span>
            <Show when={props.report.basins.find((one) => one.controller === name)}>
              {(one) => <span class="number">{percent(one().share)} %</span>}
            </Show>
          </button>
        )}
      </For>
    </div>
  );
}

/** The share that one controller delivers in time. */
function Share(props: { name: string; basin: Basin }): JSX.Element {
  const [low, high] = props.basin.share95.map(percent);
  return (
    <>
      <h3 class="recovery-share" title="Share delivered in time, with its 95 % interval">
        <span>
          {labelOf(props.name)} still delivers in {percent(props.basin.share)} %
        </span>
        <span class="number">
          {low} to {high}
        </span>
      </h3>
      <Interval share={props.basin.share} interval={props.basin.share95} />
    </>
  );
}

/** The cells of one controller, or the difference of two. */
export function Cells(props: {
  lab: Session & Trial & Notices;
  report: RecoveryReport;
  indices: readonly number[];
}): JSX.Element {
  const { lab } = props;
  const name = (): string => props.report.names[props.indices[0] ?? 0] ?? '';
  const title = (): string => titleOf(props.report, props.indices);
  const basin = (): Basin | undefined =>
    props.indices.length === 1
      ? props.report.basins.find((one) => one.controller === name())
      : undefined;
  const dropped = (): number | undefined => {
    const at = store.dropped();
    return at && lab.scene()?.map === props.report.map ? cellAt(props.report, at) : undefined;
  };
  const fell = (): RecoveryCell | undefined =>
    props.indices.length === 1
      ? rowsOf(props.report, name()).find((one) => one.cell === dropped())
      : undefined;
  return (
    <div class="recovery-shown">
      <Show when={basin()} fallback={<h3>{title()}</h3>} keyed>
        {(one) => <Share name={name()} basin={one} />}
      </Show>
      <Show when={lab.scene()}>
        {(scene) => (
          <RecoveryFigure
            report={props.report}
            name={name()}
            label={title()}
            looks={looksOf(props.report, props.indices)}
            workspace={scene().workspace}
            walls={scene().map === props.report.map ? scene().walls : []}
            chosen={store.chosen()?.cell}
            dropped={dropped()}
            onChoose={(cell) => {
              store.setChosen({ cell, name: name() });
            }}
          />
        )}
      </Show>
      <Legend isDifference={props.indices.length > 1} />
      <Show when={fell()}>
        {(cell) => <p class="hint">Your last drag ended here: {cellWords(cell())}.</p>}
      </Show>
      <p class="hint">
        {/* It is the share of the tried places, taken for the whole map: only right when all are tried. */}
        <Show when={props.report.stage === 'done' && basin()?.area_m2}>
          {(area_m2) => <>{squareCentimetres(area_m2())} around the goal. </>}
        </Show>
        A cell shows what happened most often. Press one to see its trials and why they failed.
      </p>
    </div>
  );
}
