// The list of challenges, or the one that is being played.

import { Show, type JSX } from 'solid-js';
import { ChallengeList } from './ChallengeList';
import { PlayView, type ChallengeLab } from './PlayView';
import './challenge.css';

export default function ChallengePanel(props: { lab: ChallengeLab }): JSX.Element {
  const { lab } = props;
  return (
    <Show when={lab.contest.name()} fallback={<ChallengeList lab={lab} />} keyed>
      {(name) => <PlayView lab={lab} name={name} />}
    </Show>
  );
}
