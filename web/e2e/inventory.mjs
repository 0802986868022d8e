// Every control that the browser tells assistive technology of, and what is wrong with it.

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
/** Chromium's names of what the tests call otherwise. */
const NAMES = { DisclosureTriangle: 'summary', PopUpButton: 'button', ToggleButton: 'button' };
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

/** In the page: where a control is and how large what one may press of it is. */
function measure(index) {
  this.ferryIndex = index;
  const areas = [this, ...(this.labels ?? [])].map((one) => one.getBoundingClientRect());
  const smaller = (area) => Math.min(area.width, area.height);
  const { width, height } = areas.reduce((a, b) => (smaller(b) > smaller(a) ? b : a));
  const list = this.closest('[role=tablist], [role=tree], [role=toolbar]');
  return {
    width,
    height,
    isGone: !this.isConnected,
    // One of a set is reached by Tab, the others by arrows from it.
    set: this.type === 'radio' ? `radio ${this.name}` : (list?.getAttribute('aria-label') ?? ''),
    html: this.outerHTML.slice(0, 120),
  };
}

/** None for what went meanwhile, a notice or a mark. */
async function resolve(cdp, { backendDOMNodeId: backendNodeId }) {
  try {
    return (await cdp.send('DOM.resolveNode', { backendNodeId })).object;
  } catch {
    return undefined;
  }
}

/** All controls on the page now; each element gets its index as `ferryIndex`. */
export async function controls(page) {
  const cdp = await page.context().newCDPSession(page);
  const { nodes } = await cdp.send('Accessibility.getFullAXTree');
  const byId = new Map(nodes.map((node) => [node.nodeId, node]));
  const groupOf = (node) => {
    let at = byId.get(node.parentId);
    while (at && (at.ignored || !GROUPS.has(at.role.value))) at = byId.get(at.parentId);
    return at;
  };
  const found = [];
  for (const node of nodes) {
    const chromium = node.role?.value;
    const role = NAMES[chromium] ?? chromium;
    if (node.ignored || !(ROLES.has(chromium) || NAMES[chromium])) continue;
    const object = await resolve(cdp, node);
    if (!object) continue;
    const { result } = await cdp.send('Runtime.callFunctionOn', {
      objectId: object.objectId,
      functionDeclaration: measure.toString(),
      arguments: [{ value: found.length }],
      returnByValue: true,
    });
    if (result.value.isGone) continue;
    const name = node.name?.value.trim() ?? '';
    const group = groupOf(node);
    found.push({
      ...result.value,
      index: found.length,
      role,
      name,
      key: `${role} ${name}`,
      group: `${group?.nodeId}`,
      groupName: `${group?.role.value ?? 'page'} ${group?.name?.value ?? ''}`.trim(),
      isDisabled: node.properties?.some((one) => one.name === 'disabled' && one.value.value),
    });
  }
  await cdp.detach();
  return found;
}

/** What is wrong with the names and sizes of controls. */
export function faultsOf(all, leastPx) {
  const faults = [];
  const seen = new Map();
  for (const one of all) {
    if (!one.name) faults.push(`${one.role} without a name: ${one.html}`);
    const own = `${one.group} ${one.key}`;
    if (seen.has(own)) faults.push(`two are “${one.key}” in ${one.groupName}`);
    seen.set(own, one);
    // Browsers round borders; half a pixel is not what a finger misses by.
    if (Math.min(one.width, one.height) < leastPx - 0.5) {
      const size = `${one.width.toFixed(0)}×${one.height.toFixed(0)}`;
      faults.push(`${one.key} is ${size} px, less than ${leastPx}`);
    }
  }
  return faults;
}

/**
 * Which of `wanted`, some of `all` that `controls` found just now, Tab does not get to from `opener` on.
 * What is disabled need not be reached.
 */
export async function unreached(page, all, wanted, opener) {
  const missing = new Map();
  for (const one of wanted) if (!one.isDisabled) missing.set(one.set || one.key, one);
  if (missing.size === 0) return [];
  await page.evaluate(() => {
    window.ferryFocused = new Set();
    window.ferryListens ??=
      document.addEventListener(
        'focusin',
        ({ target }) => window.ferryFocused.add(target.ferryIndex),
        true,
      ) ?? true;
  });
  if (opener) await opener.focus();
  const stops = await page.evaluate(
    () => document.querySelectorAll('button, input, select, summary, a, [tabindex]').length,
  );
  const ROUND = 16;
  for (let pressed = 0; pressed < 1.2 * stops + ROUND && missing.size > 0; pressed += ROUND) {
    for (let i = 0; i < ROUND; i++) await page.keyboard.press('Tab');
    const focused = new Set(await page.evaluate(() => [...window.ferryFocused]));
    for (const one of all) if (focused.has(one.index)) missing.delete(one.set || one.key);
  }
  // A message goes by itself meanwhile.
  const there = new Set(
    await page.evaluate(() => [...document.querySelectorAll('*')].map((one) => one.ferryIndex)),
  );
  return [...missing.values()]
    .filter(({ index }) => there.has(index))
    .map((one) => `Tab does not get to ${one.key}`);
}
