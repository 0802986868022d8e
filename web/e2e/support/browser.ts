// The browser, its arguments and window sizes.

/** Chromium without its own window: the same engine, with a fifth less work than `chromium --headless`. */
export const BROWSER = process.env.FERRY_BROWSER ?? '/usr/bin/chromium-headless-shell';

/** Arguments of every test. */
export const CHROMIUM_ARGUMENTS = [
  '--headless',
  '--no-sandbox',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/** WebGL without a graphics card. Replaces `--disable-gpu`. */
export const SOFTWARE_WEBGL = [
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
];

export const DESKTOP = { viewport: { width: 1280, height: 800 } };
export const TABLET = { viewport: { width: 820, height: 1180 }, hasTouch: true };
export const PHONE = { viewport: { width: 390, height: 844 } };
