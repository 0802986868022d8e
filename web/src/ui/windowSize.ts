// Whether the window is that of a phone. The width is that of `--phone` in styles/breakpoints.css.

import { createSignal } from 'solid-js';

const query = matchMedia('(max-width: 640px)');
const [phone, setPhone] = createSignal(query.matches);
query.addEventListener('change', () => {
  setPhone(query.matches);
});

export const isPhone = phone;
