// Assembles the page: the laboratory with its panels, and the other views.

// Imported first, so that the panels' styles override it.
import './Page.css';
import { Match, Show, Switch, createEffect, createSignal, type JSX } from 'solid-js';
import { type View, VIEWS } from '../lab/address';
import { openLinks } from './openLinks';
import { createLab } from '../lab/lab';
import { followChallengeLink } from '../lab/pageChallenge';
import { createPageExperiment } from '../lab/pageExperiment';
import { createCapture } from '../features/export/capture';
import { CaptureTools, RecordingClock } from '../features/export/CaptureTools';
import { openCase } from '../features/events/cases';
import { Dock } from './Dock';
import { FirstVisit } from './FirstVisit';
import { createFirstVisit } from './visit';
import { Help } from './Help';
import { Inspector } from './Inspector';
import { MAP_LAYERS } from './layers';
import { PhoneTabs } from './PhoneTabs';
import { Rail } from './Rail';
import { Stage } from './Stage';
import { TopBar } from './TopBar';
import { FailureCard } from '../features/failure/FailureCard';
import { createInteraction } from '../plan/interaction';
import { createLayers } from '../plan/layer';
import { createChoice } from '../ui/storage';
import { LiveRegion } from './LiveRegion';
import { createMapOpener } from '../features/maps/opener';
import { ExperimentNotice } from '../features/share/ExperimentNotice';
import { ShareButton } from '../features/share/ShareButton';
import { onFileDrop } from '../ui/fileDrop';
import { lazyPart, lazyView } from '../ui/lazyPart';
import type { ViewPicture } from '../plan/viewPicture';

const ShareFiles = lazyPart(
  () => import('./ShareFiles'),
  'list of files',
  (missing) => missing,
);
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
  const layers = createLayers(MAP_LAYERS, lab);
  const interaction = createInteraction(lab, layers);
  const first = createFirstVisit(address, window);
  const [mode, chooseMode] = createChoice('view', ['plan', 'scene']);
  createEffect(() => {
    document.title = view() === 'laboratory' ? 'Ferry' : `${VIEWS[view()]} – Ferry`;
    if (address.lesson() !== undefined) lab.showPanel('learn');
  });
  /** Opens a view with its form filled in. Without its code it says so itself. */
  const showFilled = async (name: View, fillIn: () => Promise<void>): Promise<void> => {
    await fillIn().catch(() => undefined);
    address.show(name);
  };
  /** The laboratory shows what a dropped file has changed, or why it was refused. */
  const onDrop = (name: RegExp, take: (file: File) => Promise<void>): void => {
    onFileDrop(name, (file) => {
      address.show('laboratory');
      void take(file);
    });
  };
  onDrop(/\.svg$/i, async (file) => {
    lab.showPanel('setup');
    await opener.open(file);
  });
  onDrop(/\.json$/i, (file) => openCase(lab, file));
  return (
    <Show
      when={!first.isOpen()}
      fallback={
        <FirstVisit lab={lab} interaction={interaction} layers={layers} onEnd={first.end} />
      }
    >
      <Rail lab={lab} />
      {/* Before the other parts, so that Run is among the first stops of the Tab key. */}
      <Show when={view() === 'laboratory'}>
        <Dock lab={lab} />
      </Show>
      <TopBar
        lab={lab}
        mode={mode()}
        onMode={chooseMode}
        share={
          <ShareButton
            session={lab.session}
            links={links}
            map={lab.scene()?.map}
            open={openLinks(lab)}
            files={<ShareFiles lab={lab} />}
          >
            <CaptureTools capture={capture} />
          </ShareButton>
        }
      />
      <LiveRegion lab={lab} />
      <Switch>
        <Match when={view() === 'laboratory'}>
          <Stage
            lab={lab}
            interaction={interaction}
            layers={layers}
            mode={mode()}
            onMode={chooseMode}
            onPicture={setPicture}
            notice={<ExperimentNotice lab={lab} links={links} />}
          >
            <RecordingClock capture={capture} />
          </Stage>
          <Inspector
            lab={lab}
            parts={{
              picker: interaction.picker,
              layers,
              links,
              opener,
              onTrain: () =>
                void showFilled('train', async () => {
                  (await import('../features/train/state')).showMap();
                }),
            }}
            below={<FailureCard lab={lab} />}
          />
        </Match>
        <Match when={view() === 'draw'}>
          <DrawView lab={lab} open={opener.open} />
        </Match>
        <Match when={view() === 'train'}>
          <TrainView
            lab={lab}
            onEvaluate={(policy, map) =>
              void showFilled('evaluate', async () => {
                (await import('../features/evaluate/draft')).fillIn(policy, map);
              })
            }
          />
        </Match>
        <Match when={view() === 'recordings'}>
          <RecordingsView
            session={lab.session}
            tick={lab.state()?.tick}
            maps={lab.catalog.maps()}
          />
        </Match>
        <Match when={view() === 'evaluate'}>
          <EvaluateView lab={lab} />
        </Match>
      </Switch>
      <PhoneTabs lab={lab} />
      <Help lab={lab} />
    </Show>
  );
}
