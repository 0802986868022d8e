// What the page says about the shipped policies on a new map.

import { expect, it } from 'vitest';
import { page, userEvent } from 'vitest/browser';
import { fakeLab, refusal, show } from '../../lab/testingLab';
import type { EvaluationSummary, JobStage, PolicySummary } from '../../net/protocol.gen';
import { OpenMap } from './OpenMap';
import { createMapOpener } from './opener';

const policy = (name: string, maps: string[]): PolicySummary => ({
  name,
  reference: name,
  is_shipped: name !== 'mine',
  maps,
  seed: 1,
  updates: 1,
  has_memory: false,
  origin: null,
});

const REPORT = {
  name: 'mine',
  width_m: 0.58,
  height_m: 0.33,
  walls: 1,
  regions: 1,
  free_m2: 0.1,
  widest_m: 0.1,
  narrowest: null,
  reached_share: 1,
  repairs: [],
};

function evaluation(
  id: string,
  stage: JobStage,
  done: number,
  delivered: number,
): EvaluationSummary {
  const cell = {
    controller: 'rl',
    map: 'mine',
    disturbances: 0,
    program: null,
    varied: [],
  } as const;
  return {
    id,
    query: {
      controllers: ['rl'],
      maps: ['mine'],
      disturbances: [0],
      episodes: 5,
      seed: 1,
      rl_policy: 'explorer',
      program: null,
      vary: [],
    },
    stage,
    message: null,
    cells: [{ ...cell, varied: [], done, delivered, elapsed_s: 1, paper: null }],
    rows_done: 0,
  };
}

const line = (words: RegExp) => page.getByText(words);
const train = page.getByRole('button', { name: 'Train a policy on it' });

/** The page after a drawing was opened; each evaluation has the answer that is given for its policy. */
async function open(answerTo: (policy: string) => unknown) {
  const asked: string[] = [];
  const { lab, server } = fakeLab({
    'POST /api/maps': () => REPORT,
    'POST /api/evaluations': (body: string) => {
      const { rl_policy } = JSON.parse(body) as { rl_policy: string };
      asked.push(rl_policy);
      return answerTo(rl_policy);
    },
  });
  show(() => <OpenMap lab={lab} opener={createMapOpener(lab)} onTrain={() => undefined} />);
  await expect.element(page.getByRole('button', { name: 'Open SVG…' })).toBeEnabled();
  server.lists({
    policies: [
      policy('colon', ['colon']),
      policy('explorer', ['tubes', 'trees']),
      policy('general', ['colon', 'posts']),
      policy('mine', ['a', 'b']),
    ],
  });
  await userEvent.upload(
    page.getByLabelText('Drawing of the map'),
    new File(['<svg/>'], 'mine.svg'),
  );
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  server.load();
  return { server, asked };
}

it('tries a shipped policy that knows more than one map, and no other if it solves this one', async () => {
  const { server, asked } = await open((name) => evaluation(name, 'waiting', 0, 0));
  await expect.element(line(/^The shipped policy explorer is tried: 0 of 5/)).toBeVisible();
  server.lists({ evaluations: [evaluation('explorer', 'running', 3, 3)] });
  await expect.element(line(/^The shipped policy explorer is tried: 3 of 5/)).toBeVisible();
  server.lists({ evaluations: [evaluation('explorer', 'done', 5, 5)] });
  await expect.element(line(/^The shipped policy explorer solves this map: 5 of 5/)).toBeVisible();
  await expect.element(train).not.toHaveClass('primary');
  expect(asked).toEqual(['explorer']);
  await page.getByRole('button', { name: 'Let explorer carry' }).click();
  await expect.poll(() => server.command('configure')?.parameters.rl_policy).toBe('explorer');
  server.done();
  await expect.poll(() => server.command('select_controller')?.controller).toBe('rl');
});

it('leads to the training when no shipped policy solves the map', async () => {
  const { server, asked } = await open((name) => evaluation(name, 'waiting', 0, 0));
  await expect.poll(() => asked).toEqual(['explorer']);
  server.lists({ evaluations: [evaluation('explorer', 'done', 5, 4)] });
  await expect.poll(() => asked).toEqual(['explorer', 'general']);
  await expect
    .element(line(/^The shipped policy explorer does not solve this map: 4/))
    .toBeVisible();
  await expect.element(train).not.toHaveClass('primary');
  server.lists({
    evaluations: [evaluation('explorer', 'done', 5, 4), evaluation('general', 'done', 5, 3)],
  });
  await expect
    .element(line(/^The shipped policy general does not solve this map: 3/))
    .toBeVisible();
  await expect.element(train).toHaveClass('primary');
});

it('says why no policy could be tried', async () => {
  await open(() => refusal('the queue is full'));
  await expect.element(line(/general could not be tried: the queue is full/)).toBeVisible();
  await expect.element(train).not.toHaveClass('primary');
});

it('forgets the trials when the report is dismissed, and tries no other policy', async () => {
  const { server, asked } = await open((name) => evaluation(name, 'waiting', 0, 0));
  await expect.poll(() => asked).toEqual(['explorer']);
  server.lists({ evaluations: [evaluation('explorer', 'running', 1, 1)] });
  await expect.element(line(/1 of 5 trials/)).toBeVisible();
  await page.getByRole('button', { name: 'Dismiss the report' }).click();
  await expect.element(line(/of 5 trials/)).not.toBeInTheDocument();
  server.lists({ evaluations: [evaluation('explorer', 'done', 5, 0)] });
  await expect.element(line(/of 5/)).not.toBeInTheDocument();
  expect(asked).toEqual(['explorer']);
});
