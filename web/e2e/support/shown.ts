// Finds out in the page what it draws, without help by the page. These functions run in it before its scripts.

declare global {
  interface Window {
    /** Calls back in the frame that shows another tick. */
    ferryShown: (listener: (tick: string) => void) => void;
    ferryGpu: { frames: number; buffers: number; textures: number };
  }
}

/** The tick is written, as the title of the time, in the frame that draws its state. */
export function tellTick() {
  const listeners: ((tick: string) => void)[] = [];
  window.ferryShown = (listener) => listeners.push(listener);
  const appeared = new MutationObserver(() => {
    const element = document.querySelector<HTMLElement>('[data-testid=sim-time]');
    if (!element) return;
    appeared.disconnect();
    new MutationObserver(() => {
      const tick = element.title.replace(/\D/g, '');
      for (const listener of listeners) listener(tick);
    }).observe(element, { attributeFilter: ['title'] });
  });
  appeared.observe(document, { childList: true, subtree: true });
}

/** Counts what the newest WebGL context draws and keeps on the graphics card. */
export function countGpu() {
  const contexts = new WeakMap<object, Window['ferryGpu']>();
  const count = (
    method: keyof WebGL2RenderingContext,
    what: keyof Window['ferryGpu'],
    by: number,
  ) => {
    const gl = WebGL2RenderingContext.prototype;
    const own = Reflect.get(gl, method) as (...all: unknown[]) => unknown;
    Reflect.set(gl, method, function (this: WebGL2RenderingContext, ...all: unknown[]) {
      const counts = contexts.get(this) ?? { frames: 0, buffers: 0, textures: 0 };
      counts[what] += by;
      contexts.set(this, counts);
      window.ferryGpu = counts;
      return own.apply(this, all);
    });
  };
  count('clear', 'frames', 1);
  count('createBuffer', 'buffers', 1);
  count('deleteBuffer', 'buffers', -1);
  count('createTexture', 'textures', 1);
  count('deleteTexture', 'textures', -1);
}
