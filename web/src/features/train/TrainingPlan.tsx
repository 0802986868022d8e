// The map from above with a value map of the training, and the episodes that move on it.

import { createEffect, createMemo, createSignal, onCleanup, onMount, type JSX } from 'solid-js';
import { nextToward, type Vec2 } from '../../lab/geometry';
import type { MapCheck, TrainingCells, TrainingFrame } from '../../net/protocol.gen';
import { createValues } from '../../plan/drawValues';
import { ARROWS } from '../../plan/gesture';
import { Relief } from '../../plan/relief';
import { contextOf } from '../../plan/sheet';
import { fitView, type View, worldFromPx } from '../../plan/transform';
import { framed } from '../../plan/tray';
import { onSize, type Size } from '../../ui/size';
import { prefersLessMotion } from '../../ui/motion';
import { drawBase, drawEpisodes, type Layers, mostSteps } from './drawFrame';
import { around, cellAt, valueCells } from './grid';
import { palette } from '../../ui/palette';

/** Around the box of the map, for the mark of a goal near the border, as in watch.css. */
const MARGIN_PX = 12;
const MARGIN = { left: MARGIN_PX, right: MARGIN_PX, top: MARGIN_PX, bottom: MARGIN_PX };
const STEPS_PER_S = 14;
/** The ends of the episodes are shown for as many steps. */
const REST_STEPS = 14;

interface PlanProps {
  readonly label: string;
  readonly helpId?: string;
  /** Undefined until the server has sent it. */
  readonly map: MapCheck | undefined;
  readonly cells?: TrainingCells | undefined;
  readonly frame?: TrainingFrame | undefined;
  readonly range?: readonly [number, number] | undefined;
  readonly layers: Layers;
  readonly chosen?: number | undefined;
  readonly onChoose?: (place: Vec2) => void;
}

export function TrainingPlan(props: PlanProps): JSX.Element {
  let base!: HTMLCanvasElement;
  let moving!: HTMLCanvasElement;
  const isStill = prefersLessMotion();
  const [size, setSize] = createSignal<Size>();
  const workspace = createMemo(
    () => props.map?.workspace ?? (props.cells ? around(props.cells) : undefined),
  );
  const view = createMemo<View | undefined>(() => {
    const [rect, now] = [workspace(), size()];
    return rect && now && fitView(framed(rect), now.width, now.height, MARGIN);
  });
  const relief = createMemo(() => {
    const rect = workspace();
    return rect && new Relief({ workspace: rect, walls: props.map?.outlines ?? [] }, palette());
  });
  const values = createMemo(() => {
    const { cells, frame, range } = props;
    return cells && frame && createValues(valueCells(cells, frame), palette(), range);
  });
  onMount(() => {
    onSize(base, setSize);
    createEffect(() => {
      const [now, px, walls] = [view(), size(), relief()];
      const { layers, cells, frame, chosen } = props;
      const ctx = px && contextOf(base, px);
      if (!ctx || !now || !walls) return;
      drawBase(ctx, {
        ...{ view: now, palette: palette(), relief: walls, layers },
        ...{ cells, frame, chosen, values: values() },
      });
    });
    createEffect(() => {
      const [now, px] = [view(), size()];
      const { cells, frame } = props;
      if (!now || !px) return;
      const base = { view: now, palette: palette() };
      const isShown = props.layers.episodes && cells && frame;
      const draw = (steps: number): void => {
        const ctx = contextOf(moving, px);
        if (ctx && isShown) drawEpisodes(ctx, base, cells, frame, steps);
      };
      if (!isShown || isStill()) {
        draw(Infinity);
        return;
      }
      const period = mostSteps(frame) + REST_STEPS;
      const began_ms = performance.now();
      let request = 0;
      const next = (): void => {
        draw((((performance.now() - began_ms) / 1000) * STEPS_PER_S) % period);
        request = requestAnimationFrame(next);
      };
      next();
      onCleanup(() => cancelAnimationFrame(request));
    });
  });

  const onKeyDown = (event: KeyboardEvent): void => {
    const direction = ARROWS[event.key];
    const { cells } = props;
    if (!direction || !cells || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    const from = props.chosen ?? cellAt(cells, cells.goal_m) ?? 0;
    const at = cells.centers_m[from];
    const next = at && nextToward(cells.centers_m, at, direction);
    const center = cells.centers_m[next ?? from];
    if (center) props.onChoose?.(center);
  };
  return (
    <div class="train-plan">
      <canvas
        ref={base}
        class="train-canvas"
        tabindex="0"
        role="application"
        aria-label={props.label}
        aria-describedby={props.helpId}
        data-cell={props.chosen}
        data-update={props.frame?.update}
        onClick={(event) => {
          const now = view();
          if (now) props.onChoose?.(worldFromPx(now, [event.offsetX, event.offsetY]));
        }}
        onKeyDown={onKeyDown}
      />
      <canvas ref={moving} class="train-episodes" aria-hidden="true" />
    </div>
  );
}
