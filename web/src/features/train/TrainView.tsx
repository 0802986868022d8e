// The Train view: a policy learns a map, and you watch it.

import { For, Show, createMemo, mapArray, type JSX } from 'solid-js';
import type { Notices, Session, Trial } from '../../lab/slices';
import type { PolicySummary, TrainingSummary } from '../../net/protocol.gen';
import { createPalette } from '../../ui/palette';
import type { Theme } from '../../ui/theme';
import { colourRange } from './colourRange';
import { Curves } from './Curves';
import { withLast } from './curves';
import { FoldedIntro, Intro } from './Intro';
import { createLive } from './live';
import { PoliciesPanel } from './PoliciesPanel';
import { isActive, milestone, stageSentence } from '../../lab/trainingStage';
import { type Policy, policyOf } from './policyUse';
import { StartPanel } from './StartPanel';
import { createTrainState, type TrainState } from './state';
import { TrainingEntry } from './TrainingEntry';
import { LayerToggles, Marks, Readings } from './TrainLegend';
import { usePolicy } from './usePolicy';
import { WatchPane } from './WatchPane';
import './train.css';
import './watch.css';

export interface TrainProps {
  /** Keeps the form and the selection while another view is open. */
  readonly kept: { train?: TrainState };
  readonly lab: Session & Trial & Notices;
  readonly theme: () => Theme;
  readonly onLaboratory: () => void;
  /** Opens the view Evaluate with a policy, by its reference, and a map. */
  readonly onEvaluate: (policy: string, map: string) => void;
}

/** The new training, the first of the list, and its value map. */
function bringIntoView(view: HTMLElement, list: HTMLElement): void {
  // Where the view scrolls itself, its top has both; where the page scrolls, the form is above them.
  if (view.scrollHeight > view.clientHeight) view.scrollTop = 0;
  else list.scrollIntoView({ block: 'start' });
}

export function TrainView(props: TrainProps): JSX.Element {
  const { lab } = props;
  const state = (props.kept.train ??= createTrainState());
  const palette = createPalette(() => props.theme());
  const all = (): readonly TrainingSummary[] => lab.catalog.trainings() ?? [];
  const sameIds = { equals: (a: string[], b: string[]) => a.join() === b.join() };
  const ids = createMemo(() => all().map(({ id }) => id), [], sameIds);
  const byId = (id: string | undefined): TrainingSummary | undefined =>
    all().find((one) => one.id === id);
  const before = (id: string): readonly TrainingSummary[] => all().slice(0, ids().indexOf(id));
  /** The chosen training, otherwise the newest, and the one beside it. */
  const shown = createMemo(() => byId(state.chosen())?.id ?? ids().at(-1));
  const beside = createMemo(() => byId(state.compared())?.id);
  const watched = createMemo(
    () => [shown(), beside()].filter((id): id is string => id !== undefined),
    [],
    sameIds,
  );
  const points = lab.catalog.watch(shown);
  const lives = createMemo(
    mapArray(watched, (id) => {
      // The last summary stays while the training is removed.
      const first = byId(id);
      if (!first) throw new Error(`${id} is not in the list`);
      const summary = createMemo<TrainingSummary>((last) => byId(id) ?? last, first);
      return createLive(summary, () => (shown() === id ? points() : undefined));
    }),
  );
  const range = createMemo(() => colourRange(lives().map((live) => live.summary())), undefined, {
    equals: (a, b) => a?.join() === b?.join(),
  });
  const trained = ({ policy }: TrainingSummary): PolicySummary | undefined =>
    policyOf(lab.catalog.policies() ?? [], policy ?? undefined);
  const use = (policy: Policy, maps: readonly string[]): void => {
    void usePolicy(lab, policy, maps);
    props.onLaboratory();
    // Where the page scrolls, the button may be far down.
    window.scrollTo(0, 0);
  };
  const evaluate = (policy: Policy, map: string): void => {
    props.onEvaluate(policy.reference, map);
    window.scrollTo(0, 0);
  };
  const choose = (id: string): void => {
    if (state.compared() === id) state.compare(undefined);
    state.choose(id);
  };
  const said = createMemo(() => {
    const summary = byId(shown());
    return summary ? milestone(summary, before(summary.id)) : '';
  });
  let view!: HTMLElement;
  let entries!: HTMLElement;
  return (
    <main ref={view} class="view train">
      <div class="train-left">
        <section class="panel" aria-label="New training">
          <header class="panel-head">
            <h2>New training</h2>
          </header>
          <StartPanel
            lab={lab}
            state={state}
            onStarted={() => {
              bringIntoView(view, entries);
            }}
          />
        </section>
        <section ref={entries} class="panel" aria-label="Trainings">
          <header class="panel-head">
            <h2>Trainings</h2>
          </header>
          <p class="visually-hidden" role="status">
            {said()}
          </p>
          <ul class="training-entries">
            <For each={ids().toReversed()}>
              {(id) => (
                <Show when={byId(id)}>
                  {(summary) => (
                    <TrainingEntry
                      summary={summary()}
                      before={before(id)}
                      isShown={shown() === id}
                      isCompared={beside() === id}
                      canCompare={shown() !== id}
                      canOperate={lab.canOperate()}
                      isDeleted={summary().policy !== null && !trained(summary())}
                      onChoose={() => {
                        choose(id);
                      }}
                      onCompare={() => {
                        state.choose(shown());
                        state.compare(beside() === id ? undefined : id);
                      }}
                      onUse={() => {
                        const policy = trained(summary());
                        if (policy) use(policy, [summary().query.map]);
                      }}
                      onEvaluate={() => {
                        const policy = trained(summary());
                        if (policy) evaluate(policy, summary().query.map);
                      }}
                    />
                  )}
                </Show>
              )}
            </For>
          </ul>
          <Show when={lab.catalog.trainings()?.length === 0}>
            <p class="placeholder">No trainings yet.</p>
          </Show>
        </section>
      </div>
      {/* With the list, so that nothing moves when that arrives. */}
      <Show when={lab.catalog.trainings()}>
        <div class="train-right">
          <Show when={ids().length === 0}>
            <Intro />
          </Show>
          <Show when={lives().length > 0}>
            <section class="panel train-watch" aria-label="Value map">
              <header class="panel-head">
                <h2>Value map</h2>
                <LayerToggles layers={state.layers()} onChange={state.setLayers} />
              </header>
              <p class="hint">
                What the policy expects from each place: the sum of all later rewards on the route
                to the goal. Arrows show the best step.
              </p>
              <Marks />
              <div class="train-panes" data-count={lives().length}>
                <For each={lives()}>
                  {(live) => (
                    <WatchPane
                      live={live}
                      sentence={stageSentence(live.summary(), before(live.summary().id))}
                      range={range()}
                      isGrowing={lives().some((one) => isActive(one.summary()))}
                      state={state}
                      palette={palette}
                      theme={props.theme}
                    />
                  )}
                </For>
              </div>
              <Readings />
            </section>
            <section class="panel" aria-label="Curves">
              <header class="panel-head">
                <h2>Curves</h2>
              </header>
              <Show when={lives()} keyed>
                {(now) => (
                  <Curves
                    curves={now.map((live) => ({
                      get name() {
                        return live.summary().query.name;
                      },
                      get points() {
                        const { stage, updates, examined } = live.summary();
                        return withLast(live.points(), updates, stage === 'done' ? examined : null);
                      },
                      get total() {
                        return live.summary().updates_total;
                      },
                      get isOver() {
                        return !isActive(live.summary());
                      },
                    }))}
                    palette={palette}
                    theme={props.theme}
                  />
                )}
              </Show>
            </section>
            <FoldedIntro />
          </Show>
          <PoliciesPanel
            lab={lab}
            palette={palette}
            theme={props.theme}
            onUse={(policy) => {
              use(policy, policy.maps);
            }}
          />
        </div>
      </Show>
    </main>
  );
}
