// The lists of the server, as its newest messages have them, and the points of the training that is watched.

import { createEffect, createMemo, createSignal, onCleanup, type Accessor } from 'solid-js';
import type { CatalogMessage, ServerMessage, TrainingPoint } from '../net/protocol.gen';
import type { Model } from './model';

type Name = CatalogMessage['list'];
type Items<N extends Name> = Extract<CatalogMessage, { list: N }>['items'];

/** Each list; undefined before its first message. */
type Lists = { readonly [N in Name]: Accessor<Items<N> | undefined> };

export interface Catalog extends Lists {
  /** References of the policies that are not shipped. */
  readonly addedPolicies: Accessor<readonly string[]>;
  /** Asks for the points of a training until the owner is disposed of. One training is watched at a time. */
  watch(training: Accessor<string | undefined>): Accessor<readonly TrainingPoint[]>;
}

const NONE: readonly TrainingPoint[] = [];

type ListMessage = Extract<ServerMessage, { type: 'catalog' | 'training_points' }>;

/** `watch` asks the server. */
export function createCatalog(
  connection: Accessor<Model['connection']>,
  watch: (training: string | null) => void,
): { readonly catalog: Catalog; take(message: ListMessage): void } {
  const [lists, setLists] = createSignal<{ readonly [N in Name]?: Items<N> }>({});
  const [watched, setWatched] = createSignal({ training: '', points: NONE });
  const list = <N extends Name>(name: N): Lists[N] => createMemo(() => lists()[name]) as Lists[N];
  return {
    catalog: {
      maps: list('maps'),
      policies: list('policies'),
      trainings: list('trainings'),
      evaluations: list('evaluations'),
      recoveries: list('recoveries'),
      programs: list('programs'),
      challenges: list('challenges'),
      jobs: list('jobs'),
      paces: list('paces'),
      addedPolicies: createMemo(() =>
        (lists().policies ?? []).filter((one) => !one.is_shipped).map((one) => one.reference),
      ),
      watch: (training) => {
        createEffect(() => {
          if (connection().kind === 'live') watch(training() ?? null);
        });
        onCleanup(() => watch(null));
        return () => (watched().training === training() ? watched().points : NONE);
      },
    },
    take: (message) => {
      if (message.type === 'catalog') setLists({ ...lists(), [message.list]: message.items });
      else {
        const { training, first, points } = message;
        setWatched({ training, points: [...watched().points.slice(0, first), ...points] });
      }
    },
  };
}
