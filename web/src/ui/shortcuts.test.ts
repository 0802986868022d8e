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

function found(press: Partial<Press>, focus: Partial<Focus> = {}): string | undefined {
  const whole = { key: '', repeat: false, ctrlKey: false, altKey: false, metaKey: false, ...press };
  return shortcutFor(LIST, whole, { ...NOWHERE, ...focus })?.does;
}

describe('a shortcut', () => {
  it('works everywhere, also with capital letters', () => {
    expect(found({ key: ' ' })).toBe('run');
    expect(found({ key: 'R' })).toBe('reset');
    expect(found({ key: '+' })).toBe('faster');
  });

  it('does not work in a text field, in a dialog, or as a repeated key', () => {
    expect(found({ key: 'r' }, { takesText: true })).toBeUndefined();
    expect(found({ key: 'r' }, { inDialog: true })).toBeUndefined();
    expect(found({ key: 'r', repeat: true })).toBeUndefined();
  });

  it('leaves Space to focused buttons', () => {
    expect(found({ key: ' ' }, { takesSpace: true })).toBeUndefined();
    expect(found({ key: 'r' }, { takesSpace: true })).toBe('reset');
  });

  it("ignores the browser's own keys, but accepts AltGr", () => {
    expect(found({ key: 'r', ctrlKey: true })).toBeUndefined();
    expect(found({ key: 'r', metaKey: true })).toBeUndefined();
    expect(found({ key: ']', ctrlKey: true, altKey: true })).toBe('faster');
  });

  it('leaves keys of a panel to the panel', () => {
    expect(found({ key: 'd' })).toBeUndefined();
  });
});
