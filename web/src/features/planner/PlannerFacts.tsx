// Numbers of ERRT's planning.

import type { JSX } from 'solid-js';
import { fixed } from '../../ui/format';
import { MOST_EDGES, type PlanLayer, type StateMessage } from '../../net/protocol.gen';
import { pathWords } from './plannerFacts';
import { Fact } from '../../ui/Fact';

/** Before the first plan, only their names. */
export function PlannerFacts(props: {
  plan: PlanLayer | undefined;
  state: StateMessage;
}): JSX.Element {
  const of = (words: (plan: PlanLayer) => string): string => (props.plan ? words(props.plan) : '–');
  return (
    <dl class="facts" aria-label="ERRT's plan">
      <Fact
        name="Path"
        value={of(({ way }) => pathWords(way, props.state.phase))}
        help="Length of the path that the tool follows"
        testid="plan-way"
      />
      <Fact
        name="Plans"
        value={of(({ plans }) => String(plans))}
        help="Number of plans since the start of the trial"
        testid="plan-plans"
      />
      <Fact
        name="Nodes tried"
        value={of(({ attempts }) => String(attempts))}
        help="Number of nodes that the last search tried to add to the tree"
        testid="plan-attempts"
      />
      <Fact
        name="Tree"
        value={of(({ tree }) =>
          tree.length < MOST_EDGES ? String(tree.length) : `${MOST_EDGES}+`,
        )}
        help="Number of edges in the tree of the last search"
        testid="plan-tree"
      />
      <Fact
        name="β"
        value={of(({ beta }) => fixed(beta, 2))}
        help="β: weight of the path length from the root when the search chooses the nearest node"
        testid="plan-beta"
      />
    </dl>
  );
}
