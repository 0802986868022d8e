// Trainings that are started by request.

import { type APIRequestContext, expect } from '@playwright/test';
import type { Policies, Trainings, TrainingSummary } from './wire';

/** A training takes both processors of a small machine. */
export const TRAIN_MS = 300_000;
/** So few that a training takes seconds; the policy is not good. */
export const FEW_UPDATES = 200;
/** A training that is still learning when a test pauses it. */
export const MORE_UPDATES = 400;

async function read<T>(request: APIRequestContext, address: string) {
  return (await (await request.get(address)).json()) as T;
}

/** Starts a short training on the map `open`, and returns its id. */
export async function startTraining(
  request: APIRequestContext,
  origin: string,
  name: string,
  updates = FEW_UPDATES,
) {
  const response = await request.post(`${origin}/api/trainings`, {
    data: { map: 'open', name, seed: 1, settings: { updates } },
  });
  expect(response.status(), await response.text()).toBe(201);
  return ((await response.json()) as TrainingSummary).id;
}

/** Waits until a training is in a stage. */
export async function reachStage(
  request: APIRequestContext,
  origin: string,
  id: string,
  stage: TrainingSummary['stage'],
) {
  await expect
    .poll(
      async () => (await read<TrainingSummary>(request, `${origin}/api/trainings/${id}`)).stage,
      { message: id, intervals: [100], timeout: TRAIN_MS },
    )
    .toBe(stage);
}

/** Removes all trainings and all added policies: other tests on this server expect the shipped ones only. */
export async function clearTrainings(request: APIRequestContext, origin: string) {
  const all = async () => (await read<Trainings>(request, `${origin}/api/trainings`)).trainings;
  // The first request cancels, the second one removes.
  await expect
    .poll(
      async () => {
        for (const { id } of await all()) await request.delete(`${origin}/api/trainings/${id}`);
        return (await all()).length;
      },
      { intervals: [200] },
    )
    .toBe(0);
  const { policies } = await read<Policies>(request, `${origin}/api/policies`);
  for (const { name, is_shipped } of policies) {
    if (!is_shipped) await request.delete(`${origin}/api/policies/${name}`);
  }
}
