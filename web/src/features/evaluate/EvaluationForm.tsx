// The form for a new evaluation.

import { Show, createMemo, type JSX } from 'solid-js';
import {
  CONTROLLERS,
  CONTROLLER_LABELS,
  FIELDS,
  type PolicyField,
  policyOptions,
} from '../../lab/parameters';
import { createPrograms } from '../../lab/programs';
import type { Session, Trial } from '../../lab/slices';
import { EVALUATION_FIELDS } from '../../net/forms.gen';
import type { EvaluationSummary } from '../../net/protocol.gen';
import { CheckField, ChoiceField, NumberField, type Option } from '../../ui/fields/fields';
import { Form } from '../../ui/fields/Form';
import { roughly } from '../../ui/format';
import { shownName } from '../../ui/name';
import { draft, setDraft } from './draft';
import { startEvaluation } from './evaluations';
import { chooseControllers, type Draft, estimate_s, queryOf, sizeWords } from './request';
import { VaryFields } from './VaryFields';
import './EvaluationForm.css';

const DISTURBANCES = [0, 3] as const;
const LABELS = new Map<string, string>(Object.entries(CONTROLLER_LABELS));

export function EvaluationForm(props: {
  lab: Session & Trial;
  measured: readonly EvaluationSummary[];
  onStarted: (id: string) => void;
}): JSX.Element {
  const { lab } = props;
  const programs = createPrograms(lab.catalog, () => draft().program || undefined);
  const change = (part: Partial<Draft>): void => {
    setDraft({ ...draft(), ...part });
  };
  const policies = createMemo((): readonly Option[] => {
    const field = FIELDS.find((one): one is PolicyField => one.kind === 'policy');
    return field ? policyOptions(field, lab.catalog.addedPolicies(), draft().rl_policy) : [];
  });
  const scope = (): string => {
    const query = queryOf(draft());
    const size = sizeWords(query);
    if (size === undefined) return '';
    const time_s = estimate_s(query, props.measured);
    const estimate = time_s === undefined ? 'duration not known yet' : `about ${roughly(time_s)}`;
    return `${size}; ${estimate}.`;
  };
  return (
    <Form
      class="evaluation-form"
      send={async () => {
        props.onStarted(await startEvaluation(queryOf(draft())));
      }}
      button="Run"
      disabled={!lab.canOperate()}
      why="Only the operator can start and cancel evaluations."
    >
      <CheckField<string>
        name="controllers"
        also={['program']}
        label="Controllers"
        missing="Choose at least one controller."
        all={[...CONTROLLERS, ...programs()]}
        chosen={[...draft().controllers, draft().program].filter((name) => name !== '')}
        text={(name) => LABELS.get(name) ?? shownName(name)}
        onChoose={(chosen) => {
          change(chooseControllers(chosen, draft().program));
        }}
      />
      <Show when={draft().controllers.includes('rl')}>
        <ChoiceField
          name="rl_policy"
          label="Policy of RL"
          value={draft().rl_policy}
          options={policies()}
          onChoose={(rl_policy) => {
            change({ rl_policy });
          }}
        />
      </Show>
      <CheckField
        name="maps"
        label="Maps"
        missing="Choose at least one map."
        all={lab.catalog.maps() ?? []}
        chosen={draft().maps}
        onChoose={(maps) => {
          change({ maps });
        }}
      />
      <CheckField<number>
        name="disturbances"
        label="Disturbances per episode"
        missing="Choose at least one number of disturbances."
        all={DISTURBANCES}
        chosen={draft().disturbances}
        onChoose={(disturbances) => {
          change({ disturbances });
        }}
      />
      <VaryFields
        value={draft().vary}
        onInput={(vary) => {
          change({ vary });
        }}
      />
      <div class="evaluation-columns">
        <NumberField
          {...EVALUATION_FIELDS.episodes}
          value={draft().episodes}
          onInput={(episodes) => {
            change({ episodes });
          }}
        />
        <NumberField
          name="seed"
          label="Seed"
          help="The same seed gives the same starts, goals and noise."
          min={0}
          isWhole
          value={draft().seed}
          onInput={(seed) => {
            change({ seed });
          }}
        />
      </div>
      <p class="hint" data-testid="evaluation-scope">
        {scope()}
      </p>
    </Form>
  );
}
