// The drawing, as the SVG that it is.

import {
  For,
  Show,
  createEffect,
  createMemo,
  createSignal,
  onCleanup,
  onMount,
  type JSX,
} from 'solid-js';
import type { NarrowPlace } from '../../net/protocol.gen';
import { millimetres } from '../../ui/format';
import { TESTED_WIDTH_M } from './check';
import { type Frame, type Mm, movedInside, pathText, type Shape, withImages } from './drawing';
import type { Editor } from './editor';
import { pending, shift } from './editing';
import { onKey } from './keys';
import { createPointer } from './pointer';
import { HELP_ID } from './Toolbar';

const GRID_MM = 50;
const FONT_PX = 12;
const CORNER_PX = 4;
/** Around the frame, so that strokes at the border can be seen whole. */
const MARGIN_MM = 12;

function* gridLines(from_mm: number, length_mm: number): Generator<number> {
  const first = Math.ceil(from_mm / GRID_MM) * GRID_MM;
  for (let at = first; at <= from_mm + length_mm; at += GRID_MM) yield at;
}

function Grid(props: { frame: Frame }): JSX.Element {
  const path = (): string => {
    const { x_mm, y_mm, width_mm, height_mm } = props.frame;
    const upright = [...gridLines(x_mm, width_mm)].map((x) => `M${x} ${y_mm}v${height_mm}`);
    const level = [...gridLines(y_mm, height_mm)].map((y) => `M${x_mm} ${y}h${width_mm}`);
    return [...upright, ...level].join('');
  };
  return <path class="draw-grid" d={path()} />;
}

function Drawn(props: { shape: Shape; class?: string }): JSX.Element {
  return (
    <path
      d={pathText(props.shape)}
      class={`draw-shape ${props.class ?? ''}`}
      data-kind={props.shape.kind}
      fill-rule="evenodd"
      stroke-width={props.shape.kind === 'wall' ? props.shape.width_mm : undefined}
    />
  );
}

function Passage(props: {
  place: NarrowPlace;
  isNarrowest: boolean;
  mmPerPx: number;
}): JSX.Element {
  const at = (): Mm => [1000 * props.place.x_m, -1000 * props.place.y_m];
  const isTight = (): boolean => props.place.width_m < TESTED_WIDTH_M;
  return (
    <Show when={isTight() || props.isNarrowest}>
      <g class="draw-passage" classList={{ tight: isTight() }} data-testid="passage">
        <circle cx={at()[0]} cy={at()[1]} r={500 * props.place.width_m} />
        <text x={at()[0]} y={at()[1]} font-size={String(FONT_PX * props.mmPerPx)}>
          {millimetres(props.place.width_m)}
        </text>
      </g>
    </Show>
  );
}

export function Surface(props: { editor: Editor; passages: readonly NarrowPlace[] }): JSX.Element {
  const { editor } = props;
  let svg!: SVGSVGElement;
  const [mmPerPx, setMmPerPx] = createSignal(1);
  const frame = createMemo(() => editor.editing().drawing.frame);
  const measure = (): void => {
    setMmPerPx(1 / (svg.getScreenCTM()?.a ?? 1));
  };
  onMount(() => {
    const observer = new ResizeObserver(measure);
    observer.observe(svg);
    // Another frame has another scale.
    createEffect(() => {
      frame();
      measure();
    });
    onCleanup(() => observer.disconnect());
  });
  const shapes = createMemo(() => editor.editing().drawing.shapes);
  const by = createMemo(() => shift(editor.editing()));
  const begun = createMemo(() => {
    const now = editor.editing();
    const shape = pending(now, editor.pointer());
    return shape ? withImages(shape, now.drawing.frame, now.symmetry) : [];
  });
  const viewBox = (): string => {
    const { x_mm, y_mm, width_mm, height_mm } = frame();
    const [x, y] = [x_mm - MARGIN_MM, y_mm - MARGIN_MM];
    return `${x} ${y} ${width_mm + 2 * MARGIN_MM} ${height_mm + 2 * MARGIN_MM}`;
  };
  const rectangle = () => {
    const { x_mm, y_mm, width_mm, height_mm } = frame();
    return { x: x_mm, y: y_mm, width: width_mm, height: height_mm };
  };
  const isErasing = (): boolean => editor.editing().tool === 'erase';
  /** The eraser's circle, or the place of a corner or a post. */
  const cursorRadius = (): number =>
    isErasing() ? editor.editing().size_mm.erase / 2 : CORNER_PX * mmPerPx();
  return (
    <svg
      ref={svg}
      class="draw-surface"
      data-tool={editor.editing().tool}
      viewBox={viewBox()}
      tabindex="0"
      role="application"
      aria-label="Drawing"
      aria-describedby={HELP_ID}
      {...createPointer(editor)}
      onKeyDown={(event) => onKey(editor, event)}
    >
      <rect class="draw-floor" {...rectangle()} />
      <Grid frame={frame()} />
      <For each={shapes()}>
        {(shape, index) => {
          const isSelected = (): boolean => editor.editing().selected === index();
          const shown = (): Shape => {
            const now = isSelected() ? by() : undefined;
            return now ? movedInside(shape, now, frame()) : shape;
          };
          return <Drawn shape={shown()} class={isSelected() ? 'selected' : ''} />;
        }}
      </For>
      <For each={begun()}>
        {(shape) => <Drawn shape={shape} class={isErasing() ? 'rubber' : 'begun'} />}
      </For>
      <For each={editor.editing().corners}>
        {([x, y]) => <circle class="draw-corner" cx={x} cy={y} r={CORNER_PX * mmPerPx()} />}
      </For>
      <rect class="draw-border" {...rectangle()} />
      <For each={props.passages}>
        {(place, index) => (
          <Passage place={place} isNarrowest={index() === 0} mmPerPx={mmPerPx()} />
        )}
      </For>
      <Show when={editor.pointer()}>
        {(at) => <circle class="draw-cursor" cx={at()[0]} cy={at()[1]} r={cursorRadius()} />}
      </Show>
    </svg>
  );
}
