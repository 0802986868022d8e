// What the page costs and how late it is, measured in the page and by its browser.

import { type CDPSession, type Page, expect } from '@playwright/test';
import type { Lab } from './lab';

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

/** Upper limits. `npm run soak` keeps the page to them, on a machine that does nothing else. */
export const MOST: Partial<Record<keyof Figures, number>> = {
  script_ms_per_frame: 4,
  state_to_frame_p95_ms: 50,
  // From above what a state takes from the session to the screen: the request is in it, the tick, and the camera's
  // picture when one is due.
  step_to_frame_p95_ms: 100,
};

/** Which of `figures` exceed their budget times `leniency`. */
export function overruns(figures: Figures, leniency = 1) {
  return (Object.entries(MOST) as [keyof Figures, number][])
    .filter(([name, most]) => (figures[name] ?? 0) > most * leniency)
    .map(([name, most]) => `${name} is ${figures[name]?.toFixed(1) ?? '–'}, budget ${most}`);
}

/**
 * Runs in the page before any of its scripts: notes when a state came, when a step was requested, and when the frame
 * that shows a tick was surely on the screen.
 *
 * The canvas has the tick that it shows as `data-tick`, written in the frame that draws it. The next frame can only
 * begin after that one was handed over; its start is taken as the time when the tick was seen. So each figure is up to
 * a frame too large, never too small.
 */
function probe() {
  const meter: Counted = { frames: 0, shown: [], steps: [] };
  window.ferryMeter = meter;
  const came = new Map<string | undefined, number>();
  let requested_ms: number | undefined;
  const Native = window.WebSocket;
  window.WebSocket = class extends Native {
    constructor(...all: ConstructorParameters<typeof WebSocket>) {
      super(...all);
      this.addEventListener('message', ({ data }: MessageEvent<unknown>) => {
        if (typeof data !== 'string' || !data.startsWith('{"type":"state"')) return;
        const tick = /"tick":(\d+)/.exec(data)?.[1];
        if (!came.has(tick)) came.set(tick, performance.now());
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

  const shows = (tick: string | undefined) => {
    const came_ms = came.get(tick);
    came.clear();
    const from_ms = requested_ms;
    requested_ms = undefined;
    request((now) => {
      if (came_ms !== undefined) meter.shown.push(now - came_ms);
      if (from_ms !== undefined) meter.steps.push(now - from_ms);
    });
  };
  new MutationObserver((changes) => {
    shows((changes.at(-1)?.target as HTMLElement | undefined)?.dataset.tick);
  }).observe(document, { subtree: true, attributeFilter: ['data-tick'] });
}

export class Meter {
  private before: Record<string, number> = {};

  private constructor(
    private readonly page: Page,
    private readonly cdp: CDPSession,
  ) {}

  /** Before the page is opened. */
  static async attach(page: Page) {
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

  /** What was counted since `start`. */
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

  /** What stays after the garbage is collected. */
  async memory() {
    // Twice: what the first finds free may have held more.
    await this.cdp.send('HeapProfiler.collectGarbage');
    await this.cdp.send('HeapProfiler.collectGarbage');
    const { JSHeapUsedSize, Nodes, JSEventListeners } = await this.metrics();
    return {
      heap_bytes: JSHeapUsedSize ?? NaN,
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

/** Means over the frames and percentiles, of several counts together. */
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

export const words = (figures: Figures) =>
  [
    `${figures.frames} frames, ${figures.frames_per_s.toFixed(1)} a second`,
    `script ${figures.script_ms_per_frame.toFixed(2)} ms a frame`,
    `all tasks ${figures.tasks_ms_per_frame.toFixed(2)} ms`,
    `state to frame p50 ${figures.state_to_frame_p50_ms?.toFixed(1) ?? '–'} ms`,
    `p95 ${figures.state_to_frame_p95_ms?.toFixed(1) ?? '–'} ms`,
  ].join(', ');

/** Single steps of a paused session, each seen before the next is requested. */
export async function stepThrough(lab: Lab, count: number) {
  for (let i = 0; i < count; i++) {
    const { tick } = lab.state;
    await lab.button('Step').click();
    await expect
      .poll(() => lab.canvas.getAttribute('data-tick'), { intervals: [25] })
      .toBe(`${tick + 1}`);
  }
}
