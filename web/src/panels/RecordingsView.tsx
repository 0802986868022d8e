// Recordings.

import type { JSX } from 'solid-js';

export function RecordingsView(): JSX.Element {
  return <main class="view">Recordings</main>;
}
