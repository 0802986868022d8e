// Runs the browser tests: FERRY_URL=http://… or FERRY_BIN=…/ferry node e2e/run.mjs [WORDS]
// With WORDS, only those tests that have them in their names.

import { Watch, runAll, startBrowser, startServer } from './harness.mjs';
import { Lab } from './lab.mjs';
import { recover } from './recover.mjs';
import { TESTS } from './tests.mjs';

const words = process.argv[2] ?? '';
const tests = TESTS.filter(([name]) => name.includes(words));
const server = await startServer();
const browser = await startBrowser();
const watch = new Watch(browser, server.url);
let failed = tests.length;
try {
  const lab = await Lab.open(browser, server.url);
  failed = await runAll(tests, { lab, browser, server, watch, recover });
} catch (error) {
  console.log(`FAIL  opening the page\n      ${error.message}`);
} finally {
  await browser.close();
  await server.stop();
}
console.log(`${tests.length - failed} passed, ${failed} failed`);
process.exitCode = failed === 0 ? 0 : 1;
