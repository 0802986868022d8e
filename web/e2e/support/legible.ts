// Faults of what the page shows: small, cut and covered text, and controls that something else covers.

import type { Page } from '@playwright/test';

/** Runs in the page. */
function inPage() {
  const LEAST_PX = 12;
  /** Browsers round sizes. */
  const ROUNDING_PX = 1;
  const faults = new Set<string>();
  const words = (text: string) => `“${text.replaceAll(/\s+/g, ' ').trim().slice(0, 60)}”`;
  /** What the page hides from the eyes has no size. */
  const isShown = (element: Element) =>
    element.checkVisibility({ opacityProperty: true, visibilityProperty: true }) &&
    !element.closest('.visually-hidden, [hidden], option, title, desc, style, script, textarea');

  /** Drawings are enlarged and reduced. */
  const sizeOf = (element: Element) => {
    const { fontSize } = getComputedStyle(element);
    const scale = element instanceof SVGGraphicsElement ? (element.getScreenCTM()?.d ?? 1) : 1;
    return Number.parseFloat(fontSize) * Math.abs(scale);
  };
  /** Only part of the text is shown. What is left out whole is not cut. */
  const isCut = (text: DOMRect, by: DOMRect) => {
    const isApart =
      text.right <= by.left + ROUNDING_PX ||
      text.left >= by.right - ROUNDING_PX ||
      text.bottom <= by.top + ROUNDING_PX ||
      text.top >= by.bottom - ROUNDING_PX;
    const isInside =
      text.left >= by.left - ROUNDING_PX &&
      text.right <= by.right + ROUNDING_PX &&
      text.top >= by.top - ROUNDING_PX &&
      text.bottom <= by.bottom + ROUNDING_PX;
    return !isApart && !isInside;
  };
  /** The innermost part that hides what leaves it. What scrolls can be scrolled. */
  const cutterOf = (element: Element) => {
    for (let at: Element | null = element; at; at = at.parentElement) {
      const { overflowX, overflowY } = getComputedStyle(at);
      const both = [overflowX, overflowY];
      if (both.some((one) => one === 'auto' || one === 'scroll')) return undefined;
      if (both.some((one) => one === 'hidden' || one === 'clip')) return at;
    }
    return undefined;
  };

  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const range = document.createRange();
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const [text, element] = [node.textContent ?? '', node.parentElement];
    if (!element || text.trim() === '' || !isShown(element)) continue;
    range.selectNodeContents(node);
    const boxes = [...range.getClientRects()].filter(({ width, height }) => width * height > 1);
    if (boxes.length === 0) continue;
    const size = sizeOf(element);
    if (size < LEAST_PX - 0.05) faults.add(`${words(text)} has ${size.toFixed(1)} px`);
    const cutter = cutterOf(element)?.getBoundingClientRect();
    if (cutter && boxes.some((box) => isCut(box, cutter))) faults.add(`${words(text)} is cut`);
  }

  for (const field of document.querySelectorAll<HTMLInputElement>('input:not([readonly])')) {
    const isText = ['text', 'number', 'search', ''].includes(field.type);
    if (isText && isShown(field) && field.scrollWidth > field.clientWidth + ROUNDING_PX)
      faults.add(
        `the text of the field ${words(field.labels?.[0]?.textContent ?? field.name)} is cut`,
      );
  }

  const isSticky = (element: Element | null): boolean =>
    element !== null &&
    (getComputedStyle(element).position === 'sticky' || isSticky(element.parentElement));

  for (const control of document.querySelectorAll<HTMLElement>(
    'button, select, input, a, summary',
  )) {
    const label = (control as HTMLInputElement).labels?.[0];
    const area = control.matches('[type=checkbox], [type=radio]') && label ? label : control;
    if (!isShown(area)) continue;
    const { left, top, width, height } = area.getBoundingClientRect();
    const [x, y] = [left + width / 2, top + height / 2];
    const hit = document.elementFromPoint(x, y);
    if (!hit || area.contains(hit) || hit.contains(area)) continue;
    // What is out of a part that scrolls, and what is below a part that stays in sight.
    const scroller = area.closest('.inspector-panel, .view, .popover, dialog, .scrolls');
    if (scroller && !scroller.contains(hit)) continue;
    if (hit.closest('.popover, .help-text, .notice, dialog') || isSticky(hit)) continue;
    const name = control.getAttribute('aria-label') ?? control.textContent;
    faults.add(`${words(name)} is covered by ${words(hit.outerHTML.slice(0, 80))}`);
  }
  return [...faults];
}

/** Text below 12 pixels, text of which a part is not seen, and controls whose middle is covered. */
export const illegible = (page: Page): Promise<string[]> => page.evaluate(inPage);

/** Waits until nothing fades or glides any more. */
export const atRest = (page: Page) =>
  page.evaluate(async () => {
    const finite = document
      .getAnimations()
      .filter(({ effect }) => effect?.getComputedTiming().endTime !== Infinity);
    await Promise.allSettled(finite.map(({ finished }) => finished));
  });
