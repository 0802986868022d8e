// The Train view: a policy learns a map, and you watch it.

import { Show, createMemo, type JSX } from 'solid-js';
import type { Addressed, Notices, Session, Trial } from '../../lab/slices';
import { isActive, milestone, stageSentence } from '../../lab/trainingStage';
import { createDetail } from '../../net/detail';
import type {
  PolicySummary,
  TrainingPoint,
  TrainingReport,
  TrainingSummary,
} from '../../net/protocol.gen';
import { ForKeyed } from '../../ui/ForKeyed';
import { Panel } from '../../ui/Panel';
import { colourRange } from './colourRange';
import { Curves } from './Curves';
import { withLast } from './curves';
import { FoldedIntro, Intro } from './Intro';
import { PoliciesPanel } from './PoliciesPanel';
import { policyOf } from './policyUse';
import { StartPanel } from './StartPanel';
import { choose, chosen, compare, compared } from './state';
import { TrainingEntry } from './TrainingEntry';
import { LayerToggles, Marks, Readings } from './TrainLegend';
import { TRAININGS } from './trainings';
import { usePolicy } from './usePolicy';
import { WatchPane } from './WatchPane';
import './train.css';
import './watch.css';

/** The new training, the first of the list, and its value map. */
function bringIntoView(view: HTMLElement, list: HTMLElement): void {
  // Where the view scrolls itself, its top has both; where the page scrolls, the form is above them.
  if (view.scrollHeight > view.clientHeight) view.scrollTop = 0;
  else list.scrollIntoView({ block: 'start' });
}

export default function TrainView(props: {
  lab: Addressed & Session & Trial & Notices;
  /** Opens the view Evaluate with a policy, by its reference, and a map. */
  onEvaluate: (policy: string, map: string) => void;
}): JSX.Element {
  const { lab } = props;
  const all = (): readonly TrainingSummary[] => lab.catalog.trainings() ?? [];
  const byId = (id: string | undefined): TrainingSummary | undefined =>
    all().find((one) => one.id === id);
  const before = ({ id }: TrainingSummary): readonly TrainingSummary[] =>
    all().slice(
      0,
      all().findIndex((one) => one.id === id),
    );
  /** The chosen training, otherwise the newest. */
  const shown = createMemo(() => byId(chosen()) ?? all().at(-1));
  const shownId = createMemo(() => shown()?.id);
  /** The one beside it. */
  const beside = createMemo(() => byId(compared()));
  const watched = createMemo(() => [shown(), beside()].filter((one) => one !== undefined));
  const newest = lab.catalog.watch(shownId);
  const report = createDetail<TrainingSummary, TrainingReport>(
    TRAININGS,
    beside,
    ({ id, stage, updates }) => [id, stage, updates].join(' '),
  );
  const pointsOf = ({ id }: TrainingSummary): readonly TrainingPoint[] =>
    id === shownId() ? newest() : (report()?.curve ?? []);
  const range = createMemo(() => colourRange(watched()), undefined, {
    equals: (a, b) => a?.join() === b?.join(),
  });
  const trained = ({ policy }: TrainingSummary): PolicySummary | undefined =>
    policyOf(lab.catalog.policies() ?? [], policy ?? undefined);
  const use = (policy: PolicySummary | undefined, maps: readonly string[]): void => {
    if (!policy) return;
    void usePolicy(lab, policy, maps);
    lab.address.show('laboratory');
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
    const summary = shown();
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
                  isShown={shownId() === summary().id}
                  isCompared={beside()?.id === summary().id}
                  isDeleted={summary().policy !== null && !trained(summary())}
                  onChoose={() => {
                    const { id } = summary();
                    if (compared() === id) compare(undefined);
                    choose(id);
                  }}
                  onCompare={() => {
                    const { id } = summary();
                    choose(shownId());
                    compare(beside()?.id === id ? undefined : id);
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
          <Show when={watched().length > 0} fallback={<Intro />}>
            <Panel class="train-watch" name="Value map" head={<LayerToggles />}>
              <p class="hint">
                What the policy expects from each place: the sum of all later rewards on the route
                to the goal. Arrows show the best step.
              </p>
              <Marks />
              <div class="train-panes" data-count={watched().length}>
                <ForKeyed each={watched()} by={({ id }) => id}>
                  {(summary) => (
                    <WatchPane
                      summary={summary()}
                      points={pointsOf(summary())}
                      sentence={stageSentence(summary(), before(summary()))}
                      range={range()}
                      isGrowing={watched().some(isActive)}
                    />
                  )}
                </ForKeyed>
              </div>
              <Readings />
            </Panel>
            <Panel name="Curves">
              <Show
                when={watched()
                  .map(({ id }) => id)
                  .join()}
                keyed
              >
                <Curves
                  curves={watched().map((summary) => ({
                    name: summary.query.name,
                    points: withLast(
                      pointsOf(summary),
                      summary.updates,
                      summary.stage === 'done' ? summary.examined : null,
                    ),
                    total: summary.updates_total,
                    isOver: !isActive(summary),
                  }))}
                />
              </Show>
            </Panel>
            <FoldedIntro />
          </Show>
          <PoliciesPanel lab={lab} onUse={use} />
        </div>
      </Show>
    </main>
  );
}
