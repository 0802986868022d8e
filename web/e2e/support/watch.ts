import type { Browser, BrowserContext, ConsoleMessage, Page } from '@playwright/test';

/** A software driver warns that a screenshot of the 3-D view takes time. */
const SLOW_DRIVER = /GPU stall due to ReadPixels/;

/** What the browser reports when a server has gone. A request may be under way. */
export const CONNECTION_LOST =
  /ERR_(CONNECTION_(REFUSED|RESET|CLOSED)|EMPTY_RESPONSE)|WebSocket connection/i;

/** Records what no page, frame or worker may do: report errors, or send requests to other hosts. */
export class Watch {
  private readonly texts: string[] = [];
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

  /** Allows messages that a test causes on purpose. */
  allow(pattern: RegExp) {
    this.allowed.push(pattern);
  }

  /** Allows the host of a test's own server. */
  allowHost(url: string) {
    this.hosts.add(new URL(url).host);
  }

  /** Page errors, console errors and warnings. They include violations of the security policy. */
  get messages() {
    return this.texts.filter((text) => !this.allowed.some((pattern) => pattern.test(text)));
  }

  /** Requested addresses on other hosts. */
  get foreign() {
    return this.addresses.filter((address) => {
      const { protocol, host } = new URL(address);
      // Requests with these schemes do not leave the page.
      return !['blob:', 'data:', 'about:'].includes(protocol) && !this.hosts.has(host);
    });
  }

  private add(context: BrowserContext) {
    context.on('console', (message: ConsoleMessage) => {
      if (message.type() !== 'error' && message.type() !== 'warning') return;
      this.texts.push(`${message.text()} (${message.location().url})`);
    });
    context.on('weberror', (error) => this.texts.push(error.error().message));
    context.on('request', (request) => this.addresses.push(request.url()));
    const addPage = (page: Page) => {
      page.on('websocket', (socket) => this.addresses.push(socket.url()));
    };
    context.pages().forEach(addPage);
    context.on('page', addPage);
  }
}
