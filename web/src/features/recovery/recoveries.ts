// The server's recovery maps, polled: often while one runs.

import { createEffect, createMemo, on, type Accessor } from 'solid-js';
import { createDetail } from '../../net/detail';
import { createPoll } from '../../net/poll';
import { post, remove } from '../../net/requests';
import type {
  Recoveries,
  RecoveryQuery,
  RecoveryReport,
  RecoverySummary,
} from '../../net/protocol.gen';
import { store } from './store';

const BUSY_MS = 500;
/** Another operator may start one. */
const IDLE_MS = 3000;

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
export function createRecoveryList(map: Accessor<string | undefined>): RecoveryList {
  const poll = createPoll<Recoveries>(PATH, (newest) =>
    newest?.recoveries.some(isActive) ? BUSY_MS : IDLE_MS,
  );
  const all = createMemo(() => poll.data()?.recoveries ?? []);
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
      await poll.refresh();
    },
    cancel: async (id) => {
      await remove(`${PATH}/${id}`);
      await poll.refresh();
    },
  };
}
