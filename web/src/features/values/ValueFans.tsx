// The policy's expected return of each of its four actions, as a box of quantiles with the mean.

import { For, Index, Show, createMemo, type JSX } from 'solid-js';
import { ArrowDown, ArrowLeft, ArrowRight, ArrowUp } from 'lucide';
import { ACTIONS } from '../../lab/actions';
import { fixed } from '../../ui/format';
import { digits } from '../../lab/parameters';
import type { JudgementLayer } from '../../net/protocol.gen';
import { Icon } from '../../ui/Icon';
import { type Axis, bestOf, type Fan, fanAxis, fanOf, percentAlong } from './fans';
import './values.css';

const ARROWS = { right: ArrowRight, left: ArrowLeft, up: ArrowUp, down: ArrowDown };

/** What the parts of a box are. */
const KEYS = [
  ['all', 'all quantiles'],
  ['half', 'middle half'],
  ['mean', 'mean'],
] as const;

const end = (axis: Axis, which: 'from' | 'to'): string => fixed(axis[which], digits(axis.step));

function Strip(props: { fan: Fan; axis: Axis }): JSX.Element {
  const at = (value: number): string => `${percentAlong(props.axis, value)}%`;
  const width = (from: number, to: number): string =>
    `${percentAlong(props.axis, to) - percentAlong(props.axis, from)}%`;
  return (
    <svg class="strip" aria-hidden="true">
      <line class="grid" x2="100%" y1="50%" y2="50%" />
      <Index each={props.axis.ticks}>
        {(tick) => <line class="grid" x1={at(tick())} x2={at(tick())} y1="6" y2="14" />}
      </Index>
      <rect
        class="all"
        x={at(props.fan.min)}
        width={width(props.fan.min, props.fan.greatest)}
        y="6"
        height="8"
        rx="2"
      />
      <rect
        class="half"
        x={at(props.fan.lower)}
        width={width(props.fan.lower, props.fan.upper)}
        y="4"
        height="12"
        rx="2"
      />
      <line class="mean" x1={at(props.fan.mean)} x2={at(props.fan.mean)} y1="2" y2="18" />
    </svg>
  );
}

/** Before the first decision, only the names of the actions. */
export function ValueFans(props: { judgement: JudgementLayer | undefined }): JSX.Element {
  const fans = createMemo(() =>
    props.judgement?.values.map((value, index) =>
      fanOf(props.judgement?.quantiles[index] ?? [], value),
    ),
  );
  const axis = createMemo<Axis | undefined>((before?: Axis) => {
    const all = fans();
    return all ? fanAxis(all, before) : undefined;
  });
  const value = (index: number): number | undefined => props.judgement?.values[index];
  const best = (): number => bestOf(props.judgement?.values ?? []);
  return (
    <table class="value-fans" aria-label="Expected return of each action">
      <tbody>
        <Index each={ACTIONS}>
          {(action, index) => (
            <tr
              classList={{
                taken: index === props.judgement?.taken,
                best: index === best() && index !== props.judgement?.taken,
              }}
            >
              <th scope="row" title={action().name}>
                <Icon of={ARROWS[action().word]} />
                <span class="visually-hidden">{action().word}</span>
              </th>
              <td>
                <Show when={fans()?.[index]}>
                  {(fan) => (
                    <Show when={axis()}>{(one) => <Strip fan={fan()} axis={one()} />}</Show>
                  )}
                </Show>
              </td>
              <td class="number" data-testid={props.judgement && `rl-value-${action().id}`}>
                {value(index) === undefined ? '–' : fixed(value(index) ?? NaN, 3)}
              </td>
            </tr>
          )}
        </Index>
        <tr class="ends" aria-hidden="true">
          <td />
          <td>
            <Show when={axis()} fallback="–">
              {(one) => (
                <>
                  <span>{end(one(), 'from')}</span>
                  <span>{end(one(), 'to')}</span>
                </>
              )}
            </Show>
          </td>
          <td />
        </tr>
      </tbody>
    </table>
  );
}

/** The decision as a sentence, and what the policy was trained on. */
export function ValueWords(props: {
  judgement: JudgementLayer | undefined;
  map: string;
}): JSX.Element {
  const taken = (): string => {
    const word = ACTIONS[props.judgement?.taken ?? 0]?.word ?? '';
    return word.charAt(0).toUpperCase() + word.slice(1);
  };
  const best = (): number => bestOf(props.judgement?.values ?? []);
  return (
    <div class="value-words">
      <p class="decision" data-testid="rl-decision">
        <Show when={props.judgement} fallback="The policy has not decided anything yet.">
          {(judgement) => (
            <>
              <strong data-testid="rl-taken">{taken()}</strong>{' '}
              <Show
                when={best() !== judgement().taken}
                fallback={`promises most: ${fixed(judgement().values[best()] ?? NaN, 2)} of reward.`}
              >
                is taken. The shield refused {ACTIONS[best()]?.word}, which promises most.
              </Show>
              <Show when={judgement().is_shortcut}>
                <span data-testid="rl-shortcut">
                  {' '}
                  The way ahead is clear: the tool goes straight over the next cells.
                </span>
              </Show>
            </>
          )}
        </Show>
      </p>
      <p class="policy">
        <Show when={props.judgement}>
          {(judgement) => (
            <>
              Policy <strong data-testid="rl-policy">{judgement().policy}</strong>, trained on{' '}
              <span data-testid="rl-trained-on">{judgement().trained_on.join(', ')}</span>
              <Show when={!judgement().trained_on.includes(props.map)}>
                ,{' '}
                <Show
                  when={judgement().has_memory}
                  fallback={<strong data-testid="rl-unseen">not on this map</strong>}
                >
                  <span data-testid="rl-memory">
                    not on this map. It plans with what the camera has seen so far.
                  </span>
                </Show>
              </Show>
            </>
          )}
        </Show>
      </p>
      <p class="keys" title="The sum of future rewards. Later rewards count less">
        Return:
        <For each={KEYS}>
          {([part, name]) => (
            <span>
              <i class={part} /> {name}
            </span>
          )}
        </For>
      </p>
    </div>
  );
}
