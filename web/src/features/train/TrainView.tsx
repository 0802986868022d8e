// The Train view: a policy learns a map, and you watch it.

import { For, Show, createMemo, mapArray, type JSX } from 'solid-js';
import { Plus } from 'lucide';
import type { Addressed, Notices, Session, Trial } from '../../lab/slices';
import { jobOf, takeOpened } from '../../lab/jobs';
import { isActive, milestone, stageSentence } from '../../lab/trainingStage';
import { createDetail } from '../../net/detail';
import type {
  JobSummary,
  PolicySummary,
  TrainingPoint,
  TrainingReport,
  TrainingSummary,
} from '../../net/protocol.gen';
import { ForKeyed } from '../../ui/ForKeyed';
import { Icon } from '../../ui/Icon';
import { ScaleBar } from '../../ui/ScaleBar';
import { SmallButton } from '../../ui/SmallButton';
import { IS_TOUCH } from '../../ui/touch';
import { ViewFrame } from '../../ui/ViewFrame';
import { CellPanel } from './CellPanel';
import { colourRange } from './colourRange';
import { Curves } from './Curves';
import { withLast } from './curves';
import { Dock } from './Dock';
import { Facts } from './Facts';
import { FoldedIntro } from './Intro';
import { NewTraining } from './NewTraining';
import { FirstPane, HELP_ID, PlanPane } from './PlanPane';
import { PoliciesPanel } from './PoliciesPanel';
import { policyOf } from './policyUse';
import { TOY_MAP } from './recipes';
import { mapOf } from './StartPanel';
import {
  choose,
  chosen,
  compare,
  compared,
  hasCurves,
  isNew,
  playsFinished,
  setNew,
  setPlaysFinished,
} from './state';
import { TrainingEntry } from './TrainingEntry';
import { TrainingHead } from './TrainingHead';
import { Marks, Readings, ValueScale } from './TrainLegend';
import { TRAININGS } from './trainings';
import { usePolicy } from './usePolicy';
import { createWatch } from './watch';
import './train.css';
import './watch.css';

export default function TrainView(props: {
  lab: Addressed & Session & Trial & Notices;
  /** Opens the view Evaluate with a policy, by its reference, and a map. */
  onEvaluate: (policy: string, map: string) => void;
}): JSX.Element {
  const { lab } = props;
  const all = (): readonly TrainingSummary[] => lab.catalog.trainings() ?? [];
  const byId = (id: string | undefined): TrainingSummary | undefined =>
    all().find((one) => one.id === id);
  const job = ({ id }: TrainingSummary): JobSummary | undefined => jobOf(lab.catalog, id);
  takeOpened('training', choose);
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
  };
  const evaluate = (summary: TrainingSummary): void => {
    const policy = trained(summary);
    if (!policy) return;
    props.onEvaluate(policy.reference, summary.query.map);
  };
  const said = createMemo(() => {
    const summary = shown();
    return summary ? milestone(summary, job(summary)) : '';
  });
  /** Each lasts as long as its training is watched. */
  const made = mapArray(
    () => watched().map(({ id }) => id),
    (id) => {
      const first = byId(id);
      return first && createWatch(createMemo((last: TrainingSummary) => byId(id) ?? last, first));
    },
  );
  const watches = createMemo(() => made().filter((one) => one !== undefined));
  const isFirstVisit = (): boolean => all().length === 0;
  const isForm = (): boolean => isNew() || isFirstVisit();
  let entries: HTMLUListElement | undefined;
  let form: HTMLElement | undefined;
  let newButton: HTMLButtonElement | undefined;
  const closeForm = (): void => {
    setNew(false);
    setPlaysFinished(false);
    newButton?.focus();
  };
  const details = (): JSX.Element => (
    <>
      <For each={watches()}>
        {(watch, index) => (
          <section aria-label={watch.summary().query.name}>
            <TrainingHead
              lab={lab}
              summary={watch.summary()}
              job={job(watch.summary())}
              isDeleted={watch.summary().policy !== null && !trained(watch.summary())}
              isFirst={index() === 0}
              onUse={() => use(trained(watch.summary()), [watch.summary().query.map])}
              onEvaluate={() => evaluate(watch.summary())}
              onRemoved={() => entries?.querySelector('button')?.focus()}
            />
            <h3>How good is it by now?</h3>
            <Facts
              summary={watch.summary()}
              points={pointsOf(watch.summary())}
              frame={watch.frame()}
            />
            <Show when={watch.cell() !== undefined && watch.cells()}>
              {(cells) => (
                <CellPanel
                  cells={cells()}
                  cell={watch.cell() ?? 0}
                  frame={watch.frame()}
                  frames={watch.read()}
                  count={watch.count()}
                  total={watch.summary().updates_total}
                />
              )}
            </Show>
          </section>
        )}
      </For>
      <section>
        <h3>Value</h3>
        <ValueScale range={range()} isGrowing={watched().some(isActive)} />
        <Marks />
        <Readings />
        <FoldedIntro />
      </section>
      <section aria-label="Trainings">
        <header>
          <h3>Trainings</h3>
          <SmallButton
            ref={newButton}
            onClick={() => {
              setNew(true);
              form?.querySelector('select')?.focus();
            }}
          >
            <Icon of={Plus} />
            New training
          </SmallButton>
        </header>
        <ul ref={entries} class="training-entries">
          <ForKeyed each={all().toReversed()} by={({ id }) => id}>
            {(summary) => (
              <TrainingEntry
                summary={summary()}
                job={job(summary())}
                isShown={shownId() === summary().id}
                isCompared={beside()?.id === summary().id}
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
              />
            )}
          </ForKeyed>
        </ul>
      </section>
    </>
  );
  return (
    <ViewFrame
      class="train"
      map={
        <div class="train-panes" data-count={watches().length}>
          <For each={watches()} fallback={<FirstPane map={mapOf(lab)} />}>
            {(watch) => (
              <PlanPane
                watch={watch}
                sentence={stageSentence(watch.summary(), job(watch.summary()))}
                range={range()}
                isNamed={watches().length > 1}
              />
            )}
          </For>
        </div>
      }
      over={
        <p class="about">
          <Show when={watches().length === 0 && playsFinished()}>
            <strong>A finished training</strong> on the map {TOY_MAP}, played again and again.{' '}
          </Show>
          <Show when={watches().length > 0 || playsFinished()}>
            What the policy expects from each place: the sum of all later rewards on the route to
            the goal.
          </Show>
        </p>
      }
      under={
        <>
          <p id={HELP_ID} class="train-help">
            <Show
              when={watches().length > 0}
              fallback={playsFinished() ? '' : 'The map of the new training.'}
            >
              {IS_TOUCH ? 'Tap a cell' : 'Click a cell, or use the arrow keys on the plan,'} to see
              how its value changed.
            </Show>
          </p>
          <Show when={watches().length === 1 && watches()[0]?.map()}>
            {(map) => <ScaleBar width_m={map().width_m} height_m={map().height_m} />}
          </Show>
        </>
      }
      inspectorName="Training"
      inspector={
        <>
          <p class="visually-hidden" role="status">
            {said()}
          </p>
          {/* With the list, so that nothing moves when that arrives. */}
          <Show when={lab.catalog.trainings()}>
            <Show when={isForm()} fallback={details()}>
              <NewTraining
                onForm={(part) => (form = part)}
                lab={lab}
                isFirst={isFirstVisit()}
                onClose={closeForm}
                onStarted={() => {
                  closeForm();
                  document.querySelector<HTMLElement>('.training-head h2')?.focus();
                }}
              />
            </Show>
            <PoliciesPanel lab={lab} onUse={use} />
          </Show>
        </>
      }
      dockName="Playback"
      dock={
        <>
          <Show when={hasCurves() && watched().length > 0}>
            <div class="lanes train-lanes">
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
            </div>
          </Show>
          <Dock watches={watches()} />
        </>
      }
    />
  );
}
