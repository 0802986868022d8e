// A table whose columns are written once, for their heads and their cells.

import { For, Show, type JSX } from 'solid-js';
import './Table.css';
import './dataTable.css';

export interface Column<R> {
  readonly name: string;
  readonly hideName?: true;
  readonly unit?: string;
  readonly title?: string;
  /** Whether its cells name the rows. */
  readonly isHead?: true;
  readonly cell: (row: R) => JSX.Element;
}

export function Heads(props: { columns: readonly Omit<Column<never>, 'cell'>[] }): JSX.Element {
  return (
    <For each={props.columns}>
      {({ name, hideName, unit, title }) => (
        <th scope="col" title={title}>
          <span classList={{ 'visually-hidden': hideName }}>{name}</span>
          <Show when={unit}>
            <br />
            <span class="unit">{unit}</span>
          </Show>
        </th>
      )}
    </For>
  );
}

export function Cells<R>(props: { columns: readonly Column<R>[]; row: R }): JSX.Element {
  return (
    <For each={props.columns}>
      {({ name, hideName, unit, isHead, cell }) =>
        isHead ? (
          <th scope="row">{cell(props.row)}</th>
        ) : (
          <td data-label={hideName ? undefined : [name, unit].filter(Boolean).join(', ')}>
            {cell(props.row)}
          </td>
        )
      }
    </For>
  );
}

export function Table<R>(props: {
  class: string;
  /** For those who cannot see what is around it. */
  label?: string;
  columns: readonly Column<R>[];
  rows: readonly R[];
  /** Of each row. */
  testid?: string;
}): JSX.Element {
  return (
    <table class={`table ${props.class}`} aria-label={props.label}>
      <thead>
        <tr>
          <Heads columns={props.columns} />
        </tr>
      </thead>
      <tbody>
        <For each={props.rows}>
          {(row) => (
            <tr data-testid={props.testid}>
              <Cells columns={props.columns} row={row} />
            </tr>
          )}
        </For>
      </tbody>
    </table>
  );
}
