// Time: run, pause, step, reset, speed, seed, map, and the way back.

import { Show, createEffect, createMemo, on, onCleanup, onMount, type JSX } from 'solid-js';
import { clock, fixed, speed } from '../format';
import type { Lab } from '../lab';
import type { Links } from '../links';
import { LinkBar } from './LinkBar';
import { NoticeBar } from './NoticeBar';
import { PresetSelect } from './PresetSelect';
import { ShareButton } from './ShareButton';
import { Timeline } from './Timeline';
import { TruthSelect } from './TruthSelect';
import { WhyCard } from './WhyCard';

const SPEEDS = [0.125, 0.25, 0.5, 1, 2, 4, 8, 64];
const FASTEST = 64;
/** One second of ticks. */
const MANY_TICKS = 125;
const SEED_LIMIT = 2 ** 32;

/** Whether Space already means something where the focus is. */
function usesSpace(target: EventTarget | null): boolean {
  return (
    target instanceof Element &&
    target.closest('button, input:not([type=range]), select, summary, textarea, a') !== null
  );
}

function RunButtons(props: { lab: Lab }): JSX.Element {
  const { lab } = props;
  const running = (): boolean => lab.state()?.running ?? false;
  const toggle = (): void => {
    lab.send({ type: running() ? 'pause' : 'run' });
  };
  onMount(() => {
    const onKey = (event: KeyboardEvent): void => {
      if (event.key !== ' ' || event.repeat || usesSpace(event.target)) return;
      event.preventDefault();
      if (lab.canOperate()) toggle();
    };
    document.addEventListener('keydown', onKey);
    onCleanup(() => {
      document.removeEventListener('keydown', onKey);
    });
  });
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
        title={`One tick of 8 ms; with Shift ${MANY_TICKS} ticks, one second`}
        onClick={(event) => {
          lab.send({ type: 'step', ticks: event.shiftKey ? MANY_TICKS : 1 });
        }}
      >
        Step
      </button>
      <button
        type="button"
        disabled={!lab.canOperate()}
        title="Back to the start with the same seed"
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
  const speeds = createMemo(() => {
    const target = lab.state()?.speed_target ?? 1;
    const all = SPEEDS.includes(target) ? SPEEDS : [...SPEEDS, target].sort((a, b) => a - b);
    return all.map(
      (factor) => [String(factor), factor === FASTEST ? 'max (64×)' : speed(factor)] as const,
    );
  });
  const maps = createMemo(() => (lab.scene()?.maps ?? []).map((name) => [name, name] as const));
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
          value={String(lab.state()?.speed_target ?? 1)}
          options={speeds()}
          refusals={lab.refusals()}
          disabled={!lab.canOperate()}
          onChoose={(value) => {
            lab.send({ type: 'set_speed', factor: Number(value) });
          }}
        />
        <span class="achieved number" title="Simulated seconds a second that the server achieves">
          <Show when={lab.state()?.running} fallback="paused">
            achieved {fixed(lab.state()?.speed_achieved ?? 0, 2)}×
          </Show>
        </span>
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
