// State of a feature that outlives its view: a change of view removes the components.

import { createRoot } from 'solid-js';

/** Created when it is asked for first, once for each laboratory. */
export function perLab<L extends object, S>(create: (lab: L) => S): (lab: L) => S {
  const made = new WeakMap<L, { readonly state: S }>();
  return (lab) => {
    const known = made.get(lab) ?? { state: createRoot(() => create(lab)) };
    made.set(lab, known);
    return known.state;
  };
}
