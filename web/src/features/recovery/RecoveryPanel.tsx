// The tab *Recovery*: from where the bead is still delivered after a disturbance.

import { Shield } from 'lucide';
import { Show, createMemo, onMount, type JSX } from 'solid-js';
import { jobOf, leftWords, takeOpened, waitWords } from '../../lab/jobs';
import { labelOf } from '../../lab/parameters';
import type { PanelProps } from '../../lab/panel';
import { operatorOnly } from '../../lab/operatorOnly';
import { PlaceNotice } from '../../lab/PlaceNotice';
import type { ByHand, Notices, Session, Trial } from '../../lab/slices';
import { isActive } from '../../lab/trainingStage';
import type { JobSummary, RecoveryReport, RecoverySummary } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { Empty } from '../../ui/Empty';
import { clock, counted } from '../../ui/format';
import { ChoiceField } from '../../ui/fields/fields';
import { SmallButton } from '../../ui/SmallButton';
import { CellCard } from './CellCard';
import { isForGoal, KIND_WORDS, titleOf } from './cells';
import { cancelRecovery, createShown } from './recoveries';
import { Cells, Thumbnails } from './RecoveryCells';
import { RecoveryStart } from './RecoveryStart';
import * as store from './store';
import './recovery.css';

function progressWords(
  { stage, done, planned, message }: RecoverySummary,
  job: JobSummary | undefined,
): string {
  const counts = `${done} of ${counted(planned, 'trial')}`;
  if (stage === 'waiting') return waitWords(job);
  if (stage === 'running') {
    const left_s = job?.left_s ?? null;
    return left_s === null ? counts : `${counts}, ${leftWords(left_s)}`;
  }
  if (stage === 'paused') return `paused after ${counts}`;
  if (stage === 'failed') return `failed: ${message ?? ''}`;
  return stage === 'done' ? counted(done, 'trial') : `cancelled after ${counts}`;
}

function Arrange(props: { report: RecoveryReport }): JSX.Element {
  const pairs = (): store.Pair[] =>
    props.report.names.flatMap((_, first, names) =>
      names.slice(first + 1).map((_, after): store.Pair => [first, first + 1 + after]),
    );
  return (
    <ChoiceField<string>
      label="Show"
      value={String(store.pair() ?? '')}
      options={[
        ['', 'one controller'],
        ...pairs().map((pair) => [String(pair), titleOf(props.report, pair)] as const),
      ]}
      onChoose={(value) => store.setPair(pairs().find((pair) => String(pair) === value))}
    />
  );
}

/** A recovery map of another map is shown only if it is chosen here. */
function Earlier(props: {
  all: readonly RecoverySummary[];
  shown: string | undefined;
  isHere: (one: RecoverySummary) => boolean;
  onChoose: (id: string) => void;
}): JSX.Element {
  const options = (): (readonly [string, string])[] => [
    ...(props.shown === undefined ? [['', 'choose'] as const] : []),
    ...props.all.map((one) => {
      const where = props.isHere(one) ? one.map : `${one.map}, another map`;
      return [
        one.id,
        `${one.id.replace('recovery-', '')}: ${KIND_WORDS[one.kind]}, ${where}`,
      ] as const;
    }),
  ];
  return (
    <Show when={options().length > 1}>
      <ChoiceField<string>
        label="Recovery map"
        value={props.shown ?? ''}
        options={options()}
        onChoose={props.onChoose}
      />
    </Show>
  );
}

function Progress(props: { lab: Session; report: RecoveryReport }): JSX.Element {
  const { attempt, refusal } = createAttempt();
  let block!: HTMLDivElement;
  // A map is started at the end of the panel.
  onMount(() => {
    block.scrollIntoView({ block: 'center' });
  });
  return (
    <div ref={block} class="recovery-progress">
      <progress
        max={Math.max(1, props.report.planned)}
        value={props.report.done}
        aria-label="Progress of the recovery map"
      />
      <SmallButton
        {...operatorOnly(props.lab)}
        onClick={() => void attempt(cancelRecovery(props.report.id))}
      >
        Cancel map
      </SmallButton>
      <span class="refusal" role="alert">
        {refusal()}
      </span>
    </div>
  );
}

function Report(props: { lab: Session & Trial & Notices; report: RecoveryReport }): JSX.Element {
  const { lab } = props;
  const indices = createMemo(() => store.shownOf(props.report));
  const chosen = createMemo((): Required<store.Chosen> | undefined => {
    const { name, cell } = store.chosen() ?? {};
    return name === undefined || cell === undefined ? undefined : { name, cell };
  });
  return (
    <>
      <p>From where does each controller still deliver the bead after a disturbance?</p>
      <p data-testid="recovery-progress" class="hint" role="status">
        {KIND_WORDS[props.report.kind]} on {props.report.map}
        {props.report.map === lab.scene()?.map
          ? ''
          : ', which is another map than that of the session,'}{' '}
        {isForGoal(props.report, lab.goal()) ? '' : 'to another goal than the present one, '}
        from {clock(props.report.tick * (lab.scene()?.tick_s ?? 0))}:{' '}
        {progressWords(props.report, jobOf(lab.catalog, props.report.id))}
      </p>
      <Show when={isActive(props.report)}>
        <Progress lab={lab} report={props.report} />
      </Show>
      <Thumbnails lab={lab} report={props.report} shown={props.report.names[indices()[0]] ?? ''} />
      <Cells lab={lab} report={props.report} indices={indices()} />
      <Show when={chosen()}>
        {(one) => (
          <CellCard lab={lab} report={props.report} chosen={one()} label={labelOf(one().name)} />
        )}
      </Show>
      <Show when={props.report.names.length > 1}>
        <div class="form">
          <Arrange report={props.report} />
        </div>
      </Show>
    </>
  );
}

export default function RecoveryPanel(
  props: PanelProps<Session & Trial & Notices & ByHand>,
): JSX.Element {
  const { lab } = props;
  const map = createMemo(() => lab.scene()?.map);
  const shown = createShown(lab.catalog, map);
  takeOpened('recovery', (id) => store.setWanted({ id, on: map() }));
  const report = (): RecoveryReport | undefined =>
    store.report()?.id === shown()?.id ? store.report() : undefined;
  return (
    <>
      <Show
        when={lab.sight() === 'all'}
        fallback={<p class="hint">Hidden in fog: a recovery map shows the walls.</p>}
      >
        <Show
          when={report()}
          fallback={
            <Empty icon={Shield} question="From where is the bead still delivered?">
              From the shown moment, Ferry tries many disturbances under each controller, beside
              your session. Place a goal first.
            </Empty>
          }
        >
          {(report) => <Report lab={lab} report={report()} />}
        </Show>
      </Show>
      <Earlier
        all={lab.catalog.recoveries() ?? []}
        shown={shown()?.id}
        isHere={(one) => one.map === map()}
        onChoose={(id) => store.setWanted({ id, on: map() })}
      />
      <PlaceNotice lab={lab} place="recovery" />
      <RecoveryStart lab={lab} report={report()} />
    </>
  );
}
