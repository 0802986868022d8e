// The recovery map that the page shows, and how. Outside of the components: the tab and the map's layer show the same.

import { batch, createSignal } from 'solid-js';
import type { Vec2 } from '../../lab/geometry';
import { RECOVERY_DEFAULTS } from '../../net/forms.gen';
import type { ControllerName, RecoveryKind, RecoveryReport } from '../../net/protocol.gen';
import { createDraft } from '../../ui/fields/draft';

interface Draft extends Record<keyof typeof RECOVERY_DEFAULTS, string> {
  readonly kind: RecoveryKind;
  readonly left_out: readonly ControllerName[];
}

/** Numbers are as typed. The first map is a quick one; that of the server's defaults takes about seven times as long. */
export const { draft, change, edits } = createDraft<Draft>({
  kind: 'place',
  left_out: [],
  grid: '16',
  repeats: '1',
  within_s: String(RECOVERY_DEFAULTS.within_s),
  seed: String(RECOVERY_DEFAULTS.seed),
});

/** Two controllers, by their index. */
export type Pair = readonly [first: number, second: number];

/** The controller whose cells are shown, and the cell whose trials are listed. */
export interface Chosen {
  readonly cell?: number;
  readonly name: string;
}

/** The recovery map that the user has chosen, while the session was on this map; otherwise the newest is shown. */
export const [wanted, setWanted] = createSignal<{ id: string; on: string | undefined }>();

export const [report, setReport] = createSignal<RecoveryReport>();

/** The first one minus the second one; undefined: each controller beside the others. */
export const [pair, setPair] = createSignal<Pair>();

export const [chosen, setChosen] = createSignal<Chosen>();

/** The index of the controller whose cells are shown, or of the two whose difference is. */
export function shownOf({ names }: RecoveryReport): readonly [number, ...number[]] {
  return pair() ?? [Math.max(0, names.indexOf(chosen()?.name ?? ''))];
}

/** Where the hand has released the bead last. */
export const [dropped, setDropped] = createSignal<Vec2>();

/** A cell or a pair that was chosen belongs to its report. */
export function takeReport(next: RecoveryReport): void {
  batch(() => {
    if (next.id !== report()?.id) {
      setChosen(undefined);
      setPair(undefined);
    }
    setReport(next);
  });
}
