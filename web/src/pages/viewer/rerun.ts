// The used part of Rerun's viewer: exports of wasm-bindgen in `re_viewer.js` 0.36.

import { addressOf } from '../../net/base';
/** Options of the viewer. See `AppOptions` in Rerun's `re_viewer/src/web.rs`. */
interface ViewerOptions {
  readonly url: string;
  readonly render_backend: 'webgl' | 'webgpu';
  readonly hide_welcome_screen: boolean;
  readonly enable_history: boolean;
  readonly persist: boolean;
  readonly on_viewer_event: (event: string) => void;
}

export interface WebHandle {
  start(canvas: HTMLCanvasElement): Promise<void>;
  has_panicked(): boolean;
  panic_message(): string | undefined;
}

interface Viewer {
  (source: { module_or_path: Promise<Response> }): Promise<unknown>;
  readonly WebHandle: new (options: ViewerOptions) => WebHandle;
}

// `re_viewer.js` is a classic script that declares one name for all scripts of the page.
declare const wasm_bindgen: Viewer;

const SCRIPT = addressOf('/rerun/re_viewer.js');
const MODULE = addressOf('/rerun/re_viewer_bg.wasm');

function runScript(address: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const script = document.createElement('script');
    script.src = address;
    script.onload = () => resolve();
    script.onerror = () => reject(new Error(`${address} could not be loaded.`));
    document.head.append(script);
  });
}

/** Loads the viewer, about 13 MB the first time. */
export async function loadViewer(): Promise<Viewer['WebHandle']> {
  const module = fetch(MODULE);
  await runScript(SCRIPT);
  await wasm_bindgen({ module_or_path: module });
  return wasm_bindgen.WebHandle;
}
