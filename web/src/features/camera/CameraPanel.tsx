// What the controllers see: the camera image with its test patch, and the observation.

import { For, Show, createEffect, createSignal, type JSX } from 'solid-js';
import { counted, fixed } from '../../ui/format';
import { createCameraBitmap } from '../../lab/cameraBitmap';
import { blocksPath, patchPath } from '../../lab/homography';
import { CAMERA_PX, OBSERVATION_PX, OBSTACLE_MEAN } from '../../net/protocol.gen';
import type { Notices, Pictures } from '../../lab/slices';
import { createFold } from '../../ui/fold';
import { FoldButton } from '../../ui/FoldButton';
import './camera.css';

type BlocksShown = 'none' | 'quadtree' | 'rectangles';

/** Of the observation. */
const CHANNELS = [
  ['image', 'the camera image with 84 by 84 pixels'],
  ['goal, tool', 'goal in the upper half, tool in the lower half, x on the left, y on the right'],
] as const;

/** Draws a gray image, one byte per pixel, on a canvas of the same size. */
function drawGray(canvas: HTMLCanvasElement, gray: Uint8Array): void {
  const ctx = canvas.getContext('2d');
  if (!ctx) return;
  const image = ctx.createImageData(OBSERVATION_PX, OBSERVATION_PX);
  gray.forEach((value, index) => {
    image.data.fill(value, 4 * index, 4 * index + 3);
    image.data[4 * index + 3] = 255;
  });
  ctx.putImageData(image, 0, 0);
}

function CameraPictures(props: { lab: Notices & Pictures }): JSX.Element {
  const { lab } = props;
  let cameraCanvas!: HTMLCanvasElement;
  const channels: HTMLCanvasElement[] = [];
  const bitmap = createCameraBitmap(lab);
  createEffect(() => {
    const picture = bitmap();
    if (picture) cameraCanvas.getContext('2d')?.drawImage(picture, 0, 0, CAMERA_PX, CAMERA_PX);
  });

  createEffect(() => {
    const picture = lab.observation();
    const size = OBSERVATION_PX * OBSERVATION_PX;
    if (picture?.bytes.length !== 2 * size) return;
    channels.forEach((canvas, channel) => {
      drawGray(canvas, picture.bytes.subarray(channel * size, (channel + 1) * size));
    });
  });

  const [blocksShown, setBlocksShown] = createSignal<BlocksShown>('none');
  const blocks = (): string => {
    const overlay = lab.overlay();
    const shown = blocksShown();
    if (!overlay || shown === 'none') return '';
    const { picture_from_table, blocks: layer } = overlay;
    const one = shown === 'rectangles' ? layer.rectangles : [...layer.dark, ...layer.free];
    return blocksPath(picture_from_table, layer, one);
  };
  return (
    <>
      <figure class="camera-figure">
        <div class="picture-frame">
          <canvas
            ref={cameraCanvas}
            width={CAMERA_PX}
            height={CAMERA_PX}
            role="img"
            aria-label="Live image of the end-effector camera"
          />
          <svg
            class="patch"
            classList={{ obstacle: lab.overlay()?.obstacle ?? false }}
            viewBox={`0 0 ${CAMERA_PX} ${CAMERA_PX}`}
            aria-hidden="true"
          >
            <path class="blocks" d={blocks()} />
            <Show when={lab.overlay()}>{(overlay) => <path d={patchPath(overlay())} />}</Show>
          </svg>
          <Show when={!bitmap()}>
            <p class="placeholder">No image yet</p>
          </Show>
        </div>
        <figcaption class="blocks-choice">
          <span>
            <label for="blocks-shown">Blocks</label>{' '}
            <select
              id="blocks-shown"
              value={blocksShown()}
              onChange={(event) => {
                setBlocksShown(event.currentTarget.value as BlocksShown);
              }}
            >
              <option value="none">hidden</option>
              <option value="quadtree">quadtree</option>
              <option value="rectangles">rectangles</option>
            </select>
          </span>
          <Show when={lab.overlay()?.blocks}>
            {(layer) => (
              <span
                class="number"
                data-testid="blocks"
                title="The dark blocks of the quadtree are merged into the smallest possible number of rectangles: N − L − H + C"
              >
                {counted(layer().rectangles.length, 'rectangle')} from{' '}
                {counted(layer().dark.length, 'block')}
              </span>
            )}
          </Show>
        </figcaption>
      </figure>
      <For each={CHANNELS}>
        {([name, shows], channel) => (
          <figure>
            <canvas
              ref={(canvas) => (channels[channel()] = canvas)}
              class="pixels"
              width={OBSERVATION_PX}
              height={OBSERVATION_PX}
              role="img"
              aria-label={`Observation, channel ${channel()}: ${shows}`}
            />
            <figcaption>Network: {name}</figcaption>
          </figure>
        )}
      </For>
    </>
  );
}

export function CameraPanel(props: { lab: Notices & Pictures }): JSX.Element {
  const { lab } = props;
  const fold = createFold('camera');
  return (
    <section
      class="panel camera"
      aria-labelledby="camera-title"
      data-closed={fold.isOpen() ? undefined : ''}
    >
      <header class="panel-head">
        <h2 id="camera-title">
          <FoldButton fold={fold} controls="camera-pictures">
            Camera
          </FoldButton>
        </h2>
        <Show when={fold.isOpen() && lab.overlay()}>
          {(overlay) => (
            <span
              class="verdict"
              classList={{ obstacle: overlay().obstacle }}
              title={`Obstacle if the mean brightness of the 15×15 pixels around the tool is below ${OBSTACLE_MEAN}`}
            >
              {overlay().obstacle ? 'Obstacle' : 'Clear'} (brightness{' '}
              <span class="number">{fixed(overlay().center_mean, 0)}</span>)
            </span>
          )}
        </Show>
      </header>
      <div id="camera-pictures" class="pictures" hidden={!fold.isOpen()}>
        <Show when={fold.isOpen()}>
          <CameraPictures lab={lab} />
        </Show>
      </div>
    </section>
  );
}
