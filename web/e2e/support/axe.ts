// Accessibility faults that axe-core finds on the page.

import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import type { Page } from '@playwright/test';
import type { AxeResults, RunOptions } from 'axe-core';

declare global {
  interface Window {
    axe: { run: (where: Element, options: RunOptions) => Promise<AxeResults> };
  }
}

const source = await readFile(
  createRequire(import.meta.url).resolve('axe-core/axe.min.js'),
  'utf8',
);
const REPORTED_IMPACTS = ['serious', 'critical'];

/**
 * One line per element with a serious or critical violation: the rule, the element, the reason.
 * Checks all rules, or only those of `rules`, in the whole page or in a part of it.
 */
export async function violations(
  page: Page,
  rules?: readonly string[],
  part = page.locator('html'),
) {
  // The content security policy forbids a script element. The debugger may evaluate the source.
  if (!(await page.evaluate('typeof axe === "object"'))) await page.evaluate(source);
  const found = await part.evaluate(async (root, runOnly: readonly string[] | undefined) => {
    // While a colour changes, it has the contrast of neither theme. A transition that is replaced rejects.
    const finite = document
      .getAnimations()
      .filter(({ effect }) => effect?.getComputedTiming().endTime !== Infinity);
    await Promise.allSettled(finite.map(({ finished }) => finished));
    const { violations: all } = await window.axe.run(root, {
      resultTypes: ['violations'],
      iframes: false,
      preload: false,
      ...(runOnly ? { runOnly: [...runOnly] } : {}),
    });
    return all.map(({ id, impact, nodes }) => ({
      id,
      impact,
      nodes: nodes.map(({ target, any, all: every, none }) => ({
        target: target.join(' '),
        reason: [...any, ...every, ...none][0]?.message ?? '',
      })),
    }));
  }, rules);
  return found
    .filter(({ impact }) => REPORTED_IMPACTS.includes(impact ?? ''))
    .flatMap(({ id, nodes }) => nodes.map(({ target, reason }) => `${id}: ${target}: ${reason}`));
}
