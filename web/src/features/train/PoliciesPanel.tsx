// The policies of the server: those that are shipped, trained here, or uploaded.

import { createMemo, type JSX } from 'solid-js';
import { freeName, mapName } from '../../lab/maps';
import { operatorOnly } from '../../lab/operatorOnly';
import type { Session, Trial } from '../../lab/slices';
import type { PolicySummary } from '../../net/protocol.gen';
import { createAttempt } from '../../ui/attempt';
import { FileButton } from '../../ui/FileButton';
import { ForKeyed } from '../../ui/ForKeyed';
import { PolicyRow } from './PolicyRow';
import { policyOf } from './policyUse';
import { uploadPolicy } from './trainings';
import './policies.css';

const ENDING = '.safetensors';

export function PoliciesPanel(props: {
  lab: Session & Trial;
  onUse: (policy: PolicySummary, maps: readonly string[]) => void;
}): JSX.Element {
  const { lab } = props;
  const { attempt, refusal } = createAttempt();
  const all = (): readonly PolicySummary[] => lab.catalog.policies() ?? [];
  const used = createMemo(() => policyOf(all(), lab.scene()?.parameters.rl_policy)?.name);
  const upload = (file: File): void => {
    const wanted = mapName(file.name.replace(ENDING, '')) || 'policy';
    const taken = all().map(({ name }) => name);
    void attempt(uploadPolicy(freeName(wanted, taken), file));
  };
  return (
    <section class="policies" aria-label="Policies">
      <header>
        <h3>Policies</h3>
        <FileButton
          {...operatorOnly(lab, 'Adds a policy that was downloaded from a Ferry server')}
          accept={ENDING}
          inputName="File of a policy"
          class="small"
          onFile={upload}
        >
          Upload policy…
        </FileButton>
      </header>
      <p class="refusal" role="alert">
        {refusal()}
      </p>
      <ul class="plain">
        <ForKeyed each={all()} by={({ name }) => name}>
          {(policy) => (
            <PolicyRow
              lab={lab}
              policy={policy()}
              isUsed={used() === policy().name}
              attempt={attempt}
              onUse={() => props.onUse(policy(), policy().maps)}
            />
          )}
        </ForKeyed>
      </ul>
    </section>
  );
}
