import { describe, expect, it } from 'vitest';
import { type Focus, type Press, type Shortcut, shortcutFor } from './shortcuts';

const run = (): void => undefined;
const LIST: readonly Shortcut[] = [
  { keys: [' '], does: 'run', group: 'Time', run },
  { keys: [']', '+'], does: 'faster', group: 'Time', run },
  { keys: ['r'], does: 'reset', group: 'Time', run },
  { keys: ['d'], does: 'take', group: 'Workspace' },
];
const NOWHERE: Focus = { takesText: false, takesSpace: false, inDialog: false };

function heard(press: Partial<Press>, focus: Partial<Focus> = {}): string | undefined {
  const whole = { key: '', repeat: false, ctrlKey: false, altKey: false, metaKey: false, ...press };
  return shortcutFor(LIST, whole, { ...NOWHERE, ...focus })?.does;
}

describe('a shortcut', () => {
  it('is heard anywhere, in capitals too', () => {
    expect(heard({ key: ' ' })).toBe('run');
    expect(heard({ key: 'R' })).toBe('reset');
    expect(heard({ key: '+' })).toBe('faster');
  });

  it('is not heard where somebody types, nor in a dialog, nor when it repeats', () => {
    expect(heard({ key: 'r' }, { takesText: true })).toBeUndefined();
    expect(heard({ key: 'r' }, { inDialog: true })).toBeUndefined();
    expect(heard({ key: 'r', repeat: true })).toBeUndefined();
  });

  it('leaves Space to what is pressed with it', () => {
    expect(heard({ key: ' ' }, { takesSpace: true })).toBeUndefined();
    expect(heard({ key: 'r' }, { takesSpace: true })).toBe('reset');
  });

  it("leaves the browser's own keys alone, and hears AltGr", () => {
    expect(heard({ key: 'r', ctrlKey: true })).toBeUndefined();
    expect(heard({ key: 'r', metaKey: true })).toBeUndefined();
    expect(heard({ key: ']', ctrlKey: true, altKey: true })).toBe('faster');
  });

  it('leaves to a panel what the panel hears itself', () => {
    expect(heard({ key: 'd' })).toBeUndefined();
  });
});
