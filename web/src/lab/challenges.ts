// Names and addresses of challenges.

import {
  CONTROLLER_LABELS,
  type DifficultyName,
  type GhostMessage,
  type Period,
} from '../net/protocol.gen';
import { shownName } from '../ui/name';

export const DIFFICULTY_LABELS: Readonly<Record<DifficultyName, string>> = {
  easy: 'Easy',
  medium: 'Medium',
  hard: 'Hard',
};

export const PERIOD_LABELS: Readonly<Record<Period, string>> = { day: 'Today', week: 'This week' };

export const ghostName = ({ controller, player }: GhostMessage): string =>
  player === null ? CONTROLLER_LABELS[controller] : shownName(player);

/** The page that plays a challenge, after the address of a session. */
export const playQuery = (name: string): string => `?challenge=${encodeURIComponent(name)}`;

/** The page with the board of a challenge. */
export const boardPath = (name: string): string => `/board${playQuery(name)}`;

/** A challenge in the server's interface. */
export const challengePath = (name: string): string =>
  `/api/challenges/${encodeURIComponent(name)}`;
