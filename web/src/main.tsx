// Assembles the page: one laboratory, its panels around it.

import { Match, Switch, createSignal, type JSX } from 'solid-js';
import { render } from 'solid-js/web';
import { keepFocus } from './app/focus';
import { createLab } from './lab/lab';
import { createLinks } from './lab/pageExperiment';
import { carriesToken, takeToken } from './pages/login/token';
import { AsidePanel } from './app/AsidePanel';
import { CameraPanel } from './features/camera/CameraPanel';
import { ControllerPanel } from './features/controller/ControllerPanel';
import { EvaluateView } from './features/evaluate/EvaluateView';
import { Header } from './app/Header';
import { LiveRegion } from './app/LiveRegion';
import { LowerPanel } from './app/LowerPanel';
import { RecordingsView } from './features/recordings/RecordingsView';
import { Transport } from './features/playback/PlaybackBar';
import { createTheme } from './ui/theme';
import type { View } from './app/views';
import { WorkspacePanel } from './app/WorkspacePanel';

function Page(): JSX.Element {
  const { theme, toggle } = createTheme();
  const lab = createLab(window.location);
  const links = createLinks(lab, window);
  const [view, setView] = createSignal<View>('laboratory');
  return (
    <>
      <Header lab={lab} theme={theme} onTheme={toggle} view={view()} onView={setView} />
      <LiveRegion lab={lab} />
      <Switch>
        <Match when={view() === 'laboratory'}>
          <main>
            <WorkspacePanel lab={lab} theme={theme} />
            <CameraPanel lab={lab} />
            <ControllerPanel lab={lab} />
            <LowerPanel lab={lab} theme={theme} />
            <AsidePanel lab={lab} theme={theme} />
          </main>
          <Transport lab={lab} links={links} />
        </Match>
        <Match when={view() === 'recordings'}>
          <RecordingsView theme={theme} />
        </Match>
        <Match when={view() === 'evaluate'}>
          <EvaluateView
            lab={lab}
            onLaboratory={() => {
              setView('laboratory');
            }}
          />
        </Match>
      </Switch>
    </>
  );
}

// A link to log in with, in a browser that has: nothing of it may stay in the address.
takeToken(window);
// The same link followed in this very tab: as if it had been opened anew, in front of whoever reads the address.
window.addEventListener('hashchange', (event) => {
  if (!carriesToken(window)) return;
  event.stopImmediatePropagation();
  window.location.reload();
});

const root = document.getElementById('app');
if (!root) throw new Error('index.html has no #app');
keepFocus(document);
render(() => <Page />, root);
