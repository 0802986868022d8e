// Names and addresses of challenges.

import type { DifficultyName, Period } from '../net/protocol.gen';

export const DIFFICULTY_LABELS: Readonly<Record<DifficultyName, string>> = {
  easy: 'Easy',
  medium: 'Medium',
  hard: 'Hard',
};

export const PERIOD_LABELS: Readonly<Record<Period, string>> = { day: 'Today', week: 'This week' };

/** The page that plays a challenge, after the address of a session. */
export const playQuery = (name: string): string => `?challenge=${encodeURIComponent(name)}`;

/** The page with the board of a challenge. */
export const boardPath = (name: string): string => `/board${playQuery(name)}`;

/** A challenge in the server's interface. */
export const challengePath = (name: string): string =>
  `/api/challenges/${encodeURIComponent(name)}`;
