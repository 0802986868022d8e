// Test cases: opens a saved one, and says what the opened one contains.

import type { CaseSummary, EventMessage, StateMessage } from '../../net/protocol.gen';
import { clock, counted } from '../../ui/format';
import type { Notices, Panels, Session } from '../../lab/slices';

/** For the rest of the message. */
const SPARE_BYTES = 1024;

/** Whether the text fits into a message of so many bytes. */
export function fits(text: string, bytes: number): boolean {
  const { length } = new TextEncoder().encode(JSON.stringify(text));
  return length + SPARE_BYTES <= bytes;
}

/** Sends the file to the server, which reads it. */
export async function openCase(lab: Session & Notices & Panels, file: File): Promise<void> {
  const say = (text: string): void => lab.notify('playback', text);
  const bytes = lab.hello()?.message_bytes;
  if (!lab.canOperate() || bytes === undefined) {
    say('Take control to open a test case.');
    return;
  }
  const text = file.size > bytes ? '' : await file.text().catch(() => undefined);
  if (text === undefined) say('The browser could not read this file.');
  else if (file.size > bytes || !fits(text, bytes)) {
    const limit = `${bytes >> 10} KiB. It is lower while many pages are open.`;
    say(`This test case is too large: the limit is ${limit}`);
  } else {
    const { kind } = await lab.send('playback', { type: 'open_case', case: text });
    if (kind === 'done') lab.showPanel('story');
  }
}

type Verdict = 'met' | 'not met' | 'open';

/** Whether the expectation is met at this tick. */
function verdict(
  { deliveries = 0, by_tick = 0 }: CaseSummary,
  events: readonly EventMessage[],
  tick: number,
): Verdict {
  const last = Math.min(tick, by_tick);
  const delivered = events.filter((event) => event.kind === 'delivered' && event.tick <= last);
  if (delivered.length >= deliveries) return 'met';
  return tick >= by_tick ? 'not met' : 'open';
}

/** What the case contains, one sentence each. */
export function caseWords(
  summary: CaseSummary,
  events: readonly EventMessage[],
  { tick }: Pick<StateMessage, 'tick'>,
  tick_s: number,
): string[] {
  const { about, inputs, last_tick, deliveries, by_tick } = summary;
  const sentences = [`Test case: ${about}`];
  if (inputs > 0) {
    sentences.push(`${counted(inputs, 'input')}, the last one at ${clock(last_tick * tick_s)}.`);
  }
  if (deliveries !== undefined && by_tick !== undefined) {
    const now = verdict(summary, events, tick);
    sentences.push(`Expected: ${deliveries} delivered by ${clock(by_tick * tick_s)} (${now}).`);
  }
  return sentences;
}
