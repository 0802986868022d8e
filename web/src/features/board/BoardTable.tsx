// The table of a board.

import { For, createMemo, on, type JSX } from 'solid-js';
import { Dynamic } from 'solid-js/web';
import { seconds } from '../../ui/format';
import { type Row, when } from './entries';
import { shownName } from '../../ui/name';

interface Column {
  readonly head: string;
  readonly class: string;
  readonly cell: (row: Row, now: Date) => JSX.Element;
  /** A name, which may be cut off. */
  readonly full?: (row: Row) => string;
  /** The name of the row. */
  readonly isName?: true;
  /** Whether a phone, which shows no head, puts its name before it. */
  readonly isLabelled?: true;
}

const playerOf = ({ entry }: Row): string => shownName(entry.player);
const classOf = ({ entry }: Row): string => shownName(entry.class ?? '');

const COLUMNS: readonly Column[] = [
  { head: 'Place', class: 'number board-place', cell: ({ place }) => place },
  { head: 'Player', class: 'board-player', cell: playerOf, full: playerOf, isName: true },
  { head: 'Class', class: 'board-class', cell: classOf, full: classOf },
  { head: 'Total', class: 'number board-total', cell: ({ entry }) => seconds(entry.total_s) },
  {
    head: 'Time',
    class: 'number board-time',
    cell: ({ time_s }) => seconds(time_s),
    isLabelled: true,
  },
  {
    head: 'Wall stops',
    class: 'number board-walls',
    cell: ({ entry }) => entry.score.walls,
    isLabelled: true,
  },
  {
    head: 'Lost beads',
    class: 'number board-lost',
    cell: ({ entry }) => entry.score.lost_beads,
    isLabelled: true,
  },
  {
    head: 'When',
    class: 'number board-when',
    cell: ({ entry }, now) => (
      <time dateTime={entry.at} title={new Date(entry.at).toLocaleString()}>
        {when(entry.at, now)}
      </time>
    ),
  },
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
            {(column) => (
              <th
                role="columnheader"
                scope="col"
                classList={{ number: column.class.startsWith('number') }}
              >
                {column.head}
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
                {(column) => (
                  <Dynamic
                    component={column.isName ? 'th' : 'td'}
                    role={column.isName ? 'rowheader' : 'cell'}
                    class={column.class}
                    title={column.full?.(row)}
                    data-label={column.isLabelled && column.head}
                  >
                    {column.cell(row, now())}
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
