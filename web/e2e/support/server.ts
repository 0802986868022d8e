// Starts and stops a Ferry server for the tests.

import { type ChildProcess, execFileSync, spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const BINARY =
  process.env.FERRY_BIN ?? fileURLToPath(new URL('../../../target/release/ferry', import.meta.url));
const START_MS = 60_000;
const KEPT_LINES = 200;

export interface ServerOptions {
  /** A free port if not set. */
  readonly port?: string;
  /** Without a login if not set. */
  readonly token?: string;
  /** What sessions begin with; with `null`, saved sessions go on. The tests set their own goals. */
  readonly scenario?: string | null;
  /** The data folder of a server that was stopped; a new one if not set. */
  readonly data?: string;
  /** The address of its robot server; without one if not set. Each test has its own. */
  readonly robot?: string;
  /** Path below which a proxy has it; none if not set. */
  readonly basePath?: string;
  /** The address of a robot that it mirrors and may move. */
  readonly drives?: string;
}

/** A server process with its own data folder. */
export class Server {
  private lines: string[] = [];

  private constructor(
    readonly url: string,
    private readonly child: ChildProcess,
    readonly data: string,
    private readonly exited: Promise<unknown>,
  ) {}

  static newToken() {
    return execFileSync(BINARY, ['token'], { encoding: 'utf8' }).trim();
  }

  static async start({ port = '0', token, scenario = 'empty', ...given }: ServerOptions = {}) {
    const data = given.data ?? (await mkdtemp(join(tmpdir(), 'ferry-e2e-')));
    const child = spawn(
      BINARY,
      [
        ...(given.drives === undefined
          ? ['serve']
          : ['drive', '--robot', given.drives, '--enable-motion']),
        ...['--bind', `127.0.0.1:${port}`],
        ...['--data', data],
        ...(scenario === null ? [] : ['--scenario', scenario]),
        ...(given.basePath === undefined ? [] : ['--base-path', given.basePath]),
        ...(given.robot === undefined ? [] : ['--robot-server', given.robot]),
      ],
      {
        stdio: ['ignore', 'pipe', 'pipe'],
        env: { ...process.env, ...(token === undefined ? {} : { FERRY_TOKEN: token }) },
      },
    );
    const exited = once(child, 'exit');
    const output: string[] = [];
    const keep = (line: string) => {
      output.push(line);
      if (output.length > KEPT_LINES) output.shift();
    };
    createInterface({ input: child.stderr }).on('line', keep);
    try {
      const url = await listening(child, keep);
      const server = new Server(url, child, data, exited);
      server.lines = output;
      return server;
    } catch (error) {
      child.kill('SIGKILL');
      await rm(data, { recursive: true, force: true });
      throw new Error(`${String(error)}\n${output.join('\n')}`, { cause: error });
    }
  }

  get pid() {
    return this.child.pid;
  }

  get port() {
    return new URL(this.url).port;
  }

  /** The last lines of the server's output. */
  get log() {
    return this.lines.join('\n');
  }

  /** Leaves the data folder for another server. */
  async end() {
    this.child.kill('SIGTERM');
    await this.exited;
  }

  async stop() {
    await this.end();
    await rm(this.data, { recursive: true, force: true });
  }

  async kill() {
    this.child.kill('SIGKILL');
    await this.exited;
  }
}

function listening(child: ChildProcess, keep: (line: string) => void) {
  return new Promise<string>((resolve, reject) => {
    const timer = setTimeout(() => {
      reject(new Error('the server does not listen'));
    }, START_MS);
    child.once('error', reject);
    child.once('exit', (code) => {
      clearTimeout(timer);
      reject(new Error(`the server ended with ${String(code)} before it listened`));
    });
    if (!child.stdout) return;
    createInterface({ input: child.stdout }).on('line', (line) => {
      keep(line);
      const url = /listening on (http:\/\/\S+)/.exec(line)?.[1];
      if (!url) return;
      clearTimeout(timer);
      resolve(url);
    });
  });
}
