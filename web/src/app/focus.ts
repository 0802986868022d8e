// Keeps the keyboard focus in place when the focused control is removed.

const FOCUSABLE =
  ':is(button, input, select, textarea, summary, a[href], [tabindex="0"]):not(:disabled)';

/** When the focused element is removed, focuses the first control in its nearest remaining ancestor. */
export function keepFocus(page: Document): void {
  let around: readonly Element[] = [];
  page.addEventListener('focusin', ({ target }) => {
    const parts: Element[] = [];
    for (let one = target as Element | null; one; one = one.parentElement) parts.push(one);
    around = parts;
  });
  const look = (): void => {
    const [last, ...parts] = around;
    if (!last || last.isConnected || page.activeElement !== page.body) return;
    around = [];
    const left = parts.filter((part) => part.isConnected);
    for (const part of left) {
      const next = [...part.querySelectorAll<HTMLElement>(FOCUSABLE)].find((one) =>
        one.checkVisibility(),
      );
      if (next) {
        next.focus();
        return;
      }
    }
  };
  new MutationObserver(look).observe(page.body, { childList: true, subtree: true });
}
