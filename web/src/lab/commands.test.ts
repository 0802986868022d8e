import { expect, it } from 'vitest';
import type { Numbered } from '../net/connection';
import { Commands } from './commands';

function open(isOpen = true) {
  const sent: Numbered[] = [];
  const commands = new Commands((message) => {
    sent.push(message);
    return isOpen;
  });
  return { commands, sent };
}

it('gives each command its own answer', async () => {
  const { commands, sent } = open();
  const run = commands.send('playback', { type: 'run' });
  const goal = commands.send('workspace', { type: 'set_goal', x_m: 9, y_m: 0 });
  expect(sent.map(({ id }) => id)).toEqual([1, 2]);
  expect(commands.placeOf(2)).toBe('workspace');
  const refusal = {
    id: 2,
    code: 'outside_workspace',
    field: 'x_m',
    values: { x_m: 9 },
    detail: 'No.',
  } as const;
  commands.answer({ type: 'refused', ...refusal });
  commands.answer({ type: 'done', id: 1, trial: 4 });
  expect(await run).toEqual({ kind: 'done', trial: 4 });
  expect(await goal).toMatchObject({ kind: 'refused', refusal });
});

it('does not know what became of a command when the connection is lost, and sends it no more', async () => {
  const { commands, sent } = open();
  const run = commands.send('playback', { type: 'run' });
  commands.lose();
  expect(await run).toEqual({ kind: 'unknown' });
  expect(sent).toHaveLength(1);
  expect(await open(false).commands.send('playback', { type: 'run' })).toEqual({ kind: 'unknown' });
});
