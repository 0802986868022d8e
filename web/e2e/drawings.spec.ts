// Ferry reads a drawing as a browser draws it, or refuses it by element: all of tests/drawings.

import { readFile, readdir } from 'node:fs/promises';
import type { MapCheck } from '../src/net/protocol.gen';
import { expect, test } from './fixtures';
import { wallsCompared } from './support/wallsCompared';

const FOLDER = '../tests/drawings';
/** Millimetres of the table: the one exception from what a browser draws. */
const UNITS = { mm: 1, cm: 10, in: 25.4, pt: 25.4 / 72, pc: 25.4 / 6 };

/** A browser reads images as UTF-8, whatever they declare, and gives them a page and a background. */
function asImage(bytes: Buffer): string {
  const declared = /^<\?xml[^>]*encoding="(?<name>ISO[^"]*)"/.exec(bytes.toString('latin1'));
  const text = new TextDecoder(
    declared?.groups?.name ?? (bytes[0] === 0xff ? 'utf-16' : 'utf-8'),
  ).decode(bytes);
  return text
    .replace(/^<\?xml[^>]*>/, '')
    .replace(/<(\w+:)?svg\b[^>]*>/, (root) =>
      root
        .replaceAll(/\s(width|height|preserveAspectRatio)=("[^"]*"|'[^']*')/g, '')
        .replaceAll(/background(-color)?:[^;"']*/g, ''),
    );
}

const inMillimetres = (text: string): string =>
  text.replaceAll(
    /([\d.]+)(mm|cm|in|pt|pc)\b/g,
    (_, number: string, unit: keyof typeof UNITS) => `${String(Number(number) * UNITS[unit])}px`,
  );

test('drawings have the walls that the browser draws, or are refused by element', async ({
  page,
  server,
}) => {
  const files = (await readdir(FOLDER)).filter((name) => name.endsWith('.svg')).sort();
  // What is not the same: `refused: PART OF THE REASON`, `units`, or `any` of both.
  const text = await readFile(`${FOLDER}/index.json`, 'utf8');
  const others = new Map(Object.entries(JSON.parse(text) as Record<string, string>));
  expect(files.length).toBeGreaterThan(280);
  const wrong: string[] = [];
  for (const file of files) {
    const name = file.replace(/\.svg$/, '');
    const expected = others.get(name) ?? 'same';
    others.delete(name);
    const bytes = await readFile(`${FOLDER}/${file}`);
    const answer = await page.request.post(`${server.url}/api/map-checks`, {
      data: bytes,
      headers: { 'Content-Type': 'image/svg+xml' },
    });
    if (!answer.ok()) {
      const { detail } = (await answer.json()) as { detail: string };
      const reason = /^refused: (.*)$/.exec(expected)?.[1] ?? (expected === 'any' ? '' : undefined);
      if (reason === undefined || !detail.includes(reason)) wrong.push(`${name}: ${detail}`);
      continue;
    }
    if (expected.startsWith('refused')) {
      wrong.push(`${name}: accepted, but ${expected}`);
      continue;
    }
    const image = asImage(bytes);
    const drawing = Buffer.from(expected === 'units' ? inMillimetres(image) : image);
    const compared = page.evaluate(wallsCompared, {
      drawing: `data:image/svg+xml;base64,${drawing.toString('base64')}`,
      check: (await answer.json()) as MapCheck,
    });
    const difference = await compared.catch((error: unknown) => String(error));
    if (difference !== null) wrong.push(`${name}: ${JSON.stringify(difference)}`);
  }
  expect(wrong).toEqual([]);
  expect([...others.keys()]).toEqual([]);
});
