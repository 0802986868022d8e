// A policy in the table.

import { Show, createSignal, type JSX } from 'solid-js';
import type { PolicyOrigin, PolicySummary } from '../../net/protocol.gen';
import { ConfirmButton } from '../../ui/ConfirmButton';
import { roughly } from '../../ui/format';
import type { Palette } from '../../ui/palette';
import type { Theme } from '../../ui/theme';
import { TitleForm } from '../../ui/TitleForm';
import { policyName } from '../../lab/parameters';
import { shareWords } from '../../lab/trainingStage';
import { Curves } from './Curves';
import { withLast } from './curves';
import { changeWords, recipeOf } from './recipes';
import { policyFile } from './trainings';
import { addressOf } from '../../net/base';

export interface PolicyDeeds {
  readonly onUse: () => void;
  /** True if it was done. */
  readonly onRename: (name: string) => Promise<boolean>;
  readonly onDelete: () => Promise<boolean>;
}

interface RowProps extends PolicyDeeds {
  readonly policy: PolicySummary;
  readonly canOperate: boolean;
  /** Whether the live session uses it. */
  readonly isUsed: boolean;
  readonly palette: () => Palette;
  readonly theme: () => Theme;
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
          palette={props.palette}
          theme={props.theme}
        />
      </Show>
    </details>
  );
}

export function PolicyRow(props: RowProps): JSX.Element {
  let renamer: HTMLButtonElement | undefined;
  const [isRenaming, setRenaming] = createSignal(false);
  const name = (): string => props.policy.name;
  const why = (): string | undefined =>
    props.canOperate ? undefined : 'Only the operator can do this';
  const endRenaming = (): void => {
    setRenaming(false);
    renamer?.focus();
  };
  const rename = async (next: string): Promise<void> => {
    if (next === name() || (await props.onRename(next))) endRenaming();
  };
  return (
    <>
      <tr data-policy={name()}>
        <th scope="row">
          <Show when={isRenaming()} fallback={<span class="policy-name">{name()}</span>}>
            <TitleForm
              label={`New name of ${name()}`}
              value={name()}
              onSave={(next) => void rename(next)}
              onCancel={endRenaming}
            />
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
          <button
            type="button"
            class="small"
            aria-label={`Use it: ${name()}`}
            disabled={!props.canOperate}
            title={why()}
            onClick={() => {
              props.onUse();
            }}
          >
            Use it
          </button>
          <a
            class="button small"
            href={addressOf(policyFile(name()))}
            download={`${name()}.safetensors`}
            aria-label={`Download ${name()}`}
          >
            Download
          </a>
          <Show when={!props.policy.is_shipped}>
            <button
              ref={renamer}
              type="button"
              class="small"
              aria-label={`Rename ${name()}`}
              disabled={!props.canOperate}
              title={why()}
              onClick={() => {
                setRenaming(true);
              }}
            >
              Rename
            </button>
            <ConfirmButton
              verb="Delete"
              of={name()}
              warning={props.isUsed ? 'The laboratory uses it.' : undefined}
              disabled={!props.canOperate}
              title={why()}
              onYes={props.onDelete}
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
