// The newest kept run that the user has seen.

import { createSignal, type Signal } from 'solid-js';
import { perLab } from '../../lab/perLab';
import type { Session } from '../../lab/slices';

/** Number of the newest run that the user has seen; undefined until the first scene. */
export const seenOf = perLab<Session, Signal<number | undefined>>(() => createSignal<number>());
