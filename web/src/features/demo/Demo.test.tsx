import { expect, it, vi } from 'vitest';
import { page } from 'vitest/browser';
import { fakeLab, show } from '../../lab/testingLab';
import { phaseOf } from '../../lab/testingFacts';
import { Demo } from './Demo';
import { PROGRAMME, SILENCE_MS } from './programme';

const CARRIES = { mode: 2, phase: phaseOf('transporting'), running: true } as const;

it('says nothing of the next part until its trial has come', async () => {
  const { lab, server } = fakeLab();
  server.lists({ maps: ['colon', 'posts'] });
  let now_ms = performance.now();
  vi.spyOn(performance, 'now').mockImplementation(() => now_ms);
  show(() => (
    <Demo lab={lab} onBegin={() => undefined}>
      <div />
    </Demo>
  ));
  const said = (): (string | undefined)[] =>
    ['.demo-badge', '.demo-caption'].map((part) => document.querySelector(part)?.textContent);
  const goal_m: [number, number, number] = [0, -0.3, 0];

  // What the session does when the page comes, for example after a reload.
  await expect.poll(() => lab.canOperate()).toBe(true);
  server.state({ ...CARRIES, controller: 'errt', goal_m, tick: 500, newest_tick: 500 });
  await expect.poll(() => server.command('load_scenario')).toBeDefined();
  await expect.poll(said).toEqual(['ERRT, a planner', 'ERRT carries the bead to its goal.']);

  server.load();
  server.state({ ...CARRIES, mode: 1, phase: phaseOf('approaching') });
  await expect.poll(said).toEqual(['Fetching', PROGRAMME[0]?.title]);
  server.state({ ...CARRIES, leg_steps: 20 });
  now_ms += 3000;
  await expect.poll(said).toEqual(['RL, a neural network', PROGRAMME[0]?.cues[0]?.caption]);
  server.state({ mode: 1, phase: phaseOf('approaching') });
  await expect.poll(said).toEqual(['Fetching', 'The arm flies to the bead.']);

  // A visitor comes and goes: the next part has another controller.
  server.state({ ...CARRIES });
  document.body.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true }));
  await expect.poll(said).toEqual(['RL, a neural network', expect.stringMatching(/^You are in/)]);
  const before = server.sent.length;
  now_ms += SILENCE_MS + 1;
  await expect.poll(() => server.sent.slice(before).map(({ type }) => type)).toContain('run');
  await expect.poll(said).toEqual(['RL, a neural network', 'RL carries the bead to its goal.']);
  server.load();
  server.state({ ...CARRIES });
  await expect.poll(said).toEqual(['ERRT, a planner', PROGRAMME[1]?.title]);

  server.disconnect();
  await expect.element(page.getByText('One moment, please.')).toBeVisible();
  expect(said()[0], 'no badge').toBeUndefined();
  vi.restoreAllMocks();
});
