// What happened in this trial, as numbers.

import type { JSX } from 'solid-js';
import { deliveredGoals } from '../lab/deliveries';
import { TERMS } from '../lab/terms';
import type { Events, Trial } from '../lab/slices';

function Counter(props: {
  label: string;
  help?: string;
  testid: string;
  value: number | undefined;
}): JSX.Element {
  return (
    <div title={props.help}>
      <dt>{props.label}</dt>
      <dd class="number" data-testid={props.testid}>
        {props.value ?? '–'}
      </dd>
    </div>
  );
}

export function Counters(props: { lab: Trial & Events }): JSX.Element {
  const { lab } = props;
  return (
    <dl class="counters">
      <Counter
        label="Delivered"
        testid="deliveries"
        value={deliveredGoals(lab.state(), lab.marks())}
      />
      <Counter label="Pulled away" testid="disturbances" value={lab.state()?.disturbances} />
      <Counter label="Switches" help={TERMS.mode} testid="switches" value={lab.state()?.switches} />
      <Counter label="Steps" testid="steps" value={lab.state()?.steps} />
    </dl>
  );
}
