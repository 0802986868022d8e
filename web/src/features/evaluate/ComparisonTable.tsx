// Differences between two controllers in the same trials.

import { For, type JSX } from 'solid-js';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { Comparison, PairedMean } from '../../net/protocol.gen';
import { difference } from './table';
import { variedWords } from './varied';
import './tables.css';

/** Programs have their own names. */
const LABELS = new Map<string, string>(Object.entries(CONTROLLER_LABELS));

function label(controller: string): string {
  return LABELS.get(controller) ?? controller;
}

function paired(mean: PairedMean | null, scale: number, digits: number): string {
  return mean === null ? '–' : difference(mean.mean, mean.interval95, scale, digits);
}

export function ComparisonTable(props: { comparisons: readonly Comparison[] }): JSX.Element {
  return (
    <div class="table-frame" tabindex="0" role="region" aria-label="Paired differences">
      <table class="results number differences">
        <thead>
          <tr>
            <th scope="col">First − second</th>
            <th scope="col">Map</th>
            <th scope="col" title="Scripted disturbances per episode">
              Dist.
            </th>
            <th
              scope="col"
              title="Episodes in which both, only the first, only the second, or neither delivered the bead"
            >
              Delivered
              <br />
              <span class="unit">both · first · second · neither</span>
            </th>
            <th
              scope="col"
              title="Difference of the shares delivered, with its 95 % interval (Newcombe, paired)"
            >
              Delivered
              <br />
              <span class="unit">points, 95 %</span>
            </th>
            <th
              scope="col"
              title="Control steps in episodes that both delivered, with the 95 % interval (Student's t)"
            >
              Steps
              <br />
              <span class="unit">95 %</span>
            </th>
            <th
              scope="col"
              title="Mean distance between tool and bead in episodes that both delivered"
            >
              Error
              <br />
              <span class="unit">cm, 95 %</span>
            </th>
            <th
              scope="col"
              title="Length of the tool's path divided by the shortest path, in episodes that both delivered"
            >
              Path ÷ shortest
              <br />
              <span class="unit">95 %</span>
            </th>
          </tr>
        </thead>
        <tbody>
          <For each={props.comparisons}>
            {(one) => (
              <tr data-testid="comparison">
                <th scope="row">
                  {label(one.controller)} − {label(one.against)}
                </th>
                <td>{[one.map, variedWords(one.varied)].filter(Boolean).join('; ')}</td>
                <td>{one.disturbances}</td>
                <td>{[one.both, one.first_only, one.second_only, one.neither].join(' · ')}</td>
                <td>{difference(one.delivered_difference, one.delivered_difference95, 100, 1)}</td>
                <td>{paired(one.steps, 1, 1)}</td>
                <td>{paired(one.tracking_error_mean_m, 100, 2)}</td>
                <td>{paired(one.path_ratio, 1, 3)}</td>
              </tr>
            )}
          </For>
        </tbody>
      </table>
    </div>
  );
}
