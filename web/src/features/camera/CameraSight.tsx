// What the controllers see: the camera's image beside what they make of it. Enlarged, with its blocks and the observation.

import { For, Show, createEffect, createSignal, type JSX } from 'solid-js';
import { Maximize2, Minimize2 } from 'lucide';
import { counted, fixed } from '../../ui/format';
import { createCameraBitmap } from '../../lab/cameraBitmap';
import { blocksPath, patchPath } from '../../lab/homography';
import { CAMERA_PX, OBSERVATION_PX, OBSTACLE_MEAN } from '../../net/protocol.gen';
import type { Notices, Pictures } from '../../lab/slices';
import { createFold } from '../../ui/fold';
import { Icon } from '../../ui/Icon';
import { Segmented } from '../../ui/Segmented';
import './camera.css';

const BLOCKS = ['hidden', 'quadtree', 'rectangles'] as const;
type BlocksShown = (typeof BLOCKS)[number];

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

/** Whether the patch around the tool is free. */
function Verdict(props: { lab: Pictures }): JSX.Element {
  return (
    <p
      class="verdict"
      title={`Obstacle if the mean brightness of the 15×15 pixels around the tool is below ${OBSTACLE_MEAN}`}
    >
      <Show when={props.lab.overlay()} fallback="–">
        {(overlay) => (
          <>
            <strong classList={{ alarm: overlay().obstacle }}>
              {overlay().obstacle ? 'Obstacle' : 'Clear'}
            </strong>{' '}
            around the tool (brightness{' '}
            <span class="number">{fixed(overlay().center_mean, 0)}</span>)
          </>
        )}
      </Show>
    </p>
  );
}

/** Below the enlarged image. */
function CameraDetails(props: {
  lab: Pictures;
  blocksShown: BlocksShown;
  onBlocks: (shown: BlocksShown) => void;
}): JSX.Element {
  const { lab } = props;
  const channels: HTMLCanvasElement[] = [];
  createEffect(() => {
    const picture = lab.observation();
    const size = OBSERVATION_PX * OBSERVATION_PX;
    if (picture?.bytes.length !== 2 * size) return;
    channels.forEach((canvas, channel) =>
      drawGray(canvas, picture.bytes.subarray(channel * size, (channel + 1) * size)),
    );
  });
  return (
    <div id="camera-details" class="camera-details">
      <Verdict lab={lab} />
      <Segmented
        label="Blocks"
        name="blocks-shown"
        value={props.blocksShown}
        segments={BLOCKS.map((value) => ({
          value,
          label: value === 'hidden' ? 'No blocks' : value,
        }))}
        onChoose={props.onBlocks}
      />
      <p
        class="blocks-count number"
        data-testid="blocks"
        title="The dark blocks of the quadtree are merged into the smallest possible number of rectangles: N − L − H + C"
      >
        <Show when={lab.overlay()?.blocks}>
          {(layer) => (
            <>
              {counted(layer().rectangles.length, 'rectangle')} from{' '}
              {counted(layer().dark.length, 'block')}
            </>
          )}
        </Show>
      </p>
      <For each={CHANNELS}>
        {([name, shows], channel) => (
          <figure>
            <canvas
              ref={(canvas) => (channels[channel()] = canvas)}
              width={OBSERVATION_PX}
              height={OBSERVATION_PX}
              role="img"
              aria-label={`Observation, channel ${channel()}: ${shows}`}
            />
            <figcaption>Network: {name}</figcaption>
          </figure>
        )}
      </For>
    </div>
  );
}

/** The child stands beside the small image. */
export function CameraSight(props: {
  lab: Notices & Pictures;
  children: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  let canvas!: HTMLCanvasElement;
  const fold = createFold('camera');
  const [blocksShown, setBlocksShown] = createSignal<BlocksShown>('hidden');
  const bitmap = createCameraBitmap(lab);
  createEffect(() => {
    const picture = bitmap();
    if (picture) canvas.getContext('2d')?.drawImage(picture, 0, 0, CAMERA_PX, CAMERA_PX);
  });
  const blocks = (): string => {
    const overlay = lab.overlay();
    const shown = blocksShown();
    if (!overlay || shown === 'hidden' || !fold.isOpen()) return '';
    const { picture_from_table, blocks: layer } = overlay;
    const one = shown === 'rectangles' ? layer.rectangles : [...layer.dark, ...layer.free];
    return blocksPath(picture_from_table, layer, one);
  };
  return (
    <div class="camera-sight" classList={{ enlarged: fold.isOpen() }}>
      <div class="camera-image">
        <canvas
          ref={canvas}
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
        <button
          type="button"
          aria-label="Camera"
          aria-expanded={fold.isOpen()}
          aria-controls="camera-details"
          title={fold.isOpen() ? 'Make the image smaller' : 'Enlarge the image'}
          onClick={() => fold.set(!fold.isOpen())}
        >
          <Icon of={fold.isOpen() ? Minimize2 : Maximize2} />
        </button>
      </div>
      <Show when={fold.isOpen()}>
        <CameraDetails lab={lab} blocksShown={blocksShown()} onBlocks={setBlocksShown} />
      </Show>
      <div class="camera-beside">{props.children}</div>
    </div>
  );
}
