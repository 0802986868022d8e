// A form as it is filled in.

import { createSignal } from 'solid-js';

export function createDraft<D extends object>(blank: D) {
  const [draft, setDraft] = createSignal(blank);
  return {
    draft,
    change: (part: Partial<D>): void => {
      setDraft((now) => ({ ...now, ...part }));
    },
    /** Attributes of the field that edits one part. */
    edits: <N extends keyof D & string>(name: N) => {
      const put = (value: D[N]): void => {
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
