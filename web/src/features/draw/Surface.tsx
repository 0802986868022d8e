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
import { GOAL_RADIUS_M, type NarrowPlace } from '../../net/protocol.gen';
import { millimetres } from '../../ui/format';
import { TESTED_WIDTH_M } from './check';
import {
  BLANK,
  type Frame,
  type Mark,
  type Mm,
  movedInside,
  pathText,
  type Shape,
  snapped,
  withImages,
} from './drawing';
import type { Editor } from './editor';
import { pending, shift } from './editing';
import { onKey } from './keys';
import { createPointer } from './pointer';
import { measured } from './measure';
import { HELP_ID } from './tools';

const GRID_MM = 50;
const FONT_PX = 12;
const CORNER_PX = 4;
const RIM_PX = 1.5;
const START_PX = 7;
/** Of the wall around the frame, as in draw.css. */
const BORDER_MM = 6;

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

/** The edge of a shape, below all shapes: where walls meet, they are one. */
function Rim(props: { shape: Shape; mmPerPx: number; isSelected: boolean }): JSX.Element {
  const width_mm = (): number => (props.shape.kind === 'wall' ? props.shape.width_mm : 0);
  const rim_mm = (): number => (props.isSelected ? 2 : 1) * RIM_PX * props.mmPerPx;
  return (
    <path
      d={pathText(props.shape)}
      class="draw-rim"
      classList={{ selected: props.isSelected }}
      stroke-width={width_mm() + 2 * rim_mm()}
    />
  );
}

function Label(props: { at: Mm; mmPerPx: number; children: JSX.Element }): JSX.Element {
  return (
    <text
      class="draw-label"
      x={props.at[0]}
      y={props.at[1]}
      font-size={String(FONT_PX * props.mmPerPx)}
    >
      {props.children}
    </text>
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
        <Label at={at()} mmPerPx={props.mmPerPx}>
          {millimetres(props.place.width_m)}
        </Label>
      </g>
    </Show>
  );
}

/** Where the bead starts, or the circle of the goal. */
function Marked(props: { mark: Mark; at: Mm; mmPerPx: number }): JSX.Element {
  const radius_mm = (): number =>
    props.mark === 'goal' ? 1000 * GOAL_RADIUS_M : START_PX * props.mmPerPx;
  return (
    <g class="draw-mark" data-mark={props.mark}>
      <circle cx={props.at[0]} cy={props.at[1]} r={radius_mm()} />
      <Label
        at={[props.at[0], props.at[1] - radius_mm() - FONT_PX * props.mmPerPx]}
        mmPerPx={props.mmPerPx}
      >
        {props.mark}
      </Label>
    </g>
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
  /** As they are, or as they are dragged. */
  const marks = createMemo(() => {
    const { drawing, tool, trace, snap_mm } = editor.editing();
    const last = trace.at(-1);
    const dragged = last && (tool === 'start' || tool === 'goal');
    const all = { ...drawing.marks, ...(dragged && { [tool]: snapped(last, snap_mm) }) };
    return Object.entries(all) as [Mark, Mm][];
  });
  const by = createMemo(() => shift(editor.editing()));
  const begun = createMemo(() => {
    const now = editor.editing();
    const shape = pending(now, editor.pointer());
    return shape ? withImages(shape, now.drawing.frame, now.symmetry) : [];
  });
  /** The frame fills the box of the map, and its border is around it. */
  const border_mm = createMemo(() => {
    const { width_mm, height_mm } = frame();
    const { width_mm: usual_mm, height_mm: high_mm } = BLANK.frame;
    return BORDER_MM * Math.max(width_mm / usual_mm, height_mm / high_mm);
  });
  const rectangle = (more_mm: number) => {
    const { x_mm, y_mm, width_mm, height_mm } = frame();
    return {
      x: x_mm - more_mm,
      y: y_mm - more_mm,
      width: width_mm + 2 * more_mm,
      height: height_mm + 2 * more_mm,
    };
  };
  const viewBox = (): string => {
    const { x, y, width, height } = rectangle(border_mm());
    return `${x} ${y} ${width} ${height}`;
  };
  /** Between the frame and the edge, over the ends of the rims. */
  const border = (): string =>
    [rectangle(border_mm()), rectangle(0)]
      .map(({ x, y, width, height }) => `M${x} ${y}h${width}v${height}h${-width}z`)
      .join('');
  const isErasing = (): boolean => editor.editing().tool === 'erase';
  const isSelected = (index: number): boolean => editor.editing().selected === index;
  const shownAt = (shape: Shape, index: number): Shape => {
    const now = isSelected(index) ? by() : undefined;
    return now ? movedInside(shape, now, frame()) : shape;
  };
  /** What is begun, otherwise what is selected. */
  const size = createMemo(() => {
    if (isErasing()) return undefined;
    const selected = editor.editing().selected ?? -1;
    const shape = shapes()[selected];
    const one = begun()[0] ?? (shape && shownAt(shape, selected));
    return one && measured(one);
  });
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
      <rect class="draw-floor" {...rectangle(0)} />
      <Grid frame={frame()} />
      <For each={shapes()}>
        {(shape, index) => (
          <Rim
            shape={shownAt(shape, index())}
            mmPerPx={mmPerPx()}
            isSelected={isSelected(index())}
          />
        )}
      </For>
      <path class="draw-border" d={border()} />
      <For each={shapes()}>{(shape, index) => <Drawn shape={shownAt(shape, index())} />}</For>
      <For each={begun()}>
        {(shape) => <Drawn shape={shape} class={isErasing() ? 'rubber' : 'begun'} />}
      </For>
      <For each={editor.editing().corners}>
        {([x, y]) => <circle class="draw-corner" cx={x} cy={y} r={CORNER_PX * mmPerPx()} />}
      </For>
      <For each={props.passages}>
        {(place, index) => (
          <Passage place={place} isNarrowest={index() === 0} mmPerPx={mmPerPx()} />
        )}
      </For>
      <For each={marks()}>{([mark, at]) => <Marked mark={mark} at={at} mmPerPx={mmPerPx()} />}</For>
      <Show when={size()}>
        {(one) => (
          <Label at={one().at} mmPerPx={mmPerPx()}>
            {one().text}
          </Label>
        )}
      </Show>
      <Show when={editor.pointer()}>
        {(at) => <circle class="draw-cursor" cx={at()[0]} cy={at()[1]} r={cursorRadius()} />}
      </Show>
    </svg>
  );
}
