// All keys of the page.

import { CONTROLLER_SHORTCUTS } from '../features/controller/shortcuts';
import { DRAW_SHORTCUTS } from '../features/draw/keys';
import { TRAIN_SHORTCUTS } from '../features/train/keys';
import { TIME_SHORTCUTS } from '../features/playback/shortcuts';
import { isAtStake } from '../lab/contest';
import type { FeatureShortcuts } from '../lab/shortcuts';
import { WORKSPACE_SHORTCUTS } from '../plan/input';
import type { Shortcut } from '../ui/shortcuts';
import type { Lab } from '../lab/slices';

const OF_FEATURES: readonly FeatureShortcuts[] = [TIME_SHORTCUTS, CONTROLLER_SHORTCUTS];

export function pageShortcuts(
  lab: Lab,
  /** Whether the laboratory is visible: keys change only what is visible. */
  isShown: () => boolean,
  help: () => void,
): readonly Shortcut[] {
  const operate = (act: () => void) => () => {
    if (isShown() && lab.canOperate() && lab.state() && !isAtStake(lab)) act();
  };
  return [
    ...OF_FEATURES.flatMap((shortcuts) => shortcuts(lab, operate)),
    {
      group: 'Page',
      keys: ['g'],
      does: 'go to the workspace to set a goal',
      run: () => document.querySelector<HTMLElement>('.stage-canvas')?.focus(),
    },
    { group: 'Page', keys: ['?'], does: 'open this help', run: help },
    ...WORKSPACE_SHORTCUTS,
    ...DRAW_SHORTCUTS,
    ...TRAIN_SHORTCUTS,
  ];
}
