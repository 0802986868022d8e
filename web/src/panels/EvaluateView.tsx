// Evaluate.

import type { JSX } from 'solid-js';

export function EvaluateView(): JSX.Element {
  return <main class="view">Evaluate</main>;
}
