// The demonstration over a long time: each caption is shown again and again, and the memory does not grow.
// `[DEMO_MINUTES=10] npm run soak`

import { join } from 'node:path';
import { PROGRAMME } from '../src/features/demo/programme';
import { Lab, expect, test } from './fixtures';
import { type Memory, OUTPUT, growth, memoryOf, memoryWords, writeReport } from './support/growth';
import { Meter } from './support/meter';
import { Server } from './support/server';

const MINUTES = Number(process.env.DEMO_MINUTES ?? 10);
const MINUTE_MS = 60_000;
/** A part of the programme takes less. */
const MAX_STILL_MS = 90_000;
const LOOK_MS = 500;

const CAPTIONS = new Set(
  PROGRAMME.flatMap(({ title, cues }) => [title, ...cues.map(({ caption }) => caption)]),
);

test('runs its programme again and again', async ({ page, watch }) => {
  const server = await Server.start();
  try {
    watch.allowHost(server.url);
    const meter = await Meter.attach(page);
    const lab = new Lab(page);
    await page.goto(`${server.url}/demo`);
    const caption = page.locator('.demo-caption');
    await expect(caption).toHaveText(PROGRAMME[0]?.title ?? '');

    const seen = new Map<string, number>();
    const samples: Memory[] = [];
    let last = { caption: '', tick: -1 };
    let changed_ms = { caption: Date.now(), tick: Date.now() };
    let longest_ms = { caption: 0, tick: 0 };
    const look = async () => {
      const now = Date.now();
      const next = { caption: await caption.innerText(), tick: lab.state.tick };
      for (const name of ['caption', 'tick'] as const) {
        if (next[name] === last[name]) {
          const still_ms = now - changed_ms[name];
          longest_ms = { ...longest_ms, [name]: Math.max(longest_ms[name], still_ms) };
        } else changed_ms = { ...changed_ms, [name]: now };
      }
      if (next.caption !== last.caption) {
        const count = (seen.get(next.caption) ?? 0) + 1;
        seen.set(next.caption, count);
        if (count === 1) await page.screenshot({ path: join(OUTPUT, `demo-${seen.size}.png`) });
      }
      last = next;
    };

    for (let minute = 1; minute <= MINUTES; minute++) {
      const end = Date.now() + MINUTE_MS;
      while (Date.now() < end) {
        await look();
        await new Promise((resolve) => setTimeout(resolve, LOOK_MS));
      }
      const memory = await memoryOf(minute, meter, server);
      samples.push(memory);
      console.log(memoryWords(memory));
    }
    const missing = [...CAPTIONS].filter((text) => !seen.has(text));
    const faults = growth(samples);
    const times = [...seen].sort(([, a], [, b]) => a - b);
    await writeReport('demo-soak', {
      minutes: MINUTES,
      longest_ms,
      faults,
      missing,
      times,
      samples,
    });
    console.log(`shown: ${times.map(([text, count]) => `${count}× ${text}`).join(' | ')}`);
    console.log(
      `longest without a change: caption ${longest_ms.caption} ms, tick ${longest_ms.tick} ms`,
    );
    expect(missing).toEqual([]);
    expect(Math.max(longest_ms.caption, longest_ms.tick)).toBeLessThan(MAX_STILL_MS);
    expect(faults).toEqual([]);
  } finally {
    await page.goto('about:blank');
    await server.stop();
  }
});
