// A policy in the table.

import { Show, createSignal, type JSX } from 'solid-js';
import type { PolicyOrigin, PolicySummary } from '../../net/protocol.gen';
import type { Attempt } from '../../ui/attempt';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { roughly } from '../../ui/format';
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
    <details
      onToggle={({ currentTarget }) => {
        setOpen(currentTarget.open);
      }}
    >
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
  return (
    <>
      <tr data-policy={name()}>
        <th scope="row">
          <Show when={renaming.isOn()} fallback={<span class="policy-name">{name()}</span>}>
            <TitleForm {...renaming.form} label={`New name of ${name()}`} value={name()} />
          </Show>
          <span class="about">
            {props.policy.is_shipped ? 'shipped' : 'added'}
            {props.policy.has_memory ? ', with a memory' : ''}
            {props.isUsed ? ', used now' : ''}
          </span>
        </th>
        <td>{props.policy.maps.join(', ')}</td>
        <td class="number" data-label="Updates">
          {props.policy.updates}
        </td>
        <td class="number" data-label="Examination">
          <Show when={props.policy.origin} fallback="–">
            {(origin) => shareWords(origin().examined)}
          </Show>
        </td>
        <td class="number" data-label="Seed">
          {props.policy.seed}
        </td>
        <td class="policy-deeds">
          <SmallButton
            {...operatorOnly(props.lab)}
            aria-label={`Use it: ${name()}`}
            onClick={props.onUse}
          >
            Use it
          </SmallButton>
          <a
            class="button small"
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
        </td>
      </tr>
      <Show when={props.policy.origin}>
        {(origin) => (
          <tr class="policy-origin">
            <td colspan="6">
              <Origin {...props} origin={origin()} />
            </td>
          </tr>
        )}
      </Show>
    </>
  );
}
