// What the page costs and how late it is, measured in the page and by its browser.

import { until } from './harness.mjs';

/**
 * Runs in the page before any of its scripts: notes when a state came, when a step was asked for,
 * and when the frame that shows a tick was surely on the screen.
 *
 * The canvas has the tick of what it shows as `data-tick`, written in the frame that draws it. The
 * next frame can only begin after that one was handed over; its beginning is taken as the time when
 * the tick was seen. So each figure is up to a frame too large, never too small.
 */
function probe() {
  const meter = { frames: 0, shown: [], steps: [] };
  window.ferryMeter = meter;
  const came = new Map();
  let asked_ms;
  const Native = window.WebSocket;
  window.WebSocket = class extends Native {
    constructor(...all) {
      super(...all);
      this.addEventListener('message', ({ data }) => {
        if (typeof data !== 'string' || !data.startsWith('{"type":"state"')) return;
        const tick = /"tick":(\d+)/.exec(data)?.[1];
        if (!came.has(tick)) came.set(tick, performance.now());
      });
    }

    send(data) {
      if (data.includes('"step"')) asked_ms = performance.now();
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

  const shows = (tick) => {
    const came_ms = came.get(tick);
    came.clear();
    const from_ms = asked_ms;
    asked_ms = undefined;
    request((now) => {
      if (came_ms !== undefined) meter.shown.push(now - came_ms);
      if (from_ms !== undefined) meter.steps.push(now - from_ms);
    });
  };
  new MutationObserver((changes) => {
    shows(changes.at(-1).target.dataset.tick);
  }).observe(document, { subtree: true, attributeFilter: ['data-tick'] });
}

export class Meter {
  /** Before the page is opened. */
  static async attach(page) {
    await page.addInitScript(probe);
    const meter = new Meter();
    meter.page = page;
    meter.cdp = await page.context().newCDPSession(page);
    await meter.cdp.send('Performance.enable');
    return meter;
  }

  async metrics() {
    const { metrics } = await this.cdp.send('Performance.getMetrics');
    return Object.fromEntries(metrics.map(({ name, value }) => [name, value]));
  }

  /** Starts to count anew. */
  async start() {
    await this.page.evaluate(() => {
      Object.assign(window.ferryMeter, { frames: 0, shown: [], steps: [] });
    });
    this.before = await this.metrics();
  }

  /** What was counted since `start`. */
  async stop() {
    const after = await this.metrics();
    const counted = await this.page.evaluate(() => window.ferryMeter);
    const passed_s = (name) => after[name] - this.before[name];
    return {
      ...counted,
      time_s: passed_s('Timestamp'),
      script_s: passed_s('ScriptDuration'),
      tasks_s: passed_s('TaskDuration'),
    };
  }

  /** What stays after the garbage is gone. */
  async memory() {
    // Twice: what the first finds free may have held more.
    await this.cdp.send('HeapProfiler.collectGarbage');
    await this.cdp.send('HeapProfiler.collectGarbage');
    const { JSHeapUsedSize, Nodes, JSEventListeners } = await this.metrics();
    return { heap_bytes: JSHeapUsedSize, dom_nodes: Nodes, listeners: JSEventListeners };
  }
}

/** Means over the frames and percentiles, of all that was counted in several times. */
export function figuresOf(counts) {
  const sum = (name) => counts.reduce((total, count) => total + count[name], 0);
  const all = (name) => counts.flatMap((count) => count[name]);
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

function percentile(values, share) {
  if (values.length === 0) return undefined;
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

/** Single steps of a session that stands, each seen before the next is asked for. */
export async function stepThrough(lab, count) {
  for (let i = 0; i < count; i++) {
    const { tick } = lab.state;
    await lab.button('Step').click();
    await until(
      'a tick',
      async () => (await lab.canvas.getAttribute('data-tick')) === `${tick + 1}`,
    );
  }
}
