// Buttons that save a picture or a video of the view, and the clock of a video that is being recorded.

import { Show, onCleanup, type JSX } from 'solid-js';
import { Image as ImageIcon, Video } from 'lucide';
import { duration } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { SmallButton } from '../../ui/SmallButton';
import type { Capture } from './capture';
import { VIDEO_LIMIT_S } from './video';
import './export.css';

export function CaptureTools(props: { capture: Capture }): JSX.Element {
  const { capture } = props;
  // A message belongs to the popover that was open when the file was saved, or to the next one.
  onCleanup(() => capture.forget());
  const isRecording = (): boolean => capture.recorded_s() !== undefined;
  return (
    <div class="capture" role="group" aria-label="Picture and video">
      <div class="buttons">
        <button
          type="button"
          title="The plan or the 3-D view as it is now"
          disabled={!capture.isReady()}
          onClick={() => void capture.savePicture()}
        >
          <Icon of={ImageIcon} />
          Picture (PNG)
        </button>
        <Show when={capture.canRecord}>
          <button
            type="button"
            disabled={!capture.isReady()}
            onClick={() => {
              if (isRecording()) capture.stopVideo();
              else capture.startVideo();
            }}
          >
            <Icon of={Video} />
            {isRecording() ? 'Stop video' : 'Record video'}
          </button>
        </Show>
      </div>
      <p class="capture-done" role="status">
        <Show when={capture.saved()}>{(name) => `Saved as ${name()}.`}</Show>
      </p>
      <p class="hint">
        {capture.canRecord
          ? `Of the plan or the 3-D view, with map, controller and time below it. A video has at most ${VIDEO_LIMIT_S} s.`
          : 'This browser cannot record videos: it has no MediaRecorder for WebM or MP4.'}
      </p>
    </div>
  );
}

/** Over the view while a video is recorded. */
export function RecordingClock(props: { capture: Capture }): JSX.Element {
  const { capture } = props;
  // Without the view there is nothing to record.
  onCleanup(() => capture.stopVideo());
  return (
    <Show when={capture.recorded_s() !== undefined}>
      <div class="recording-clock" role="group" aria-label="Video">
        <span class="number" role="timer">
          {duration(capture.recorded_s() ?? 0)}
        </span>
        <SmallButton aria-label="Stop video" title="Saves the video" onClick={capture.stopVideo}>
          Stop
        </SmallButton>
      </div>
    </Show>
  );
}
