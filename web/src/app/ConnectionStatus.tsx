// The session's name, the state of the connection, and buttons to restart or log in again.

import { Show, createEffect, onCleanup, type JSX } from 'solid-js';
import { loggedOut } from '../net/access';
import type { ConnectionState } from '../lab/model';
import { MAIN } from '../net/session';
import type { Session } from '../lab/slices';
import { endWords } from '../words/facts';
import './ConnectionStatus.css';

function connectionText(connection: ConnectionState): string {
  switch (connection.kind) {
    case 'connecting':
      return 'connecting';
    case 'live':
      return 'live';
    case 'lost':
      return `reconnecting, attempt ${connection.attempt}`;
    case 'outdated':
      return 'the server has another version: reload the page';
  }
}

function Reload(props: { label: string; title: string }): JSX.Element {
  return (
    <button
      type="button"
      class="small primary"
      title={props.title}
      onClick={() => {
        window.location.reload();
      }}
    >
      {props.label}
    </button>
  );
}

/** Puts the session's name in the browser tab, because several sessions may be open side by side. */
function nameTab(session: string): void {
  createEffect(() => {
    const before = document.title;
    document.title = `${session} – ${before}`;
    onCleanup(() => {
      document.title = before;
    });
  });
}

export function ConnectionStatus(props: { lab: Session }): JSX.Element {
  const { lab } = props;
  const isNamed = lab.session !== MAIN;
  if (isNamed) nameTab(lab.session);
  const hasEnded = (): boolean => lab.ended() !== undefined;
  const why = (): string | undefined => {
    const ended = lab.ended();
    return ended && endWords(ended);
  };
  return (
    <>
      <div class="whose">
        <Show when={isNamed}>
          <span class="session-name" data-testid="session-name" title={`Session ${lab.session}`}>
            <span class="visually-hidden">Session </span>
            {lab.session}
          </span>
        </Show>
        <span
          class="link"
          data-link={hasEnded() ? 'ended' : lab.connection().kind}
          data-testid="connection"
          title={why()}
        >
          {hasEnded() ? 'session ended' : connectionText(lab.connection())}
        </span>
      </div>
      <Show when={hasEnded()}>
        <Reload label="Restart" title="Reloads the page, which restarts the session" />
      </Show>
      {/* The region is always in the document: screen readers announce what appears inside it. */}
      <span class="logged-out" role="alert" aria-label="Login">
        <Show when={loggedOut()}>
          <span>login has ended</span>
          <Reload label="Log in again" title="Reloads the page, which asks for the token" />
        </Show>
      </span>
    </>
  );
}
