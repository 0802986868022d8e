// Which policy is meant, where it can carry the bead, and what the user can do then. Pure.

import type { PolicySummary } from '../../net/protocol.gen';

export type Policy = Pick<PolicySummary, 'name' | 'reference'>;

/** The policy of a reference, also under another name: it keeps its hash when it is renamed. */
export function policyOf<P extends Policy>(
  policies: readonly P[],
  reference: string | undefined,
): P | undefined {
  const hash = reference?.split('@')[1];
  return (
    policies.find((one) => one.reference === reference) ??
    policies.find((one) => hash !== undefined && one.reference.endsWith(`@${hash}`))
  );
}

/** On the present map if the policy was trained on it, otherwise on the first of its maps that the server has. */
export function mapFor(
  trained: readonly string[],
  present: string,
  all: readonly string[],
): string {
  if (trained.includes(present)) return present;
  return trained.find((map) => all.includes(map)) ?? present;
}

/** The next step of the user in the laboratory. */
export function nextWords(
  name: string,
  { hasGoal, running }: { readonly hasGoal: boolean; readonly running: boolean },
  isTouch: boolean,
): string {
  const click = isTouch ? 'Tap' : 'Click';
  const goal = hasGoal ? 'another goal' : 'the goal';
  const run = running ? '' : ', then press Run';
  return `RL drives with the policy ${name}. ${click} a place to set ${goal}${run}.`;
}
