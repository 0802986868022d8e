// The demonstration: runs the programme, shows its captions, and gives way to a visitor.

import { ArrowRight, Magnet } from 'lucide';
import { Show, createEffect, createMemo, createSignal, on, onCleanup, type JSX } from 'solid-js';
import { knownBy } from '../../lab/known';
import { loadLink } from '../../lab/loadTrial';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { isOver } from '../../lab/contest';
import type { Contested, Notices, Session, Trial } from '../../lab/slices';
import { openPage } from '../../net/access';
import {
  PROGRAMME,
  SILENCE_MS,
  challengeOf,
  cued,
  homeOf,
  isOver as isPartOver,
  isVisitorKey,
  startOf,
  turned,
} from './programme';
import {
  type Badge,
  badgeOf,
  invitation,
  plainSentence,
  playedSentence,
  programmeSentence,
  visitorSentence,
} from './said';
import { pathOf } from '../../net/base';
import { Glyph } from '../../ui/Glyph';
import { Icon } from '../../ui/Icon';
import { listen } from '../../ui/listen';
import './demo.css';

const TICK_MS = 250;
/** Interval of attempts to load the page again when it cannot go on. */
const RELOAD_MS = 10_000;
const WATCHING = 'Another screen runs this demonstration';
const WAITING = 'One moment, please.';

/** Not changed by a correction of the computer's clock. */
const nowMs = (): number => performance.now();

function Mark(props: { of: Badge['of'] }): JSX.Element {
  return (
    <Show when={props.of !== 'fetch' && props.of} fallback={<Icon of={Magnet} />}>
      {(controller) => <Glyph of={controller()} />}
    </Show>
  );
}

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
  /**
   * The trial that the present part replaces; undefined until its own is requested. A part that was refused is left
   * after its time.
   */
  const [before, setBefore] = createSignal<number>();
  let hasAsked = false;
  let reload_ms: number | undefined;

  const isLive = (): boolean => lab.connection().kind === 'live';
  /** The session or this page is over: only a new page goes on. */
  const isDone = (): boolean => lab.ended() !== undefined || lab.connection().kind === 'outdated';

  // After lost control or a lost connection the part begins again.
  createEffect(() => {
    if (!isLive()) hasAsked = false;
    if (!lab.canOperate()) {
      setBefore(undefined);
      setTouched(undefined);
    }
  });

  const run = (): void => void lab.send('workspace', { type: 'run' });
  const play = (): void => void lab.contest.play(challengeOf(new Date()));
  const isContest = (): boolean => PROGRAMME[place().part]?.link === undefined;

  const isShown = (): boolean => (lab.scene()?.trial ?? -Infinity) > (before() ?? Infinity);

  const setUp = (): void => {
    const { link, speed } = PROGRAMME[place().part] ?? {};
    setBefore(lab.scene()?.trial);
    if (link === undefined) play();
    else void loadLink(lab, 'workspace', link);
    if (speed !== undefined) void lab.send('workspace', { type: 'set_speed', factor: speed });
    run();
  };
  const begin = (part: number): void => {
    setPlace(startOf(part, nowMs()));
    setTouched(undefined);
    props.onBegin();
    setUp();
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
    const state = lab.state();
    if (state) setPlace(turned(place(), state, now));
    if (before() === undefined && knownBy(lab)) begin(place().part);
    else if (isPartOver(place(), now)) begin(place().part + 1);
  };

  createEffect(
    on(lab.state, (state) => {
      if (!state || touched_ms() !== undefined || !isShown()) return;
      const next = cued(place(), state);
      setPlace(turned(next?.place ?? place(), state, nowMs()));
      for (const command of next?.cue.commands ?? []) void lab.send('workspace', command);
    }),
  );

  const touch = (): void => {
    if (!lab.canOperate()) return;
    const isFirst = touched_ms() === undefined;
    setTouched(nowMs());
    // A visitor begins with the clock; the ghosts have run alone.
    const isNew = isContest() && (isFirst || isOver(lab.contest.attempt()));
    if (isNew) play();
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

  const isVisited = (): boolean => touched_ms() !== undefined;
  const isWatching = (): boolean =>
    !lab.canOperate() && isLive() && lab.hello()?.operator_present === true;
  const badge = createMemo((): Badge | undefined => {
    const state = lab.state();
    return state && sentence() !== WAITING ? badgeOf(state, isVisited()) : undefined;
  });
  const sentence = (): string => {
    const [state, attempt, ghosts] = [lab.state(), lab.contest.attempt(), lab.contest.ghosts()];
    if (isDone() || lab.connection().kind === 'lost') return WAITING;
    if (!state || before() === undefined) return isWatching() && state ? plainSentence(state) : '';
    if (isContest() && attempt) {
      return isVisited() ? playedSentence(attempt, ghosts) : invitation(ghosts);
    }
    if (isVisited()) return visitorSentence(state);
    // Until the part has begun, the last one is shown.
    return isShown() ? programmeSentence(place(), state) : plainSentence(state);
  };
  return (
    <main class="demo" data-part={place().part}>
      <h1 class="visually-hidden">Demonstration</h1>
      <div class="demo-stage" inert={!lab.canOperate()}>
        {props.children}
      </div>
      <PlaceNotice lab={lab} place="workspace" />
      <div class="demo-said">
        <Show when={badge()}>
          {(shown) => (
            <p class="demo-badge" data-of={shown().of}>
              <Mark of={shown().of} />
              {shown().text}
            </p>
          )}
        </Show>
        <p class="demo-caption" role="status">
          {sentence()}
        </p>
      </div>
      <p class="demo-safety">
        <Show when={isWatching()}>{WATCHING} · </Show>Simulation, not safety-rated
      </p>
      <a class="demo-leave button" href={home}>
        Leave
        <Icon of={ArrowRight} />
      </a>
    </main>
  );
}
