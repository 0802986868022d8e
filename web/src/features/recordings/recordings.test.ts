import { expect, test } from 'vitest';
import { filePath, label, size, startedAt } from './recordings';

test.each([
  [0, '0.0 kB'],
  [7036, '7.0 kB'],
  [99_949, '99.9 kB'],
  [99_960, '100 kB'],
  [999_400, '999 kB'],
  [999_600, '1.0 MB'],
  [12_345_678, '12.3 MB'],
  [3_210_000_000, '3.2 GB'],
  [5e15, '5000 TB'],
])('%d bytes are shown as %s', (bytes, text) => {
  expect(size(bytes)).toBe(text);
});

test('a time is shown in the local time zone', () => {
  expect(startedAt('2026-03-01T21:04:09.045Z', 'en-GB', 'Europe/Oslo')).toEqual({
    day: '1 Mar 2026',
    time: '22:04:09',
  });
});

test('a foreign file is shown with its name', () => {
  const stray = {
    id: 'a b',
    session: null,
    started: null,
    bytes: 1,
    log_bytes: null,
    live: false,
    title: null,
    content: null,
  };
  expect(label(stray)).toBe('a b');
  expect(filePath(stray.id, 'rrd')).toBe('/api/recordings/a%20b.rrd');
});
