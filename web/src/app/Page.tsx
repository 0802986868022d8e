// Assembles the page: the laboratory with its panels, and the other views.

// Imported first, so that the panels' styles override it.
import './Page.css';
import { Match, Switch, createSignal, type JSX } from 'solid-js';
import { createLab } from '../lab/lab';
import { createPageExperiment } from '../lab/pageExperiment';
import { AsidePanel } from './AsidePanel';
import { CameraPanel } from '../features/camera/CameraPanel';
import { ControllerPanel } from '../features/controller/ControllerPanel';
import { EvaluateView } from '../features/evaluate/EvaluateView';
import { Header } from './Header';
import { MAP_LAYERS } from './layers';
import { LiveRegion } from './LiveRegion';
import { LowerPanel } from './LowerPanel';
import { RecordingsView } from '../features/recordings/RecordingsView';
import { OpenMap } from '../features/maps/OpenMap';
import { PlaybackBar } from '../features/playback/PlaybackBar';
import { ExperimentNotice } from '../features/share/ExperimentNotice';
import { PresetSelect } from '../features/share/PresetSelect';
import { ShareButton } from '../features/share/ShareButton';
import { WhyCard } from '../features/why/WhyCard';
import { ControllerFacts } from './ControllerFacts';
import { createTheme } from '../ui/theme';
import type { View } from './views';
import { WorkspacePanel } from './WorkspacePanel';

export function Page(): JSX.Element {
  const { theme, toggle } = createTheme();
  const lab = createLab(window.location, MAP_LAYERS);
  const links = createPageExperiment(lab, window);
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
            <ControllerPanel lab={lab}>
              <ControllerFacts lab={lab} />
            </ControllerPanel>
            <LowerPanel lab={lab} theme={theme} />
            <AsidePanel lab={lab} theme={theme} />
          </main>
          <PlaybackBar
            lab={lab}
            above={<ExperimentNotice lab={lab} links={links} />}
            choices={
              <>
                <OpenMap lab={lab} />
                <PresetSelect lab={lab} links={links} />
              </>
            }
            share={<ShareButton links={links} />}
            below={<WhyCard lab={lab} />}
          />
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
