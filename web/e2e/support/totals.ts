import type { Reporter, Suite } from '@playwright/test/reporter';

/** A reporter that ends the output with one line for scripts. */
export default class Totals implements Reporter {
  private suite: Suite | undefined;

  onBegin(_config: unknown, suite: Suite) {
    this.suite = suite;
  }

  // Comes last: the list reporter writes its summary in `onEnd`.
  onExit(): Promise<void> {
    const all = this.suite?.allTests() ?? [];
    const passed = all.filter((one) => one.outcome() === 'expected').length;
    process.stdout.write(`${passed} passed, ${all.length - passed} failed\n`);
    return Promise.resolve();
  }

  printsToStdio() {
    return false;
  }
}
