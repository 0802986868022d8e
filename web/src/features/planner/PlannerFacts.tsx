// Numbers of ERRT's planning.

import type { JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import { MOST_EDGES, type PlanLayer, type StateMessage } from '../../net/protocol.gen';
import { pathWords } from './plannerFacts';
import { Fact } from '../../ui/Fact';
import '../../ui/Fact.css';
import './planner.css';

export function PlannerFacts(props: { plan: PlanLayer; state: StateMessage }): JSX.Element {
  const edges = (): string => {
    const count = props.plan.tree.length;
    return count < MOST_EDGES ? String(count) : `${MOST_EDGES}+`;
  };
  return (
    <section class="plan-facts" aria-label="ERRT's plan">
      <dl class="margins">
        <Fact
          name="path length"
          value={pathWords(props.plan.way, props.state.phase)}
          help="Length of the path that the tool follows"
          testid="plan-way"
        />
        <Fact
          name="plans"
          value={String(props.plan.plans)}
          help="Number of plans since the start of the trial"
          testid="plan-plans"
        />
        <Fact
          name="nodes tried"
          value={String(props.plan.attempts)}
          help="Number of nodes that the last search tried to add to the tree"
          testid="plan-attempts"
        />
        <Fact
          name="tree size"
          value={edges()}
          help="Number of edges in the tree of the last search"
          testid="plan-tree"
        />
        <Fact
          name="β"
          value={fixed(props.plan.beta, 2)}
          help="β: weight of the path length from the root when the search chooses the nearest node"
          testid="plan-beta"
        />
      </dl>
    </section>
  );
}
