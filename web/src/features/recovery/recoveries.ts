// The recovery maps, and the cells of the one that is shown.

import { createEffect, createMemo, on, type Accessor } from 'solid-js';
import type { Catalog } from '../../lab/catalog';
import { createDetail } from '../../net/detail';
import type { RecoveryQuery, RecoveryReport, RecoverySummary } from '../../net/protocol.gen';
import { post, remove } from '../../net/requests';
import { setWanted, takeReport, wanted } from './store';

export const PATH = '/api/recoveries';

/** Starts a recovery map and shows it. */
export async function startRecovery(query: RecoveryQuery, map: string): Promise<void> {
  const { id } = await post<RecoverySummary>(PATH, JSON.stringify(query));
  setWanted({ id, on: map });
}

export const cancelRecovery = (id: string): Promise<void> => remove(`${PATH}/${id}`);

/** The one that was chosen, otherwise the newest on `map`. The store gets its cells. */
export function createShown(
  catalog: Catalog,
  map: Accessor<string | undefined>,
): Accessor<RecoverySummary | undefined> {
  const shown = createMemo(() => {
    const all = catalog.recoveries() ?? [];
    const chosen = wanted();
    const id = chosen?.on === map() ? chosen?.id : undefined;
    return all.find((one) => one.id === id) ?? all.findLast((one) => one.map === map());
  });
  // What was chosen on another map would be taken for a result on this one.
  createEffect(on(map, () => setWanted(undefined), { defer: true }));
  const detail = createDetail<RecoverySummary, RecoveryReport>(PATH, shown, (summary) =>
    [summary.id, summary.stage, summary.done].join(' '),
  );
  createEffect(() => {
    const now = detail();
    if (now) takeReport(now);
  });
  return shown;
}
