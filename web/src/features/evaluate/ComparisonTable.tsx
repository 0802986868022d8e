// Two controllers at the same trials, difference by difference.

import { For, type JSX } from 'solid-js';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { Comparison, ControllerName, PairedMean } from '../../net/protocol.gen';
import { difference } from './table';

function label(controller: string): string {
  return CONTROLLER_LABELS[controller as ControllerName];
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
            <th scope="col" title="Scripted disturbances an episode">
              Dist.
            </th>
            <th scope="col" title="Episodes that both delivered, one alone, or neither">
              Delivered
              <br />
              <span class="unit">both · first · second · neither</span>
            </th>
            <th scope="col" title="Share delivered, with its 95 % interval (Newcombe, paired)">
              Delivered
              <br />
              <span class="unit">points, 95 %</span>
            </th>
            <th scope="col" title="Control steps, where both delivered (Student's t)">
              Steps
              <br />
              <span class="unit">95 %</span>
            </th>
            <th scope="col" title="Mean distance of tool and bead, where both delivered">
              Error
              <br />
              <span class="unit">cm, 95 %</span>
            </th>
            <th scope="col" title="Way over the shortest, where both delivered">
              Way
              <br />
              <span class="unit">of shortest, 95 %</span>
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
                <td>{one.map}</td>
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
