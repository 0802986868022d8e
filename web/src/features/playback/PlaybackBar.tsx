// The playback bar: run, pause, step, reset, speed, seed, map, timeline.

import { Show, createEffect, createMemo, createSignal, on, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import { loadMap } from '../../lab/loadMap';
import { runOrPause } from './run';
import { speedName, SPEEDS, ticksToControlStep } from './steps';
import { Achieved } from './Achieved';
import { PlaceNotice } from '../../lab/PlaceNotice';
import { Timeline } from './Timeline';
import { numberFault, numberOf } from '../../ui/fields/number';
import { NumberInput } from '../../ui/fields/NumberInput';
import { TruthSelect } from '../../ui/ServerSelect';
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
      <button
        type="button"
        class="primary run"
        disabled={!lab.canOperate()}
        title="Space"
        onClick={() => {
          runOrPause(lab);
        }}
      >
        {running() ? 'Pause' : 'Run'}
      </button>
      <button
        type="button"
        disabled={!lab.canOperate() || running()}
        title={`One tick of 8 ms; with Shift ${MANY_TICKS} ticks, one second (.)`}
        onClick={(event) => {
          lab.send({ type: 'step', ticks: event.shiftKey ? MANY_TICKS : 1 });
        }}
      >
        Step
      </button>
      <button
        type="button"
        class="seldom"
        disabled={!lab.canOperate() || running()}
        title="To the next control step: 31 or 32 ticks, a quarter of a second (,)"
        onClick={() => {
          const tick = lab.state()?.tick ?? 0;
          const ticks = ticksToControlStep(tick, lab.scene()?.tick_s ?? 0.008);
          lab.send({ type: 'step', ticks });
        }}
      >
        Step ¼ s
      </button>
      <button
        type="button"
        disabled={!lab.canOperate()}
        title="Back to the start with the same seed (R)"
        onClick={() => {
          lab.send({ type: 'reset' });
        }}
      >
        Reset
      </button>
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
  createEffect(on([() => props.seed, lab.refusals], show));
  return (
    <form
      class="field"
      onSubmit={(event) => {
        event.preventDefault();
        lab.send({ type: 'reset', seed: numberOf(typed() ?? String(props.seed)) });
      }}
    >
      <label for="seed">Seed</label>
      <NumberInput
        id="seed"
        min={0}
        isWhole
        isStrict
        value={typed() ?? props.seed}
        disabled={!lab.canOperate()}
        title="Enter resets the trial with this seed"
        style={{ '--digits': String(props.seed).length }}
        onInput={setTyped}
        onBlur={() => {
          if (numberFault(typed() ?? '0') === undefined) show();
        }}
      />
      <button
        type="button"
        disabled={!lab.canOperate()}
        title="Resets the trial with a random seed"
        onClick={() => {
          lab.send({ type: 'reset', seed: Math.floor(Math.random() * SEED_LIMIT) });
        }}
      >
        New seed
      </button>
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
  const names = createMemo(() => lab.scene()?.maps ?? [], [], {
    equals: (a, b) => a.join() === b.join(),
  });
  const maps = createMemo(() => names().map((name) => [name, name] as const));
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
          <TruthSelect
            label="Speed"
            value={String(target())}
            options={speeds()}
            refusals={lab.refusals()}
            disabled={!lab.canOperate()}
            onChoose={(value) => {
              lab.send({ type: 'set_speed', factor: Number(value) });
            }}
          />
          <Achieved lab={lab} />
          <Show when={lab.scene()}>
            {(scene) => (
              <>
                <TruthSelect
                  label="Map"
                  value={scene().map}
                  options={maps()}
                  refusals={lab.refusals()}
                  disabled={!lab.canOperate()}
                  onChoose={(map) => {
                    loadMap(lab, map);
                  }}
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
