// The Train view: a policy learns a map, and you watch it.

import { For, Show, createEffect, createMemo, mapArray, type JSX } from 'solid-js';
import type { Session, Trial } from '../../lab/slices';
import type { TrainingSummary } from '../../net/protocol.gen';
import { createPalette } from '../../ui/palette';
import type { Theme } from '../../ui/theme';
import { Curves } from './Curves';
import { Intro } from './Intro';
import { createLive } from './live';
import { PoliciesPanel } from './PoliciesPanel';
import { milestone, stageSentence } from '../../lab/trainingStage';
import { StartPanel } from './StartPanel';
import { createTrainState, type TrainState } from './state';
import { TrainingEntry } from './TrainingEntry';
import { LayerToggles, Marks } from './TrainLegend';
import { createPolicyList, createTrainingList } from './trainings';
import { usePolicy } from './usePolicy';
import { WatchPane } from './WatchPane';
import './train.css';
import './watch.css';

export interface TrainProps {
  /** Keeps the form and the selection while another view is open. */
  readonly kept: { train?: TrainState };
  readonly lab: Session & Trial;
  readonly theme: () => Theme;
  readonly onLaboratory: () => void;
}

export function TrainView(props: TrainProps): JSX.Element {
  const { lab } = props;
  const state = (props.kept.train ??= createTrainState());
  const list = createTrainingList();
  const policies = createPolicyList();
  const palette = createPalette(() => props.theme());
  const all = (): readonly TrainingSummary[] => list.all() ?? [];
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
  const lives = createMemo(
    mapArray(watched, (id) => {
      // The last summary stays while the training is removed.
      const first = byId(id);
      if (!first) throw new Error(`${id} is not in the list`);
      return createLive(createMemo<TrainingSummary>((last) => byId(id) ?? last, first));
    }),
  );
  const use = (reference: string, maps: readonly string[]): void => {
    usePolicy(lab, reference, maps);
    props.onLaboratory();
  };
  const choose = (id: string): void => {
    if (state.compared() === id) state.compare(undefined);
    state.choose(id);
  };
  const said = createMemo(() => {
    const summary = byId(shown());
    return summary ? milestone(summary, before(summary.id)) : '';
  });
  const finished = createMemo(() => all().filter(({ stage }) => stage === 'done').length);
  // A finished training is a new policy.
  createEffect(() => {
    if (finished() > 0) void policies.refresh();
  });
  return (
    <main class="view train">
      <div class="train-left">
        <section class="panel" aria-label="New training">
          <header class="panel-head">
            <h2>New training</h2>
          </header>
          <StartPanel
            lab={lab}
            state={state}
            list={list}
            trainings={all()}
            policies={policies.all() ?? []}
          />
        </section>
        <section class="panel" aria-label="Trainings">
          <header class="panel-head">
            <h2>Trainings</h2>
          </header>
          <div role="alert">
            <Show when={list.trouble()}>{(text) => <p class="refusal">{text()}</p>}</Show>
          </div>
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
                      list={list}
                      isShown={shown() === id}
                      isCompared={beside() === id}
                      canCompare={shown() !== id}
                      canOperate={lab.canOperate()}
                      onChoose={() => {
                        choose(id);
                      }}
                      onCompare={() => {
                        state.choose(shown());
                        state.compare(beside() === id ? undefined : id);
                      }}
                      onUse={(reference) => {
                        use(reference, [summary().query.map]);
                      }}
                    />
                  )}
                </Show>
              )}
            </For>
          </ul>
          <Show when={list.all()?.length === 0}>
            <p class="placeholder">No trainings yet.</p>
          </Show>
        </section>
      </div>
      {/* With the list, so that nothing moves when that arrives. */}
      <Show when={list.all()}>
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
                      state={state}
                      palette={palette}
                      theme={props.theme}
                    />
                  )}
                </For>
              </div>
              <p class="hint">
                Rank correlation 1: the order of the values is exactly that of the true distances.
                0: they have nothing in common.
              </p>
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
                        return live.points();
                      },
                      get total() {
                        return live.summary().updates_total;
                      },
                    }))}
                    palette={palette}
                    theme={props.theme}
                  />
                )}
              </Show>
            </section>
          </Show>
          <PoliciesPanel
            lab={lab}
            list={policies}
            palette={palette}
            theme={props.theme}
            onUse={({ reference, maps }) => {
              use(reference, maps);
            }}
          />
        </div>
      </Show>
    </main>
  );
}
