import type { Browser, BrowserContext, ConsoleMessage } from '@playwright/test';

/** A driver in software reports that a screenshot of the 3-D view takes time. */
const SLOW_DRIVER = /GPU stall due to ReadPixels/;

/** Notes what no page, frame or worker may do: report errors, or send requests to another host than the server. */
export class Watch {
  private readonly seen: string[] = [];
  private readonly addresses: string[] = [];
  private readonly allowed = [SLOW_DRIVER];
  private readonly hosts = new Set<string>();
  private readonly onContext = (context: BrowserContext) => {
    this.add(context);
  };

  constructor(
    private readonly browser: Browser,
    url: string,
  ) {
    this.allowHost(url);
    for (const context of browser.contexts()) this.add(context);
    browser.on('context', this.onContext);
  }

  close() {
    this.browser.off('context', this.onContext);
  }

  /** For a test that causes such a message on purpose. */
  allow(pattern: RegExp) {
    this.allowed.push(pattern);
  }

  /** For a test with its own server. */
  allowHost(url: string) {
    this.hosts.add(new URL(url).host);
  }

  /** Console errors and warnings (violations of the content security policy among them), and page errors. */
  get messages() {
    return this.seen.filter((text) => !this.allowed.some((pattern) => pattern.test(text)));
  }

  /** Addresses on other hosts. */
  get foreign() {
    return this.addresses.filter((address) => {
      const { protocol, host } = new URL(address);
      // These never leave the page.
      return !['blob:', 'data:', 'about:'].includes(protocol) && !this.hosts.has(host);
    });
  }

  private add(context: BrowserContext) {
    context.on('console', (message: ConsoleMessage) => {
      if (message.type() !== 'error' && message.type() !== 'warning') return;
      this.seen.push(`${message.text()} (${message.location().url})`);
    });
    context.on('weberror', (error) => this.seen.push(error.error().message));
    context.on('request', (request) => this.addresses.push(request.url()));
    context.on('page', (page) => {
      page.on('websocket', (socket) => this.addresses.push(socket.url()));
    });
  }
}
