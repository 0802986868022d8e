// A form as it is filled in.

import { createSignal, type Accessor } from 'solid-js';

/** Attributes of the field that edits one part. */
interface Edits<N, V> {
  readonly name: N;
  readonly value: V;
  readonly onInput: (value: V) => void;
  readonly onChoose: (value: V) => void;
}

export interface DraftOf<D extends object> {
  readonly draft: Accessor<D>;
  readonly change: (part: Partial<D>) => void;
  readonly edits: <N extends keyof D>(name: N) => Edits<N, D[N]>;
}

export function createDraft<D extends object>(blank: D): DraftOf<D> {
  const [draft, setDraft] = createSignal(blank);
  return {
    draft,
    change: (part) => {
      setDraft((now) => ({ ...now, ...part }));
    },
    edits: (name) => {
      const put = (value: D[typeof name]): void => {
        setDraft((now) => ({ ...now, [name]: value }));
      };
      return {
        name,
        get value() {
          return draft()[name];
        },
        onInput: put,
        onChoose: put,
      };
    },
  };
}
