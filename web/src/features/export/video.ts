// Records a canvas as a video.

/** A video ends after this time. */
export const VIDEO_LIMIT_S = 60;
const FRAMES_PER_S = 30;
/** A little less than the time of a frame: a display of 60 Hz draws every second time. */
const FRAME_MS = 1000 / FRAMES_PER_S - 4;
const BITS_PER_S = 8_000_000;

/** WebM first; MP4 for browsers that record no WebM. VP8 takes less time than VP9. */
const TYPES = ['video/webm;codecs=vp8', 'video/webm;codecs=vp9', 'video/webm', 'video/mp4'];

/** What the browser can record; undefined if it can record none of the types. */
export function videoType(
  recorder: Pick<typeof MediaRecorder, 'isTypeSupported'> | undefined,
): string | undefined {
  return recorder && TYPES.find((type) => recorder.isTypeSupported(type));
}

/** The type for this browser. */
export function ownVideoType(): string | undefined {
  const canCapture = 'captureStream' in HTMLCanvasElement.prototype;
  return canCapture && 'MediaRecorder' in window ? videoType(MediaRecorder) : undefined;
}

export function videoEnding(type: string): 'webm' | 'mp4' {
  return type.startsWith('video/mp4') ? 'mp4' : 'webm';
}

export interface Recording {
  /** Ends the recording. `onEnd` follows. */
  stop(): void;
}

/** Calls `draw` for each frame until the recording ends: by `stop`, at the limit, or because it failed. */
export function record(
  canvas: HTMLCanvasElement,
  type: string,
  draw: (elapsed_s: number) => void,
  onEnd: (video: Blob | Error) => void,
): Recording {
  const stream = canvas.captureStream(FRAMES_PER_S);
  const started_ms = performance.now();
  let limit: ReturnType<typeof setTimeout> | undefined;
  let frame = 0;
  let drawn_ms = -Infinity;
  const end = (): void => {
    clearTimeout(limit);
    cancelAnimationFrame(frame);
    for (const track of stream.getTracks()) track.stop();
  };
  const next = (): void => {
    const now_ms = performance.now();
    if (now_ms - drawn_ms > FRAME_MS) {
      drawn_ms = now_ms;
      draw((now_ms - started_ms) / 1000);
    }
    frame = requestAnimationFrame(next);
  };
  try {
    const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: BITS_PER_S });
    const parts: Blob[] = [];
    let failure: Error | undefined;
    const stop = (): void => {
      if (recorder.state !== 'inactive') recorder.stop();
    };
    recorder.addEventListener('error', () => {
      failure = new Error('The browser could not record the video.');
      stop();
    });
    recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
    recorder.addEventListener('stop', () => {
      end();
      onEnd(failure ?? new Blob(parts, { type: recorder.mimeType }));
    });
    recorder.start();
    // A hidden page draws no frames, but the time passes.
    limit = setTimeout(stop, 1000 * VIDEO_LIMIT_S);
    next();
    return { stop };
  } catch (reason) {
    end();
    throw reason;
  }
}
