import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { CARRIERS, LOOKS } from './controllers';

type Tokens = ReadonlyMap<string, string>;
type Rgb = readonly [number, number, number];

const sheet = readFileSync(join(import.meta.dirname, '../styles/tokens.css'), 'utf8');
const [ofLight = '', ofDark = ''] = sheet.split(":root[data-theme='dark']");
const tokensIn = (text: string): [string, string][] =>
  [...text.matchAll(/--([\w-]+): (#[0-9a-f]{6});/g)].map(([, name = '', colour = '']) => [
    name,
    colour,
  ]);
const light: Tokens = new Map(tokensIn(ofLight));
const dark: Tokens = new Map([...light, ...tokensIn(ofDark.split('}')[0] ?? '')]);
const THEMES = { light, dark };

/** Linear parts, 0 to 1. */
function linear(tokens: Tokens, name: string): Rgb {
  const colour = tokens.get(name);
  if (colour === undefined) throw new Error(`There is no colour --${name}.`);
  const part = (at: number): number => {
    const share = Number.parseInt(colour.slice(at, at + 2), 16) / 255;
    return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
  };
  return [part(1), part(3), part(5)];
}

const luminanceOf = ([r, g, b]: Rgb): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** As in WCAG 2. */
function contrast(tokens: Tokens, a: string, b: string): number {
  const [dim, bright] = [a, b]
    .map((name) => luminanceOf(linear(tokens, name)))
    .sort((x, y) => x - y);
  return ((bright ?? 0) + 0.05) / ((dim ?? 0) + 0.05);
}

/**
 * Colours as people without one kind of cones see them. Machado, Oliveira and Fernandes, "A Physiologically-based Model
 * for Simulation of Color Vision Deficiency" (2009), severity 1.
 */
const SIGHTS: Readonly<Record<string, readonly [Rgb, Rgb, Rgb]>> = {
  usual: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  protanopia: [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  deuteranopia: [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  tritanopia: [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};

const times = (rows: readonly [Rgb, Rgb, Rgb], colour: Rgb): Rgb => {
  const [x, y, z] = rows.map((row) =>
    row.reduce((sum, part, i) => sum + part * (colour[i] ?? 0), 0),
  );
  return [x ?? 0, y ?? 0, z ?? 0];
};

/** Ottosson, "A perceptual color space for image processing" (2020). */
function oklab(colour: Rgb): Rgb {
  const [l, m, s] = times(
    [
      [0.4122214708, 0.5363325363, 0.0514459929],
      [0.2119034982, 0.6806995451, 0.1073969566],
      [0.0883024619, 0.2817188376, 0.6299787005],
    ],
    colour,
  ).map((part) => Math.cbrt(Math.max(0, part)));
  return times(
    [
      [0.2104542553, 0.793617785, -0.0040720468],
      [1.9779984951, -2.428592205, 0.4505937099],
      [0.0259040371, 0.7827717662, -0.808675766],
    ],
    [l ?? 0, m ?? 0, s ?? 0],
  );
}

const FOUR = ['rl', 'errt', 'attractor', 'you'] as const;
/** OKLab × 100. Smaller differences are hard to see in thin lines. */
const LEAST_DIFFERENCE = 8;

describe('controllers', () => {
  it('each has its own shape and its own dash', () => {
    expect(new Set(CARRIERS.map((name) => LOOKS[name].shape)).size).toBe(CARRIERS.length);
    expect(new Set(CARRIERS.map((name) => LOOKS[name].dash.join())).size).toBe(CARRIERS.length);
    expect(LOOKS.rl.dash).toEqual([]);
  });

  for (const [theme, tokens] of Object.entries(THEMES)) {
    for (const [sight, rows] of Object.entries(SIGHTS)) {
      it.each(['colour', 'mark'] as const)(`are told apart by %s, ${theme}, ${sight}`, (kind) => {
        const seen = FOUR.map((name) => oklab(times(rows, linear(tokens, LOOKS[name][kind]))));
        for (const [i, a] of seen.entries()) {
          for (const b of seen.slice(0, i)) {
            const difference = 100 * Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
            expect(difference).toBeGreaterThan(LEAST_DIFFERENCE);
          }
        }
      });
    }
  }
});

describe.each(Object.entries(THEMES))('marks on the map, %s', (_, tokens) => {
  const marks = ['m-goal', 'm-danger', 'm-ink', 'm-cursor', 'magnet', 'north', 'south', 'sensed'];

  it.each([...CARRIERS.map((name) => LOOKS[name].mark), ...marks])(
    '%s is seen on the floor, and on its casing',
    (mark) => {
      expect(contrast(tokens, mark, 'floor')).toBeGreaterThanOrEqual(3);
      expect(contrast(tokens, mark, 'case')).toBeGreaterThanOrEqual(3);
    },
  );

  it('the casing is seen on every tissue, and the wall on the floor', () => {
    for (const tissue of ['wall', 'wall-deep', 'wall-lip']) {
      expect(contrast(tokens, 'case', tissue)).toBeGreaterThanOrEqual(3);
    }
    expect(contrast(tokens, 'wall', 'floor')).toBeGreaterThanOrEqual(3);
    expect(contrast(tokens, 'bead-edge', 'bead')).toBeGreaterThanOrEqual(3);
  });

  it('the classes of a recovery map differ in grey', () => {
    for (const [a, b] of [
      ['delivered', 'lost'],
      ['late', 'lost'],
      ['late', 'late-stripes'],
      ['lost', 'lost-lattice'],
    ] as const) {
      expect(contrast(tokens, a, b), `${a} and ${b}`).toBeGreaterThanOrEqual(3);
    }
  });
});
