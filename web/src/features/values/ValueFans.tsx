// The policy's expected return of each of its four actions, as a fan of quantiles.

import { Index, Show, createMemo, type JSX } from 'solid-js';
import { ACTIONS } from '../../lab/actions';
import { fixed } from '../../ui/format';
import { digits } from '../../lab/parameters';
import type { JudgementLayer } from '../../net/protocol.gen';
import { type Axis, bestOf, type Fan, fanAxis, fanOf, percentAlong } from './fans';
import './values.css';

function Strip(props: { fan: Fan; axis: Axis }): JSX.Element {
  const at = (value: number): string => `${percentAlong(props.axis, value)}%`;
  const width = (from: number, to: number): string =>
    `${percentAlong(props.axis, to) - percentAlong(props.axis, from)}%`;
  return (
    <svg class="strip" aria-hidden="true">
      <Index each={props.axis.ticks}>
        {(tick) => <line class="grid" x1={at(tick())} x2={at(tick())} y1="0" y2="100%" />}
      </Index>
      <rect
        class="all"
        x={at(props.fan.min)}
        width={width(props.fan.min, props.fan.greatest)}
        y="5"
        height="10"
      />
      <rect
        class="half"
        x={at(props.fan.lower)}
        width={width(props.fan.lower, props.fan.upper)}
        y="3"
        height="14"
      />
      <line class="mean" x1={at(props.fan.mean)} x2={at(props.fan.mean)} y1="1" y2="19" />
    </svg>
  );
}

function Numbers(props: { axis: Axis }): JSX.Element {
  return (
    <svg class="strip numbers" aria-hidden="true">
      <Index each={props.axis.ticks}>
        {(tick) => (
          <text x={`${percentAlong(props.axis, tick())}%`} y="11">
            {fixed(tick(), digits(props.axis.step))}
          </text>
        )}
      </Index>
    </svg>
  );
}

export function ValueFans(props: { judgement: JudgementLayer; map: string }): JSX.Element {
  const fans = createMemo(() =>
    props.judgement.values.map((value, index) =>
      fanOf(props.judgement.quantiles[index] ?? [], value),
    ),
  );
  const axis = createMemo<Axis>((before?: Axis) => fanAxis(fans(), before));
  const best = (): number => bestOf(props.judgement.values);
  const shielded = (): boolean => best() !== props.judgement.taken;
  return (
    <section class="value-fans" aria-label="What the policy expects">
      <p class="keys" title="The sum of future rewards. Later rewards count less">
        Return:
        <span class="all" /> all quantiles
        <span class="half" /> middle half
        <span class="mean" /> mean
      </p>
      <table aria-label="Expected return of each action">
        <tbody>
          <Index each={ACTIONS}>
            {(action, index) => (
              <tr
                classList={{
                  taken: index === props.judgement.taken,
                  best: shielded() && index === best(),
                }}
              >
                <th scope="row">
                  <span aria-hidden="true">{action().arrow}</span> {action().name}
                </th>
                <td>
                  <Show when={fans()[index]}>{(fan) => <Strip fan={fan()} axis={axis()} />}</Show>
                </td>
                <td class="number" data-testid={`rl-value-${action().id}`}>
                  {fixed(props.judgement.values[index] ?? NaN, 3)}
                </td>
              </tr>
            )}
          </Index>
          <tr aria-hidden="true">
            <td />
            <td>
              <Numbers axis={axis()} />
            </td>
            <td />
          </tr>
        </tbody>
      </table>
      <p class="decision">
        Taken: <strong data-testid="rl-taken">{ACTIONS[props.judgement.taken]?.name}</strong>
        <Show when={shielded()}>, the next best: the shield refused the best action</Show>
        <Show when={props.judgement.is_shortcut}>
          <span data-testid="rl-shortcut">
            . The way ahead is clear, so the tool goes straight over the next cells
          </span>
        </Show>
      </p>
      <p class="rule">
        Policy: <strong data-testid="rl-policy">{props.judgement.policy}</strong>, trained on:{' '}
        <span data-testid="rl-trained-on">{props.judgement.trained_on.join(', ')}</span>
        <Show when={!props.judgement.trained_on.includes(props.map)}>
          ,{' '}
          <Show
            when={props.judgement.has_memory}
            fallback={<strong data-testid="rl-unseen">not on this map</strong>}
          >
            <span data-testid="rl-memory">
              not on this map. It plans with what the camera has seen so far.
            </span>
          </Show>
        </Show>
      </p>
    </section>
  );
}
