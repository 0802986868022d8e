// Whether the browser draws 3-D without a graphics card, which is slow. Loads nothing of the 3-D view.

const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** By the name of the renderer; one without a name is not trusted. */
export const isSoftware = (renderer: string | undefined): boolean =>
  !renderer || SOFTWARE.test(renderer);

function rendererName(): string | undefined {
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('webgl2', { failIfMajorPerformanceCaveat: true });
  const info = context?.getExtension('WEBGL_debug_renderer_info');
  const name: unknown = info && context?.getParameter(info.UNMASKED_RENDERER_WEBGL);
  // A browser has few contexts and frees unused ones late.
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return typeof name === 'string' ? name : undefined;
}

let answer: boolean | undefined;

/** Asks the browser once. */
export const drawsSlowly = (): boolean => (answer ??= isSoftware(rendererName()));

/** The view of a user who has not chosen one, where the 3-D view is wanted. */
export const firstView = (isSlow = drawsSlowly()): 'plan' | 'scene' => (isSlow ? 'plan' : 'scene');
