import { createRoot, createSignal } from 'solid-js';
import { expect, it } from 'vitest';
import { createPending } from './pending';

/** A server that answers when the test says so. */
function open() {
  const [truth, setTruth] = createSignal('a');
  const sent: string[] = [];
  const answers: (() => void)[] = [];
  const pending = createRoot(() =>
    createPending(truth, (value) => {
      sent.push(value);
      return new Promise<void>((done) => answers.push(done));
    }),
  );
  const answer = async (): Promise<void> => {
    answers.shift()?.();
    await Promise.resolve();
    await Promise.resolve();
  };
  return { pending, setTruth, sent, answer };
}

it('shows the choice until it is answered, then what the server has', async () => {
  const { pending, setTruth, answer } = open();
  pending.choose('b');
  expect([pending.value(), pending.isPending()]).toEqual(['b', true]);
  setTruth('b');
  await answer();
  expect([pending.value(), pending.isPending()]).toEqual(['b', false]);
});

it('shows the old value again after a refusal', async () => {
  const { pending, answer } = open();
  pending.choose('b');
  await answer();
  expect([pending.value(), pending.isPending()]).toEqual(['a', false]);
});

it('sends the newest of the choices that were made meanwhile', async () => {
  const { pending, sent, answer } = open();
  for (const value of ['b', 'c', 'd']) pending.choose(value);
  expect(sent).toEqual(['b']);
  await answer();
  expect(sent).toEqual(['b', 'd']);
  expect(pending.value()).toBe('d');
  await answer();
  expect([pending.value(), pending.isPending()]).toEqual(['a', false]);
});
