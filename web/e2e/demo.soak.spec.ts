// The demonstration over a long time: each caption is shown again and again, and the memory does not grow.
// `[DEMO_MINUTES=10] npm run soak`

import { join } from 'node:path';
import { PROGRAMME } from '../src/features/demo/programme';
import { Lab, expect, test } from './fixtures';
import { useSlowDisplay } from './support/display';
import { type Memory, OUTPUT, growth, memoryOf, memoryWords, writeReport } from './support/growth';
import { Meter } from './support/meter';
import { Server } from './support/server';
import { until } from './support/wait';

const MINUTES = Number(process.env.DEMO_MINUTES ?? 10);
const MINUTE_MS = 60_000;
/** A part of the programme takes less. */
const MAX_STILL_MS = 90_000;
const LOOK_MS = 500;
/** Ten frames per second: the soak measures stalls and memory, not how smooth the page is. */
const FRAME_MS = 100;

/** During the challenge, an invitation stands in the place of the captions. */
const INVITATION = 'Touch the screen and be faster.';
const CAPTIONS = new Set(
  PROGRAMME.filter(({ link }) => link).flatMap(({ title, cues }) => [
    title,
    ...cues.map(({ caption }) => caption),
  ]),
);

/** Runs in the page before its scripts. Asking for the caption again and again would leave code in the memory. */
function tellCaptions() {
  let last = '';
  new MutationObserver(() => {
    const text = document.querySelector('.demo-caption')?.textContent.trim() ?? '';
    if (text === last) return;
    last = text;
    void (window as unknown as { ferryCaption: (text: string) => Promise<void> }).ferryCaption(
      text,
    );
  }).observe(document, { subtree: true, childList: true, characterData: true });
}

test('runs its programme again and again', async ({ page, watch }) => {
  const server = await Server.start();
  try {
    watch.allowHost(server.url);
    const meter = await Meter.attach(page);
    const lab = new Lab(page);
    let caption = '';
    await page.exposeFunction('ferryCaption', (text: string) => {
      caption = text;
    });
    await page.addInitScript(tellCaptions);
    await useSlowDisplay(page, FRAME_MS);
    await page.goto(`${server.url}/demo`);
    await until('the first state', () => lab.isComplete);

    const seen = new Map<string, number>();
    const samples: Memory[] = [];
    let last = { caption: '', tick: -1 };
    let changed_ms = { caption: Date.now(), tick: Date.now() };
    let longest_ms = { caption: 0, tick: 0 };
    const look = async () => {
      const now = Date.now();
      const next = { caption, tick: lab.state.tick };
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
      // The meter's own lists grow until it starts again.
      await meter.start();
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
    expect([...seen.keys()].some((text) => text.endsWith(INVITATION))).toBe(true);
    expect(Math.max(longest_ms.caption, longest_ms.tick)).toBeLessThan(MAX_STILL_MS);
    expect(faults).toEqual([]);
  } finally {
    await page.goto('about:blank');
    await server.stop();
  }
});
