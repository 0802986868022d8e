// A class at one server: each visitor can act after one press, and takes no session of another.

import { DAILY, LONG, Lab, expect, test } from './fixtures';
import { must, until } from './support/wait';

for (const [count, suite] of [
  [5, DAILY],
  [30, LONG],
] as const) {
  test(`${count} visitors can act after one press each`, suite, async ({ browser, server }) => {
    test.setTimeout(20_000 + count * 12_000);
    const contexts = [];
    const visitors: Lab[] = [];
    for (let number = 0; number < count; number += 1) {
      const context = await browser.newContext();
      contexts.push(context);
      const page = await context.newPage();
      // Before the page opens: it reads all messages.
      const visitor = new Lab(page);
      await page.goto(server.url);
      const begin = visitor.button('Pull it away');
      await until('the first messages', () => visitor.isComplete);
      await begin.click();
      await visitor.live();
      await visitor.isRole('operator');
      await until('its trial runs', () => visitor.state.running);
      visitors.push(visitor);
      // So that the next ones do not wait for the pictures of those before.
      await visitor.button('Pause').click();
      await until('a pause', () => !visitor.state.running);
    }
    const names = visitors.map(({ hello }) => hello.session);
    expect(new Set(names).size).toBe(count);
    expect(names[0]).toBe('main');
    // Each is still the operator, also after a reload.
    for (const visitor of visitors) await visitor.isRole('operator');
    const last = must(visitors.at(-1), 'the last visitor');
    await last.page.reload();
    await last.live();
    await last.isRole('operator');
    await Promise.all(contexts.map((context) => context.close()));
    const end = (name: string) => fetch(`${server.url}/api/sessions/${name}`, { method: 'DELETE' });
    await Promise.all(names.filter((name) => name !== 'main').map(end));
  });
}
