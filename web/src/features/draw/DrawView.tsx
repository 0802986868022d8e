// A map of one's own: drawn here, checked by the server after each change, saved and used.

import { createMemo, type JSX } from 'solid-js';
import { PlaceNotice } from '../../lab/PlaceNotice';
import type { Addressed, Notices, Session, Trial } from '../../lab/slices';
import { fixed } from '../../ui/format';
import { listen } from '../../ui/listen';
import { createCheck } from './check';
import { svgText } from './drawing';
import { createEditor } from './editor';
import { onUndoKey } from './keys';
import { SidePanel } from './SidePanel';
import { Surface } from './Surface';
import { Toolbar } from './Toolbar';
import './draw.css';

/** Keeps the drawing and its history while another view is open. */
const editor = createEditor();

export default function DrawView(props: {
  lab: Addressed & Session & Trial & Notices;
  /** Adds the drawing to the server's maps and loads it; returns whether it was added. */
  open: (file: File) => Promise<boolean>;
}): JSX.Element {
  const svg = createMemo(() => svgText(editor.editing().drawing));
  const isLive = createMemo(() => props.lab.connection().kind === 'live');
  const check = createCheck(svg, isLive);
  listen('keydown', (event) => onUndoKey(editor, event));
  const place = (): string => {
    const at = editor.pointer();
    return at ? `x ${fixed(at[0] / 1000, 3)} y ${fixed(-at[1] / 1000, 3)} m` : 'x –   y –';
  };
  return (
    <main class="view draw">
      <Toolbar editor={editor} />
      <section class="panel draw-stage" aria-label="Drawing area">
        <Surface editor={editor} passages={check.found()?.passages ?? []} />
        <footer class="panel-foot">
          <p class="hint">Squares of 5 cm. The border is a wall.</p>
          <output class="readout" aria-live="off">
            {place()}
          </output>
        </footer>
        <PlaceNotice lab={props.lab} place="playback" />
      </section>
      <SidePanel
        lab={props.lab}
        editor={editor}
        check={check}
        onSave={async (file) => {
          if (await props.open(file)) props.lab.address.show('laboratory');
        }}
      />
    </main>
  );
}
