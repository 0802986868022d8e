// The current tip, in the band below the map, in place of the hint.

import { Lightbulb } from 'lucide';
import { Show, createEffect, createMemo, createSignal, on, type JSX } from 'solid-js';
import type { Panels, Session, Trial } from '../../lab/slices';
import { IS_TOUCH } from '../../ui/touch';
import { recall, remember } from '../../ui/storage';
import { type Shown, TIP_IDS, type TipId, doneAfter, nextTip, tipsFrom, tipText } from './tips';
import { Icon } from '../../ui/Icon';
import './tips.css';

const KEY = 'tips';

export function TipBar(props: { lab: Session & Trial & Panels; scene: boolean }): JSX.Element {
  const { lab } = props;
  const [done, setDone] = createSignal<ReadonlySet<TipId>>(tipsFrom(recall(KEY)));
  const store = (tips: ReadonlySet<TipId>): void => {
    setDone(tips);
    remember(KEY, [...tips].join());
  };
  const shown = createMemo(
    (): Shown | undefined => {
      const state = lab.state();
      return (
        state && {
          running: state.running,
          fetching: state.mode === 1 && state.disturbances > 0,
          goal: state.goal_m?.join() ?? '',
          controller: state.controller,
          compares: lab.panel() === 'compare',
          scene: props.scene,
        }
      );
    },
    undefined,
    { equals: (a, b) => JSON.stringify(a) === JSON.stringify(b) },
  );
  createEffect(
    on([shown, lab.canOperate], ([now, canOperate], before) => {
      // A viewer only watches.
      if (!now || !canOperate) return;
      const after = doneAfter(done(), now, before?.[0] ?? now);
      if (after.size > done().size) store(after);
    }),
  );
  const hasGoal = (): boolean => lab.goal() !== undefined;
  const isDelivered = createMemo(() => lab.state()?.phase.code === 'delivered');
  const tip = (): TipId | undefined =>
    shown() && lab.canOperate() ? nextTip(done(), hasGoal(), isDelivered()) : undefined;
  return (
    <Show when={tip()}>
      {(id) => (
        <p class="tip" role="status">
          <Icon of={Lightbulb} />
          <span>{tipText(id(), hasGoal(), IS_TOUCH)}</span>
          <Show when={id() === 'controller'}>
            <button type="button" class="small" onClick={() => lab.showPanel('compare')}>
              Compare
            </button>
          </Show>
          <button type="button" class="ghost small" onClick={() => store(new Set(TIP_IDS))}>
            Skip tips
          </button>
        </p>
      )}
    </Show>
  );
}
