// Browsers that Playwright does not drive: Debian's Firefox by WebDriver BiDi, and WebKitGTK by WebDriver.

import { type ChildProcess, spawn } from 'node:child_process';
import { once } from 'node:events';
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import puppeteer from 'puppeteer-core';
import { Builder, Origin } from 'selenium-webdriver';

export type Place = readonly [number, number];

export interface OtherBrowser {
  open(url: string): Promise<void>;
  /** The value of an expression in the page. */
  read<T>(expression: string): Promise<T>;
  /** Presses at the first place, moves along the others, and releases. */
  drag(places: readonly Place[]): Promise<void>;
  /** A picture of the page, as PNG. */
  picture(): Promise<Buffer>;
  close(): Promise<void>;
}

type Environment = Readonly<Record<string, string | undefined>>;

async function stopped(child: ChildProcess) {
  child.kill();
  if (child.exitCode === null && child.signalCode === null) await once(child, 'exit');
}

/** A display in memory: without one, Firefox has no WebGL, and WebKitGTK does not start. */
async function newDisplay() {
  const server = spawn('Xvfb', ['-displayfd', '3', '-screen', '0', '1400x1000x24'], {
    stdio: ['ignore', 'ignore', 'ignore', 'pipe'],
  });
  const [output] = server.stdio.slice(3);
  if (!output || !('readable' in output)) throw new Error('Xvfb has no output');
  const number = await Promise.race([
    once(createInterface({ input: output }), 'line').then(([line]) => Number(line)),
    once(server, 'error').then(([error]) => Promise.reject(error as Error)),
  ]);
  return { number, stop: () => stopped(server) };
}

async function firefox(env: Environment): Promise<OtherBrowser> {
  const display = await newDisplay();
  const browser = await puppeteer.launch({
    browser: 'firefox',
    executablePath: '/usr/bin/firefox-esr',
    headless: false,
    env: { ...env, DISPLAY: `:${display.number}` },
    // Without a graphics card.
    extraPrefsFirefox: { 'webgl.force-enabled': true, 'webgl.forbid-software': false },
    defaultViewport: { width: 1280, height: 800 },
  });
  const page = await browser.newPage();
  return {
    open: async (url) => {
      await page.goto(url);
    },
    read: <T>(expression: string) => page.evaluate(expression) as Promise<T>,
    drag: async ([first = [0, 0], ...others]) => {
      await page.mouse.move(...first);
      await page.mouse.down();
      for (const place of others) await page.mouse.move(...place, { steps: 5 });
      await page.mouse.up();
    },
    picture: async () => Buffer.from(await page.screenshot()),
    close: async () => {
      await browser.close();
      await display.stop();
    },
  };
}

const LIBRARIES = '/usr/lib/x86_64-linux-gnu';
/** Plus the number of the display, so that two drivers do not meet. */
const PORT = 4700;

async function webkit(env: Environment): Promise<OtherBrowser> {
  const display = await newDisplay();
  const port = PORT + display.number;
  const driver = spawn('WebKitWebDriver', [`--port=${port}`], {
    stdio: 'ignore',
    env: { ...env, DISPLAY: `:${display.number}` },
  });
  const library = readdirSync(LIBRARIES).find((name) => /^webkit2?gtk-/.test(name)) ?? '';
  const session = new Builder()
    .usingServer(`http://127.0.0.1:${port}`)
    .withCapabilities({
      browserName: 'MiniBrowser',
      'webkitgtk:browserOptions': {
        binary: join(LIBRARIES, library, 'MiniBrowser'),
        args: ['--automation'],
      },
    })
    .build();
  await session.manage().window().setRect({ width: 1300, height: 900, x: 0, y: 0 });
  return {
    open: (url) => session.get(url),
    read: <T>(expression: string) => session.executeScript<T>(`return ${expression}`),
    drag: async ([first = [0, 0], ...others]) => {
      const at = ([x, y]: Place) => ({
        origin: Origin.VIEWPORT,
        x: Math.round(x),
        y: Math.round(y),
        duration: 100,
      });
      const actions = session.actions().move(at(first)).press();
      for (const place of others) actions.move(at(place));
      await actions.release().perform();
    },
    picture: async () => Buffer.from(await session.takeScreenshot(), 'base64'),
    close: async () => {
      await session.quit();
      await stopped(driver);
      await display.stop();
    },
  };
}

export const OTHER_BROWSERS = { firefox, webkit };
