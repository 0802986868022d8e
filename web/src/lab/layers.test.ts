import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { createRoot } from 'solid-js';
import { createLayerChoice, type KnownLayer, type Layers } from './layers';

const KNOWN: readonly KnownLayer[] = [{ id: 'plan', shownAtFirst: true }, { id: 'flow' }];
const layersOf = (): Layers => createRoot(() => createLayerChoice(KNOWN));

beforeEach(() => {
  const stored = new Map<string, string>();
  vi.stubGlobal('localStorage', {
    getItem: (key: string) => stored.get(key) ?? null,
    setItem: (key: string, value: string) => stored.set(key, value),
  });
});
afterEach(() => {
  vi.unstubAllGlobals();
});

it('are the default at first, or with a damaged store', () => {
  expect([...layersOf().layers()]).toEqual(['plan']);
  localStorage.setItem('ferry.layer.flow', 'yes');
  expect([...layersOf().layers()]).toEqual(['plan']);
});

it('are those that were chosen, also on the next page', () => {
  const first = layersOf();
  first.showLayer('flow', true);
  expect([...first.layers()]).toEqual(['plan', 'flow']);
  first.showLayer('plan', false);
  first.showLayer('removed', true);
  expect([...layersOf().layers()]).toEqual(['flow']);
});
