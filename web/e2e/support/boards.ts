// Boards on the disk, as `Kept` of server/boards.rs writes them.

import { mkdir, mkdtemp, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

export interface Attempt {
  readonly player: string;
  readonly class?: string;
  /** Tick of the delivery. */
  readonly tick: number;
  readonly walls?: number;
  readonly lost_beads?: number;
}

/** A data folder with a board for each of `names`. A server reads a board once, so it must not run yet. */
export async function dataWithBoards(names: readonly string[], attempts: readonly Attempt[]) {
  const data = await mkdtemp(join(tmpdir(), 'ferry-e2e-'));
  for (const name of names) {
    const folder = join(data, 'challenges', name);
    await mkdir(folder, { recursive: true });
    for (const [index, attempt] of attempts.entries()) {
      const { player, tick, walls = 0, lost_beads = 0 } = attempt;
      const steer = { x_m: 0.1, y_m: -0.3, approach: false };
      const log = {
        about: '',
        scenario: { map: 'posts', controller: 'you', seed: 1 },
        // Two attempts with the same inputs would be one.
        inputs: [{ tick: index + 1, input: { steer } }],
      };
      const kept = {
        signature: { player, class: attempt.class ?? null, at: '2026-11-20T09:30:00Z' },
        attempt: { log, score: { tick, walls, lost_beads }, world_hash: '0000000000000000' },
        trace: { samples: [], mishaps: [] },
      };
      await writeFile(join(folder, `${index}.json`), JSON.stringify(kept));
    }
  }
  return data;
}
