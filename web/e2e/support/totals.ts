import { stripVTControlCharacters } from 'node:util';
import type { Reporter, Suite, TestCase } from '@playwright/test/reporter';

const ERROR_LINES = 12;

/** The title of a failed test and the start of its error. */
function failure(one: TestCase) {
  const error = one.results.at(-1)?.errors[0];
  const words = stripVTControlCharacters(error?.message ?? error?.value ?? 'no error');
  const lines = words.split('\n').slice(0, ERROR_LINES);
  return [`failed: ${one.title}`, ...lines.map((line) => `  ${line}`)].join('\n');
}

/** Ends the output with the errors, which are far above between logs, and with one line for scripts. */
export default class Totals implements Reporter {
  private suite: Suite | undefined;

  onBegin(_config: unknown, suite: Suite) {
    this.suite = suite;
  }

  // Comes last: the list reporter writes its summary in `onEnd`.
  onExit(): Promise<void> {
    const all = this.suite?.allTests() ?? [];
    const failed = all.filter((one) => one.outcome() !== 'expected');
    for (const one of failed) process.stdout.write(`${failure(one)}\n`);
    process.stdout.write(`${all.length - failed.length} passed, ${failed.length} failed\n`);
    return Promise.resolve();
  }

  printsToStdio() {
    return false;
  }
}
