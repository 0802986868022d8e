// The form for a new evaluation.

import { Show, createMemo, type JSX } from 'solid-js';
import {
  CONTROLLERS,
  FIELDS,
  labelOf,
  type PolicyField,
  policyOptions,
} from '../../lab/parameters';
import { paceOf } from '../../lab/jobs';
import { createPrograms } from '../../lab/programs';
import type { Session, Trial } from '../../lab/slices';
import { EVALUATION_FIELDS } from '../../net/forms.gen';
import { CheckField, ChoiceField, NumberField, type Option } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { roughly } from '../../ui/format';
import { change, draft, edits } from './draft';
import { startEvaluation } from './evaluations';
import { chooseControllers, estimate_s, queryOf, sizeWords } from './request';
import { Mark } from './Named';
import { VaryFields } from './VaryFields';
import './EvaluationForm.css';

const DISTURBANCES = [0, 3] as const;

export function EvaluationForm(props: {
  lab: Session & Trial;
  onStarted: (id: string) => void;
  /** Below the fields. */
  children?: JSX.Element;
}): JSX.Element {
  const { lab } = props;
  const programs = createPrograms(lab.catalog, () => draft().program || undefined);
  const policies = createMemo((): readonly Option[] => {
    const field = FIELDS.find((one): one is PolicyField => one.kind === 'policy');
    return field ? policyOptions(field, lab.catalog.addedPolicies(), draft().rl_policy) : [];
  });
  const scope = (): string => {
    const query = queryOf(draft());
    const size = sizeWords(query);
    if (size === undefined) return '';
    const time_s = estimate_s(query, (work) => paceOf(lab.catalog, work));
    return Number.isNaN(time_s) ? `${size}.` : `${size}; about ${roughly(time_s)}.`;
  };
  return (
    <Form
      class="evaluation-form"
      send={async () => props.onStarted(await startEvaluation(lab.session, queryOf(draft())))}
      button="Run"
      isFoot
      beside={
        <span class="hint" data-testid="evaluation-scope">
          {scope()}
        </span>
      }
      disabled={!lab.canOperate()}
      why="Only the operator can start and cancel evaluations."
    >
      <CheckField<string>
        name="controllers"
        also={['program']}
        label="Controllers"
        missing="Choose at least one controller."
        all={[...CONTROLLERS, ...programs()]}
        value={[...draft().controllers, draft().program].filter((name) => name !== '')}
        text={labelOf}
        mark={(name) => <Mark of={name} />}
        onChoose={(chosen) => change(chooseControllers(chosen, draft().program))}
      />
      <Show when={draft().controllers.includes('rl')}>
        <ChoiceField {...edits('rl_policy')} label="Policy of RL" options={policies()} />
      </Show>
      <CheckField
        {...edits('maps')}
        label="Maps"
        missing="Choose at least one map."
        all={lab.catalog.maps() ?? []}
      />
      <CheckField<number>
        {...edits('disturbances')}
        label="Disturbances per episode"
        missing="Choose at least one number of disturbances."
        all={DISTURBANCES}
      />
      <VaryFields {...edits('vary')} />
      <div class="evaluation-columns">
        <NumberField {...EVALUATION_FIELDS.episodes} {...edits('episodes')} />
        <NumberField
          {...edits('seed')}
          label="Seed"
          help="The same seed gives the same starts, goals and noise."
          min={0}
          isWhole
        />
      </div>
      {props.children}
    </Form>
  );
}
