// Long runs: memory of the page and the server each minute, and what of it grows.

import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import type { Meter } from './meter';
import type { Server } from './server';
import { must } from './wait';

export const OUTPUT = fileURLToPath(new URL('../../../test-output/', import.meta.url));
/** As long as a part of a recording: the server's memory rises within each and falls at its end. */
const COMPARED_MINUTES = 10;
const MAX_GROWTH = 0.1;
const NAMES = ['heap_bytes', 'dom_nodes', 'listeners', 'server_rss_bytes'] as const;

export type Memory = { minute: number } & Record<(typeof NAMES)[number], number>;

async function rssBytes(pid: number | undefined) {
  const status = await readFile(`/proc/${must(pid, 'a process')}/status`, 'utf8');
  return 1024 * Number(/VmRSS:\s+(\d+)/.exec(status)?.[1]);
}

export async function memoryOf(minute: number, meter: Meter, server: Server): Promise<Memory> {
  return { minute, ...(await meter.memory()), server_rss_bytes: await rssBytes(server.pid) };
}

export function memoryWords(memory: Memory) {
  const mb = (bytes: number) => (bytes / 1e6).toFixed(1);
  return (
    `${String(memory.minute).padStart(3)} min: heap ${mb(memory.heap_bytes)} MB, ` +
    `${memory.dom_nodes} nodes, ${memory.listeners} listeners, ` +
    `server ${mb(memory.server_rss_bytes)} MB`
  );
}

function median(samples: readonly Memory[], name: keyof Memory) {
  const sorted = samples.map((sample) => sample[name]).sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? NaN;
}

/**
 * The figures that grew by more than MAX_GROWTH. Compares the medians of some minutes near the
 * start and at the end, because one minute alone may be an exception.
 */
export function growth(samples: readonly Memory[]) {
  const settled_minutes = Math.max(1, Math.min(5, Math.floor(samples.length / 2)));
  const settled = samples.slice(settled_minutes - 1, settled_minutes - 1 + COMPARED_MINUTES);
  const last = samples.slice(-COMPARED_MINUTES);
  return NAMES.filter((name) => median(last, name) > median(settled, name) * (1 + MAX_GROWTH)).map(
    (name) => `${name} grew from ${median(settled, name)} to ${median(last, name)}`,
  );
}

/** Writes `report` to test-output. */
export async function writeReport(name: string, report: object) {
  await mkdir(OUTPUT, { recursive: true });
  await writeFile(`${OUTPUT}${name}.json`, `${JSON.stringify(report, null, 2)}\n`);
}
