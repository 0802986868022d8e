import { expect, test } from 'vitest';
import { keptAtHome } from './home';

const HOME = 'http://127.0.0.1:8080';

test('sends requests only to its own server', async () => {
  const requested: string[] = [];
  const kept = keptAtHome((input) => {
    requested.push(input instanceof Request ? input.url : input.toString());
    return Promise.resolve(new Response());
  }, HOME);
  await kept('/api/recordings');
  await kept(new URL('/rerun/re_viewer.js', HOME));
  await kept(new Request(`${HOME}/api/recordings`, { method: 'HEAD' }));
  expect(requested).toEqual([
    '/api/recordings',
    `${HOME}/rerun/re_viewer.js`,
    `${HOME}/api/recordings`,
  ]);
  for (const foreign of [
    'https://tel.rerun.io/api/pog',
    '//example.org/',
    'http://127.0.0.1:8081/',
    'https://127.0.0.1:8080/',
    new Request('https://app.rerun.io/x', { method: 'POST' }),
  ]) {
    expect((await kept(foreign)).status).toBe(403);
  }
  expect(requested).toHaveLength(3);
});
