// A map of one's own: drawn here, checked by the server after each change, saved and used.

import { createMemo, type JSX } from 'solid-js';
import type { Addressed, Notices, Panels, Session, Trial } from '../../lab/slices';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { fixed } from '../../ui/format';
import { listen } from '../../ui/listen';
import { ScaleBar } from '../../ui/ScaleBar';
import { ViewFrame } from '../../ui/ViewFrame';
import { createCheck } from './check';
import { Dock } from './Dock';
import { svgText } from './drawing';
import { createEditor } from './editor';
import { farGoal } from './farGoal';
import { onUndoKey } from './keys';
import { type Places, placesOf } from './marks';
import { SidePanel } from './SidePanel';
import { Surface } from './Surface';
import { HELP_ID, helpOf } from './tools';
import './draw.css';

/** Keeps the drawing and its history while another view is open. */
const editor = createEditor();

export default function DrawView(props: {
  lab: Addressed & Session & Trial & Notices & Panels;
  /** Adds the drawing to the server's maps and loads it; returns whether it was added. */
  open: (file: File, places: Places) => Promise<boolean>;
}): JSX.Element {
  const { lab } = props;
  const svg = createMemo(() => svgText(editor.editing().drawing));
  const isLive = createMemo(() => lab.connection().kind === 'live');
  const check = createCheck(svg, isLive);
  listen('keydown', (event) => onUndoKey(editor, event));
  const frame = () => editor.editing().drawing.frame;
  const place = (): string => {
    const at = editor.pointer();
    return at ? `x ${fixed(at[0] / 1000, 3)} y ${fixed(-at[1] / 1000, 3)} m` : '';
  };
  const save = async (file: File): Promise<void> => {
    const { marks = {} } = editor.editing().drawing;
    if (!(await props.open(file, placesOf(marks)))) return;
    lab.address.show('laboratory');
    // What the server has read, and which policies deliver on it.
    lab.showPanel('setup');
    const [scene, state] = [lab.scene(), lab.state()];
    if (!scene || !state || state.goal_m) return;
    const [x, y] = state.bead_m;
    const goal = farGoal(scene, [x, y]);
    if (goal) await lab.send('workspace', { type: 'set_goal', x_m: goal[0], y_m: goal[1] });
  };
  return (
    <ViewFrame
      class="draw"
      map={<Surface editor={editor} passages={check.found()?.passages ?? []} />}
      over={<p class="draw-about">Squares of 5 cm. The border is a wall.</p>}
      under={
        <>
          <p id={HELP_ID} class="draw-help">
            {helpOf(editor.editing().tool)}
          </p>
          <output class="readout number" aria-live="off">
            {place()}
          </output>
          <ScaleBar width_m={frame().width_mm / 1000} height_m={frame().height_mm / 1000} />
        </>
      }
      inspectorName="Check and use"
      inspector={<SidePanel lab={lab} editor={editor} check={check} onSave={save} />}
      dockName="Tools"
      dock={
        <>
          <PlaceNotice lab={lab} place="playback" />
          <Dock editor={editor} />
        </>
      }
    />
  );
}
