import { createRoot, createSignal } from 'solid-js';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { trainingOf } from '../../lab/testing';
import { CELLS, frameOf } from './testing';
import { coarseToFine, createValueMaps } from './valueMaps';

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

/** A training of 20 value maps, and a server that answers when the test lets it. */
async function slowServer() {
  const asked: string[] = [];
  let open: { yes: (answer: unknown) => void; no: (reason: Error) => void } | undefined;
  const [wanted, want] = createSignal<readonly number[]>([]);
  const [maps, close] = createRoot((dispose) => [
    createValueMaps(
      () => trainingOf({ frames: 20 }),
      wanted,
      (path) => {
        asked.push(path.replace(/^.*\//, ''));
        return new Promise((yes, no) => {
          open = { yes: yes as (answer: unknown) => void, no };
        });
      },
    ),
    dispose,
  ]);
  const settle = () => vi.advanceTimersByTimeAsync(0);
  await settle();
  const answer = async (content: unknown): Promise<void> => {
    open?.yes(content);
    await settle();
  };
  const fail = async (): Promise<void> => {
    open?.no(new Error('lost'));
    await settle();
  };
  return { maps, close, asked, want, answer, fail, settle };
}

it('reads coarse to fine, the newest first, each once', () => {
  const order = coarseToFine(40);
  expect(order.slice(0, 6)).toEqual([39, 0, 16, 32, 8, 24]);
  expect([...order].sort((a, b) => a - b)).toEqual(Array.from({ length: 40 }, (_, i) => i));
  expect(coarseToFine(0)).toEqual([]);
  expect(coarseToFine(1)).toEqual([0]);
});

describe('the value maps', () => {
  it('come after the cells, one after the other, each once', async () => {
    const { maps, asked, want, answer } = await slowServer();
    want([4, 0]);
    expect(asked).toEqual(['cells']);
    await answer(CELLS);
    expect(maps.cells()).toBe(CELLS);
    expect(asked).toEqual(['cells', '4']);
    // The one that is shown is read before all others.
    want([7, 4, 0]);
    await answer(frameOf(400));
    expect(asked).toEqual(['cells', '4', '7']);
    await answer(frameOf(700));
    await answer(frameOf(0));
    expect(asked).toEqual(['cells', '4', '7', '0']);
    expect(maps.frames().flatMap((frame, index) => (frame ? [index] : []))).toEqual([0, 4, 7]);
    want([0, 1]);
    expect(asked).toEqual(['cells', '4', '7', '0', '1']);
  });

  it('are requested again some time after a failure', async () => {
    const { maps, asked, answer, fail } = await slowServer();
    await fail();
    expect(maps.error()).toBe('lost');
    expect(asked).toEqual(['cells']);
    await vi.advanceTimersByTimeAsync(2000);
    await answer(CELLS);
    expect(asked).toEqual(['cells', 'cells']);
    expect(maps.error()).toBeUndefined();
  });

  it('are read no more when the owner is disposed of', async () => {
    const { asked, want, close, answer } = await slowServer();
    want([3]);
    close();
    await answer(CELLS);
    expect(asked).toEqual(['cells']);
  });
});
