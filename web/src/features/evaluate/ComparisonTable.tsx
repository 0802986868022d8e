// Differences between two controllers in the same trials.

import type { JSX } from 'solid-js';
import { labelOf } from '../../lab/parameters';
import type { Comparison, PairedMean } from '../../net/protocol.gen';
import { type Column, Table } from '../../ui/Table';
import { Named } from './Named';
import { signed } from './table';
import { variedWords } from './varied';
import './tables.css';

/** With its interval, both multiplied by `scale`. */
function difference(
  value: number,
  [low, high]: readonly [number, number],
  scale: number,
  digits: number,
): JSX.Element {
  const text = (one: number): string => signed(one * scale, digits);
  return (
    <>
      {text(value)}
      <small>
        {text(low)} to {text(high)}
      </small>
    </>
  );
}

const paired = (mean: PairedMean | null, scale: number, digits: number): JSX.Element =>
  mean === null ? '–' : difference(mean.mean, mean.interval95, scale, digits);

const COLUMNS: readonly Column<Comparison>[] = [
  {
    name: 'First − second',
    isHead: true,
    cell: (one) => (
      <>
        <Named of={one.controller}>{labelOf(one.controller)}</Named>
        {' − '}
        <Named of={one.against}>{labelOf(one.against)}</Named>
        <small>{[one.map, variedWords(one.varied)].filter(Boolean).join('; ')}</small>
      </>
    ),
  },
  {
    name: 'Dist.',
    title: 'Scripted disturbances per episode',
    cell: (one) => one.disturbances,
  },
  {
    name: 'Delivered',
    unit: 'both, 1st, 2nd, neither',
    title: 'Episodes in which both, only the first, only the second, or neither delivered the bead',
    cell: (one) => [one.both, one.first_only, one.second_only, one.neither].join(' · '),
  },
  {
    name: 'Delivered',
    unit: 'points, 95 %',
    title: 'Difference of the shares delivered, with its 95 % interval (Newcombe, paired)',
    cell: (one) => difference(one.delivered_difference, one.delivered_difference95, 100, 1),
  },
  {
    name: 'Steps',
    unit: '95 %',
    title: "Control steps in episodes that both delivered, with the 95 % interval (Student's t)",
    cell: (one) => paired(one.steps, 1, 1),
  },
  {
    name: 'Error',
    unit: 'cm, 95 %',
    title: 'Mean distance between tool and bead in episodes that both delivered',
    cell: (one) => paired(one.tracking_error_mean_m, 100, 2),
  },
  {
    name: 'Path ÷ shortest',
    unit: '95 %',
    title:
      "Length of the tool's path divided by the shortest path, in episodes that both delivered",
    cell: (one) => paired(one.path_ratio, 1, 3),
  },
];

export function ComparisonTable(props: { comparisons: readonly Comparison[] }): JSX.Element {
  return (
    <div class="table-frame" tabindex="0" role="region" aria-label="Paired differences">
      <Table class="data-table" columns={COLUMNS} rows={props.comparisons} testid="comparison" />
    </div>
  );
}
