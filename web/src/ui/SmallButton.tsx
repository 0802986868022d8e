// The button of panels, lists and tables.

import type { JSX } from 'solid-js';

export function SmallButton(props: JSX.ButtonHTMLAttributes<HTMLButtonElement>): JSX.Element {
  return <button type="button" class="small" {...props} />;
}
