// What a new visitor can try, one tip at a time. A tip goes when it is done, and does not come back. Pure.

export const TIP_IDS = ['run', 'drag', 'goal', 'controller', 'scene'] as const;
export type TipId = (typeof TIP_IDS)[number];

/** What the page shows at one moment. */
export interface Shown {
  readonly running: boolean;
  /** The arm flies to a bead that was disturbed. */
  readonly fetching: boolean;
  readonly goal: string;
  readonly controller: string;
  /** The panel *Compare*. */
  readonly compares: boolean;
  /** The 3-D view. */
  readonly scene: boolean;
}

const DONE: Readonly<Record<TipId, (now: Shown, before: Shown) => boolean>> = {
  run: (now) => now.running,
  drag: (now) => now.fetching,
  goal: (now, before) => now.goal !== '' && now.goal !== before.goal,
  controller: (now, before) => now.controller !== before.controller || now.compares,
  scene: (now) => now.scene,
};

/** The tips that are done after a change. At the first moment `before` is `now`: what already is counts as done. */
export function doneAfter(done: ReadonlySet<TipId>, now: Shown, before: Shown): Set<TipId> {
  return new Set(TIP_IDS.filter((id) => done.has(id) || DONE[id](now, before)));
}

/** Without a goal the arm does not move: running and dragging would show nothing. */
const NEEDS_GOAL: ReadonlySet<TipId> = new Set(['run', 'drag']);
/** After a delivery there is nothing to carry, and the status asks for the next goal. */
const IS_OVER: ReadonlySet<TipId> = new Set(['run', 'drag', 'goal']);

export function nextTip(
  done: ReadonlySet<TipId>,
  hasGoal: boolean,
  isDelivered: boolean,
): TipId | undefined {
  return TIP_IDS.find(
    (id) => !done.has(id) && (hasGoal || !NEEDS_GOAL.has(id)) && !(isDelivered && IS_OVER.has(id)),
  );
}

/** Reads the stored tips; unknown names are ignored. */
export function tipsFrom(text: string | null): Set<TipId> {
  const names = (text ?? '').split(',');
  return new Set(TIP_IDS.filter((id) => names.includes(id)));
}

/** `isTouch`: a finger taps, a mouse clicks. */
export function tipText(id: TipId, hasGoal: boolean, isTouch: boolean): string {
  const click = isTouch ? 'Tap' : 'Click';
  switch (id) {
    case 'run':
      return 'Press Run, then drag the bead away.';
    case 'drag':
      return 'Drag the bead far out of the circle: the magnet loses it.';
    case 'goal':
      return `${click} a free place to set ${hasGoal ? 'another' : 'the'} goal.`;
    case 'controller':
      return 'Choose another controller, or run all three side by side.';
    case 'scene':
      return 'Choose 3-D to see the arm.';
  }
}
