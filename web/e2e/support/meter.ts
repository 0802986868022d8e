// Measures the page: script time per frame, delay from a message to the screen, and memory.

import { type CDPSession, type Page, expect } from '@playwright/test';
import type { Lab } from './lab';
import { tellTick } from './shown';

interface Counted {
  frames: number;
  shown: number[];
  steps: number[];
}

export interface Count extends Counted {
  time_s: number;
  script_s: number;
  tasks_s: number;
}

export interface Figures {
  frames: number;
  frames_per_s: number;
  script_ms_per_frame: number;
  tasks_ms_per_frame: number;
  states: number;
  state_to_frame_p50_ms: number | undefined;
  state_to_frame_p95_ms: number | undefined;
  step_to_frame_p95_ms: number | undefined;
}

declare global {
  interface Window {
    ferryMeter: Counted;
  }
}

interface HeapSnapshot {
  snapshot: { meta: { node_fields: string[]; node_types: [string[], ...unknown[]] } };
  nodes: number[];
}

/** What a page does not keep itself: code that is compiled for hours, and what lies outside the heap. */
const NOT_KEPT = ['code', 'native', 'synthetic'];

/** Bytes of the objects in the page's heap, after a collection. */
async function objectBytes(cdp: CDPSession) {
  const chunks: string[] = [];
  const add = ({ chunk }: { chunk: string }) => {
    chunks.push(chunk);
  };
  cdp.on('HeapProfiler.addHeapSnapshotChunk', add);
  await cdp.send('HeapProfiler.takeHeapSnapshot', { reportProgress: false });
  cdp.off('HeapProfiler.addHeapSnapshotChunk', add);
  const { snapshot, nodes } = JSON.parse(chunks.join('')) as HeapSnapshot;
  const { node_fields, node_types } = snapshot.meta;
  const [types] = node_types;
  const typeAt = node_fields.indexOf('type');
  const sizeAt = node_fields.indexOf('self_size');
  let bytes = 0;
  for (let node = 0; node < nodes.length; node += node_fields.length) {
    const type = types[nodes[node + typeAt] ?? NaN] ?? '';
    if (!NOT_KEPT.includes(type)) bytes += nodes[node + sizeAt] ?? 0;
  }
  return bytes;
}

/** Upper limits. `npm run soak` checks them on a machine that does nothing else. */
export const BUDGETS: Partial<Record<keyof Figures, number>> = {
  script_ms_per_frame: 4,
  state_to_frame_p95_ms: 50,
  // An upper bound for the time of a state from the session to the screen: it includes the request,
  // the tick and, when one is due, the camera's picture.
  step_to_frame_p95_ms: 100,
};

/** One line for each of `figures` that exceeds its budget times `leniency`. */
export function overruns(figures: Figures, leniency = 1) {
  return (Object.entries(BUDGETS) as [keyof Figures, number][])
    .filter(([name, budget]) => (figures[name] ?? 0) > budget * leniency)
    .map(([name, budget]) => `${name} is ${figures[name]?.toFixed(1) ?? '–'}, budget ${budget}`);
}

/**
 * Runs in the page before the page's scripts. Records when a state arrives, when a step is
 * requested, and when a tick is on the screen.
 *
 * The page writes the tick in the frame that draws its state. The next
 * frame begins only after the browser has taken that frame, so its start counts as the time when
 * the tick is on the screen. Each figure is at most one frame too large, and never too small.
 */
function probe() {
  const meter: Counted = { frames: 0, shown: [], steps: [] };
  window.ferryMeter = meter;
  const received = new Map<string | undefined, number>();
  let requested_ms: number | undefined;
  const Native = window.WebSocket;
  window.WebSocket = class extends Native {
    constructor(...all: ConstructorParameters<typeof WebSocket>) {
      super(...all);
      this.addEventListener('message', ({ data }: MessageEvent<unknown>) => {
        if (typeof data !== 'string' || !data.startsWith('{"type":"state"')) return;
        const tick = /"tick":(\d+)/.exec(data)?.[1];
        if (!received.has(tick)) received.set(tick, performance.now());
      });
    }

    override send(data: string) {
      if (data.includes('"step"')) requested_ms = performance.now();
      super.send(data);
    }
  };

  const request = window.requestAnimationFrame.bind(window);
  let last = -1;
  window.requestAnimationFrame = (work) =>
    request((now) => {
      if (now !== last) meter.frames += 1;
      last = now;
      work(now);
    });

  window.ferryShown((tick) => {
    const received_ms = received.get(tick);
    received.clear();
    const stepped_ms = requested_ms;
    requested_ms = undefined;
    request((now) => {
      if (received_ms !== undefined) meter.shown.push(now - received_ms);
      if (stepped_ms !== undefined) meter.steps.push(now - stepped_ms);
    });
  });
}

export class Meter {
  private before: Record<string, number> = {};

  private constructor(
    private readonly page: Page,
    private readonly cdp: CDPSession,
  ) {}

  /** Must be called before the page is opened. */
  static async attach(page: Page) {
    await page.addInitScript(tellTick);
    await page.addInitScript(probe);
    const cdp = await page.context().newCDPSession(page);
    await cdp.send('Performance.enable');
    return new Meter(page, cdp);
  }

  async start() {
    await this.page.evaluate(() => {
      Object.assign(window.ferryMeter, { frames: 0, shown: [], steps: [] });
    });
    this.before = await this.metrics();
  }

  /** The counts since `start`. */
  async stop(): Promise<Count> {
    const after = await this.metrics();
    const counted = await this.page.evaluate(() => window.ferryMeter);
    const passed_s = (name: string) => (after[name] ?? NaN) - (this.before[name] ?? NaN);
    return {
      ...counted,
      time_s: passed_s('Timestamp'),
      script_s: passed_s('ScriptDuration'),
      tasks_s: passed_s('TaskDuration'),
    };
  }

  /** The memory in use after garbage collection. */
  async memory() {
    const heap_bytes = await objectBytes(this.cdp);
    const { Nodes, JSEventListeners } = await this.metrics();
    return {
      heap_bytes,
      dom_nodes: Nodes ?? NaN,
      listeners: JSEventListeners ?? NaN,
    };
  }

  private async metrics(): Promise<Record<string, number>> {
    const { metrics } = await this.cdp.send('Performance.getMetrics');
    return Object.fromEntries(metrics.map(({ name, value }) => [name, value]));
  }
}

function percentile(values: readonly number[], share: number) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

/** Means per frame and percentiles, over several counts. */
export function figuresOf(counts: readonly Count[]): Figures {
  const sum = (name: 'frames' | 'time_s' | 'script_s' | 'tasks_s') =>
    counts.reduce((total, count) => total + count[name], 0);
  const all = (name: 'shown' | 'steps') => counts.flatMap((count) => count[name]);
  const frames = sum('frames');
  return {
    frames,
    frames_per_s: frames / sum('time_s'),
    script_ms_per_frame: (1000 * sum('script_s')) / Math.max(1, frames),
    tasks_ms_per_frame: (1000 * sum('tasks_s')) / Math.max(1, frames),
    states: all('shown').length,
    state_to_frame_p50_ms: percentile(all('shown'), 0.5),
    state_to_frame_p95_ms: percentile(all('shown'), 0.95),
    step_to_frame_p95_ms: percentile(all('steps'), 0.95),
  };
}

export const summaryOf = (figures: Figures) =>
  [
    `${figures.frames} frames, ${figures.frames_per_s.toFixed(1)} per second`,
    `script ${figures.script_ms_per_frame.toFixed(2)} ms per frame`,
    `all tasks ${figures.tasks_ms_per_frame.toFixed(2)} ms`,
    `state to frame p50 ${figures.state_to_frame_p50_ms?.toFixed(1) ?? '–'} ms`,
    `p95 ${figures.state_to_frame_p95_ms?.toFixed(1) ?? '–'} ms`,
  ].join(', ');

/** Steps a paused session, and waits after each step until the plan view shows it. */
export async function stepThrough(lab: Lab, count: number) {
  for (let i = 0; i < count; i++) {
    const { tick } = lab.state;
    await lab.button('Step').click();
    await expect
      .poll(() => lab.page.getByTestId('sim-time').getAttribute('title'), { intervals: [25] })
      .toBe(`Tick ${tick + 1}`);
  }
}
