// The story of one event: why it happened, what the camera saw, and buttons to continue from there.

import {
  For,
  Match,
  Show,
  Switch,
  createEffect,
  createMemo,
  createResource,
  on,
  type JSX,
} from 'solid-js';
import { ChevronLeft, ChevronRight } from 'lucide';
import { eventWords } from '../../words/events';
import { CommandButton } from '../../lab/CommandButton';
import { get, type Refusal } from '../../net/requests';
import { centimetres, clock } from '../../ui/format';
import type { EventMessage, MomentMessage } from '../../net/protocol.gen';
import { sessionPath } from '../../net/session';
import { eventTitle, isSameEvent, marginWords, sentence, whatItSaw } from '../../lab/eventStory';
import { causeOfEvent } from '../../lab/failure';
import type { Events, Panels, Session, Trial } from '../../lab/slices';
import { CloseButton } from '../../ui/CloseButton';
import { addressOf } from '../../net/base';
import { Icon } from '../../ui/Icon';
import './why.css';

const BESIDE = [
  [-1, 'Previous event', ChevronLeft],
  [1, 'Next event', ChevronRight],
] as const;

/** The button that led to the next card: it has the focus there again. */
let ledBy: string | undefined;

/** e on a scale from 0 to twice the limit. The limit is in the middle. */
function MarginBar(props: { moment: MomentMessage }): JSX.Element {
  const share = (): number =>
    Math.min(1, props.moment.error_m / (2 * props.moment.threshold_m || 1));
  return (
    <svg class="why-margin" viewBox="0 0 200 14" preserveAspectRatio="none" aria-hidden="true">
      <rect class="scale" x="0" y="4" width="200" height="6" />
      <rect class="error" x="0" y="4" width={200 * share()} height="6" />
      <line class="limit" x1="100" x2="100" y1="0" y2="14" />
    </svg>
  );
}

function Story(props: {
  moment: MomentMessage;
  path: string;
  cause: string | undefined;
}): JSX.Element {
  return (
    <>
      <Show when={props.cause}>{(cause) => <p class="why-cause">{cause()}</p>}</Show>
      <p class="why-margin-text number">
        e {centimetres(props.moment.error_m)}, limit {centimetres(props.moment.threshold_m)}:{' '}
        <strong>{marginWords(props.moment)}</strong>
      </p>
      <MarginBar moment={props.moment} />
      <p>{whatItSaw(props.moment)}</p>
      <img
        class="why-picture"
        src={addressOf(`${props.path}/camera.png`)}
        width="480"
        height="480"
        alt={`What the camera saw at ${clock(props.moment.sim_time_s)}`}
      />
    </>
  );
}

export function WhyCard(props: {
  lab: Session & Trial & Events & Panels;
  event: EventMessage;
  /** Whether no line of the list above it says what happened. */
  isAlone?: boolean;
}): JSX.Element {
  const { lab } = props;
  let card!: HTMLElement;
  const path = createMemo(() => sessionPath(lab.session, `moments/${props.event.tick}`));
  const [moment] = createResource(path, get<MomentMessage>);
  // After a new connection the server sends the events again.
  const place = createMemo(() => lab.marks().findIndex((one) => isSameEvent(one, props.event)));
  const isPast = (): boolean => place() < 0;
  const beside = (step: number): EventMessage | undefined => lab.marks()[place() + step];
  createEffect(
    on(
      () => props.event,
      () => {
        const by = card.querySelector<HTMLElement>(`[aria-label="${ledBy ?? ''}"]:enabled`);
        ledBy = undefined;
        (by ?? card).focus({ preventScroll: true });
        card.parentElement?.scrollIntoView({ block: 'nearest' });
      },
    ),
  );
  const close = (): void => lab.inspect(undefined);
  return (
    <section
      ref={card}
      class="why"
      role="dialog"
      aria-labelledby="why-title"
      aria-describedby="why-sentence"
      tabindex="-1"
      onKeyDown={(event) => {
        if (event.key === 'Escape') close();
      }}
    >
      <header>
        <h3 id="why-title">{eventTitle(props.event)}</h3>
        <For each={BESIDE}>
          {([step, name, icon]) => (
            <button
              type="button"
              class="ghost icon-only"
              aria-label={name}
              disabled={isPast() || !beside(step)}
              onClick={() => {
                ledBy = name;
                lab.inspect(beside(step));
              }}
            >
              <Icon of={icon} />
            </button>
          )}
        </For>
        <CloseButton label="Close" onClose={close} />
      </header>
      <div class="why-body">
        <p
          id="why-sentence"
          class="why-sentence"
          classList={{ 'visually-hidden': props.isAlone !== true }}
        >
          {sentence(eventWords(props.event.what))}
        </p>
        <Show when={isPast()}>
          <p class="hint">
            The session was rewound and then took another course; this event is not part of it.
          </p>
        </Show>
        <Switch fallback={<p class="hint">Loading …</p>}>
          <Match when={moment.error as Refusal | undefined}>
            {(refusal) => (
              <p class="hint" role="alert">
                {refusal().detail}
              </p>
            )}
          </Match>
          <Match when={!moment.loading && moment()}>
            {(found) => (
              <Story
                moment={found()}
                path={path()}
                cause={causeOfEvent(props.event, found(), lab.scene()?.map ?? '')}
              />
            )}
          </Match>
        </Switch>
      </div>
      <footer>
        <CommandButton
          lab={lab}
          at="playback"
          class="small"
          disabled={isPast()}
          title="Rewinds to the control step at or before this event and pauses there"
          command={() => ({ type: 'rewind', tick: props.event.tick })}
        >
          Rewind to here
        </CommandButton>
        <CommandButton
          lab={lab}
          at="playback"
          class="small primary"
          disabled={isPast()}
          title="Continues from this moment under every controller"
          command={() => ({ type: 'fork', tick: props.event.tick })}
          onDone={() => {
            lab.showPanel('compare');
            close();
          }}
        >
          Compare controllers from here
        </CommandButton>
      </footer>
    </section>
  );
}
