// The playback bar: run, pause, step, reset, speed, seed, map, timeline.

import { Show, createEffect, createMemo, createSignal, on, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import { loadTrial } from '../../lab/loadTrial';
import { hintAtGoal, runOrPause } from './run';
import { speedName, SPEEDS, ticksToControlStep } from './steps';
import { CommandButton } from '../../lab/CommandButton';
import { Achieved } from './Achieved';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { Timeline } from './Timeline';
import { numberFault, numberOf } from '../../ui/fields/number';
import { NumberInput } from '../../ui/fields/NumberInput';
import { createPending } from '../../ui/pending';
import { ServerSelect } from '../../ui/ServerSelect';
import type { Events, Notices, Session, Trial } from '../../lab/slices';
import './PlaybackBar.css';

/** One second of ticks. */
const MANY_TICKS = 125;
const SEED_LIMIT = 2 ** 32;

function RunButtons(props: { lab: Session & Trial & Notices }): JSX.Element {
  const { lab } = props;
  const running = (): boolean => lab.state()?.running ?? false;
  return (
    <div class="buttons">
      <CommandButton
        lab={lab}
        at="playback"
        class="primary run"
        title="Space"
        command={() => runOrPause(lab)}
        onDone={() => {
          hintAtGoal(lab);
        }}
      >
        {running() ? 'Pause' : 'Run'}
      </CommandButton>
      <CommandButton
        lab={lab}
        at="playback"
        disabled={running()}
        title={`One tick of 8 ms; with Shift ${MANY_TICKS} ticks, one second (.)`}
        command={({ shiftKey }) => ({ type: 'step', ticks: shiftKey ? MANY_TICKS : 1 })}
      >
        Step
      </CommandButton>
      <CommandButton
        lab={lab}
        at="playback"
        class="seldom"
        disabled={running()}
        title="To the next control step: 31 or 32 ticks, a quarter of a second (,)"
        command={() => {
          const tick = lab.state()?.tick ?? 0;
          return { type: 'step', ticks: ticksToControlStep(tick, lab.scene()?.tick_s ?? 0.008) };
        }}
      >
        Step ¼ s
      </CommandButton>
      <CommandButton
        lab={lab}
        at="playback"
        title="Back to the start with the same seed (R)"
        command={() => ({ type: 'reset' })}
      >
        Reset
      </CommandButton>
    </div>
  );
}

function Seed(props: { lab: Session & Notices; seed: number }): JSX.Element {
  const { lab } = props;
  // As typed. Leaving the field does not reset the trial.
  const [typed, setTyped] = createSignal<string>();
  const show = (): void => {
    setTyped(undefined);
  };
  const seed = createPending(
    () => props.seed,
    (value) => lab.send('playback', { type: 'reset', seed: value }),
  );
  createEffect(on(seed.value, show));
  return (
    <form
      class="field"
      onSubmit={(event) => {
        event.preventDefault();
        seed.choose(numberOf(typed() ?? String(props.seed)));
      }}
    >
      <label for="seed">Seed</label>
      <NumberInput
        id="seed"
        min={0}
        isWhole
        isStrict
        value={typed() ?? seed.value()}
        aria-busy={seed.isPending()}
        disabled={!lab.canOperate()}
        title="Enter resets the trial with this seed"
        style={{ '--digits': String(props.seed).length }}
        onInput={setTyped}
        onBlur={() => {
          if (numberFault(typed() ?? '0') === undefined) show();
        }}
      />
      <CommandButton
        lab={lab}
        at="playback"
        title="Resets the trial with a random seed"
        command={() => ({ type: 'reset', seed: Math.floor(Math.random() * SEED_LIMIT) })}
      >
        New seed
      </CommandButton>
    </form>
  );
}

export function PlaybackBar(props: {
  lab: Session & Trial & Events & Notices;
  /** Above the row of controls. */
  above: JSX.Element;
  /** Beside the map: other controls that choose an experiment. */
  choices: JSX.Element;
  /** At the end of the row. */
  share: JSX.Element;
  /** Beside the timeline. */
  runs: JSX.Element;
  /** Below the timeline. */
  below: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  const [isOpen, setOpen] = createSignal(false);
  // A memo, so that other updates do not recreate the list under the pointer.
  const target = createMemo(() => lab.state()?.speed_target ?? 1);
  const speeds = createMemo(() => {
    const all = [...new Set([...SPEEDS, target()])].sort((a, b) => a - b);
    return all.map((factor) => [String(factor), speedName(factor)] as const);
  });
  const maps = createMemo(() => (lab.catalog.maps() ?? []).map((name) => [name, name] as const));
  return (
    <footer class="bar transport" role="region" aria-label="Playback">
      {props.above}
      <div class="transport-row">
        <RunButtons lab={lab} />
        <button
          type="button"
          class="more"
          aria-expanded={isOpen()}
          aria-controls="more-controls"
          onClick={() => setOpen(!isOpen())}
        >
          More
        </button>
        <div id="more-controls" class="more-controls" data-open={isOpen()}>
          <ServerSelect
            label="Speed"
            value={String(target())}
            options={speeds()}
            disabled={!lab.canOperate()}
            onChoose={(value) => lab.send('playback', { type: 'set_speed', factor: Number(value) })}
          />
          <Achieved lab={lab} />
          <Show when={lab.scene()}>
            {(scene) => (
              <>
                <ServerSelect
                  label="Map"
                  value={scene().map}
                  options={maps()}
                  disabled={!lab.canOperate()}
                  onChoose={(map) => loadTrial(lab, 'playback', { map })}
                />
                {props.choices}
                <Seed lab={lab} seed={scene().seed} />
                {props.share}
              </>
            )}
          </Show>
        </div>
        <div class="now number">
          <span class="sim-time" data-testid="sim-time">
            {clock(lab.state()?.sim_time_s ?? 0)}
          </span>
          <span class="tick seldom" data-testid="tick">
            tick {lab.state()?.tick ?? 0}
          </span>
        </div>
      </div>
      <Timeline lab={lab} beside={props.runs} />
      {props.below}
      <PlaceNotice lab={lab} place="playback" />
    </footer>
  );
}
