// Test cases: a saved one opens and repeats its inputs.

import { readFile } from 'node:fs/promises';
import { Buffer } from 'node:buffer';
import { type Lab, expect, test } from './fixtures';
import { dropFile } from './support/drop';
import { distance } from './support/table';
import { until } from './support/wait';

/** The parts of a case that the tests change. */
interface Case {
  scenario: { map: string; seed: number; parameters: Record<string, unknown> };
  inputs: unknown[];
  more?: unknown;
}

async function steps(lab: Lab, count: number) {
  for (let i = 0; i < count; i++) {
    // The page counts the ticks of a step from the tick that it shows.
    await lab.drawn();
    const { tick } = lab.state;
    delete lab.sent.step;
    await lab.button('Step').click({ modifiers: ['Shift'] });
    const { ticks } = await until('a step', () => lab.sent.step);
    await until('its end', () => lab.state.tick === tick + ticks);
  }
  return lab.state;
}

/** Sets a goal, moves the bead half a second later, and saves the trial half a second after that. */
async function makeCase(lab: Lab) {
  await lab.reset();
  const start = await lab.bead();
  await lab.setGoal(lab.freePoints(start, 0.2, 0.4)[0]);
  await steps(lab, 2);
  const [away] = lab.freePoints(await lab.bead(), 0.15, 0.25);
  await lab.startDrag(away);
  await lab.page.mouse.up();
  await until('the bead at its new place', async () => distance(await lab.bead(), away) < 0.01);
  const { tick, world_hash: hash } = await steps(lab, 2);
  await lab.panel('Story');
  const downloading = lab.page.waitForEvent('download');
  await lab.page.getByRole('link', { name: 'Keep as test case' }).click();
  const text = await readFile(await (await downloading).path(), 'utf8');
  const { inputs } = JSON.parse(text) as Case;
  const { seed } = lab.scene;
  return { text, start, tick, hash, goal: lab.state.goal_m, seed, inputs: inputs.length };
}

async function choose(lab: Lab, text: string) {
  await lab.panel('Story');
  const opening = lab.page.waitForEvent('filechooser');
  await lab.button('Open test case…').click();
  const file = { name: 'a.json', mimeType: 'application/json', buffer: Buffer.from(text) };
  await (await opening).setFiles(file);
}

const drop = (lab: Lab, text: string) =>
  dropFile(lab.page, 'Dropped.JSON', 'application/json', text);

/** The laboratory opens, because it shows what the file changes. */
async function dropElsewhere(lab: Lab, text: string) {
  await lab.view('Recordings').click();
  await drop(lab, text);
  await expect(lab.canvas).toBeVisible();
}

test('opens a saved test case and repeats its inputs', async ({ lab }) => {
  const kept = await makeCase(lab);
  for (const openBy of [choose, dropElsewhere]) {
    await lab.map('open');
    await lab.controller('ERRT');
    await openBy(lab, kept.text);
    await until('the case', () => lab.scene.map === 'posts' && lab.scene.case);
    expect(lab.scene.case?.inputs).toBe(kept.inputs);
    expect(lab.scene.seed).toBe(kept.seed);
    await until('its start', () => lab.state.tick === 0 && lab.state.controller === 'attractor');
    expect(distance(await lab.bead(), kept.start)).toBeLessThan(1e-9);
    expect(lab.state.goal_m).toEqual(kept.goal);
    const bar = lab.page.locator('.case-words');
    await expect(bar).toContainText('Test case: attractor on posts, with disturbances by hand.');
    await expect(bar).toContainText(`${kept.inputs} inputs, the last one at 0.5 s.`);
    await expect(bar).toContainText(/Expected: 1 delivered by 1:01\.\d \(open\)\./);
    const { tick, world_hash } = await steps(lab, 4);
    expect({ tick, hash: world_hash }).toEqual({ tick: kept.tick, hash: kept.hash });
    await expect(lab.page.getByTestId('disturbances')).toHaveText('1');
  }
  // A rewind repeats it, too.
  await lab.label('Timeline').press('Home');
  await until('the start', () => lab.state.tick === 0);
  const { tick, world_hash } = await steps(lab, 4);
  expect({ tick, hash: world_hash }).toEqual({ tick: kept.tick, hash: kept.hash });
});
