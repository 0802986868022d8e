import { expect } from '@playwright/test';

/** Short: most conditions become true within a few frames. */
const INTERVAL_MS = 25;
const WAIT_MS = 20_000;

type Truthy<T> = Exclude<T, false | 0 | '' | null | undefined>;

/** Waits until `probe` returns something truthy and returns it. */
export async function until<T>(
  what: string,
  probe: () => T | Promise<T>,
  timeoutMs = WAIT_MS,
): Promise<Truthy<T>> {
  let value: T | undefined;
  await expect
    .poll(
      async () => {
        value = await probe();
        return Boolean(value);
      },
      { message: what, intervals: [INTERVAL_MS], timeout: timeoutMs },
    )
    .toBe(true);
  return value as Truthy<T>;
}

/** Returns the value, and throws if it is missing. */
export function must<T>(value: T | null | undefined, what: string): T {
  if (value === null || value === undefined) throw new Error(`missing: ${what}`);
  return value;
}
