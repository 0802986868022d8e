import { appendFileSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import { type Plugin, defineConfig } from 'vite';
import solid from 'vite-plugin-solid';

/** What the page is made of, with its licences. The help links to it. */
const LICENSES = 'licenses.txt';

/** Writes each file also as gzip and as brotli, where that is smaller. The server sends what the browser accepts. */
const compressed = (): Plugin => ({
  name: 'compressed',
  apply: 'build',
  writeBundle({ dir = '' }) {
    for (const entry of readdirSync(dir, { recursive: true, withFileTypes: true })) {
      if (!entry.isFile()) continue;
      const path = join(entry.parentPath, entry.name);
      const content = readFileSync(path);
      for (const [ending, pack] of [
        ['gz', gzipSync] as const,
        ['br', brotliCompressSync] as const,
      ]) {
        const packed = pack(content, ending === 'gz' ? { level: 9 } : {});
        if (packed.length < content.length) writeFileSync(`${path}.${ending}`, packed);
      }
    }
  },
});

/** The font is no module, so that Vite does not list its licence. */
const fontLicense = (): Plugin => ({
  name: 'font-license',
  apply: 'build',
  writeBundle({ dir = '' }) {
    const text = readFileSync('node_modules/@fontsource-variable/inter/LICENSE');
    appendFileSync(join(dir, LICENSES), `\n\n## Inter (OFL-1.1)\n\n${text.toString()}`);
  },
});

/**
 * uPlot asks `Intl` for the browser's language when it is loaded, which throws where that is no language tag: `C`, `de_DE`.
 * The standard language of the browser is always one.
 */
const anyLanguage = (): {
  name: string;
  transform: (code: string, id: string) => string | null;
} => ({
  name: 'any-language',
  transform: (code, id) => {
    if (!/uPlot\.esm\.js/.test(id)) return null;
    if (!code.includes('nav.language')) throw new Error('uPlot does not ask for a language');
    return code.replace('nav.language', 'undefined');
  },
});

/** Where `make dev` finds the server. */
const SERVER = process.env.FERRY_SERVER ?? 'http://127.0.0.1:8080';
/** What the server answers; the rest is the page. */
const SERVED = ['/api', '/rerun', '/login', '/logout', '/healthz', '/metrics'];

/** Requests a session's address from the server too, which opens the session. */
const opensSessions = (): Plugin => ({
  name: 'opens-sessions',
  configureServer({ middlewares }) {
    middlewares.use(({ url = '' }, _response, next) => {
      if (!/^\/(s\/[^?]+|demo)?(\?|$)/.test(url)) {
        next();
        return;
      }
      fetch(SERVER + url).then(
        () => next(),
        () => next(new Error(`no server at ${SERVER}: start one with \`ferry serve\``)),
      );
    });
  },
});

export default defineConfig({
  experimental: {
    // Scripts and styles find each other from where they lie: the server may be at any path. It corrects its own pages.
    renderBuiltUrl: (name, { hostType }) => (hostType === 'html' ? `/${name}` : { relative: true }),
  },
  plugins: [solid(), anyLanguage(), fontLicense(), compressed(), opensSessions()],
  // Libraries are bundled beforehand for `make dev` and for tests of components.
  optimizeDeps: { rolldownOptions: { plugins: [anyLanguage()] } },
  server: {
    // The server takes requests of its own page only.
    proxy: Object.fromEntries(
      SERVED.map((path) => [
        path,
        { target: SERVER, ws: true, changeOrigin: true, headers: { origin: SERVER } },
      ]),
    ),
  },
  // For the names in src/styles/breakpoints.css.
  css: { transformer: 'lightningcss', lightningcss: { drafts: { customMedia: true } } },
  build: {
    outDir: process.env.FERRY_WEB_OUT ?? 'dist',
    emptyOutDir: true,
    // As in index.html and docs/operations.md.
    target: ['chrome111', 'edge111', 'firefox121', 'safari16.4'],
    // The page's policy is `default-src 'self'`: a `data:` address would be refused.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    license: { fileName: LICENSES },
    // The page, the one that Rerun's viewer has for itself, the one to log in with, and what is there in place of a page
    // that is not.
    rolldownOptions: {
      input: ['', 'viewer/', 'login/', 'refused/', 'copy/'].map((folder) => `${folder}index.html`),
    },
    // The renderer of the 3-D view, which is loaded when that is opened.
    chunkSizeWarningLimit: 700,
  },
});
