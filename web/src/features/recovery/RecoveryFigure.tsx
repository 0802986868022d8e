// One controller's cells, or the difference of two, to look at and to choose from.

import { For, Show, type JSX } from 'solid-js';
import type { Polygon, Rect, RecoveryReport } from '../../net/protocol.gen';
import { ARROWS } from '../../plan/gesture';
import { ForKeyed } from '../../ui/ForKeyed';
import type { Look } from './cells';
import { mm } from './cells';
import { drawingOf, nextShape } from './shapes';

const FAINTEST = 0.25;
const DOT = 7;

function outline(ring: readonly (readonly [number, number])[]): string {
  return `M${ring.map(([x_m, y_m]) => `${mm(x_m).toFixed(1)} ${(-mm(y_m)).toFixed(1)}`).join('L')}z`;
}

const wallsPath = (walls: readonly Polygon[]): string =>
  walls.flatMap(({ exterior, holes }) => [exterior, ...holes].map(outline)).join('');

/** Stripes and crosses, so that the figure is read without its colours, too. */
function Patterns(): JSX.Element {
  return (
    <defs>
      <pattern id="recovery-late" width="8" height="8" patternUnits="userSpaceOnUse">
        <rect class="late-ground" width="8" height="8" />
        <path class="late-lines" d="M-2 2l4-4M0 8l8-8M6 10l4-4" />
      </pattern>
      <pattern id="recovery-lost" width="8" height="8" patternUnits="userSpaceOnUse">
        <rect class="lost-ground" width="8" height="8" />
        <path class="lost-lines" d="M0 0l8 8M8 0l-8 8" />
      </pattern>
    </defs>
  );
}

export function RecoveryFigure(props: {
  report: RecoveryReport;
  /** The controller whose cells are drawn. */
  name: string;
  label: string;
  looks: ReadonlyMap<number, Look>;
  workspace: Rect;
  walls: readonly Polygon[];
  chosen: number | undefined;
  dropped: number | undefined;
  /** Without, it is only a picture. */
  onChoose?: (cell: number) => void;
}): JSX.Element {
  const drawing = () => drawingOf(props.report, props.name, props.workspace);
  const dot = (at: readonly [number, number], kind: string): JSX.Element => (
    <circle class={`dot ${kind}`} cx={mm(at[0])} cy={-mm(at[1])} r={DOT} />
  );
  return (
    <svg
      class="recovery-cells"
      viewBox={drawing().box.join(' ')}
      {...(props.onChoose
        ? {
            role: 'application',
            tabindex: 0,
            'aria-label': `${props.label}: cells. Arrow keys choose one.`,
          }
        : { 'aria-hidden': 'true' })}
      onKeyDown={(event) => {
        const arrow = ARROWS[event.key];
        if (!arrow || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        event.stopPropagation();
        const next = nextShape(drawing().shapes, props.chosen, [arrow[0], -arrow[1]]);
        if (next !== undefined) props.onChoose?.(next);
      }}
    >
      <Patterns />
      <Show when={props.report.kind === 'place'}>
        <path class="wall" fill-rule="evenodd" d={wallsPath(props.walls)} />
      </Show>
      {/* Each report draws them again. A press that began on one must end on the same. */}
      <ForKeyed each={drawing().shapes} by={({ cell }) => String(cell)}>
        {(shape) => {
          const look = (): Look | undefined => props.looks.get(shape().cell);
          return (
            <path
              d={shape().path}
              class="cell"
              data-cell={shape().cell}
              data-kind={look()?.kind}
              classList={{
                chosen: props.chosen === shape().cell,
                dropped: props.dropped === shape().cell,
              }}
              fill-opacity={FAINTEST + (1 - FAINTEST) * (look()?.strength ?? 0)}
              onClick={() => {
                props.onChoose?.(shape().cell);
              }}
            />
          );
        }}
      </ForKeyed>
      <For each={props.onChoose && drawing().labels}>
        {({ text, at: [x, y] }) => (
          <text class="axis number" x={x} y={y} aria-hidden="true">
            {text}
          </text>
        )}
      </For>
      <Show when={props.report.kind === 'place'}>
        {dot(props.report.bead_m, 'bead')}
        <Show when={props.report.goal_m}>{(goal_m) => dot(goal_m(), 'goal')}</Show>
      </Show>
    </svg>
  );
}
