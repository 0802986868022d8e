// Measures the hand: the time from a movement of the pointer to the picture of the state that follows it.

import { type Page, expect } from '@playwright/test';
import type { StateMessage } from '../../src/net/protocol.gen';
import { Lab } from './lab';
import { tellTick } from './shown';
import { type Point, distance } from './table';
import { must, until } from './wait';

/** Times of one input, in milliseconds of the page's clock. */
interface Input {
  x_m: number;
  y_m: number;
  event_ms: number;
  sent_ms: number;
  /** When a state arrived that has this target or a later one. */
  received_ms?: number;
  /** When the frame that drew that state was finished. */
  drawn_ms?: number;
  /** When the frame after it began: by then the browser has taken the picture. */
  shown_ms?: number;
}

declare global {
  interface Window {
    ferryHand: Input[];
  }
}

/** Upper limit of `hand_p95_ms`, with one browser beside three sessions without one, on a machine that does nothing else. */
export const HAND_BUDGET_MS = 50;
const INPUTS = 220;
/** Long enough that the 60 messages per second of the hand are no limit. */
const PAUSE_MS = { least: 40, most: 180 };
/** How far the pointer moves from the tool's first place. */
const REACH_M = 0.03;
/** Slow, so that no session delivers during a measurement. */
const SLOW = 'seed=1&transport_speed_m_s=0.01&step_limit=5000';
const COMPANIONS = [
  ['rl', 'colon'],
  ['errt', 'colon'],
  ['attractor', 'posts'],
] as const;

/**
 * Runs in the page before the page's scripts. A pointer event belongs to the message `steer` that is sent while it is
 * handled. A state belongs to the message with its `steer_m`, and to the messages before that one. It is drawn in the
 * frame that writes its tick.
 */
function probe() {
  window.ferryHand = [];
  let event_ms: number | undefined;
  // The page's own listeners run later in the same dispatch.
  for (const type of ['pointerrawupdate', 'pointermove']) {
    window.addEventListener(type, ({ timeStamp }) => (event_ms = timeStamp), true);
  }
  const Native = window.WebSocket;
  window.WebSocket = class extends Native {
    constructor(...all: ConstructorParameters<typeof WebSocket>) {
      super(...all);
      this.addEventListener('message', ({ data }: MessageEvent<unknown>) => {
        const now = performance.now();
        const isState = typeof data === 'string' && data.startsWith('{"type":"state"');
        if (!isState || window.ferryHand.at(-1)?.received_ms !== undefined) return;
        const { steer_m } = JSON.parse(data) as { steer_m: [number, number] | null };
        if (!steer_m) return;
        const at = window.ferryHand.findLastIndex(
          ({ x_m, y_m }) => Math.hypot(x_m - steer_m[0], y_m - steer_m[1]) < 1e-6,
        );
        for (const one of window.ferryHand.slice(0, at + 1)) one.received_ms ??= now;
      });
    }

    override send(data: string) {
      if (data.startsWith('{"type":"steer"') && event_ms !== undefined) {
        const { x_m, y_m } = JSON.parse(data) as { x_m: number; y_m: number };
        window.ferryHand.push({ x_m, y_m, event_ms, sent_ms: performance.now() });
        event_ms = undefined;
      }
      super.send(data);
    }
  };

  const request = window.requestAnimationFrame.bind(window);
  const channel = new MessageChannel();
  let drawing: Input[] = [];
  channel.port1.onmessage = () => {
    for (const one of drawing) one.drawn_ms ??= performance.now();
    drawing = [];
  };
  window.ferryShown(() => {
    const inputs = window.ferryHand.filter(
      ({ received_ms, shown_ms }) => received_ms !== undefined && shown_ms === undefined,
    );
    if (inputs.length === 0) return;
    drawing.push(...inputs);
    channel.port2.postMessage(undefined);
    request((now) => {
      for (const one of inputs) one.shown_ms ??= now;
    });
  });
}

/** Must be called before the page is opened. */
export async function attachHand(page: Page) {
  await page.addInitScript(tellTick);
  await page.addInitScript(probe);
}

type Open = () => Promise<{ name: string; lab: Lab }>;

/** Starts sessions that carry a bead slowly, and closes their pages. Returns their names. */
async function startCompanions(open: Open) {
  const names: string[] = [];
  for (const [controller, map] of COMPANIONS) {
    const { name, lab } = await open();
    names.push(name);
    const { trial } = lab.scene;
    await lab.page.evaluate((hash) => {
      location.hash = hash;
    }, `#v=1&map=${map}&controller=${controller}&${SLOW}`);
    await until('the experiment', () => lab.scene.trial > trial && lab.scene.map === map);
    await lab.drawn();
    await lab.setGoal(must(lab.freePoints(await lab.bead(), 0.3, 0.6).at(-1), 'a goal'));
    await lab.run();
    await until('transport', () => lab.state.leg_steps > 2);
    await lab.page.close();
  }
  return names;
}

interface Summary {
  running: boolean;
  viewers: number;
}

async function statesOf(origin: string, names: readonly string[]) {
  const read = async (path: string): Promise<unknown> =>
    (await fetch(`${origin}/api/sessions/${path}`)).json();
  return Promise.all(
    names.map(async (name) => ({
      ...((await read(name)) as Summary),
      ...((await read(`${name}/state`)) as Pick<StateMessage, 'deliveries' | 'phase'>),
    })),
  );
}

/** Companions carry all the time, without a browser. */
async function expectAtWork(origin: string, names: readonly string[]) {
  const idle = (await statesOf(origin, names)).filter(
    ({ running, viewers, phase, deliveries }) =>
      !running ||
      viewers > 0 ||
      deliveries > 0 ||
      !['transporting', 'approaching'].includes(phase.code),
  );
  expect(idle).toEqual([]);
}

/** Points to places around the tool at random moments. */
async function movePointer(lab: Lab, count: number) {
  const { mouse } = lab.page;
  const tool: Point = [lab.state.tool_m[0], lab.state.tool_m[1]];
  const [x, y] = await lab.px(tool);
  const [edge] = await lab.px([tool[0] + REACH_M, tool[1]]);
  const reach_px = edge - x;
  await mouse.move(x, y);
  await mouse.down();
  await until('the hand', () => lab.state.steer_m && distance(lab.state.steer_m, tool) < 0.005);
  await lab.page.evaluate(() => (window.ferryHand.length = 0));
  for (let input = 0; input < count; input++) {
    const angle = 2 * Math.PI * Math.random();
    const away = reach_px * Math.sqrt(Math.random());
    await mouse.move(x + away * Math.cos(angle), y + away * Math.sin(angle));
    const pause_ms = PAUSE_MS.least + (PAUSE_MS.most - PAUSE_MS.least) * Math.random();
    // A plain delay: the moment must be random, and there is no condition to wait for.
    await new Promise((resolve) => setTimeout(resolve, pause_ms));
  }
  await lab.drawn();
  await mouse.up();
  return lab.page.evaluate(() => window.ferryHand);
}

function quantiles(values: readonly number[]) {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (share: number) =>
    sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? NaN;
  return { p50_ms: at(0.5), p95_ms: at(0.95), p99_ms: at(0.99) };
}

const PARTS = {
  'event to send': ['event_ms', 'sent_ms'],
  'send to state': ['sent_ms', 'received_ms'],
  'state to drawn': ['received_ms', 'drawn_ms'],
  'drawn to shown': ['drawn_ms', 'shown_ms'],
  'event to drawn': ['event_ms', 'drawn_ms'],
  'event to shown': ['event_ms', 'shown_ms'],
} as const;

export type HandFigures = Record<keyof typeof PARTS, ReturnType<typeof quantiles>> & {
  inputs: number;
};

function figuresOf(inputs: readonly Input[]): HandFigures {
  const entries = Object.entries(PARTS).map(([name, [from, to]]) => [
    name,
    // One that was never shown counts as infinitely late.
    quantiles(inputs.map((one) => (one[to] ?? Infinity) - (one[from] ?? 0))),
  ]);
  return { inputs: inputs.length, ...Object.fromEntries(entries) } as HandFigures;
}

export const handWords = ({ inputs, ...parts }: HandFigures) =>
  [
    `${inputs} inputs`,
    ...Object.entries(parts).map(([name, { p50_ms, p95_ms, p99_ms }]) => {
      const [p50, p95, p99] = [p50_ms, p95_ms, p99_ms].map((value) => value.toFixed(1));
      return `${name} p50 ${p50}, p95 ${p95}, p99 ${p99} ms`;
    }),
  ].join('; ');

/** Steers the session of `lab` by hand, beside three sessions without a browser. */
export async function measureHand(lab: Lab, open: Open, count = INPUTS): Promise<HandFigures> {
  const { origin } = new URL(lab.page.url());
  const names = await startCompanions(open);
  await lab.reset();
  await lab.controller('You');
  await lab.button('Set goal').click();
  await lab.click(must(lab.freePoints(await lab.bead(), 0.3, 0.4).at(-1), 'a goal'));
  await until('the goal', () => lab.state.goal_m);
  await lab.run();
  await expectAtWork(origin, names);
  const inputs = await movePointer(lab, count);
  await expectAtWork(origin, names);
  await lab.pause();
  for (const name of names) await fetch(`${origin}/api/sessions/${name}`, { method: 'DELETE' });
  // Two movements within a frame are one event.
  expect(inputs.length).toBeGreaterThanOrEqual(0.9 * count);
  return figuresOf(inputs);
}
