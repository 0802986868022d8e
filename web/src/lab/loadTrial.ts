// Starts another trial. Each promise settles when the trial is shown.

import type { ClientMessage } from '../net/protocol.gen';
import type { Answer } from './commands';
import { experimentFrom, loadMessage } from './experimentLink';
import { knownBy } from './known';
import type { Place } from './places';
import type { Session, Trial } from './slices';

type Wanted = Omit<Extract<ClientMessage, { type: 'load_scenario' }>, 'type'>;

/** Starts a trial on a map. Controller, seed and parameters are the present ones, unless others are wanted. */
export async function loadTrial(
  lab: Session & Trial,
  at: Place,
  wanted: Wanted,
): Promise<Answer | undefined> {
  const [scene, state] = [lab.scene(), lab.state()];
  if (!scene || !state) return undefined;
  const { seed, parameters } = scene;
  const { controller } = state;
  return lab.send(at, { type: 'load_scenario', controller, seed, parameters, ...wanted });
}

/** Starts the experiment of a link that the page contains; does nothing before the server's maps are known. */
export async function loadLink(
  lab: Session & Trial,
  at: Place,
  link: string,
): Promise<Answer | undefined> {
  const known = knownBy(lab);
  if (!known) return undefined;
  const read = experimentFrom(link, known);
  if (read.kind !== 'experiment') throw new Error(`The page has a broken link: ${link}`);
  return lab.send(at, loadMessage(read.experiment, known.defaults));
}
