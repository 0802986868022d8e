// What the page of a board shows: addresses, names, rows. Pure.

import type { BoardEntry, ChallengeReport, ChallengeSummary, Period } from '../../net/protocol.gen';
import { DIFFICULTY_LABELS, PERIOD_LABELS } from '../../lab/challenges';
import { seconds } from '../../ui/format';
import { shownName } from '../../ui/name';
import { addressOf } from '../../net/base';

/** What the address chooses. */
export interface Chosen {
  /** Name of a challenge; undefined for the easy one of today. */
  readonly challenge: string | undefined;
  /** Name of a class; undefined for all. */
  readonly ofClass: string | undefined;
}

export function chosenIn(search: string): Chosen {
  const query = new URLSearchParams(search);
  const text = (name: string): string | undefined => {
    const value = query.get(name)?.trim();
    return value === '' ? undefined : value;
  };
  return { challenge: text('challenge'), ofClass: text('class') };
}

export function boardAddress({ challenge, ofClass }: Chosen): string {
  const query = new URLSearchParams();
  if (challenge !== undefined) query.set('challenge', challenge);
  if (ofClass !== undefined) query.set('class', ofClass);
  const text = query.toString();
  return addressOf(text === '' ? '/board' : `/board?${text}`);
}

export function easyOfToday(all: readonly ChallengeSummary[]): string | undefined {
  return all.find(({ difficulty, period }) => difficulty === 'easy' && period === 'day')?.name;
}

const inSentence = (period: Period): string => PERIOD_LABELS[period].toLowerCase();

/** `Easy today`; the name of a challenge that is not offered. */
export function shortTitle({ name, difficulty, period }: ChallengeSummary): string {
  return period === null ? name : `${DIFFICULTY_LABELS[difficulty]} ${inSentence(period)}`;
}

/** `Easy challenge of today`, `Challenge hard-2026-w47`. */
export function longTitle(name: string, summary: ChallengeSummary | undefined): string {
  if (!summary?.period) return `Challenge ${name}`;
  return `${DIFFICULTY_LABELS[summary.difficulty]} challenge of ${inSentence(summary.period)}`;
}

export function pageTitle(name: string | undefined, ofClass: string | undefined): string {
  const words = ['Board', name, ofClass === undefined ? undefined : `class ${shownName(ofClass)}`];
  return `${words.filter((word) => word !== undefined).join(' · ')} – Ferry`;
}

/** The classes on a board and the chosen one, in the order of their numbers and letters. */
export function classesOf(
  board: readonly BoardEntry[],
  chosen: string | undefined,
): readonly string[] {
  const all = new Set(board.flatMap((entry) => entry.class ?? []));
  if (chosen !== undefined) all.add(chosen);
  return [...all].sort((a, b) => a.localeCompare(b, 'en', { numeric: true }));
}

/** A better attempt of the same player has another key. */
export function keyOf({ player, class: ofClass, at }: BoardEntry): string {
  return JSON.stringify([player, ofClass, at]);
}

export interface Row {
  readonly key: string;
  /** Among the rows that are shown, from 1. */
  readonly place: number;
  readonly entry: BoardEntry;
  /** Seconds until the delivery, without the penalties. */
  readonly time_s: number;
}

type Rules = Pick<ChallengeReport, 'board' | 'wall_s' | 'lost_bead_s'>;

/** The rows of a class. One that has not changed is the same object as `before`, so that it is not drawn again. */
export function rowsOf(
  { board, wall_s, lost_bead_s }: Rules,
  ofClass: string | undefined,
  before: readonly Row[] = [],
): readonly Row[] {
  const shown = board.filter((entry) => ofClass === undefined || entry.class === ofClass);
  return shown.map((entry, index) => {
    const [key, place] = [keyOf(entry), index + 1];
    const old = before[index];
    if (old?.key === key) return old;
    const { walls, lost_beads } = entry.score;
    return { key, place, entry, time_s: entry.total_s - walls * wall_s - lost_beads * lost_bead_s };
  });
}

/** Entries that were not on the board before. */
export function added(
  now: readonly BoardEntry[],
  before: readonly BoardEntry[],
): readonly BoardEntry[] {
  const known = new Set(before.map(keyOf));
  return now.filter((entry) => !known.has(keyOf(entry)));
}

/** `New: Ada, place 3, 21.4 s`. */
export function newWords({ place, entry }: Row): string {
  return `New: ${shownName(entry.player)}, place ${place}, ${seconds(entry.total_s)}`;
}

/** The local time of a moment of today, otherwise its date. */
export function when(at: string, now: Date, locale?: string, timeZone?: string): string {
  const date = new Date(at);
  const zone = timeZone === undefined ? {} : { timeZone };
  const day = (one: Date): string => one.toLocaleDateString('en-CA', zone);
  if (day(date) !== day(now)) {
    return date.toLocaleDateString(locale, { day: 'numeric', month: 'short', ...zone });
  }
  return date.toLocaleTimeString(locale, {
    hour: '2-digit',
    minute: '2-digit',
    hourCycle: 'h23',
    ...zone,
  });
}
