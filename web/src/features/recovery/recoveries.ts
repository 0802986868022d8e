// The recovery maps, and the cells of the one that is shown.

import { createEffect, createMemo, on, type Accessor } from 'solid-js';
import { createDetail } from '../../net/detail';
import { post, remove } from '../../net/requests';
import type { RecoveryQuery, RecoveryReport, RecoverySummary } from '../../net/protocol.gen';
import type { Catalog } from '../../lab/catalog';
import { store } from './store';

export const PATH = '/api/recoveries';

export const isActive = ({ stage }: Pick<RecoverySummary, 'stage'>): boolean =>
  stage === 'waiting' || stage === 'running';

export interface RecoveryList {
  /** In the order of the requests. */
  readonly all: Accessor<readonly RecoverySummary[]>;
  /** The one that is shown. */
  readonly shown: Accessor<RecoverySummary | undefined>;
  start(query: RecoveryQuery): Promise<void>;
  cancel(id: string): Promise<void>;
}

/** The recovery maps; the store gets the cells of the one that is shown: the one that was chosen, otherwise the newest on `map`. */
export function createRecoveryList(
  catalog: Catalog,
  map: Accessor<string | undefined>,
): RecoveryList {
  const all = createMemo(() => catalog.recoveries() ?? []);
  const shown = createMemo(
    () =>
      all().find(({ id }) => id === store.wanted()) ?? all().findLast((one) => one.map === map()),
  );
  // What was chosen on another map would be taken for a result on this one.
  createEffect(on(map, () => store.setWanted(undefined), { defer: true }));
  const detail = createDetail<RecoverySummary, RecoveryReport>(PATH, shown, (summary) =>
    [summary.id, summary.stage, summary.done].join(' '),
  );
  createEffect(() => {
    const now = detail();
    if (now) store.setReport(now);
  });
  return {
    all,
    shown,
    start: async (query) => {
      const { id } = await post<RecoverySummary>(PATH, JSON.stringify(query));
      store.setWanted(id);
      store.setChosen(undefined);
      store.setArrangement('each');
    },
    cancel: (id) => remove(`${PATH}/${id}`),
  };
}
