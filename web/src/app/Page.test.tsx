// The whole page: roles, keys, announcements, dropped files.

import { expect, it } from 'vitest';
import { eventAt } from '../lab/testingFacts';
import { page, userEvent } from 'vitest/browser';
import { fakeServer, show, type FakeServer } from '../lab/testingLab';
import type { TabbedPanel } from '../lab/panels';
import type { MapReport } from '../net/protocol.gen';
import { Page } from './Page';

const REPORT: MapReport = {
  name: 'dropped',
  width_m: 0.58,
  height_m: 0.33,
  walls: 2,
  regions: 1,
  free_m2: 0.18,
  widest_m: 0.2,
  narrowest: null,
  reached_share: 1,
  repairs: [],
};
const TRANSPORT = ['Run', 'Step', 'Reset', 'Disturb'];

const button = (name: string) => page.getByRole('button', { name, exact: true });
const view = (name: string) => page.getByRole('link', { name, exact: true });
const notice = (place: string) => document.querySelector(`[data-place=${place}] .notice`);
const connection = page.getByTestId('connection');
const canvas = page.getByLabelText('Workspace', { exact: true });

/** The page without tips, with a panel of the inspector. */
async function open(answers = {}, panel: TabbedPanel = 'tune'): Promise<FakeServer> {
  localStorage.setItem('ferry.visit', 'done');
  localStorage.setItem('ferry.tips', 'run,drag,goal,controller,scene');
  localStorage.setItem('ferry.panel', panel);
  const server = fakeServer(answers);
  show(() => <Page />);
  await expect.element(connection).toHaveAttribute('data-link', 'live');
  await expect.element(button('Run')).toBeVisible();
  return server;
}

const heightOf = (selector: string): number =>
  document.querySelector(selector)?.getBoundingClientRect().height ?? NaN;

function drop(name: string, text: string): void {
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([text], name));
  document
    .querySelector('main')
    ?.dispatchEvent(new DragEvent('drop', { bubbles: true, dataTransfer }));
}

it('opens as the operator, and every control has a name', async () => {
  await open();
  await expect.element(button('Restore defaults')).toBeVisible();
  await expect.element(connection).toHaveAttribute('data-role', 'operator');
  await expect.element(button('Run')).toBeEnabled();
  await expect.element(page.getByText('Simulation, not safety-rated')).toBeVisible();
  const controls = document.querySelectorAll<HTMLInputElement>('button, input, select, canvas');
  const unnamed = [...controls].filter((one) => {
    const labels = one.labels as NodeListOf<Element> | null | undefined;
    const label = one.getAttribute('aria-label') ?? labels?.[0]?.textContent;
    // A plot is one picture; its parts have no name.
    return !(label ?? one.textContent).trim() && !one.closest('[role=img]');
  });
  expect(controls.length).toBeGreaterThan(50);
  expect(unnamed.map((one) => one.outerHTML)).toEqual([]);
});

it("has none of the operator's controls for a viewer, and says why", async () => {
  const server = await open();
  for (const name of TRANSPORT) await expect.element(button(name)).toBeEnabled();
  server.hello({ role: 'viewer' });
  await expect.element(page.getByText('Another browser steers.')).toBeVisible();
  for (const name of TRANSPORT) await expect.element(button(name)).not.toBeInTheDocument();
  for (const name of ['Restore defaults', 'Clear goal'])
    await expect.element(button(name)).toBeDisabled();
  const fields = [
    ...document.querySelectorAll('.parameters :is(input:not([name=magnet-side]), select)'),
  ];
  expect(fields.length).toBeGreaterThan(10);
  expect(fields.filter((field) => !field.matches(':disabled'))).toEqual([]);
  await canvas.click();
  await expect.poll(() => notice('workspace')?.textContent).toContain('Take control');
  expect(server.command('set_goal')).toBeUndefined();
});

it('shows why a goal is refused, and sends none beside the table', async () => {
  const server = await open();
  const { width, height } = canvas.element().getBoundingClientRect();
  await canvas.click({ position: { x: width / 2, y: height / 2 } });
  await expect.poll(() => server.command('set_goal')).toBeDefined();
  server.refuse('in_wall', 'The goal is in a wall.');
  await expect.poll(() => notice('workspace')?.textContent).toContain('is in a wall');
  const atPress = document.querySelector('.moment[data-kind=refused]');
  expect(atPress?.textContent).toContain('is in a wall');
  const before = server.sent.length;
  await canvas.click({ position: { x: width / 2, y: 2 } });
  expect(server.sent.length).toBe(before);
});

it('reports a lost connection', async () => {
  const server = await open();
  server.disconnect();
  await expect.element(connection).toHaveAttribute('data-link', 'lost');
  await expect.element(page.getByText('No connection: reconnecting')).toBeVisible();
  await expect.element(button('Run')).toBeDisabled();
});

it('runs shortcuts anywhere', async () => {
  const server = await open();
  const { keyboard } = userEvent;
  await keyboard('.');
  await expect.poll(() => server.command('step')?.ticks).toBe(1);
  await keyboard(',');
  await expect.poll(() => server.command('step')?.ticks).toBe(32);
  await keyboard(']');
  await expect.poll(() => server.command('set_speed')?.factor).toBe(2);
  server.state({ speed_target: 2 });
  await expect.element(page.getByLabelText('Speed', { exact: true })).toHaveValue('2');
  await keyboard('[[');
  await expect.poll(() => server.command('set_speed')?.factor).toBe(1);
  for (const [key, controller] of [
    ['2', 'errt'],
    ['3', 'attractor'],
  ] as const) {
    await keyboard(key);
    await expect.poll(() => server.command('select_controller')?.controller).toBe(controller);
  }
  await keyboard(' ');
  await expect.poll(() => server.command('run')).toBeDefined();
  server.state({ running: true });
  server.done();
  await expect.poll(() => notice('workspace')?.textContent).toContain('No goal is set');
  await expect.element(button('Pause')).toBeVisible();
  await keyboard(' ');
  await expect.poll(() => server.command('pause')).toBeDefined();
  await keyboard('g');
  await expect.element(canvas).toHaveFocus();
  await keyboard('r');
  await expect.poll(() => server.command('reset')).toBeDefined();
});

it('runs no shortcut while typing, behind the help, or when they are off', async () => {
  const server = await open();
  const { keyboard } = userEvent;
  await page.getByTitle('Set up: map, preset, seed').click();
  const seed = page.getByLabelText('Seed', { exact: true });
  await seed.click();
  await keyboard('2rg');
  await expect.element(seed).toHaveFocus();

  const plots = button('Plots');
  (plots.element() as HTMLElement).focus();
  await keyboard('?');
  const help = page.getByRole('dialog', { name: 'Help' });
  await expect.element(help.getByText('grab or release the bead')).toBeVisible();
  await keyboard('r');
  await keyboard('{Escape}');
  await expect.element(plots).toHaveFocus();

  await button('Help').click();
  await help.getByRole('checkbox').click();
  await keyboard('{Escape}');
  await keyboard('.');
  expect(server.sent).toEqual([]);
  await button('Step').click();
  await expect.poll(() => server.command('step')?.ticks).toBe(1);
  await button('Help').click();
  await help.getByRole('checkbox').click();
  await help.getByRole('button', { name: 'Close' }).click();
  await keyboard(',');
  await expect.poll(() => server.command('step')?.ticks).toBe(32);
});

it('announces events and roles one at a time', async () => {
  const server = await open({}, 'story');
  const said: [at_ms: number, text: string][] = [];
  const region = page.getByTestId('live-region').element();
  new MutationObserver(() => said.push([performance.now(), region.textContent])).observe(region, {
    characterData: true,
    childList: true,
    subtree: true,
  });
  for (let tick = 1; tick <= 3; tick++) {
    const kick = { code: 'kicked', impulse_n_s: 0.0008 } as const;
    server.tell({ type: 'event', ...eventAt(tick, 'disturbance', kick) });
  }
  await expect.poll(() => said.at(-1)?.[1]).toContain('a kick of 0.80 mN·s');
  server.hello({ role: 'viewer' });
  await expect.poll(() => said.at(-1)?.[1]).toBe('You are watching.');
  server.hello();
  await expect.poll(() => said.at(-1)?.[1]).toBe('You have control.');
  said.slice(1).forEach(([at], index) => {
    expect(at - (said[index]?.[0] ?? 0), 'milliseconds apart').toBeGreaterThan(700);
  });
  await expect.element(page.getByRole('log')).toHaveAttribute('aria-live', 'off');
});

it('takes a drawing that is dropped in another view', async () => {
  const server = await open({ 'POST /api/maps': () => REPORT });
  server.hello({ role: 'viewer' });
  await expect.element(button('Run')).not.toBeInTheDocument();
  await view('Recordings').click();
  drop('Dropped.SVG', '<svg/>');
  await expect
    .poll(() => notice('transport')?.textContent)
    .toContain('Take control to open a map.');
  server.hello();
  await expect.element(button('Run')).toBeEnabled();
  await view('Recordings').click();
  drop('Dropped.SVG', '<svg/>');
  await expect.poll(() => server.command('load_scenario')?.map).toBe('dropped');
  server.scene({ map: 'dropped' });
  await expect.element(page.getByText('580 × 330 mm, 2 walls.')).toBeVisible();
  await expect.element(view('Lab')).toHaveAttribute('aria-current', 'page');
});

it('has Run among the first ten stops of the Tab key', async () => {
  await open();
  const stops: (string | undefined)[] = [];
  while (stops.length < 10 && stops.at(-1) !== 'Run') {
    await userEvent.tab();
    stops.push(document.activeElement?.textContent.trim());
  }
  expect(stops).toContain('Run');
});

it('keeps the scale of the map, whatever is open', async () => {
  await open({}, 'now');
  const box = document.querySelector('.map-box');
  const size = (): number[] => {
    const { width, height } = box?.getBoundingClientRect() ?? { width: NaN, height: NaN };
    return [Math.round(width), Math.round(height)];
  };
  const { documentElement: whole } = document;
  const beyond = () => [whole.scrollWidth - innerWidth, whole.scrollHeight - innerHeight];
  for (const [width, height] of [
    [1280, 800],
    [1440, 900],
    [2560, 1440],
  ] as const) {
    await page.viewport(width, height);
    await expect.poll(beyond, { message: `px beyond ${width}×${height}` }).toEqual([0, 0]);
    const first = size();
    expect(first[1]).toBeGreaterThanOrEqual(0.6 * height);
    for (const press of [
      button('Plots'),
      button('Hide the panel'),
      button('Plots'),
      button('Show the panel'),
      button('Layers'),
      button('Layers'),
      page.getByRole('tab', { name: 'Test' }),
    ]) {
      await press.click();
      expect(size()).toEqual(first);
      expect(beyond()).toEqual([0, 0]);
    }
    await page.getByRole('tab', { name: 'Now' }).click();
  }
  await page.viewport(1280, 800);
});

it('has a panel as a sheet over half of the map on a phone', async () => {
  await page.viewport(390, 844);
  await open({}, 'now');
  expect(document.documentElement.scrollWidth).toBeLessThanOrEqual(390);
  expect(document.querySelector('.inspector')).toBeNull();
  await button('Story').click();
  await expect.poll(() => heightOf('.inspector')).toBeGreaterThan(200);
  const half = 0.53 * heightOf('.stage');
  expect(heightOf('.inspector')).toBeLessThan(half);
  const handle = button('Whole height');
  await userEvent.click(handle);
  await expect.element(handle).toHaveAttribute('aria-expanded', 'true');
  await expect.poll(() => heightOf('.inspector')).toBeGreaterThan(0.9 * heightOf('.stage'));
  const pull = (down_px: number): void => {
    const { left, top } = handle.element().getBoundingClientRect();
    const at = (type: string, clientY: number): void => {
      const event = { bubbles: true, pointerId: 1, clientX: left + 1, clientY };
      handle.element().dispatchEvent(new PointerEvent(type, event));
    };
    handle.element().setPointerCapture = () => undefined;
    at('pointerdown', top);
    at('pointerup', top + down_px);
  };
  pull(200);
  await expect.poll(() => heightOf('.inspector')).toBeLessThan(half);
  pull(-200);
  await expect.element(handle).toHaveAttribute('aria-expanded', 'true');
  pull(200);
  pull(200);
  await expect.poll(() => document.querySelector('.inspector')).toBeNull();
  await button('Story').click();
  await button('Steer').click();
  await expect.poll(() => document.querySelector('.inspector')).toBeNull();
  await page.viewport(1280, 800);
});
