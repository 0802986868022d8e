// What can be done with the server's trainings and policies. A refusal is thrown.

import type { TrainingQuery, TrainingSummary } from '../../net/protocol.gen';
import { patch, post, remove } from '../../net/requests';
import { startPath } from '../../lab/jobs';
import { nameFault } from './recipes';

export const TRAININGS = '/api/trainings';

export const trainingPath = (id: string): string => `${TRAININGS}/${encodeURIComponent(id)}`;

const policyPath = (name: string): string => `/api/policies/${encodeURIComponent(name)}`;

export const policyFile = (name: string): string => `${policyPath(name)}.safetensors`;

/** For a session. Returns the id. */
export const startTraining = async (session: string, query: TrainingQuery): Promise<string> =>
  (await post<TrainingSummary>(startPath(TRAININGS, session), JSON.stringify(query))).id;

export const pauseTraining = (id: string): Promise<unknown> => post(`${trainingPath(id)}/pause`);

export const resumeTraining = (id: string): Promise<unknown> => post(`${trainingPath(id)}/resume`);

/** Cancels one that has not ended, and removes one that has. */
export const discardTraining = (id: string): Promise<void> => remove(trainingPath(id));

export const uploadPolicy = (name: string, file: File): Promise<unknown> =>
  post(policyPath(name), file, 'application/octet-stream');

export async function renamePolicy(name: string, next: string): Promise<void> {
  const fault = nameFault(next);
  if (fault !== undefined) throw new Error(fault);
  await patch(policyPath(name), JSON.stringify({ name: next }));
}

export const discardPolicy = (name: string): Promise<void> => remove(policyPath(name));
