// The keyboard shortcuts of the page: one list for the listener and the help.

export interface Shortcut {
  /** Values of `KeyboardEvent.key`; each of them works. */
  readonly keys: readonly string[];
  readonly does: string;
  readonly group: string;
  /** Undefined for keys that a panel handles itself while it has the focus. */
  readonly run?: () => void;
}

const NAMES: Partial<Record<string, string>> = {
  ' ': 'Space',
  ArrowLeft: '←',
  ArrowRight: '→',
  ArrowUp: '↑',
  ArrowDown: '↓',
  Escape: 'Esc',
};

/** The label on the key. */
export function keyName(key: string): string {
  return NAMES[key] ?? (/^[a-z]$/.test(key) ? key.toUpperCase() : key);
}

/** Properties of the focused element. */
export interface Focus {
  /** It takes text, or letters select an option. */
  readonly takesText: boolean;
  /** Space presses or opens it. */
  readonly takesSpace: boolean;
  /** It is in a dialog, which handles all keys. */
  readonly inDialog: boolean;
}

export type Press = Pick<KeyboardEvent, 'key' | 'repeat' | 'ctrlKey' | 'altKey' | 'metaKey'>;

/** The shortcut of a key press with the present focus. Pure. */
export function shortcutFor(
  shortcuts: readonly Shortcut[],
  press: Press,
  focus: Focus,
): Shortcut | undefined {
  if (press.repeat || focus.takesText || focus.inDialog) return undefined;
  if (press.key === ' ' && focus.takesSpace) return undefined;
  // Some keyboards reach [ and ] with AltGr, which counts as Control and Alt together.
  const isAltGr = press.ctrlKey && press.altKey;
  if (press.metaKey || (!isAltGr && (press.ctrlKey || press.altKey))) return undefined;
  const key = press.key.length === 1 ? press.key.toLowerCase() : press.key;
  return shortcuts.find(({ keys, run }) => run && keys.includes(key));
}

const TEXT = 'input:not([type=range], [type=radio], [type=checkbox]), select, textarea';

export function focusOf(target: EventTarget | null): Focus {
  if (!(target instanceof Element)) {
    return { takesText: false, takesSpace: false, inDialog: false };
  }
  return {
    takesText:
      target.closest(TEXT) !== null || (target instanceof HTMLElement && target.isContentEditable),
    takesSpace: target.closest('button, input:not([type=range]), summary, a') !== null,
    inDialog: target.closest('dialog') !== null,
  };
}

/** Listens until the returned function is called. A panel that handles a key itself prevents its default. */
export function attachShortcuts(shortcuts: readonly Shortcut[], areOn: () => boolean): () => void {
  const onKey = (event: KeyboardEvent): void => {
    if (event.defaultPrevented || !areOn()) return;
    const shortcut = shortcutFor(shortcuts, event, focusOf(event.target));
    if (!shortcut?.run) return;
    event.preventDefault();
    shortcut.run();
  };
  document.addEventListener('keydown', onKey);
  return () => document.removeEventListener('keydown', onKey);
}
