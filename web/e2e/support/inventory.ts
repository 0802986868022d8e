// All controls that the browser reports to assistive technology, and what is wrong with them.

import type { CDPSession, Locator, Page } from '@playwright/test';

interface AXNode {
  nodeId: string;
  ignored: boolean;
  parentId?: string;
  backendDOMNodeId?: number;
  role?: { value?: string };
  name?: { value?: string };
  properties?: { name: string; value: { value?: unknown } }[];
}

interface Measured {
  width: number;
  height: number;
  isGone: boolean;
  /** One of a set is reached by Tab, the others by arrow keys from it. */
  set: string;
  html: string;
}

export interface Control extends Measured {
  index: number;
  role: string;
  name: string;
  key: string;
  group: string;
  groupName: string;
  isDisabled: boolean;
}

type Indexed = Element & { ferryIndex?: number };

declare global {
  interface Window {
    ferryFocused: Set<number | undefined>;
    ferryListens?: boolean;
  }
}

const ROLES = new Set([
  'application',
  'button',
  'checkbox',
  'combobox',
  'DisclosureTriangle',
  'link',
  'listbox',
  'menuitem',
  'radio',
  'searchbox',
  'slider',
  'spinbutton',
  'switch',
  'tab',
  'textbox',
  'treeitem',
]);
/** Chromium's names of roles that the tests call otherwise. */
const NAMES: Record<string, string> = {
  DisclosureTriangle: 'summary',
  PopUpButton: 'button',
  ToggleButton: 'button',
};
const GROUPS = new Set([
  'alert',
  'article',
  'banner',
  'contentinfo',
  'dialog',
  'form',
  'group',
  'main',
  'navigation',
  'radiogroup',
  'region',
  'tablist',
  'tabpanel',
  'toolbar',
]);

/** Least side of what is pressed: by WCAG for a mouse, and what the page promises to fingers. */
export const LEAST_PX = { mouse: 24, touch: 36 };

/** Runs in the page: where a control is and how large the part is that can be pressed. */
function measure(this: HTMLInputElement & Indexed, index: number): Measured {
  this.ferryIndex = index;
  const labels = (this.labels as NodeListOf<HTMLElement> | null | undefined) ?? [];
  const areas = [this, ...labels].map((one) => one.getBoundingClientRect());
  const smaller = (area: DOMRect) => Math.min(area.width, area.height);
  const { width, height } = areas.reduce((a, b) => (smaller(b) > smaller(a) ? b : a));
  const list = this.closest('[role=tablist], [role=tree], [role=toolbar]');
  return {
    width,
    height,
    isGone: !this.isConnected,
    set: this.type === 'radio' ? `radio ${this.name}` : (list?.getAttribute('aria-label') ?? ''),
    html: this.outerHTML.slice(0, 120),
  };
}

/** `undefined` for what has been removed meanwhile, a notice or a mark. */
async function objectOf(cdp: CDPSession, backendNodeId: number | undefined) {
  try {
    if (backendNodeId === undefined) return undefined;
    return (await cdp.send('DOM.resolveNode', { backendNodeId })).object;
  } catch {
    return undefined;
  }
}

/** All controls on the page now; each element gets its index as `ferryIndex`. */
export async function controls(page: Page): Promise<Control[]> {
  const cdp = await page.context().newCDPSession(page);
  const { nodes } = (await cdp.send('Accessibility.getFullAXTree')) as { nodes: AXNode[] };
  const byId = new Map(nodes.map((node) => [node.nodeId, node]));
  const parentOf = (node: AXNode) => byId.get(node.parentId ?? '');
  const groupOf = (node: AXNode) => {
    let at = parentOf(node);
    while (at && (at.ignored || !GROUPS.has(at.role?.value ?? ''))) at = parentOf(at);
    return at;
  };
  const found: Control[] = [];
  for (const node of nodes) {
    const chromium = node.role?.value ?? '';
    if (node.ignored || !(ROLES.has(chromium) || chromium in NAMES)) continue;
    const objectId = (await objectOf(cdp, node.backendDOMNodeId))?.objectId;
    if (!objectId) continue;
    const { result } = await cdp.send('Runtime.callFunctionOn', {
      objectId,
      functionDeclaration: measure.toString(),
      arguments: [{ value: found.length }],
      returnByValue: true,
    });
    const measured = result.value as Measured;
    if (measured.isGone) continue;
    const role = NAMES[chromium] ?? chromium;
    const name = node.name?.value?.trim() ?? '';
    const group = groupOf(node);
    found.push({
      ...measured,
      index: found.length,
      role,
      name,
      key: `${role} ${name}`,
      group: group?.nodeId ?? '',
      groupName: `${group?.role?.value ?? 'page'} ${group?.name?.value ?? ''}`.trim(),
      isDisabled: (node.properties ?? []).some(
        ({ name: property, value }) => property === 'disabled' && Boolean(value.value),
      ),
    });
  }
  await cdp.detach();
  return found;
}

/** What is wrong with the names and sizes of controls. */
export function faultsOf(all: readonly Control[], leastPx: number) {
  const faults: string[] = [];
  const seen = new Set<string>();
  for (const one of all) {
    if (!one.name) faults.push(`${one.role} without a name: ${one.html}`);
    const own = `${one.group} ${one.key}`;
    if (seen.has(own)) faults.push(`two are “${one.key}” in ${one.groupName}`);
    seen.add(own);
    // Browsers round borders: half a pixel does not count.
    if (Math.min(one.width, one.height) < leastPx - 0.5) {
      const size = `${one.width.toFixed(0)}×${one.height.toFixed(0)}`;
      faults.push(`${one.key} is ${size} px, less than ${leastPx}`);
    }
  }
  return faults;
}

/**
 * Which of `wanted`, some of `all` that `controls` has just found, Tab does not reach from `opener` on.
 * Disabled controls need not be reached.
 */
export async function unreached(
  page: Page,
  all: readonly Control[],
  wanted: readonly Control[],
  opener: Locator | undefined,
) {
  const missing = new Map(
    wanted.filter((one) => !one.isDisabled).map((one) => [one.set || one.key, one]),
  );
  if (missing.size === 0) return [];
  const stops = await page.evaluate(() => {
    window.ferryFocused = new Set();
    if (!window.ferryListens) {
      const note = ({ target }: Event) => window.ferryFocused.add((target as Indexed).ferryIndex);
      document.addEventListener('focusin', note, true);
      window.ferryListens = true;
    }
    return document.querySelectorAll('button, input, select, summary, a, [tabindex]').length;
  });
  if (opener) await opener.focus();
  const ROUND = 16;
  for (let pressed = 0; pressed < 1.2 * stops + ROUND && missing.size > 0; pressed += ROUND) {
    for (let i = 0; i < ROUND; i++) await page.keyboard.press('Tab');
    const focused = new Set(await page.evaluate(() => [...window.ferryFocused]));
    for (const one of all) if (focused.has(one.index)) missing.delete(one.set || one.key);
  }
  // A message may have been removed meanwhile.
  const there = new Set(
    await page.evaluate(() =>
      [...document.querySelectorAll('*')].map((one: Indexed) => one.ferryIndex),
    ),
  );
  return [...missing.values()]
    .filter(({ index }) => there.has(index))
    .map((one) => `Tab does not reach ${one.key}`);
}
