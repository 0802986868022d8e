// The page `/demo`: the scene of the session `demo` on the whole screen.

import { Show, createSignal, type JSX } from 'solid-js';
import { Demo } from '../features/demo/Demo';
import { createLab } from '../lab/lab';
import { createInteraction } from '../plan/interaction';
import { createLayers } from '../plan/layer';
import { PlanView } from '../plan/PlanView';
import { ScenePanel } from '../scene/ScenePanel';
import { MAP_LAYERS } from './layers';

const HELP_ID = 'demo-help';
/** Visitors see the bead for the first time, and it moves. */
const GRAB_PX = 56;

export default function DemoPage(): JSX.Element {
  const lab = createLab(window, MAP_LAYERS);
  const layers = createLayers(MAP_LAYERS, lab);
  const interaction = createInteraction(lab, layers, GRAB_PX);
  const [isFlat, setFlat] = createSignal(false);
  const toPlan = (): void => {
    setFlat(true);
  };
  const [begun, setBegun] = createSignal(0);
  const surface = { lab, interaction, layers, helpId: HELP_ID, whole: begun };
  return (
    <Demo
      lab={lab}
      onBegin={() => {
        setBegun((count) => count + 1);
      }}
    >
      <p id={HELP_ID} class="visually-hidden">
        Drag the bead to disturb it. Click a free place to set a goal.
      </p>
      <Show
        when={isFlat()}
        fallback={<ScenePanel {...surface} onPlan={toPlan} onProblem={toPlan} isFixed isBold />}
      >
        <PlanView {...surface} />
      </Show>
    </Demo>
  );
}
