// The training of a tiny map that is over while one watches, and one that is finished already.

import { type JSX } from 'solid-js';
import { operatorOnly } from '../../lab/operatorOnly';
import type { Session } from '../../lab/slices';
import { createAttempt } from '../../ui/attempt';
import { SmallButton } from '../../ui/SmallButton';
import { suggestedName, takenNames, TOY_MAP, toyQuery } from './recipes';
import { choose, compare, playsFinished, setPlaysFinished } from './state';
import { startTraining } from './trainings';

export function ToyStart(props: {
  lab: Session;
  /** Whether it is what a first visitor should do. */
  isFirst: boolean;
  /** The new training is shown. */
  onStarted: () => void;
}): JSX.Element {
  const { attempt, refusal, isBusy } = createAttempt();
  const name = (): string => suggestedName(TOY_MAP, takenNames(props.lab.catalog));
  /** Each one learns with other random numbers. */
  const seed = (): number =>
    1 + (props.lab.catalog.trainings() ?? []).filter(({ query }) => query.recipe === 'toy').length;
  const start = async (): Promise<void> => {
    const id = await startTraining(props.lab.session, toyQuery(name(), seed()));
    compare(undefined);
    choose(id);
    props.onStarted();
  };
  return (
    <div class="train-toy stack">
      <p>
        On the tiny map <strong>{TOY_MAP}</strong>, a policy learns while you watch. It gets the
        name <strong>{name()}</strong>; seed {seed()}.
      </p>
      <div class="training-deeds">
        <SmallButton
          {...operatorOnly(props.lab)}
          class={props.isFirst ? 'primary' : 'small'}
          aria-disabled={isBusy()}
          onClick={() => {
            if (!isBusy()) void attempt(start());
          }}
        >
          Watch it learn (15 s)
        </SmallButton>
        {/* Later there are trainings of one's own to replay. */}
        {props.isFirst && (
          <SmallButton
            aria-pressed={playsFinished()}
            onClick={() => setPlaysFinished(!playsFinished())}
          >
            Play a finished training
          </SmallButton>
        )}
      </div>
      <p class="refusal" role="alert">
        {refusal()}
      </p>
    </div>
  );
}
