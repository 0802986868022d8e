import { createRoot, createSignal } from 'solid-js';
import { expect, it } from 'vitest';
import type { TrainingPoint } from '../net/protocol.gen';
import { trainingOf } from './testing';
import { fakeLab } from './testingLab';

const pointOf = (update: number): TrainingPoint => ({
  update,
  steps: 0,
  episodes: 0,
  reward_mean: null,
  reward_deviation: null,
  loss_mean: null,
  ended: 0,
  reached: 0,
  examined: null,
});

it('watches one training, has each of its points once, and asks again after a lost connection', async () => {
  // The page asks for its address before it connects again.
  const { lab, server } = fakeLab({ [`GET ${window.location.pathname}`]: () => ({}) });
  await expect.poll(() => lab.connection().kind).toBe('live');
  const asked = (): (string | null)[] =>
    server.sent.flatMap((one) => (one.type === 'watch_training' ? [one.training] : []));
  const [id, setId] = createSignal<string | undefined>('training-1');
  const [points, stop] = createRoot((dispose) => [lab.catalog.watch(id), dispose] as const);
  const send = (training: string, first: number, ...updates: number[]): void => {
    server.tell({ type: 'training_points', training, first, points: updates.map(pointOf) });
  };
  const updates = (): number[] => points().map(({ update }) => update);
  expect(asked()).toEqual(['training-1']);
  send('training-1', 0, 100, 200);
  send('training-1', 2, 300);
  expect(updates()).toEqual([100, 200, 300]);
  // It failed, and goes on from an earlier point.
  send('training-1', 1, 250);
  expect(updates()).toEqual([100, 250]);

  server.disconnect();
  expect(updates()).toEqual([100, 250]);
  await expect.poll(asked, { timeout: 5000 }).toEqual(['training-1', 'training-1']);
  expect(updates()).toEqual([100, 250]);
  send('training-1', 0, 100, 250, 300);
  await expect.poll(updates).toEqual([100, 250, 300]);

  setId('training-2');
  expect(updates()).toEqual([]);
  // One that was on its way.
  send('training-1', 3, 400);
  expect(updates()).toEqual([]);
  send('training-2', 0, 100);
  expect(updates()).toEqual([100]);
  stop();
  expect(asked()).toEqual(['training-1', 'training-1', 'training-2', null]);
});

// The last one: its page goes on trying to connect.
it('has each list as the newest message has it, also while the connection is lost', async () => {
  const { lab, server } = fakeLab();
  expect(lab.catalog.maps()).toBeUndefined();
  await expect.poll(() => lab.catalog.maps()).toEqual(['posts']);
  const before = lab.catalog.maps();
  server.lists({ trainings: [trainingOf()] });
  expect(lab.catalog.trainings()).toHaveLength(1);
  expect(lab.catalog.maps()).toBe(before);
  server.disconnect();
  expect(lab.catalog.trainings()).toHaveLength(1);
});
