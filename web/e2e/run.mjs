// Runs the browser tests: FERRY_URL=http://… or FERRY_BIN=…/ferry node e2e/run.mjs

import { runAll, startBrowser, startServer } from './harness.mjs';
import { Lab } from './lab.mjs';
import { TESTS } from './tests.mjs';

const server = await startServer();
const browser = await startBrowser();
let failed = TESTS.length;
try {
  const lab = await Lab.open(browser, server.url);
  failed = await runAll(TESTS, { lab, browser, server });
} catch (error) {
  console.log(`FAIL  opening the page\n      ${error.message}`);
} finally {
  await browser.close();
  await server.stop();
}
console.log(`${TESTS.length - failed} passed, ${failed} failed`);
process.exitCode = failed === 0 ? 0 : 1;
