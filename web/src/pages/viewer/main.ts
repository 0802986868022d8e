// The page of Rerun's viewer, in a frame of the Recordings view: `/viewer/?recording=ID&theme=dark`.

import { reasonText } from '../../net/problem';
import { answered } from '../../net/requests';
import { keptAtHome } from './home';
import { themeOf } from '../../features/recordings/viewerMessages';
import { loadViewer, type WebHandle } from './rerun';
import { part } from '../part';
import { Scheme } from './scheme';
import { addressOf } from '../../net/base';

const PANIC_CHECK_MS = 1000;

const canvas = part('canvas');
const status = part('p');

function show(state: 'loading' | 'open' | 'failed', text: string): void {
  document.body.dataset.state = state;
  status.textContent = text;
}

/** The used fields of the viewer's events. */
interface ViewerEvent {
  readonly type?: string;
  readonly timeline?: string;
  readonly time?: number;
}

/** Shows the viewer when the recording is open, and keeps its place on the time line for the tests. */
function follow({ type, timeline, time }: ViewerEvent): void {
  if (type === 'recording_open') show('open', '');
  if (timeline !== undefined) document.body.dataset.timeline = timeline;
  if (time !== undefined) document.body.dataset.time = String(time);
}

function watchForPanic(handle: WebHandle): void {
  if (handle.has_panicked()) {
    show('failed', `Rerun's viewer has crashed: ${handle.panic_message() ?? 'no reason given'}`);
    return;
  }
  setTimeout(() => watchForPanic(handle), PANIC_CHECK_MS);
}

async function open(recording: string): Promise<void> {
  const path = `/api/recordings/${encodeURIComponent(recording)}.rrd`;
  const { href } = new URL(addressOf(path), location.origin);
  // Only the answer to GET says why it is refused.
  if (!(await fetch(href, { method: 'HEAD' })).ok) await answered(path, {});
  show('loading', 'Loading Rerun’s viewer, 13 MB the first time…');
  const Handle = await loadViewer();
  show('loading', 'Opening the recording…');
  const handle = new Handle({
    url: href,
    render_backend: 'webgl',
    hide_welcome_screen: true,
    enable_history: false,
    persist: false,
    on_viewer_event: (event) => follow(JSON.parse(event) as ViewerEvent),
  });
  await handle.start(canvas);
  watchForPanic(handle);
}

function start(): void {
  const query = new URLSearchParams(location.search);
  const theme = query.get('theme') === 'light' ? 'light' : 'dark';
  const scheme = new Scheme(theme);
  globalThis.fetch = keptAtHome(fetch.bind(globalThis), location.origin);
  globalThis.matchMedia = scheme.answering(matchMedia.bind(globalThis));
  // The viewer logs tens of thousands of lines about its shaders.
  // eslint-disable-next-line no-console
  console.debug = () => undefined;

  document.documentElement.dataset.theme = theme;
  addEventListener('message', ({ origin, data }) => {
    const changed = origin === location.origin ? themeOf(data) : undefined;
    if (!changed) return;
    document.documentElement.dataset.theme = changed;
    scheme.set(changed);
  });
  open(query.get('recording') ?? '').catch((reason: unknown) =>
    show('failed', `The recording could not be opened: ${reasonText(reason)}`),
  );
}

start();
