// The Train view: a policy learns a map, and you watch it.

import { For, Show, createMemo, mapArray, type JSX } from 'solid-js';
import type { Notices, Session, Trial } from '../../lab/slices';
import { isActive, milestone, stageSentence } from '../../lab/trainingStage';
import type { PolicySummary, TrainingSummary } from '../../net/protocol.gen';
import { ForKeyed } from '../../ui/ForKeyed';
import { createPalette } from '../../ui/palette';
import { Panel } from '../../ui/Panel';
import type { Theme } from '../../ui/theme';
import { colourRange } from './colourRange';
import { Curves } from './Curves';
import { withLast } from './curves';
import { FoldedIntro, Intro } from './Intro';
import { createLive } from './live';
import { PoliciesPanel } from './PoliciesPanel';
import { policyOf } from './policyUse';
import { StartPanel } from './StartPanel';
import { choose, chosen, compare, compared } from './state';
import { TrainingEntry } from './TrainingEntry';
import { LayerToggles, Marks, Readings } from './TrainLegend';
import { usePolicy } from './usePolicy';
import { WatchPane } from './WatchPane';
import './train.css';
import './watch.css';

export interface TrainProps {
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
  const palette = createPalette(() => props.theme());
  const all = (): readonly TrainingSummary[] => lab.catalog.trainings() ?? [];
  const byId = (id: string | undefined): TrainingSummary | undefined =>
    all().find((one) => one.id === id);
  const before = ({ id }: TrainingSummary): readonly TrainingSummary[] =>
    all().slice(
      0,
      all().findIndex((one) => one.id === id),
    );
  /** The chosen training, otherwise the newest, and the one beside it. */
  const shown = createMemo(() => (byId(chosen()) ?? all().at(-1))?.id);
  const beside = createMemo(() => byId(compared())?.id);
  const watched = createMemo(() => [shown(), beside()].filter((id) => id !== undefined), [], {
    equals: (a, b) => a.join() === b.join(),
  });
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
  const use = (policy: PolicySummary | undefined, maps: readonly string[]): void => {
    if (!policy) return;
    void usePolicy(lab, policy, maps);
    props.onLaboratory();
    // Where the page scrolls, the button may be far down.
    window.scrollTo(0, 0);
  };
  const evaluate = (summary: TrainingSummary): void => {
    const policy = trained(summary);
    if (!policy) return;
    props.onEvaluate(policy.reference, summary.query.map);
    window.scrollTo(0, 0);
  };
  const said = createMemo(() => {
    const summary = byId(shown());
    return summary ? milestone(summary, before(summary)) : '';
  });
  let view!: HTMLElement;
  let entries!: HTMLElement;
  return (
    <main ref={view} class="view train">
      <div class="train-left">
        <Panel name="New training">
          <StartPanel
            lab={lab}
            onStarted={() => {
              bringIntoView(view, entries);
            }}
          />
        </Panel>
        <Panel ref={(panel) => (entries = panel)} name="Trainings">
          <p class="visually-hidden" role="status">
            {said()}
          </p>
          <ul class="training-entries">
            <ForKeyed each={all().toReversed()} by={({ id }) => id}>
              {(summary) => (
                <TrainingEntry
                  lab={lab}
                  summary={summary()}
                  before={before(summary())}
                  isShown={shown() === summary().id}
                  isCompared={beside() === summary().id}
                  isDeleted={summary().policy !== null && !trained(summary())}
                  onChoose={() => {
                    const { id } = summary();
                    if (compared() === id) compare(undefined);
                    choose(id);
                  }}
                  onCompare={() => {
                    const { id } = summary();
                    choose(shown());
                    compare(beside() === id ? undefined : id);
                  }}
                  onUse={() => {
                    use(trained(summary()), [summary().query.map]);
                  }}
                  onEvaluate={() => {
                    evaluate(summary());
                  }}
                />
              )}
            </ForKeyed>
          </ul>
          <Show when={lab.catalog.trainings()?.length === 0}>
            <p class="placeholder">No trainings yet.</p>
          </Show>
        </Panel>
      </div>
      {/* With the list, so that nothing moves when that arrives. */}
      <Show when={lab.catalog.trainings()}>
        <div class="train-right">
          <Show when={lives().length > 0} fallback={<Intro />}>
            <Panel class="train-watch" name="Value map" head={<LayerToggles />}>
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
                      sentence={stageSentence(live.summary(), before(live.summary()))}
                      range={range()}
                      isGrowing={lives().some((one) => isActive(one.summary()))}
                      palette={palette}
                      theme={props.theme}
                    />
                  )}
                </For>
              </div>
              <Readings />
            </Panel>
            <Panel name="Curves">
              <Show when={lives()} keyed>
                {(now) => (
                  <Curves
                    curves={now.map((live) => {
                      const { query, stage, updates, updates_total, examined } = live.summary();
                      return {
                        name: query.name,
                        points: withLast(
                          live.points(),
                          updates,
                          stage === 'done' ? examined : null,
                        ),
                        total: updates_total,
                        isOver: !isActive({ stage }),
                      };
                    })}
                    palette={palette}
                    theme={props.theme}
                  />
                )}
              </Show>
            </Panel>
            <FoldedIntro />
          </Show>
          <PoliciesPanel lab={lab} palette={palette} theme={props.theme} onUse={use} />
        </div>
      </Show>
    </main>
  );
}
