import solid from 'vite-plugin-solid';
import { defineConfig } from 'vitest/config';

export default defineConfig({
  plugins: [solid()],
  // For the names in src/styles/breakpoints.css.
  css: { transformer: 'lightningcss', lightningcss: { drafts: { customMedia: true } } },
  build: {
    outDir: process.env.FERRY_WEB_OUT ?? 'dist',
    emptyOutDir: true,
    target: 'es2022',
    // The page's policy is `default-src 'self'`: a `data:` address would be refused.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    // The page, the one that Rerun's viewer has for itself, the one to log in with, and what is there in place of a page
    // that is not.
    rolldownOptions: {
      input: ['index.html', 'viewer/index.html', 'login/index.html', 'refused/index.html'],
    },
    // The renderer of the 3-D view, which is loaded when that is opened.
    chunkSizeWarningLimit: 700,
  },
  test: {
    // Only pure modules are unit-tested; the page itself is tested in a browser (e2e).
    environment: 'node',
    include: ['src/**/*.test.ts'],
  },
});
