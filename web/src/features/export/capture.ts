// Pictures and videos of the view. The page makes them; nothing is sent to the server.

import { createSignal, untrack, type Accessor } from 'solid-js';
import { messageOf } from '../../ui/attempt';
import { download, pngOfCanvas } from '../../ui/download';
import type { ViewPicture } from '../../plan/viewPicture';
import type { Notices, Trial } from '../../lab/slices';
import { caption, createSheet, fileName, fillSheet } from './picture';
import { ownVideoType, record, videoEnding, type Recording } from './video';
import { palette } from '../../ui/palette';

/** Pixels of a picture per CSS pixel, at least. */
const PICTURE_RATIO = 2;

export type Capture = ReturnType<typeof createCapture>;

export function createCapture(lab: Trial & Notices, view: Accessor<ViewPicture | undefined>) {
  const type = ownVideoType();
  const [recorded_s, setRecorded] = createSignal<number>();
  const [saved, setSaved] = createSignal<string>();
  let recording: Recording | undefined;

  const say = (reason: unknown): void => lab.notify('workspace', messageOf(reason));
  const save = (name: string, content: Blob): void => {
    download(name, content);
    setSaved(name);
  };
  /** Draws the view as it is now. */
  const fill = (sheet: HTMLCanvasElement, ratio: number): boolean =>
    untrack(() => {
      const [now, scene, state] = [view(), lab.scene(), lab.state()];
      if (!now || !scene || !state) return false;
      return fillSheet(sheet, ratio, now, palette(), caption(scene.map, state));
    });
  const nameOf = (ending: string): string =>
    untrack(() => {
      const [scene, state] = [lab.scene(), lab.state()];
      return scene && state ? fileName(scene.map, state, ending) : `ferry.${ending}`;
    });

  return {
    /** Whether there is a view to capture. */
    isReady: () => view() !== undefined && lab.state() !== undefined,
    canRecord: type !== undefined,
    /** Whole seconds of the video that is being recorded; undefined if none is. */
    recorded_s,
    /** Name of the file that was saved last, until `forget`. */
    saved,
    forget: () => setSaved(undefined),
    savePicture: async (): Promise<void> => {
      const now = untrack(view);
      if (!now) return;
      const ratio = Math.max(PICTURE_RATIO, window.devicePixelRatio);
      const sheet = createSheet(now, ratio);
      const name = nameOf('png');
      setSaved(undefined);
      try {
        if (fill(sheet, ratio)) save(name, await pngOfCanvas(sheet));
      } catch (reason) {
        say(reason);
      }
    },
    startVideo: (): void => {
      const now = untrack(view);
      if (!now || recording || type === undefined) return;
      const ratio = window.devicePixelRatio;
      const sheet = createSheet(now, ratio);
      try {
        // The recorder needs a picture to begin with.
        fill(sheet, ratio);
        setRecorded(0);
        setSaved(undefined);
        recording = record(
          sheet,
          type,
          (elapsed_s) => {
            fill(sheet, ratio);
            setRecorded(Math.floor(elapsed_s));
          },
          (video) => {
            recording = undefined;
            setRecorded(undefined);
            if (video instanceof Error) say(video);
            else save(nameOf(videoEnding(type)), video);
          },
        );
      } catch (reason) {
        setRecorded(undefined);
        say(reason);
      }
    },
    stopVideo: (): void => recording?.stop(),
  };
}
