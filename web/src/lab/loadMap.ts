import type { Answer } from './commands';
import type { Session, Trial } from './slices';

/** Starts a trial on another map with the present parameters. */
export async function loadMap(lab: Session & Trial, map: string): Promise<Answer | undefined> {
  const scene = lab.scene();
  const state = lab.state();
  if (!scene || !state) return undefined;
  return lab.send('playback', {
    type: 'load_scenario',
    map,
    controller: state.controller,
    seed: scene.seed,
    parameters: scene.parameters,
  });
}
