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
  it('works everywhere, also with capital letters', () => {
    expect(heard({ key: ' ' })).toBe('run');
    expect(heard({ key: 'R' })).toBe('reset');
    expect(heard({ key: '+' })).toBe('faster');
  });

  it('does not work in a text field, in a dialog, or as a repeated key', () => {
    expect(heard({ key: 'r' }, { takesText: true })).toBeUndefined();
    expect(heard({ key: 'r' }, { inDialog: true })).toBeUndefined();
    expect(heard({ key: 'r', repeat: true })).toBeUndefined();
  });

  it('leaves Space to focused buttons', () => {
    expect(heard({ key: ' ' }, { takesSpace: true })).toBeUndefined();
    expect(heard({ key: 'r' }, { takesSpace: true })).toBe('reset');
  });

  it("ignores the browser's own keys, but accepts AltGr", () => {
    expect(heard({ key: 'r', ctrlKey: true })).toBeUndefined();
    expect(heard({ key: 'r', metaKey: true })).toBeUndefined();
    expect(heard({ key: ']', ctrlKey: true, altKey: true })).toBe('faster');
  });

  it('leaves keys of a panel to the panel', () => {
    expect(heard({ key: 'd' })).toBeUndefined();
  });
});
