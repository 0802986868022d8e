// The start of a training: of the toy map at once, or of one's own map with a form.

import { Show, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import { CloseButton } from '../../ui/CloseButton';
import { Intro } from './Intro';
import { StartPanel } from './StartPanel';
import { ToyStart } from './ToyStart';

export function NewTraining(props: {
  /** The part of the form. */
  onForm: (part: HTMLElement) => void;
  lab: Session & Trial;
  /** Whether there has been no training yet. */
  isFirst: boolean;
  onClose: () => void;
  onStarted: () => void;
}): JSX.Element {
  return (
    <>
      <section>
        <header>
          <h2>{props.isFirst ? 'Watch a policy learn' : 'New training'}</h2>
          <Show when={!props.isFirst}>
            <CloseButton label="Close the form" onClose={() => props.onClose()} />
          </Show>
        </header>
        <ToyStart lab={props.lab} isFirst={props.isFirst} onStarted={() => props.onStarted()} />
        <Show when={props.isFirst}>
          <Intro />
        </Show>
      </section>
      <section ref={(part) => props.onForm(part)}>
        <h3>{props.isFirst ? 'Train a policy of your own' : 'On a map of your choice'}</h3>
        <StartPanel
          lab={props.lab}
          isPrimary={!props.isFirst}
          onStarted={() => props.onStarted()}
        />
      </section>
    </>
  );
}
