import { playwright } from '@vitest/browser-playwright';
import { defineConfig } from 'vitest/config';
import { BROWSER, CHROMIUM_ARGUMENTS, DESKTOP } from './e2e/support/browser.ts';

export default defineConfig({
  test: {
    projects: [
      // Modules.
      {
        extends: './vite.config.ts',
        test: {
          name: 'modules',
          environment: 'node',
          include: ['src/**/*.test.ts'],
          // Beside the Rust tests, the machine may stand still for seconds.
          testTimeout: 30_000,
        },
      },
      // Components, in a browser. The test plays the server.
      {
        extends: './vite.config.ts',
        // Found while a test runs, it would load that test's page again.
        optimizeDeps: { include: ['uplot'] },
        test: {
          name: 'components',
          // The browser; without it, the plugin for Solid asks for another one.
          environment: 'node',
          include: ['src/**/*.test.tsx'],
          expect: { poll: { timeout: 5000 } },
          browser: {
            enabled: true,
            headless: true,
            screenshotFailures: false,
            provider: playwright({
              launchOptions: { executablePath: BROWSER, args: CHROMIUM_ARGUMENTS },
            }),
            instances: [{ browser: 'chromium', viewport: DESKTOP.viewport }],
          },
        },
      },
    ],
  },
});
