// What the lanes show, and the paper's figure as a file.

import { For, Show, type JSX } from 'solid-js';
import { Ellipsis } from 'lucide';
import { hasLargeLanes, setLargeLanes } from '../../lab/lanes';
import { shownWalls } from '../../lab/sight';
import type { ByHand, Notices, Trial } from '../../lab/slices';
import { type TimeAxis, type WindowChoice, WINDOWS } from '../../lab/timeAxis';
import { download, pngOf } from '../../ui/download';
import { clock } from '../../ui/format';
import { Icon } from '../../ui/Icon';
import { palette } from '../../ui/palette';
import { createPopover } from '../../ui/popover';
import { SmallButton } from '../../ui/SmallButton';
import { choosePart, isOnlyOne, isShown } from './chosen';
import { FIGURE_PX, figureSvg } from './figureSvg';
import { PARTS } from './parts';
import { csvOf, type Sample } from './sample';

const FILES = ['CSV', 'PNG', 'SVG'] as const;
/** A figure covers at least this time. */
const LEAST_S = 1;
const MENU_ID = 'plot-menu';

export function PlotMenu(props: {
  lab: Trial & Notices & ByHand;
  axis: TimeAxis;
  take: () => Sample | undefined;
}): JSX.Element {
  const { lab, axis } = props;
  const popover = createPopover(MENU_ID);
  const save = async (kind: (typeof FILES)[number]): Promise<void> => {
    const [shown, scene, state] = [props.take(), lab.scene(), lab.state()];
    if (!shown || !scene || !state) return;
    // Without the room that the axis has for what comes.
    const newest_s = shown.columns.sim_time_s.at(-1) ?? 0;
    const sample = { ...shown, to_s: Math.max(shown.from_s + LEAST_S, newest_s) };
    const put = (content: BlobPart, type: string): void => {
      const name = `ferry-${scene.map}-seed${scene.seed}-tick${state.tick}`;
      download(`${name}.${kind.toLowerCase()}`, new Blob([content], { type }));
    };
    if (kind === 'CSV') {
      put(csvOf(lab.history, sample), 'text/csv');
      return;
    }
    const svg = figureSvg({
      title: `Ferry: map ${scene.map}, ${state.controller}, seed ${scene.seed}, ${clock(sample.from_s)} to ${clock(sample.to_s)}`,
      palette: palette(),
      sample,
      threshold_m: scene.parameters.threshold_m,
      workspace: scene.workspace,
      walls: shownWalls(lab),
      goal_m: lab.goal(),
    });
    if (kind === 'SVG') {
      put(svg, 'image/svg+xml');
      return;
    }
    try {
      put(await pngOf(svg, FIGURE_PX), 'image/png');
    } catch {
      lab.notify('playback', 'This browser could not draw the figure as a PNG.');
    }
  };
  return (
    <div {...popover.box} class="plot-tools">
      <button
        {...popover.button}
        class="ghost icon-only small"
        aria-label="More about plots"
        title="Which plots, how large, time window, save"
      >
        <Icon of={Ellipsis} />
      </button>
      <Show when={popover.open()}>
        <div id={MENU_ID} class="plot-menu popover" role="group" aria-label="Plots">
          <For each={PARTS}>
            {({ letter, title }) => (
              <label title={isOnlyOne(letter) ? 'One plot stays' : undefined}>
                <input
                  type="checkbox"
                  checked={isShown(letter)}
                  disabled={isOnlyOne(letter)}
                  onChange={(event) => choosePart(letter, event.currentTarget.checked)}
                />
                {title}
              </label>
            )}
          </For>
          <label>
            <input
              type="checkbox"
              checked={hasLargeLanes()}
              onChange={(event) => setLargeLanes(event.currentTarget.checked)}
            />
            Large plots
          </label>
          <label class="plot-window">
            Time window
            <select
              aria-label="Time window of the plots"
              onChange={(event) => axis.choose(event.currentTarget.value as WindowChoice)}
            >
              <For each={WINDOWS}>
                {([id, label]) => (
                  <option value={id} selected={axis.choice() === id}>
                    {label}
                  </option>
                )}
              </For>
            </select>
          </label>
          <div
            class="buttons"
            title="The figure with all plots and the path in the plane; CSV: the numbers"
          >
            Save
            <For each={FILES}>
              {(kind) => (
                <SmallButton aria-label={`Save ${kind}`} onClick={() => void save(kind)}>
                  {kind}
                </SmallButton>
              )}
            </For>
          </div>
        </div>
      </Show>
    </div>
  );
}
