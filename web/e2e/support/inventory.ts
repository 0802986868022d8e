// Lists all controls that the browser reports to assistive technology, and finds their faults:
// missing names, small sizes, no focus by Tab.

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
  isDetached: boolean;
  /** The group that the control belongs to: Tab reaches one member, arrow keys the others. */
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
/** The names in the tests for roles that Chromium names differently. */
const ROLE_NAMES: Record<string, string> = {
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

/** Minimum side of a control. */
export const MIN_SIDE_PX = { mouse: 32, touch: 44 };

/** Runs in the page: measures the area of a control that can be pressed, including its labels. */
function measure(this: HTMLInputElement & Indexed, index: number): Measured {
  this.ferryIndex = index;
  const labels = (this.labels as NodeListOf<HTMLElement> | null | undefined) ?? [];
  const areas = [this, ...labels].map((one) => one.getBoundingClientRect());
  const smaller = (area: DOMRect) => Math.min(area.width, area.height);
  const { width, height } = areas.reduce((a, b) => (smaller(b) > smaller(a) ? b : a));
  const list = this.closest('[role=tablist], [role=tree], [role=toolbar], [role=log]');
  return {
    width,
    height,
    isDetached: !this.isConnected,
    set: this.type === 'radio' ? `radio ${this.name}` : (list?.getAttribute('aria-label') ?? ''),
    html: this.outerHTML.slice(0, 120),
  };
}

/** `undefined` if the element has been removed meanwhile, such as a notice or a mark. */
async function objectOf(cdp: CDPSession, backendNodeId: number | undefined) {
  try {
    if (backendNodeId === undefined) return undefined;
    return (await cdp.send('DOM.resolveNode', { backendNodeId })).object;
  } catch {
    return undefined;
  }
}

/** All controls that are on the page now. Each element gets its index as `ferryIndex`. */
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
  const interactive = nodes.filter(({ ignored, role }) => {
    const chromium = role?.value ?? '';
    return !ignored && (ROLES.has(chromium) || chromium in ROLE_NAMES);
  });
  const measureNode = async (node: AXNode, index: number) => {
    const objectId = (await objectOf(cdp, node.backendDOMNodeId))?.objectId;
    if (!objectId) return undefined;
    const { result } = await cdp.send('Runtime.callFunctionOn', {
      objectId,
      functionDeclaration: measure.toString(),
      arguments: [{ value: index }],
      returnByValue: true,
    });
    return result.value as Measured;
  };
  const sizes = await Promise.all(interactive.map(measureNode));
  const found: Control[] = [];
  for (const [index, node] of interactive.entries()) {
    const measured = sizes[index];
    if (!measured || measured.isDetached) continue;
    const chromium = node.role?.value ?? '';
    const role = ROLE_NAMES[chromium] ?? chromium;
    const name = node.name?.value?.trim() ?? '';
    const group = groupOf(node);
    found.push({
      ...measured,
      index,
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

/** Missing and repeated names, and sides below `minSidePx`. */
export function faultsOf(all: readonly Control[], minSidePx: number) {
  const faults: string[] = [];
  const seen = new Set<string>();
  for (const one of all) {
    if (!one.name) faults.push(`${one.role} without a name: ${one.html}`);
    const own = `${one.group} ${one.key}`;
    if (seen.has(own)) faults.push(`two controls “${one.key}” in ${one.groupName}`);
    seen.add(own);
    // Browsers round borders, so half a pixel is allowed.
    if (Math.min(one.width, one.height) < minSidePx - 0.5) {
      const size = `${one.width.toFixed(0)}×${one.height.toFixed(0)}`;
      faults.push(`${one.key} is ${size} px, less than ${minSidePx}`);
    }
  }
  return faults;
}

/**
 * Presses Tab from `opener` on, and returns the controls of `wanted` that get no focus. `all` is the
 * latest result of `controls`; it contains `wanted`. Disabled controls are skipped.
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
      const record = ({ target }: Event) => window.ferryFocused.add((target as Indexed).ferryIndex);
      document.addEventListener('focusin', record, true);
      window.ferryListens = true;
    }
    return document.querySelectorAll('button, input, select, summary, a, [tabindex]').length;
  });
  if (opener) await opener.focus();
  const ROUND = 16;
  for (let pressed = 0; pressed < 1.2 * stops + ROUND && missing.size > 0; pressed += ROUND) {
    // Without waiting for each: the browser handles the keys in order.
    await Promise.all(Array.from({ length: ROUND }, () => page.keyboard.press('Tab')));
    const focused = new Set(await page.evaluate(() => [...window.ferryFocused]));
    for (const one of all) if (focused.has(one.index)) missing.delete(one.set || one.key);
  }
  // A notice may have been removed meanwhile.
  const present = new Set(
    await page.evaluate(() =>
      [...document.querySelectorAll('*')].map((one: Indexed) => one.ferryIndex),
    ),
  );
  return [...missing.values()]
    .filter(({ index }) => present.has(index))
    .map((one) => `Tab does not reach ${one.key}`);
}
