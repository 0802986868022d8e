// How and when a branch ended. Pure.

import { Check, Clock, Ellipsis, type IconNode, X } from 'lucide';
import type { Branch, ComparisonMessage } from '../../net/protocol.gen';

export type Ending = readonly [word: string, icon: IconNode, tone: 'good' | 'bad' | 'plain'];

export function ending(comparison: ComparisonMessage, branch: Branch): Ending {
  if (branch.delivered_tick !== null) return ['delivered', Check, 'good'];
  if (!branch.done) return [comparison.running ? 'running' : 'stopped early', Ellipsis, 'plain'];
  if (branch.phase?.code === 'lifted_off') return ['lifted off', X, 'bad'];
  const { phase } = branch;
  if (phase?.code !== 'stopped') return ['not in time', Clock, 'plain'];
  return [phase.by.endsWith('_steps') ? 'out of steps' : 'stopped', X, 'bad'];
}

/** Tick of its delivery, otherwise of its last sample. */
export const endTick = (
  { tick, ticks_a_sample }: ComparisonMessage,
  { delivered_tick, samples }: Branch,
): number => delivered_tick ?? tick + samples.length * ticks_a_sample;
