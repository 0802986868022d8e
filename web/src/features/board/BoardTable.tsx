// The table of a board.

import { For, createMemo, on, type JSX } from 'solid-js';
import { seconds } from '../../ui/format';
import { type Row, when } from './entries';
import { shownName } from '../../ui/name';

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
          <th role="columnheader" scope="col" class="number">
            Place
          </th>
          <th role="columnheader" scope="col">
            Player
          </th>
          <th role="columnheader" scope="col">
            Class
          </th>
          <th role="columnheader" scope="col" class="number">
            Total
          </th>
          <th role="columnheader" scope="col" class="number">
            Time
          </th>
          <th role="columnheader" scope="col" class="number">
            Wall stops
          </th>
          <th role="columnheader" scope="col" class="number">
            Lost beads
          </th>
          <th role="columnheader" scope="col" class="number">
            When
          </th>
        </tr>
      </thead>
      <tbody role="rowgroup">
        <For each={props.rows}>
          {({ key, place, entry, time_s }) => (
            <tr role="row" data-new={props.fresh.has(key) ? '' : undefined}>
              <td role="cell" class="number board-place">
                {place}
              </td>
              <th role="rowheader" scope="row" class="board-player" title={shownName(entry.player)}>
                {shownName(entry.player)}
              </th>
              <td role="cell" class="board-class" title={shownName(entry.class ?? '')}>
                {shownName(entry.class ?? '')}
              </td>
              <td role="cell" class="number board-total">
                {seconds(entry.total_s)}
              </td>
              <td role="cell" class="number board-time" data-label="Time">
                {seconds(time_s)}
              </td>
              <td role="cell" class="number board-walls" data-label="Wall stops">
                {entry.score.walls}
              </td>
              <td role="cell" class="number board-lost" data-label="Lost beads">
                {entry.score.lost_beads}
              </td>
              <td role="cell" class="number board-when">
                <time dateTime={entry.at} title={new Date(entry.at).toLocaleString()}>
                  {when(entry.at, now())}
                </time>
              </td>
            </tr>
          )}
        </For>
      </tbody>
    </table>
  );
}
