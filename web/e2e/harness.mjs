// A server, a browser and who watches it for the tests, and the list that their results go to.

import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { chromium } from 'playwright-core';

const START_MS = 60_000;

const delay = (ms) =>
  new Promise((resolve) => {
    setTimeout(resolve, ms);
  });

/** Waits until `probe` gives something truthy and returns it. */
export async function until(what, probe, timeoutMs = 20_000) {
  const end = Date.now() + timeoutMs;
  for (;;) {
    const value = await probe();
    if (value) return value;
    if (Date.now() > end) throw new Error(`waited ${timeoutMs / 1000} s for: ${what}`);
    await delay(40);
  }
}

export function check(condition, message) {
  if (!condition) throw new Error(message);
}

/**
 * The server at FERRY_URL, or one of our own.
 * `kill` and `pid` are there only for our own.
 */
export async function startServer() {
  const given = process.env.FERRY_URL;
  return given ? { url: given, stop: async () => {} } : startOwnServer();
}

/** Started from FERRY_BIN with a fresh data directory, at a free port unless told, and open unless it has a token. */
export async function startOwnServer({ port = 0, token } = {}) {
  const binary = process.env.FERRY_BIN;
  if (!binary) throw new Error('set FERRY_URL (a running server) or FERRY_BIN (the binary)');
  const data = await mkdtemp(join(tmpdir(), 'ferry-e2e-'));
  const child = spawn(binary, ['serve', '--bind', `127.0.0.1:${port}`, '--data', data], {
    stdio: ['ignore', 'pipe', 'inherit'],
    env: token === undefined ? process.env : { ...process.env, FERRY_TOKEN: token },
  });
  const exited = new Promise((resolve) => {
    child.once('exit', resolve);
  });
  const listening = new Promise((resolve, reject) => {
    createInterface({ input: child.stdout }).on('line', (line) => {
      const match = /listening on (http:\/\/\S+)/.exec(line);
      if (match) resolve(match[1]);
    });
    child.once('error', reject);
    child.once('exit', (code) => {
      reject(new Error(`the server ended with ${code} before it listened`));
    });
    setTimeout(() => {
      reject(new Error('the server does not listen'));
    }, START_MS).unref();
  });
  const stop = async () => {
    child.kill('SIGTERM');
    await exited;
    await rm(data, { recursive: true, force: true });
  };
  try {
    const url = await listening;
    return {
      url,
      stop,
      pid: child.pid,
      kill: async () => {
        child.kill('SIGKILL');
        await exited;
      },
    };
  } catch (error) {
    await stop();
    throw error;
  }
}

/** WebGL without a graphics card. */
const SOFTWARE_WEBGL = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/** Chromium with a fresh profile, which the launcher makes and removes. */
export function startBrowser({ webgl = false } = {}) {
  return chromium.launch({
    executablePath: '/usr/bin/chromium',
    headless: true,
    args: [
      '--headless',
      '--no-sandbox',
      ...(webgl ? SOFTWARE_WEBGL : ['--disable-gpu']),
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });
}

/** What no page, frame or worker of a browser may do: complain, or ask anybody but its server. */
export class Watch {
  complaints = [];
  strangers = [];

  constructor(browser, url) {
    const { host } = new URL(url);
    const judge = (address) => {
      const { protocol, host: asked } = new URL(address);
      // These two never leave the page.
      if (protocol !== 'blob:' && protocol !== 'data:' && asked !== host) {
        this.strangers.push(address);
      }
    };
    // A refusal by the content security policy is an error on the console.
    browser.on('context', (context) => {
      context.on('console', (message) => {
        if (message.type() !== 'error' && message.type() !== 'warning') return;
        // A driver in software says that a screenshot of the 3-D view takes time.
        if (message.text().includes('GPU stall due to ReadPixels')) return;
        this.complaints.push(`${message.text()} (${message.location().url})`);
      });
      context.on('weberror', (error) => this.complaints.push(error.error().message));
      context.on('request', (request) => judge(request.url()));
      context.on('page', (page) => page.on('websocket', (socket) => judge(socket.url())));
    });
  }
}

/** Runs the tests in order, all of them, and returns how many failed. */
export async function runAll(tests, context) {
  let failed = 0;
  for (const [name, test] of tests) {
    const start = Date.now();
    try {
      await test(context);
      console.log(`ok    ${name} (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    } catch (error) {
      failed += 1;
      console.log(`FAIL  ${name}\n      ${error.message}`);
      await context.lab
        .screenshot(`failed-${name.replaceAll(/\W+/g, '-')}`)
        .catch((reason) => console.log(`      no screenshot: ${reason.message}`));
      await context
        .recover(context)
        .catch((reason) => console.log(`      no recovery: ${reason.message}`));
    }
  }
  return failed;
}
