// On a phone: the task of the open lesson, beside Run. It opens the lesson over the map, and closes it.

import { ChevronDown, ChevronUp } from 'lucide';
import { Show, type JSX } from 'solid-js';
import type { Panels } from '../../lab/slices';
import { Icon } from '../../ui/Icon';
import { lessonsOf, type LessonsLab } from './store';
import './taskBar.css';

export default function TaskBar(props: {
  lab: LessonsLab & Panels;
  /** In its place while no experiment of a lesson is under way. */
  children: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  const store = lessonsOf(lab);
  const isOpen = (): boolean => lab.panel() === 'learn';
  return (
    <Show when={store.isFollowed()} fallback={props.children}>
      <button
        type="button"
        class="task-bar"
        aria-expanded={isOpen()}
        onClick={() => {
          if (isOpen()) lab.closePanel();
          else lab.showPanel('learn');
        }}
      >
        <strong>{store.nextTask()?.text ?? 'Done. Go on in the lesson'}</strong>
        <span class="number">
          {store.tasksDone()} of {store.tasks().length}
        </span>
        <Icon of={isOpen() ? ChevronDown : ChevronUp} />
      </button>
    </Show>
  );
}
