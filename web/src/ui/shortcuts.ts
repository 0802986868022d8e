// The page's keys: one list, one listener, and the words of the help.

export interface Shortcut {
  /** As `KeyboardEvent.key` names them; any of them will do. */
  readonly keys: readonly string[];
  readonly does: string;
  readonly group: string;
  /** None for keys that some panel hears itself while it has the focus. */
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

/** As it stands on the key. */
export function keyName(key: string): string {
  return NAMES[key] ?? (/^[a-z]$/.test(key) ? key.toUpperCase() : key);
}

/** What matters of where a key was pressed. */
export interface Focus {
  /** Text goes there, or a letter chooses. */
  readonly takesText: boolean;
  /** Space presses it, or opens it. */
  readonly takesSpace: boolean;
  /** A dialog has the keyboard for itself. */
  readonly inDialog: boolean;
}

export interface Press {
  readonly key: string;
  readonly repeat: boolean;
  readonly ctrlKey: boolean;
  readonly altKey: boolean;
  readonly metaKey: boolean;
}

/** What a press means where the focus is. Pure. */
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

/** Listens until what is returned is called. A panel that used a key itself has prevented its default. */
export function attachShortcuts(shortcuts: readonly Shortcut[], areOn: () => boolean): () => void {
  const onKey = (event: KeyboardEvent): void => {
    if (event.defaultPrevented || !areOn()) return;
    const shortcut = shortcutFor(shortcuts, event, focusOf(event.target));
    if (!shortcut?.run) return;
    event.preventDefault();
    shortcut.run();
  };
  document.addEventListener('keydown', onKey);
  return () => {
    document.removeEventListener('keydown', onKey);
  };
}
