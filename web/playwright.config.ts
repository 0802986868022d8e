import { defineConfig } from '@playwright/test';
import { BROWSER, CHROMIUM_ARGUMENTS } from './e2e/support/browser';

/** `FERRY_BIN` is the server that is tested, `target/release/ferry` if not set. */
export default defineConfig({
  testDir: 'e2e',
  outputDir: '../test-output/browser',
  fullyParallel: true,
  workers: 2,
  retries: 0,
  forbidOnly: true,
  timeout: 120_000,
  expect: { timeout: 20_000 },
  reporter: [['list'], ['./e2e/support/totals.ts']],
  use: {
    viewport: { width: 1280, height: 800 },
    colorScheme: 'dark',
    // A page in a new context costs four times as much. Playwright clears everything that a test may have left.
    reuseContext: true,
    actionTimeout: 20_000,
    navigationTimeout: 30_000,
    launchOptions: {
      executablePath: BROWSER,
      args: [...CHROMIUM_ARGUMENTS, '--disable-gpu'],
    },
    screenshot: 'only-on-failure',
    // Pictures and snapshots of each action would cost a fifth of the time.
    trace: { mode: 'retain-on-failure', screenshots: false, snapshots: false },
  },
  projects: [
    // The daily suite: one test of every feature.
    { name: 'browser', testIgnore: '*soak.spec.ts', grepInvert: /@long/ },
    // Twenty minutes: `npm run e2e:long`.
    ...(process.env.FERRY_LONG
      ? [{ name: 'long', testIgnore: '*soak.spec.ts', grep: /@long/ }]
      : []),
    // Forty minutes: `npm run soak`.
    ...(process.env.FERRY_SOAK ? [{ name: 'soak', testMatch: '*soak.spec.ts', timeout: 0 }] : []),
  ],
});
