// The demonstration: runs the programme, shows its captions, and gives way to a visitor.

import { Show, createEffect, createSignal, on, onCleanup, type JSX } from 'solid-js';
import { knownBy } from '../../lab/known';
import { loadLink } from '../../lab/loadTrial';
import { PlaceNotice } from '../../lab/PlaceNotice';
import type { Answer } from '../../lab/commands';
import { isOver } from '../../lab/contest';
import type { Contested, Notices, Session, Trial } from '../../lab/slices';
import { openPage } from '../../net/access';
import type { ControllerName } from '../../net/protocol.gen';
import {
  CARRIERS,
  PROGRAMME,
  SILENCE_MS,
  challengeOf,
  cued,
  homeOf,
  invitation,
  isOver as isPartOver,
  isVisitorKey,
  playedCaption,
  startOf,
  turned,
  visitorCaption,
  watchedCaption,
} from './programme';
import { listen } from '../../ui/listen';
import './demo.css';
import { pathOf } from '../../net/base';

const TICK_MS = 250;
/** Interval of attempts to load the page again when it cannot go on. */
const RELOAD_MS = 10_000;
const WATCHING = 'Another screen runs this demonstration';
const WAITING = 'One moment, please.';

/** Not changed by a correction of the computer's clock. */
const nowMs = (): number => performance.now();

export function Demo(props: {
  lab: Session & Trial & Notices & Contested;
  /** A part begins: the view returns to what it shows at first. */
  onBegin: () => void;
  children: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  const home = homeOf(window.location.hash);
  const [place, setPlace] = createSignal(startOf(0, nowMs()));
  /** When a visitor last touched the screen; undefined while the programme runs. */
  const [touched_ms, setTouched] = createSignal<number>();
  /** The trial of the present part; undefined until it is requested. */
  let own: Promise<Answer | undefined> | number | undefined;
  let hasAsked = false;
  let reload_ms: number | undefined;

  const isLive = (): boolean => lab.connection().kind === 'live';
  /** The session or this page is over: only a new page goes on. */
  const isDone = (): boolean => lab.ended() !== undefined || lab.connection().kind === 'outdated';

  // After lost control or a lost connection the part begins again.
  createEffect(() => {
    if (!isLive()) hasAsked = false;
    if (!lab.canOperate()) {
      own = undefined;
      setTouched(undefined);
    }
  });

  const run = (): void => void lab.send('workspace', { type: 'run' });
  const play = (): Promise<Answer> => lab.contest.play(challengeOf(new Date()));
  const isContest = (): boolean => PROGRAMME[place().part]?.link === undefined;

  const setUp = async (): Promise<void> => {
    const { link, speed } = PROGRAMME[place().part] ?? {};
    const asked = link === undefined ? play() : loadLink(lab, 'workspace', link);
    own = asked;
    if (speed !== undefined) void lab.send('workspace', { type: 'set_speed', factor: speed });
    run();
    const answer = await asked;
    // A part that was refused is left after its time.
    if (own === asked && answer?.kind === 'done') own = answer.trial;
  };
  const begin = (part: number): void => {
    setPlace(startOf(part, nowMs()));
    setTouched(undefined);
    props.onBegin();
    void setUp();
  };

  const reload = async (): Promise<void> => {
    reload_ms = Infinity;
    // The browser's own page for a missing server would stay.
    const { isOpen } = await openPage(pathOf(window.location.pathname));
    if (isOpen) window.location.reload();
    reload_ms = nowMs() + RELOAD_MS;
  };
  const takeFreeControl = (): void => {
    const isFree = lab.hello()?.operator_present === false;
    if (isFree) void lab.send('session', { type: 'take_control' });
    // Another browser was faster. The request would take control from it when it sends nothing for a time.
    else if (hasAsked) void lab.send('session', { type: 'release_control' });
    hasAsked = isFree;
  };
  const tick = (): void => {
    const now = nowMs();
    if (isDone()) {
      reload_ms ??= now + RELOAD_MS;
      if (now >= reload_ms) void reload();
      return;
    }
    if (!isLive()) return;
    if (!lab.canOperate()) {
      takeFreeControl();
      return;
    }
    const touched = touched_ms();
    if (touched !== undefined) {
      if (now - touched > SILENCE_MS) begin(place().part + 1);
      return;
    }
    setPlace(turned(place(), now));
    if (own === undefined && knownBy(lab)) begin(place().part);
    else if (isPartOver(place(), now)) begin(place().part + 1);
  };

  createEffect(
    on(lab.state, (state) => {
      if (!state || touched_ms() !== undefined || lab.scene()?.trial !== own) return;
      const next = cued(place(), state);
      if (!next) return;
      setPlace(next.place);
      for (const command of next.cue.commands ?? []) void lab.send('workspace', command);
    }),
  );

  const touch = (): void => {
    if (!lab.canOperate()) return;
    const isFirst = touched_ms() === undefined;
    setTouched(nowMs());
    // A visitor begins with the clock; the ghosts have run alone.
    const isNew = isContest() && (isFirst || isOver(lab.contest.attempt()));
    if (isNew) void play();
    if (isNew || !lab.state()?.running) run();
  };
  const early = { capture: true, passive: true };
  listen('pointerdown', touch, early);
  listen('wheel', touch, early);
  listen(
    'pointermove',
    (event) => {
      // A drag that goes on is no silence.
      if (event.buttons !== 0) touch();
    },
    early,
  );
  listen(
    'keydown',
    (event) => {
      if (event.key === 'Escape') window.location.assign(home);
      else if (isVisitorKey(event)) touch();
    },
    early,
  );
  const timer = setInterval(tick, TICK_MS);
  onCleanup(() => clearInterval(timer));

  const carrier = (name: ControllerName): string =>
    name === 'you' && touched_ms() === undefined ? 'Ghosts' : CARRIERS[name];
  const isWatching = (): boolean =>
    !lab.canOperate() && isLive() && lab.hello()?.operator_present === true;
  const caption = (): string => {
    const [state, attempt, ghosts] = [lab.state(), lab.contest.attempt(), lab.contest.ghosts()];
    if (isDone() || lab.connection().kind === 'lost') return WAITING;
    if (!lab.canOperate()) return isWatching() && state ? watchedCaption(state) : '';
    const isVisited = touched_ms() !== undefined;
    if (isContest() && attempt) {
      return isVisited ? playedCaption(attempt, ghosts) : invitation(ghosts);
    }
    return isVisited && state ? visitorCaption(state) : place().caption;
  };
  return (
    <main class="demo" data-part={place().part}>
      <h1 class="visually-hidden">Demonstration</h1>
      <div class="demo-stage" inert={!lab.canOperate()}>
        {props.children}
      </div>
      <Show when={lab.state()}>
        {(state) => (
          <p class="demo-mode" data-mode={state().mode}>
            {state().mode === 1 ? 'Fetch' : carrier(state().controller)}
          </p>
        )}
      </Show>
      <PlaceNotice lab={lab} place="workspace" />
      <p class="demo-caption" role="status">
        {caption()}
      </p>
      <p class="demo-safety">
        <Show when={isWatching()}>{WATCHING} · </Show>Simulation, not safety-rated
      </p>
      <a class="demo-leave" href={home}>
        Leave
      </a>
    </main>
  );
}
