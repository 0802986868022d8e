// How ERRT's planning goes, in numbers.

import type { JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import { MOST_EDGES, type PlanLayer, type StateMessage } from '../../net/protocol.gen';
import { wayWords } from './plannerFacts';
import { Fact } from '../../ui/Fact';

export function PlannerFacts(props: { plan: PlanLayer; state: StateMessage }): JSX.Element {
  const edges = (): string => {
    const count = props.plan.tree.length;
    return count < MOST_EDGES ? String(count) : `${MOST_EDGES}+`;
  };
  return (
    <section class="plan-facts" aria-label="ERRT's plan">
      <dl class="margins">
        <Fact
          name="way"
          value={wayWords(props.plan.way, props.state.phase)}
          help="Length of the way that is followed"
          testid="plan-way"
        />
        <Fact
          name="plans"
          value={String(props.plan.plans)}
          help="Ways planned since the trial began"
          testid="plan-plans"
        />
        <Fact
          name="tried"
          value={String(props.plan.attempts)}
          help="Edges tried in the last search"
          testid="plan-attempts"
        />
        <Fact name="tree" value={edges()} help="Edges of its tree" testid="plan-tree" />
        <Fact
          name="β"
          value={fixed(props.plan.beta, 2)}
          help="Weight of the way from the root in the choice of the nearest node"
          testid="plan-beta"
        />
      </dl>
    </section>
  );
}
