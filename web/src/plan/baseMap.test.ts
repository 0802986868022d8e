import { createRoot, createSignal } from 'solid-js';
import { expect, test, vi } from 'vitest';
import { sceneOf } from '../lab/testing';
import { clipped, createBaseMap } from './baseMap';
import { type BasePicture, type Draw, drawn, type LiveLayer } from './layer';
import { Sheet } from './sheet';
import * as colours from '../ui/palette';

vi.mock('../ui/palette', () => {
  const [palette, setPalette] = createSignal({});
  return { palette, setPalette };
});
const { setPalette } = colours as unknown as { setPalette: (palette: object) => void };

const VIEW = { pxPerM: 1000, originX: 0, originY: 0 };
const noDraw: Draw<BasePicture> = () => undefined;

function open() {
  vi.stubGlobal(
    'Path2D',
    class {
      moveTo = noDraw;
      lineTo = noDraw;
      closePath = noDraw;
      rect = noDraw;
    },
  );
  const [scene, setScene] = createSignal(sceneOf('posts'));
  const [view, setView] = createSignal(VIEW);
  const [below, setBelow] = createSignal(1);
  const [above, setAbove] = createSignal(1);
  const [isShown, setShown] = createSignal(true);
  const layer: LiveLayer = {
    id: 'one',
    label: 'One',
    swatch: ['magnet'],
    group: 'Motion',
    create: () => ({}),
    isShown,
    belowWalls: drawn(below, noDraw),
    aboveWalls: drawn(above, noDraw),
  };
  const base = createRoot(() => createBaseMap({ scene }, [layer], view));
  return { base, setScene, setView, setBelow, setAbove, setShown };
}

test('the base map changes with map, theme, size and its layers, and with nothing else', () => {
  const { base, setScene, setView, setBelow, setAbove, setShown } = open();
  let before = base();
  const changes = (): { map: boolean; ground: boolean } => {
    const now = base();
    const changed = { map: now !== before, ground: now?.ground !== before?.ground };
    before = now;
    return changed;
  };
  const both = { map: true, ground: true };
  expect(changes()).toEqual({ map: false, ground: false });
  setScene(sceneOf('colon'));
  expect(changes()).toEqual(both);
  setPalette({});
  expect(changes()).toEqual(both);
  setView({ ...VIEW, pxPerM: 2000 });
  expect(changes()).toEqual(both);
  setBelow(2);
  expect(changes()).toEqual(both);
  // Floor and walls stay.
  setAbove(2);
  expect(changes()).toEqual({ map: true, ground: false });
  setShown(false);
  expect(changes()).toEqual(both);
  setAbove(3);
  setBelow(3);
  expect(changes()).toEqual({ map: false, ground: false });
});

test('a ring around the tool ends with the frame of the tray, not with the workspace', () => {
  const roundRect = vi.fn();
  vi.stubGlobal(
    'Path2D',
    class {
      roundRect = roundRect;
    },
  );
  const clip = vi.fn();
  const ctx = {
    save: noDraw,
    clip,
    restore: noDraw,
  } as unknown as CanvasRenderingContext2D;
  const scene = sceneOf('posts');
  clipped(noDraw)(ctx, { view: VIEW, palette: colours.palette(), scene, free: new Path2D() });
  expect(clip).toHaveBeenCalledOnce();
  const { x_min_m, y_max_m } = scene.workspace;
  const [left, top] = roundRect.mock.calls[0] as [number, number];
  expect(left).toBeLessThan(1000 * x_min_m - 5);
  expect(top).toBeLessThan(-1000 * y_max_m - 5);
});

test('a sheet is painted again only for another input or another ratio', () => {
  const ctx = new Proxy({}, { get: () => () => undefined }) as CanvasRenderingContext2D;
  vi.stubGlobal('document', { createElement: () => ({ getContext: () => ctx }) });
  const paint = vi.fn();
  const sheet = new Sheet<object>(paint);
  const size = { width: 4, height: 4 };
  const one = {};
  for (const [input, ratio] of [
    [one, 1],
    [one, 1],
    [{}, 1],
    [one, 2],
    [one, 2],
  ] as const) {
    sheet.copy(ctx, input, size, ratio);
  }
  expect(paint).toHaveBeenCalledTimes(3);
});
