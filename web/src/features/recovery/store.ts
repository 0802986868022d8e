// The recovery map that the page shows, and how. Outside of the components: the tab and the map's layer show the same.

import { createRoot, createSignal } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import { RECOVERY_DEFAULTS } from '../../net/forms.gen';
import type { ControllerName, RecoveryKind, RecoveryReport } from '../../net/protocol.gen';

export interface Draft {
  readonly kind: RecoveryKind;
  readonly left_out: readonly ControllerName[];
  /** As typed. */
  readonly grid: string;
  readonly repeats: string;
  readonly within_s: string;
  readonly seed: string;
}

/** Each controller beside the others, or the first minus the second of two, by their index. */
export type Arrangement = 'each' | readonly [first: number, second: number];

/** A cell, and the controller whose trials are listed. */
export interface Chosen {
  readonly cell: number;
  readonly name: string;
}

function createStore() {
  const [draft, setDraft] = createSignal<Draft>({
    kind: 'place',
    left_out: [],
    grid: String(RECOVERY_DEFAULTS.grid),
    repeats: String(RECOVERY_DEFAULTS.repeats),
    within_s: String(RECOVERY_DEFAULTS.within_s),
    seed: String(RECOVERY_DEFAULTS.seed),
  });
  const [wanted, setWanted] = createSignal<string>();
  const [report, setReport] = createSignal<RecoveryReport>();
  const [arrangement, setArrangement] = createSignal<Arrangement>('each');
  const [chosen, setChosen] = createSignal<Chosen>();
  const [front, setFront] = createSignal<string>();
  const [dropped, setDropped] = createSignal<Vec2>();
  return {
    draft,
    setDraft,
    /** Id of the recovery map that was asked for; otherwise the newest is shown. */
    wanted,
    setWanted,
    report,
    setReport,
    arrangement,
    setArrangement,
    chosen,
    setChosen,
    /** The controller on the plan; otherwise the first one. */
    front,
    setFront,
    /** Where the hand has released the bead last. */
    dropped,
    setDropped,
  };
}

export const store = createRoot(createStore);
