// Rules of the structure: floors of imports, sizes of files, and places of style sheets.

import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join, normalize, relative } from 'node:path';
import { expect, it } from 'vitest';

const SRC = import.meta.dirname;
/** A file imports from its own folder and from lower floors. `ui` and `net` are on one floor. */
const FLOORS: readonly (readonly string[])[] = [
  ['styles'],
  ['ui', 'net'],
  ['words'],
  ['lab'],
  ['plan'],
  ['scene'],
  ['features'],
  ['app', 'pages'],
  ['main.tsx', 'house.test.ts'],
];
const MAX_LINES = 300;
const MAX_LOOSE = 5;
const IMPORTS = /(?:\bfrom|\bimport\(|^@?import)\s*['"](\.[^'"]*)['"]/gm;
const BREAKPOINTS = 'styles/breakpoints.css';

const files = readdirSync(SRC, { recursive: true, withFileTypes: true })
  .filter((entry) => entry.isFile())
  .map((entry) => relative(SRC, join(entry.parentPath, entry.name)));
const scripts = files.filter((file) => /\.tsx?$/.test(file));
const sheets = files.filter((file) => file.endsWith('.css'));
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

it('assigns a floor to every file', () => {
  expect([...scripts, ...sheets].filter((file) => floorOf(file) < 0)).toEqual([]);
});

it('allows imports only from lower floors, and none between features', () => {
  const wrong = [...scripts, ...sheets].flatMap((from) =>
    [...read(from).matchAll(IMPORTS)].flatMap(([, path = '']) => {
      const to = normalize(join(dirname(from), path));
      const why = objection(from, to);
      return why === undefined ? [] : [`${from} imports ${to}, which ${why}`];
    }),
  );
  expect(wrong).toEqual([]);
});

/** The scripts that a script imports, types included. */
function importsOf(from: string): string[] {
  return [...read(from).matchAll(IMPORTS)].flatMap(([, path = '']) => {
    const to = normalize(join(dirname(from), path));
    return scripts.filter((file) => [to, `${to}.ts`, `${to}.tsx`].includes(file));
  });
}

it('has no circles of imports', () => {
  const targets = new Map(scripts.map((file) => [file, importsOf(file)]));
  const isInCircle = (file: string): boolean => {
    const reached = new Set(targets.get(file));
    // The set grows while it is read.
    for (const one of reached) for (const to of targets.get(one) ?? []) reached.add(to);
    return reached.has(file);
  };
  const wrong = scripts.filter(isInCircle);
  expect(wrong).toEqual([]);
});

it('has few files outside the folders', () => {
  const loose = files.filter((file) => !file.includes('/'));
  expect(loose.length, loose.join(', ')).toBeLessThanOrEqual(MAX_LOOSE);
});

it('has no file above the size limit', () => {
  const long = files.filter(
    (file) => /\.(tsx?|css)$/.test(file) && read(file).trimEnd().split('\n').length > MAX_LINES,
  );
  expect(long).toEqual([]);
});

/** The first class of each selector: the class that the rule styles. */
function styledClasses(sheet: string): string[] {
  const text = read(sheet).replaceAll(/\/\*.*?\*\//gs, '');
  const selectors = [...text.matchAll(/([^{};]+)\{/g)].flatMap(([, list = '']) => list.split(','));
  return selectors.flatMap((selector) => /\.([a-z][\w-]*)/.exec(selector)?.[1] ?? []);
}

it('keeps the style of a component beside it', () => {
  // The other pages have their markup in HTML files.
  const ofComponents = sheets.filter((sheet) => partOf(sheet) !== 'pages');
  const wrong = ofComponents.flatMap((sheet) => {
    // Every folder may use the classes of `ui`.
    const isShared = partOf(sheet) === 'ui';
    const users = scripts.filter((file) => isShared || dirname(file) === dirname(sheet)).map(read);
    return styledClasses(sheet)
      .filter(
        (name) => !users.some((text) => new RegExp(`(?<![\\w-])${name}(?![\\w-])`).test(text)),
      )
      .map((name) => `${sheet} styles .${name}, which no script beside it has`);
  });
  expect(wrong).toEqual([]);
});

it('names the same browsers on the page, in the documents and to the compiler', () => {
  const wanted = /Firefox (\d+), Chrome or\s+Edge (\d+), Safari ([\d.]+)/;
  const versions = ['index.html', '../docs/operations.md'].map((file) =>
    wanted.exec(readFileSync(join(SRC, '..', file), 'utf8'))?.slice(1),
  );
  expect(versions[0]).toEqual(versions[1]);
  const [firefox, chrome, safari] = versions[0] ?? [];
  expect(readFileSync(join(SRC, '../vite.config.ts'), 'utf8')).toContain(
    `['chrome${chrome}', 'edge${chrome}', 'firefox${firefox}', 'safari${safari}']`,
  );
});

it('has the sizes of the window in one file', () => {
  const wrong = sheets.filter(
    (sheet) => sheet !== BREAKPOINTS && /@media[^{]*(width|height|pointer)/.test(read(sheet)),
  );
  expect(wrong).toEqual([]);
});
