// The table of a board.

import { For, createMemo, on, type JSX } from 'solid-js';
import { Dynamic } from 'solid-js/web';
import { seconds } from '../../ui/format';
import { type Row, when } from './entries';
import { shownName } from '../../ui/name';

/** A name, which may be cut off. */
const named = (name: string): JSX.Element => <span title={shownName(name)}>{shownName(name)}</span>;

const NAME = 'Player';
const COLUMNS: readonly (readonly [
  head: string,
  classes: string,
  cell: (row: Row, now: Date) => JSX.Element,
])[] = [
  ['Place', 'number board-place', ({ place }) => place],
  [NAME, 'board-player', ({ entry }) => named(entry.player)],
  ['Class', 'board-class', ({ entry }) => named(entry.class ?? '')],
  ['Total', 'number board-total', ({ entry }) => seconds(entry.total_s)],
  ['Time', 'number board-time', ({ time_s }) => seconds(time_s)],
  ['Wall stops', 'number board-walls', ({ entry }) => entry.score.walls],
  ['Lost beads', 'number board-lost', ({ entry }) => entry.score.lost_beads],
  [
    'When',
    'number board-when',
    ({ entry }, now) => (
      <time dateTime={entry.at} title={new Date(entry.at).toLocaleString()}>
        {when(entry.at, now)}
      </time>
    ),
  ],
];

/** The roles are explicit because a phone shows each row as a block, which would remove them. */
export function BoardTable(props: {
  name: string;
  rows: readonly Row[];
  /** Keys of the rows that are new. */
  fresh: ReadonlySet<string>;
}): JSX.Element {
  // The rows are read again every few seconds, so this also notices midnight.
  const now = createMemo(
    on(
      () => props.rows,
      () => new Date(),
    ),
  );
  return (
    <table class="board-table" role="table">
      <caption class="visually-hidden">Board of {props.name}, the best attempt first</caption>
      <thead role="rowgroup">
        <tr role="row">
          <For each={COLUMNS}>
            {([head, classes]) => (
              <th
                role="columnheader"
                scope="col"
                classList={{ number: classes.startsWith('number') }}
              >
                {head}
              </th>
            )}
          </For>
        </tr>
      </thead>
      <tbody role="rowgroup">
        <For each={props.rows}>
          {(row) => (
            <tr role="row" data-new={props.fresh.has(row.key) ? '' : undefined}>
              <For each={COLUMNS}>
                {([head, classes, cell]) => (
                  <Dynamic
                    component={head === NAME ? 'th' : 'td'}
                    role={head === NAME ? 'rowheader' : 'cell'}
                    class={classes}
                    data-label={head}
                  >
                    {cell(row, now())}
                  </Dynamic>
                )}
              </For>
            </tr>
          )}
        </For>
      </tbody>
    </table>
  );
}
