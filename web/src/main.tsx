// Assembles the page: one laboratory, its panels around it.

import type { JSX } from 'solid-js';
import { render } from 'solid-js/web';
import { createLab } from './lab';
import { CameraPanel } from './panels/CameraPanel';
import { ControllerPanel } from './panels/ControllerPanel';
import { Header } from './panels/Header';
import { LogPanel } from './panels/LogPanel';
import { LowerPanel } from './panels/LowerPanel';
import { Transport } from './panels/Transport';
import { createTheme } from './theme';
import { WorkspacePanel } from './workspace/WorkspacePanel';

function Page(): JSX.Element {
  const { theme, toggle } = createTheme();
  const lab = createLab(window.location);
  return (
    <>
      <Header lab={lab} theme={theme} onTheme={toggle} />
      <main>
        <WorkspacePanel lab={lab} theme={theme} />
        <CameraPanel lab={lab} />
        <ControllerPanel lab={lab} />
        <LowerPanel lab={lab} theme={theme} />
        <LogPanel lab={lab} />
      </main>
      <Transport lab={lab} />
    </>
  );
}

const root = document.getElementById('app');
if (!root) throw new Error('index.html has no #app');
render(() => <Page />, root);
