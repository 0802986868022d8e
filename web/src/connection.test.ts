import { describe, expect, it } from 'vitest';
import { backoffMs, liveAddress, readPicture } from './connection';

describe('the address of the socket', () => {
  it('is on the host that served the page', () => {
    expect(liveAddress({ protocol: 'http:', host: '127.0.0.1:8080' }, 'main')).toBe(
      'ws://127.0.0.1:8080/api/sessions/main/live',
    );
    expect(liveAddress({ protocol: 'https:', host: 'lab' }, 'main')).toMatch(/^wss:/);
  });
});

describe('the pause before another attempt', () => {
  it('grows from half a second to eight, and is spread', () => {
    expect(backoffMs(1, 0.5)).toBe(500);
    expect(backoffMs(3, 0.5)).toBe(2000);
    expect(backoffMs(50, 0.5)).toBe(8000);
    expect(backoffMs(1, 0)).toBeLessThan(backoffMs(1, 0.99));
  });
});

describe('a binary frame', () => {
  it('is read as kind, tick and payload', () => {
    const frame = new Uint8Array([2, 0, 0, 0, 1, 2, 0, 0, 7, 8]).buffer;
    const picture = readPicture(frame);
    expect(picture?.kind).toBe(2);
    expect(picture?.tick).toBe(513);
    expect([...(picture?.bytes ?? [])]).toEqual([7, 8]);
  });

  it('is dropped when it is too short', () => {
    expect(readPicture(new ArrayBuffer(7))).toBeUndefined();
  });
});
