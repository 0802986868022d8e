// For those who only watch: a session of their own, in which they can play.

import type { JSX } from 'solid-js';
import { playQuery } from '../../lab/challenges';
import { linkedChallenge } from '../../lab/pageChallenge';
import { OwnSessionButton } from '../../lab/OwnSessionButton';

export function OwnSession(props: { challenge?: string }): JSX.Element {
  /** The challenge that is played here, or that of this page's address. */
  const query = (): string => {
    const name = props.challenge ?? linkedChallenge(window.location);
    return name === undefined ? '' : playQuery(name);
  };
  return (
    <p class="challenge-note">
      Another browser operates this session, and you watch.
      <OwnSessionButton class="small" rest={query()}>
        Play in a session of your own
      </OwnSessionButton>
    </p>
  );
}
