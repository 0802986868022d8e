// How far an evaluation is: an icon and a word.

import type { JSX } from 'solid-js';
import { Ban, Check, Hourglass, type IconNode, Pause, Play, X } from 'lucide';
import type { EvaluationSummary } from '../../net/protocol.gen';
import { Badge } from '../../ui/Badge';
import { stageWords } from './progress';

const LOOKS: Record<EvaluationSummary['stage'], readonly [IconNode, 'good' | 'bad' | 'plain']> = {
  waiting: [Hourglass, 'plain'],
  running: [Play, 'plain'],
  paused: [Pause, 'plain'],
  done: [Check, 'good'],
  cancelled: [Ban, 'plain'],
  failed: [X, 'bad'],
};

export function Stage(props: {
  of: EvaluationSummary;
  /** Instead of those of the stage. */
  words?: string | undefined;
  testid?: string;
}): JSX.Element {
  return (
    <span class="number" data-testid={props.testid}>
      <Badge of={LOOKS[props.of.stage][0]} tone={LOOKS[props.of.stage][1]}>
        {props.words ?? stageWords(props.of)}
      </Badge>
    </span>
  );
}
