// The floors of imports, and the size limit of files.

import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join, normalize, relative } from 'node:path';
import { expect, it } from 'vitest';

const SRC = import.meta.dirname;
/** A file imports from its own floor and from lower ones; `ui` and `net` do not import each other. */
const FLOORS: readonly (readonly string[])[] = [
  ['ui', 'net'],
  ['lab'],
  ['plan'],
  ['scene'],
  ['features'],
  ['app', 'pages'],
  ['main.tsx', 'house.test.ts'],
];
const MAX_LINES = 300;
const MAX_LOOSE = 5;
const IMPORTS = /(?:\bfrom|\bimport\(|^import)\s*['"](\.[^'"]*)['"]/gm;

const files = readdirSync(SRC, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => relative(SRC, join(entry.parentPath, entry.name)));
const scripts = files.filter((file) => /\.tsx?$/.test(file));
const read = (file: string): string => readFileSync(join(SRC, file), 'utf8');

function partOf(file: string): string {
  return file.split('/')[0] ?? file;
}
function floorOf(file: string): number {
  return FLOORS.findIndex((parts) => parts.includes(partOf(file)));
}
function featureOf(file: string): string | undefined {
  return partOf(file) === 'features' ? file.split('/')[1] : undefined;
}

/** Why `from` may not import `to`; undefined if it may. */
function objection(from: string, to: string): string | undefined {
  const [above, below] = [floorOf(from), floorOf(to)];
  if (below > above) return 'is on a higher floor';
  if (below === above && partOf(from) !== partOf(to)) return 'is on the same floor';
  const [own, other] = [featureOf(from), featureOf(to)];
  if (own !== undefined && other !== undefined && own !== other) return 'is another feature';
  return undefined;
}

it('assigns a floor to every script', () => {
  expect(scripts.filter((file) => floorOf(file) < 0)).toEqual([]);
});

it('allows imports only from lower floors, and none between features', () => {
  const wrong = scripts.flatMap((from) =>
    [...read(from).matchAll(IMPORTS)].flatMap(([, path = '']) => {
      const to = normalize(join(dirname(from), path));
      const why = objection(from, to);
      return why === undefined ? [] : [`${from} imports ${to}, which ${why}`];
    }),
  );
  expect(wrong).toEqual([]);
});

it('has few loose files', () => {
  const loose = files.filter((file) => !file.includes('/'));
  expect(loose.length, loose.join(', ')).toBeLessThanOrEqual(MAX_LOOSE);
});

it('has no long files', () => {
  const long = files.filter(
    (file) =>
      /\.tsx?$/.test(file) &&
      !file.endsWith('.gen.ts') &&
      read(file).trimEnd().split('\n').length > MAX_LINES,
  );
  expect(long).toEqual([]);
});
