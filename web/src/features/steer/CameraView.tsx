// The camera's picture in place of the map: the hand sees what the controllers see.

import { createEffect, createMemo, createSignal, type JSX } from 'solid-js';
import { createCameraBitmap } from '../../lab/cameraBitmap';
import type { TableView } from '../../lab/geometry';
import { type Homography, pictureFromTable, tableFromPicture } from '../../lab/homography';
import type { Notices } from '../../lab/slices';
import { CAMERA_PX } from '../../net/protocol.gen';
import type { SurfaceProps } from '../../plan/PlanView';
import { circle } from '../../plan/shapes';
import { contextOf } from '../../plan/sheet';
import { ViewCanvas } from '../../plan/ViewCanvas';
import type { Size } from '../../ui/size';
import { palette } from '../../ui/palette';
import './steer.css';

/** The square of the picture inside the canvas. */
function squareIn({ width, height }: Size): { left: number; top: number; side: number } {
  const side = Math.min(width, height);
  return { left: (width - side) / 2, top: (height - side) / 2, side };
}

function viewThrough(homography: Homography, size: Size): TableView {
  const { left, top, side } = squareIn(size);
  const scale = side / CAMERA_PX;
  return {
    toPx: (point) => {
      const [column, row] = pictureFromTable(homography, point);
      return [left + column * scale, top + row * scale];
    },
    toWorld: ([x, y]) => tableFromPicture(homography, [(x - left) / scale, (y - top) / scale]),
  };
}

export function CameraView(
  props: Pick<SurfaceProps, 'lab' | 'interaction' | 'helpId' | 'onPicture'> & {
    notices: Notices;
  },
): JSX.Element {
  const { lab, interaction } = props;
  const bitmap = createCameraBitmap({ ...props.notices, camera: lab.camera });
  const [canvas, setCanvas] = createSignal<HTMLCanvasElement>();
  const [size, setSize] = createSignal<Size>({ width: 0, height: 0 });
  const view = createMemo(() => {
    const overlay = lab.overlay();
    return overlay && size().width > 0
      ? viewThrough(overlay.picture_from_table, size())
      : undefined;
  });
  createEffect(() => interaction.setView(view()));
  // A viewer sees the hand in every state, and it mostly stays where it was.
  const hand = createMemo(
    () => lab.steering.target() ?? lab.state()?.steer_m ?? undefined,
    undefined,
    {
      equals: (a, b) => a?.[0] === b?.[0] && a?.[1] === b?.[1],
    },
  );
  createEffect(() => {
    const [onto, { width, height }] = [canvas(), size()];
    const ctx = onto && contextOf(onto, { width, height });
    const [picture, to] = [bitmap(), hand()];
    if (!ctx || !picture) return;
    const { left, top, side } = squareIn({ width, height });
    ctx.drawImage(picture, left, top, side, side);
    const px = to && view()?.toPx(to);
    if (!px) return;
    ctx.strokeStyle = palette().you;
    ctx.lineWidth = 2;
    circle(ctx, px, 7);
    ctx.stroke();
  });
  return (
    <div class="camera-surface">
      <ViewCanvas
        lab={lab}
        interaction={interaction}
        label="Workspace"
        class="camera-canvas"
        helpId={props.helpId}
        onCanvas={setCanvas}
        onSize={setSize}
        draw={canvas}
        onPicture={props.onPicture}
      />
    </div>
  );
}
