// For those who only watch: a session of their own, in which they can play.

import type { JSX } from 'solid-js';
import { playQuery } from '../../lab/challenges';
import { linkedChallenge } from '../../lab/pageChallenge';
import { addressOf } from '../../net/base';

/** Long enough that two pages do not choose the same one. */
const LETTERS = 8;

function newSession(): string {
  const numbers = crypto.getRandomValues(new Uint8Array(LETTERS));
  return `play-${[...numbers].map((number) => (number % 36).toString(36)).join('')}`;
}

export function OwnSession(props: { challenge?: string }): JSX.Element {
  /** The challenge that is played here, or that of this page's address. */
  const query = (): string => {
    const name = props.challenge ?? linkedChallenge(window.location);
    return name === undefined ? '' : playQuery(name);
  };
  return (
    <p class="challenge-note">
      Another browser operates this session, and you watch.
      <a class="button" href={addressOf(`/s/${newSession()}${query()}`)}>
        Play in a session of your own
      </a>
    </p>
  );
}
