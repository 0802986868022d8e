// What the operator has requested of a training, until the server has done it. Pure.

import { isRunning } from '../../lab/trainingStage';
import type { TrainingStage } from '../../net/protocol.gen';

export interface Wish {
  readonly words: 'pausing…' | 'resuming…' | 'cancelling…';
  /** Its stage at the request. */
  readonly from: TrainingStage;
}

/** Whether the server still has to do it: a running training stops only at the end of its present hundred updates. */
export function isOpen({ words, from }: Wish, stage: TrainingStage): boolean {
  if (stage === from) return true;
  // The last examination cannot be paused.
  if (words === 'pausing…' && stage === 'examination') return false;
  return isRunning({ stage: from }) && isRunning({ stage });
}
