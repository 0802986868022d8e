// What the page says about a challenge and an attempt. Pure.

import { DIFFICULTY_LABELS, ghostName } from '../../lab/challenges';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type {
  AttemptReport,
  AttemptStanding,
  ChallengeReport,
  ControllerName,
  DifficultyName,
  GhostMessage,
  Ghosts,
  LossMessage,
} from '../../net/protocol.gen';
import { centimetres, counted, seconds } from '../../ui/format';

export const DIFFICULTY_HELP: Readonly<Record<DifficultyName, string>> = {
  easy: 'Posts. Nothing disturbs.',
  medium: 'The colon. Nothing disturbs.',
  hard: 'The colon with folds. Twice the bead is pulled away; where depends on your way.',
};

/** `easy-2026-11-26` as `Easy · 2026-11-26`. */
export function challengeTitle(name: string): string {
  const [difficulty = '', ...seed] = name.split('-');
  const label = Object.entries(DIFFICULTY_LABELS).find(([known]) => known === difficulty)?.[1];
  return `${label ?? difficulty} · ${seed.join('-')}`;
}

const SEED = /^[a-z0-9-]{1,24}$/;

/** Why a text is no seed; undefined if it is one. */
export const seedFault = (text: string): string | undefined =>
  SEED.test(text) ? undefined : 'Use 1 to 24 of a to z, 0 to 9 and -.';

/** `12.4 s + 2 wall stops × 1 s + 1 lost bead × 5 s`. */
export function sumWords(attempt: AttemptStanding, rules: ChallengeReport): string {
  const { walls, lost_beads, total_s } = attempt;
  const time_s = total_s - walls * rules.wall_s - lost_beads * rules.lost_bead_s;
  const parts = [
    `${seconds(time_s)} to deliver`,
    `${counted(walls, 'wall stop')} × ${rules.wall_s} s`,
    `${counted(lost_beads, 'lost bead')} × ${rules.lost_bead_s} s`,
  ];
  return `${parts.join(' + ')} = ${seconds(total_s)}`;
}

/** While it runs: `1 wall stop (+1 s), 0 lost beads`. */
export function penaltyWords(
  { walls, lost_beads }: AttemptStanding,
  rules: ChallengeReport | undefined,
): string {
  const part = (count: number, noun: string, each_s: number | undefined): string =>
    count === 0 || each_s === undefined
      ? counted(count, noun)
      : `${counted(count, noun)} (+${count * each_s} s)`;
  return `${part(walls, 'wall stop', rules?.wall_s)}, ${part(lost_beads, 'lost bead', rules?.lost_bead_s)}`;
}

/** `RL, ERRT and Attractor`. */
const LIST = new Intl.ListFormat('en-GB');

/** Whom the attempt has beaten, in one sentence. Equal times are a win for the ghost. */
export function verdict(
  attempt: AttemptStanding,
  report: AttemptReport | undefined,
  ghosts: Ghosts | undefined,
): string {
  if (!attempt.is_delivered) {
    const left = report ? ` The bead still had ${centimetres(report.remaining_m, 0)} to go.` : '';
    return `Time is up.${left}`;
  }
  const controllers = ghosts?.ghosts.filter(({ player }) => player === null) ?? [];
  if (controllers.length === 0) return 'Delivered.';
  const isBeaten = ({ total_s }: GhostMessage): boolean =>
    total_s === null || attempt.total_s < total_s;
  const beaten = controllers.filter(isBeaten).map(ghostName);
  const faster = controllers.filter((one) => !isBeaten(one)).map(ghostName);
  if (faster.length === 0) return `You beat ${LIST.format(beaten)}.`;
  if (beaten.length === 0)
    return `${LIST.format(faster)} ${faster.length === 1 ? 'was' : 'were'} faster.`;
  return `You beat ${LIST.format(beaten)}; ${LIST.format(faster)} ${faster.length === 1 ? 'was' : 'were'} faster.`;
}

const times = (count: number): string =>
  count === 1 ? 'once' : count === 2 ? 'twice' : `${count} times`;

/** Where the time was lost, and why. */
export function lossWords(loss: LossMessage, other: ControllerName | null, tick_s: number): string {
  const [from, to] = [loss.from_tick, loss.to_tick].map((tick) => seconds(tick * tick_s));
  const against =
    other === null ? 'than the magnet’s speed allows' : `than ${CONTROLLER_LABELS[other]} needed`;
  const causes = [
    loss.walls > 0 ? `a wall stopped the magnet ${times(loss.walls)}` : '',
    loss.lost_beads > 0 ? `the bead was lost ${times(loss.lost_beads)}` : '',
    loss.disturbances > 0 ? `the bead was pulled away ${times(loss.disturbances)}` : '',
  ].filter((cause) => cause !== '');
  const why =
    causes.length === 0
      ? 'Nothing happened to the bead: the magnet waited, or took a longer way.'
      : `In this time ${LIST.format(causes)}.`;
  return `Most time was lost from ${from ?? ''} to ${to ?? ''}: ${seconds(loss.lost_s)} more ${against} for this part of the way. ${why}`;
}
