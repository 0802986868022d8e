// Time: run, pause, step, reset, speed, seed, map, and the way back.

import { Show, createEffect, createMemo, on, type JSX } from 'solid-js';
import { clock } from '../../ui/format';
import type { Lab } from '../../lab/lab';
import { SPEEDS, speedName, ticksToControlStep } from './steps';
import type { Links } from '../../lab/pageExperiment';
import { Achieved } from './Achieved';
import { LinkBar } from '../share/ExperimentNotice';
import { NoticeBar } from '../../ui/NoticeBar';
import { OpenMap } from '../maps/OpenMap';
import { PresetSelect } from '../share/PresetSelect';
import { ShareButton } from '../share/ShareButton';
import { Timeline } from './Timeline';
import { TruthSelect } from '../../ui/ServerSelect';
import { WhyCard } from '../why/WhyCard';

/** One second of ticks. */
const MANY_TICKS = 125;
const SEED_LIMIT = 2 ** 32;

function RunButtons(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  const running = (): boolean => lab.state()?.running ?? false;
  const toggle = (): void => {
    lab.send({ type: running() ? 'pause' : 'run' });
  };
  return (
    <div class="buttons">
      <button
        type="button"
        class="primary run"
        disabled={!lab.canOperate()}
        title="Space"
        onClick={toggle}
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

function Seed(props: { lab: Lab; seed: number }): JSX.Element {
  const { lab } = props;
  let input!: HTMLInputElement;
  const show = (): void => {
    input.value = String(props.seed);
  };
  createEffect(on([() => props.seed, lab.refusals], show));
  return (
    <form
      class="field"
      onSubmit={(event) => {
        event.preventDefault();
        const seed = input.valueAsNumber;
        if (Number.isSafeInteger(seed) && seed >= 0) lab.send({ type: 'reset', seed });
        else lab.notify('transport', 'A seed is a whole number from 0.');
      }}
    >
      <label for="seed">Seed</label>
      <input
        ref={input}
        id="seed"
        class="number"
        type="number"
        min="0"
        step="1"
        disabled={!lab.canOperate()}
        title="Enter resets the trial with this seed"
        // Leaving the field is no reason to reset a trial.
        onBlur={show}
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

export function Transport(props: { lab: Lab; links: Links }): JSX.Element {
  const { lab, links } = props;
  // A memo of its own: other news must not make the list anew under the pointer.
  const target = createMemo(() => lab.state()?.speed_target ?? 1);
  const speeds = createMemo(() => {
    const all = [...new Set([...SPEEDS, target()])].sort((a, b) => a - b);
    return all.map((factor) => [String(factor), speedName(factor)] as const);
  });
  const names = createMemo(() => lab.scene()?.maps ?? [], [], {
    equals: (a, b) => a.join() === b.join(),
  });
  const maps = createMemo(() => names().map((name) => [name, name] as const));
  const loadMap = (map: string): void => {
    const scene = lab.scene();
    const state = lab.state();
    if (!scene || !state) return;
    // A new map is no reason to lose what was tuned.
    lab.send({
      type: 'load_scenario',
      map,
      controller: state.controller,
      seed: scene.seed,
      parameters: scene.parameters,
    });
  };
  return (
    <footer class="bar transport" role="region" aria-label="Transport">
      <LinkBar lab={lab} links={links} />
      <div class="transport-row">
        <RunButtons lab={lab} />
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
                onChoose={loadMap}
              />
              <OpenMap lab={lab} onMap={loadMap} />
              <PresetSelect lab={lab} links={links} />
              <Seed lab={lab} seed={scene().seed} />
              <ShareButton links={links} />
            </>
          )}
        </Show>
        <div class="now number">
          <span class="sim-time" data-testid="sim-time">
            {clock(lab.state()?.sim_time_s ?? 0)}
          </span>
          <span class="tick" data-testid="tick">
            tick {lab.state()?.tick ?? 0}
          </span>
        </div>
      </div>
      <Timeline lab={lab} />
      <WhyCard lab={lab} />
      <NoticeBar lab={lab} place="transport" />
    </footer>
  );
}
