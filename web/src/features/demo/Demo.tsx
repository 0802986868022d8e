// The demonstration: runs the programme, shows its captions, and gives way to a visitor.

import { Show, createEffect, createSignal, onCleanup, onMount, untrack, type JSX } from 'solid-js';
import { experimentFrom, loadMessage } from '../../lab/experimentLink';
import { CONTROLLER_LABELS } from '../../lab/parameters';
import type { Session, Trial } from '../../lab/slices';
import { PROGRAMME, SILENCE_MS, afterCue, isOver, nextCue, startOf, turned } from './programme';
import './demo.css';

const TICK_MS = 250;
/** After the session has ended or the server has gone, the page is loaded again. */
const RELOAD_MS = 10_000;
const VISITOR = 'You are in control: drag the bead, touch a place to set a goal.';

export function Demo(props: { lab: Session & Trial; children: JSX.Element }): JSX.Element {
  const { lab } = props;
  const [place, setPlace] = createSignal(startOf(0, Date.now()));
  /** When a visitor last touched the screen; undefined while the programme runs. */
  const [touched_ms, setTouched] = createSignal<number>();
  /** Number of the trial of the present part; undefined until the server has set it up. */
  let trial: number | undefined;
  let isSetUp = false;
  let broken_ms: number | undefined;

  const setUp = (): void => {
    const scene = lab.scene();
    const part = PROGRAMME[place().part];
    if (!scene || !part || !lab.canOperate()) return;
    const read = experimentFrom(part.link, scene);
    if (read.kind !== 'experiment')
      throw new Error(`the programme has a broken link: ${part.link}`);
    trial = scene.trial;
    isSetUp = true;
    lab.send(loadMessage(read.experiment, scene.defaults));
    lab.send({ type: 'set_speed', factor: part.speed });
    lab.send({ type: 'run' });
  };
  const begin = (part: number): void => {
    setPlace(startOf(part, Date.now()));
    setTouched(undefined);
    isSetUp = false;
    setUp();
  };

  const tick = (): void => {
    const now = Date.now();
    const isLive = lab.connection().kind === 'live' && lab.ended() === undefined;
    broken_ms = isLive ? undefined : (broken_ms ?? now);
    if (broken_ms !== undefined && now - broken_ms > RELOAD_MS) {
      // An ended session starts over when its page is loaded.
      window.location.reload();
      return;
    }
    if (!isLive) return;
    if (!lab.canOperate()) {
      lab.send({ type: 'take_control' });
      return;
    }
    const touched = touched_ms();
    if (touched !== undefined) {
      if (now - touched > SILENCE_MS) begin(place().part + 1);
      return;
    }
    setPlace(turned(place(), now));
    if (!isSetUp) setUp();
    else if (isOver(place(), now)) begin(place().part + 1);
  };

  createEffect(() => {
    const [state, scene] = [lab.state(), lab.scene()];
    if (!state || !scene || touched_ms() !== undefined || scene.trial === trial || !isSetUp) return;
    untrack(() => {
      const cue = nextCue(place(), state);
      if (!cue) return;
      setPlace(afterCue(place(), cue));
      if (cue.command) lab.send(cue.command);
    });
  });

  onMount(() => {
    const timer = setInterval(tick, TICK_MS);
    const onTouch = (event: Event): void => {
      if (event instanceof KeyboardEvent && event.key === 'Escape') {
        window.location.assign('/');
        return;
      }
      setTouched(Date.now());
      if (!lab.state()?.running) lab.send({ type: 'run' });
    };
    const onMove = (event: PointerEvent): void => {
      // A drag that goes on is no silence.
      if (event.buttons !== 0) setTouched(Date.now());
    };
    window.addEventListener('pointerdown', onTouch, true);
    window.addEventListener('pointermove', onMove, true);
    window.addEventListener('keydown', onTouch, true);
    onCleanup(() => {
      clearInterval(timer);
      window.removeEventListener('pointerdown', onTouch, true);
      window.removeEventListener('pointermove', onMove, true);
      window.removeEventListener('keydown', onTouch, true);
    });
  });

  const caption = (): string => (touched_ms() === undefined ? place().caption : VISITOR);
  return (
    <main class="demo" data-part={place().part}>
      <h1 class="visually-hidden">Demonstration</h1>
      <div class="demo-stage">{props.children}</div>
      <Show when={lab.state()}>
        {(state) => (
          <p class="demo-mode" data-mode={state().mode}>
            {state().mode === 1 ? 'Fetch' : `Carry: ${CONTROLLER_LABELS[state().controller]}`}
          </p>
        )}
      </Show>
      <p class="demo-caption" role="status">
        {caption()}
      </p>
      <p class="demo-safety">Simulation, not safety-rated</p>
    </main>
  );
}
