import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { KeptRun } from '../../net/protocol.gen';
import { clock } from '../../ui/format';

export function runWords({ map, seed, controller, sim_time_s, deliveries }: KeptRun): string {
  const done = deliveries === 0 ? 'not delivered' : `delivered ${deliveries}×`;
  const last = `last controller ${CONTROLLER_LABELS[controller]}`;
  return `${map}, seed ${seed}, ${clock(sim_time_s)}, ${done}, ${last}`;
}
