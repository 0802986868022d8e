// A policy in the table.

import { Show, createSignal, type JSX } from 'solid-js';
import type { PolicyOrigin, PolicySummary } from '../../net/protocol.gen';
import type { Attempt } from '../../ui/attempt';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { counted, roughly } from '../../ui/format';
import { SmallButton } from '../../ui/SmallButton';
import { createRenaming, TitleForm } from '../../ui/TitleForm';
import { operatorOnly } from '../../lab/operatorOnly';
import { policyName } from '../../lab/parameters';
import type { Session } from '../../lab/slices';
import { shareWords } from '../../lab/trainingStage';
import { Curves } from './Curves';
import { withLast } from './curves';
import { changeWords, recipeOf } from './recipes';
import { discardPolicy, policyFile, renamePolicy } from './trainings';
import { addressOf } from '../../net/base';

interface RowProps {
  readonly lab: Session;
  readonly policy: PolicySummary;
  /** Whether the live session uses it. */
  readonly isUsed: boolean;
  readonly attempt: Attempt;
  readonly onUse: () => void;
}

function originWords({ query, elapsed_s }: PolicyOrigin): string {
  const recipe = recipeOf(query.recipe).label.toLowerCase();
  const start = query.start_from === null ? 'random weights' : policyName(query.start_from);
  const changes = changeWords(query);
  const changed = changes.length > 0 ? ` with ${changes.join(', ')}` : '';
  return `Recipe ${recipe}${changed}; from ${start}; trained in about ${roughly(elapsed_s)}.`;
}

function Origin(props: RowProps & { origin: PolicyOrigin }): JSX.Element {
  const [isOpen, setOpen] = createSignal(false);
  return (
    <details onToggle={({ currentTarget }) => setOpen(currentTarget.open)}>
      <summary>How {props.policy.name} was trained</summary>
      <p class="hint">{originWords(props.origin)}</p>
      <Show when={isOpen()}>
        <Curves
          curves={[
            {
              name: props.policy.name,
              points: withLast(props.origin.curve, props.policy.updates, props.origin.examined),
              total: props.policy.updates,
              isOver: true,
            },
          ]}
        />
      </Show>
    </details>
  );
}

export function PolicyRow(props: RowProps): JSX.Element {
  const name = (): string => props.policy.name;
  const renaming = createRenaming((next) =>
    next === name() ? Promise.resolve(true) : props.attempt(renamePolicy(name(), next)),
  );
  const facts = (): string => {
    const { is_shipped, has_memory, maps, updates, origin, seed } = props.policy;
    return [
      is_shipped ? 'shipped' : 'added',
      ...(has_memory ? ['with a memory'] : []),
      ...(props.isUsed ? ['used now'] : []),
      `maps ${maps.join(', ')}`,
      counted(updates, 'update'),
      ...(origin ? [`${shareWords(origin.examined)} reached`] : []),
      `seed ${seed}`,
    ].join(' · ');
  };
  return (
    <li data-policy={name()}>
      <Show when={renaming.isOn()} fallback={<strong class="policy-name">{name()}</strong>}>
        <TitleForm {...renaming.form} label={`New name of ${name()}`} value={name()} />
      </Show>
      <p class="about number">{facts()}</p>
      <div class="policy-deeds">
        <SmallButton
          {...operatorOnly(props.lab)}
          aria-label={`Use it: ${name()}`}
          onClick={props.onUse}
        >
          Use it
        </SmallButton>
        <a
          class="button small ghost"
          href={addressOf(policyFile(name()))}
          download={`${name()}.safetensors`}
          aria-label={`Download ${name()}`}
        >
          Download
        </a>
        <Show when={!props.policy.is_shipped}>
          <SmallButton
            {...operatorOnly(props.lab)}
            {...renaming.button}
            class="small ghost"
            aria-label={`Rename ${name()}`}
          >
            Rename
          </SmallButton>
          <ConfirmButton
            {...operatorOnly(props.lab)}
            verb="Delete"
            of={name()}
            warning={props.isUsed ? 'The laboratory uses it.' : undefined}
            onYes={() => props.attempt(discardPolicy(name()))}
          />
        </Show>
      </div>
      <Show when={props.policy.origin}>{(origin) => <Origin {...props} origin={origin()} />}</Show>
    </li>
  );
}
