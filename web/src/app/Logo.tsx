// The mark of Ferry: the bead in its gut.

import type { JSX } from 'solid-js';

export function Logo(): JSX.Element {
  return (
    <svg class="logo" viewBox="0 0 30 30" width="30" height="30" aria-hidden="true">
      <circle cx="15" cy="15" r="13.6" fill="none" stroke="var(--ink)" stroke-width="2" />
      <path
        d="M5 18.5c4-5 7 2.5 11-1.5s5-7.5 9-6"
        fill="none"
        stroke="var(--wall)"
        stroke-width="4.5"
        stroke-linecap="round"
      />
      <circle
        cx="16.2"
        cy="16.2"
        r="3.6"
        fill="var(--bead)"
        stroke="var(--bead-edge)"
        stroke-width="1.4"
      />
    </svg>
  );
}
