// Assembles the page: the laboratory with its panels, and the other views.

// Imported first, so that the panels' styles override it.
import './Page.css';
import { Match, Switch, createEffect, createSignal, type JSX } from 'solid-js';
import { VIEWS } from '../lab/address';
import { createLab } from '../lab/lab';
import { followChallengeLink } from '../lab/pageChallenge';
import { createPageExperiment } from '../lab/pageExperiment';
import { AsidePanel } from './AsidePanel';
import { CameraPanel } from '../features/camera/CameraPanel';
import { createCapture } from '../features/export/capture';
import { CaptureTools, RecordingClock } from '../features/export/CaptureTools';
import { openCase } from '../features/events/cases';
import { ControllerPanel } from '../features/controller/ControllerPanel';
import { fillIn } from '../features/evaluate/draft';
import { Header } from './Header';
import { MAP_LAYERS } from './layers';
import { LiveRegion } from './LiveRegion';
import { LowerPanel } from './LowerPanel';
import { OpenMap } from '../features/maps/OpenMap';
import { createMapOpener } from '../features/maps/opener';
import { showMap } from '../features/train/state';
import { PlaybackBar } from '../features/playback/PlaybackBar';
import { KeptRuns } from '../features/runs/KeptRuns';
import { ExperimentNotice } from '../features/share/ExperimentNotice';
import { PresetSelect } from '../features/share/PresetSelect';
import { ShareButton } from '../features/share/ShareButton';
import { TwinFacts } from '../features/twin/TwinFacts';
import { WhyCard } from '../features/why/WhyCard';
import { ControllerFacts } from './ControllerFacts';
import { onFileDrop } from '../ui/fileDrop';
import { lazyView } from '../ui/lazyPart';
import type { ViewPicture } from '../plan/viewPicture';
import { WorkspacePanel } from './WorkspacePanel';

const DrawView = lazyView(() => import('../features/draw/DrawView'));
const TrainView = lazyView(() => import('../features/train/TrainView'));
const EvaluateView = lazyView(() => import('../features/evaluate/EvaluateView'));
const RecordingsView = lazyView(() => import('../features/recordings/RecordingsView'));

export function Page(): JSX.Element {
  const lab = createLab(window, MAP_LAYERS);
  const links = createPageExperiment(lab, window);
  void followChallengeLink(lab, window);
  const { address } = lab;
  const { view } = address;
  const [picture, setPicture] = createSignal<ViewPicture>();
  const capture = createCapture(lab, picture);
  const opener = createMapOpener(lab);
  createEffect(() => {
    document.title = view() === 'laboratory' ? 'Ferry' : `${VIEWS[view()]} – Ferry`;
    if (address.lesson() !== undefined) lab.openTab('lessons');
  });
  /** The laboratory shows what a dropped file has changed, or why it was refused. */
  const onDrop = (name: RegExp, take: (file: File) => Promise<void>): void => {
    onFileDrop(name, (file) => {
      address.show('laboratory');
      void take(file);
    });
  };
  onDrop(/\.svg$/i, async (file) => {
    await opener.open(file);
  });
  onDrop(/\.json$/i, (file) => openCase(lab, file));
  return (
    <>
      <Header lab={lab} />
      <LiveRegion lab={lab} />
      <Switch>
        <Match when={view() === 'laboratory'}>
          {/* Before the panels, so that Run is among the first stops of the Tab key. */}
          <PlaybackBar
            lab={lab}
            above={<ExperimentNotice lab={lab} links={links} />}
            choices={
              <>
                <OpenMap
                  lab={lab}
                  opener={opener}
                  onTrain={() => {
                    showMap();
                    address.show('train');
                  }}
                />
                <PresetSelect lab={lab} links={links} />
              </>
            }
            share={
              <ShareButton links={links} map={lab.scene()?.map}>
                <CaptureTools capture={capture} />
              </ShareButton>
            }
            runs={<KeptRuns lab={lab} />}
            below={<WhyCard lab={lab} />}
          />
          <main>
            <WorkspacePanel lab={lab} onPicture={setPicture}>
              <RecordingClock capture={capture} />
            </WorkspacePanel>
            <CameraPanel lab={lab} />
            <ControllerPanel lab={lab} above={<TwinFacts lab={lab} />}>
              <ControllerFacts lab={lab} />
            </ControllerPanel>
            <LowerPanel lab={lab} />
            <AsidePanel lab={lab} />
          </main>
        </Match>
        <Match when={view() === 'draw'}>
          <DrawView lab={lab} open={(file) => opener.open(file)} />
        </Match>
        <Match when={view() === 'train'}>
          <TrainView
            lab={lab}
            onEvaluate={(policy, map) => {
              fillIn(policy, map);
              address.show('evaluate');
            }}
          />
        </Match>
        <Match when={view() === 'recordings'}>
          <RecordingsView session={lab.session} tick={lab.state()?.tick} />
        </Match>
        <Match when={view() === 'evaluate'}>
          <EvaluateView lab={lab} />
        </Match>
      </Switch>
    </>
  );
}
