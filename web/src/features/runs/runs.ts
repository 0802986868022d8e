import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { KeptRun } from '../../net/protocol.gen';
import { clock } from '../../ui/format';

export function runWords({ map, seed, controller, sim_time_s, deliveries }: KeptRun): string {
  const what = `${map}, ${CONTROLLER_LABELS[controller]}, seed ${seed}`;
  const done = deliveries === 0 ? 'not delivered' : `delivered ${deliveries}×`;
  return `${what}, ${clock(sim_time_s)}, ${done}`;
}
