// What axe finds wrong with the page as it stands.

import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';

const source = await readFile(
  createRequire(import.meta.url).resolve('axe-core/axe.min.js'),
  'utf8',
);
const GRAVE = new Set(['serious', 'critical']);

/** One line a violation that is serious or worse: the rule, the first elements, why. */
export async function violations(page) {
  // The page's policy forbids scripts of others as elements; the debugger may evaluate.
  if (!(await page.evaluate('typeof axe === "object"'))) await page.evaluate(source);
  const found = await page.evaluate(async () => {
    const { violations: all } = await window.axe.run(document, {
      resultTypes: ['violations'],
      iframes: false,
      preload: false,
    });
    return all.map(({ id, impact, nodes }) => ({
      id,
      impact,
      nodes: nodes.map(({ target, any, all: every, none }) => ({
        target: target.join(' '),
        why: [...any, ...every, ...none][0]?.message ?? '',
      })),
    }));
  });
  return found
    .filter(({ impact }) => GRAVE.has(impact))
    .flatMap(({ id, nodes }) => nodes.map(({ target, why }) => `${id}: ${target}: ${why}`));
}
