import { describe, expect, it } from 'vitest';
import type { TrainingFrame } from '../../net/protocol.gen';
import { coarseToFine, FrameCache } from './frames';
import { frameOf } from './testing';

/** A server that answers when the test lets it. */
function slowServer() {
  const asked: number[] = [];
  const open = new Map<number, { yes: (frame: TrainingFrame) => void; no: (e: Error) => void }>();
  const failures: (string | undefined)[] = [];
  let resume = (): void => undefined;
  const cache = new FrameCache(
    (index) => {
      asked.push(index);
      return new Promise((yes, no) => open.set(index, { yes, no }));
    },
    { changed: () => undefined, failed: (why) => failures.push(why) },
    () =>
      new Promise((done) => {
        resume = done;
      }),
  );
  const settle = () => new Promise((done) => setTimeout(done));
  return {
    cache,
    asked,
    failures,
    answer: async (index: number) => {
      open.get(index)?.yes(frameOf(100 * index));
      await settle();
    },
    fail: async (index: number) => {
      open.get(index)?.no(new Error('lost'));
      await settle();
    },
    resume: async () => {
      resume();
      await settle();
    },
  };
}

describe('the order', () => {
  it('has the newest first, then coarse to fine, each once', () => {
    const order = coarseToFine(40);
    expect(order.slice(0, 6)).toEqual([39, 0, 16, 32, 8, 24]);
    expect([...order].sort((a, b) => a - b)).toEqual(Array.from({ length: 40 }, (_, i) => i));
    expect(coarseToFine(0)).toEqual([]);
    expect(coarseToFine(1)).toEqual([0]);
  });
});

describe('the cache', () => {
  it('reads a value map once, and two at a time', async () => {
    const { cache, asked, answer } = slowServer();
    cache.wantAll(5);
    cache.wantAll(5);
    expect(asked).toEqual([4, 0]);
    await answer(4);
    expect(asked).toEqual([4, 0, 2]);
    expect(cache.get(4)?.update).toBe(400);
    cache.want(4);
    await answer(0);
    expect(cache.all().map(({ update }) => update)).toEqual([0, 400]);
  });

  it('reads the one that is shown first', async () => {
    const { cache, asked, answer } = slowServer();
    cache.wantAll(20);
    cache.want(7);
    await answer(19);
    expect(asked).toEqual([19, 0, 7]);
  });

  it('waits after a failure, and can read again', async () => {
    const { cache, asked, failures, fail, resume, answer } = slowServer();
    cache.want(3);
    await fail(3);
    expect(failures).toEqual(['lost']);
    cache.want(3);
    expect(asked).toEqual([3]);
    await resume();
    cache.want(3);
    await answer(3);
    expect(asked).toEqual([3, 3]);
    expect(failures).toEqual(['lost', undefined]);
  });

  it('reads nothing more when it is closed', async () => {
    const { cache, asked, failures, answer } = slowServer();
    cache.wantAll(9);
    cache.close();
    await answer(8);
    expect(asked).toEqual([8, 0]);
    expect(failures).toEqual([]);
  });
});
