// Lets the page's first connection report that its session has ended. A test cannot cause a fault of the server.

import type { Page } from '@playwright/test';

/** Must be called before the page is opened. Returns the number of connections so far. */
export async function endFirstSession(page: Page) {
  let connections = 0;
  await page.routeWebSocket(/\/live(\?|$)/, (socket) => {
    connections += 1;
    const isFirst = connections === 1;
    const server = socket.connectToServer();
    server.onMessage((text) => {
      const message =
        typeof text === 'string' ? (JSON.parse(text) as { type?: string }) : undefined;
      if (!isFirst || message?.type !== 'state') {
        socket.send(text);
        return;
      }
      const detail = 'the camera was lost';
      const ended = { code: 'trial_failed', detail, text: detail };
      socket.send(JSON.stringify({ ...message, ended }));
      void socket.close({ code: 1001, reason: 'the session has ended' });
    });
  });
  return () => connections;
}
