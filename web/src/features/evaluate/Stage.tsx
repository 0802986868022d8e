// How far an evaluation is: an icon and a word.

import { Show, type JSX } from 'solid-js';
import { Ban, Check, type IconNode, X } from 'lucide';
import type { EvaluationSummary } from '../../net/protocol.gen';
import { Icon } from '../../ui/Icon';
import { stageWords } from './progress';

const ICONS: Partial<Record<EvaluationSummary['stage'], IconNode>> = {
  done: Check,
  failed: X,
  cancelled: Ban,
};

export function Stage(props: {
  of: EvaluationSummary;
  /** Instead of those of the stage. */
  words?: string | undefined;
  testid?: string;
}): JSX.Element {
  return (
    <span
      class="badge evaluation-stage number"
      data-stage={props.of.stage}
      data-testid={props.testid}
    >
      <Show when={ICONS[props.of.stage]}>{(icon) => <Icon of={icon()} />}</Show>
      {props.words ?? stageWords(props.of)}
    </span>
  );
}
