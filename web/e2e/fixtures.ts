// Fixtures: one server per worker, and one session with an operator's page per test.
// A test fails if the browser reports an error or sends a request to another host.

import { type BrowserContextOptions, type Page, test as base, expect } from '@playwright/test';
import { useFastPictures, useSlowDisplay } from './support/display';
import { Lab } from './support/lab';
import { Server } from './support/server';
import { Watch } from './support/watch';

export { expect } from '@playwright/test';
export { Lab } from './support/lab';

/** Tests of the long suite: `npm run e2e:long`. */
export const LONG = { tag: '@long' };
/** Tests of the daily suite: `npm run e2e`. */
export const DAILY = {};

export interface Session {
  readonly name: string;
  readonly url: string;
}

interface OpenOptions extends BrowserContextOptions {
  /** The test's session if not set. */
  readonly url?: string;
}

interface WorkerFixtures {
  server: Server;
}

interface TestFixtures {
  watch: Watch;
  /** Names a further session. It ends with the test. */
  newSession: () => Session;
  session: Session;
  /** The operator's page. */
  lab: Lab;
  /** Opens a further page in its own browser context. */
  openLab: (options?: OpenOptions) => Promise<Lab>;
}

/** Tips and the small camera image are tested in tips.spec.ts and panels.spec.ts. Elsewhere the tests use all of it. */
const skipTips = (page: Page) =>
  page.addInitScript(() => {
    localStorage.setItem('ferry.tips', 'run,drag,goal,controller,scene');
    if (localStorage.getItem('ferry.panel.camera') === null)
      localStorage.setItem('ferry.panel.camera', 'open');
  });

/** Set to draw less often. */
const FRAME_MS = Number(process.env.FERRY_FRAME_MS ?? 0);

async function open(page: Page, url: string) {
  await useFastPictures(page);
  if (FRAME_MS > 0) await useSlowDisplay(page, FRAME_MS);
  await skipTips(page);
  return Lab.attach(page, url);
}

const NAME_LENGTH = 32;
let opened = 0;

function newName(title: string) {
  opened += 1;
  const number = `-${opened}`;
  const words = title.toLowerCase().replaceAll(/[^a-z0-9]+/g, '-');
  return `t-${words}`.slice(0, NAME_LENGTH - number.length) + number;
}

export const test = base.extend<TestFixtures, WorkerFixtures>({
  server: [
    async ({}, use) => {
      const server = await Server.start();
      await use(server);
      await server.stop();
    },
    { scope: 'worker' },
  ],

  watch: [
    async ({ browser, server }, use, testInfo) => {
      const watch = new Watch(browser, server.url);
      await use(watch);
      watch.close();
      if (testInfo.status !== testInfo.expectedStatus) {
        await testInfo.attach('server.log', { body: server.log, contentType: 'text/plain' });
      }
      expect.soft(watch.messages, 'console messages').toEqual([]);
      expect.soft(watch.foreign, 'requests to other hosts').toEqual([]);
    },
    { auto: true },
  ],

  newSession: async ({ server }, use, testInfo) => {
    const names: string[] = [];
    await use(() => {
      const name = newName(testInfo.title);
      names.push(name);
      return { name, url: `${server.url}/s/${name}` };
    });
    // A test may have stopped its server.
    const end = (name: string) => fetch(`${server.url}/api/sessions/${name}`, { method: 'DELETE' });
    await Promise.allSettled(names.map(end));
  },

  session: async ({ newSession }, use) => {
    await use(newSession());
  },

  lab: async ({ session, page }, use) => {
    await use(await open(page, session.url));
  },

  openLab: async ({ session, browser }, use) => {
    const contexts: { close: () => Promise<void> }[] = [];
    await use(async ({ url = session.url, ...options } = {}) => {
      const context = await browser.newContext(options);
      contexts.push(context);
      return open(await context.newPage(), url);
    });
    await Promise.all(contexts.map((context) => context.close()));
  },
});
