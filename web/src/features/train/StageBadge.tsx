// The stage of a training, as icon and word.

import type { JSX } from 'solid-js';
import {
  Activity,
  Camera,
  Check,
  Clock,
  GraduationCap,
  type IconNode,
  Pause,
  TriangleAlert,
  X,
} from 'lucide';
import { stageWords } from '../../lab/trainingStage';
import type { TrainingStage, TrainingSummary } from '../../net/protocol.gen';
import { Badge } from '../../ui/Badge';

const ICONS: Readonly<Record<TrainingStage, IconNode>> = {
  waiting: Clock,
  images: Camera,
  learning: Activity,
  examination: GraduationCap,
  paused: Pause,
  done: Check,
  cancelled: X,
  failed: TriangleAlert,
};

export function StageBadge(props: {
  summary: TrainingSummary;
  /** What was requested, until it is done. */
  words?: string | undefined;
}): JSX.Element {
  const tone = (): 'good' | 'bad' | 'plain' => {
    const { stage } = props.summary;
    if (stage === 'done') return 'good';
    return stage === 'failed' ? 'bad' : 'plain';
  };
  return (
    <Badge class="training-stage" of={ICONS[props.summary.stage]} tone={tone()}>
      {props.words ?? stageWords(props.summary)}
    </Badge>
  );
}
