import type { Session, Trial } from './slices';

/** Starts a trial on another map with the present parameters. */
export function loadMap(lab: Session & Trial, map: string): void {
  const scene = lab.scene();
  const state = lab.state();
  if (!scene || !state) return;
  lab.send({
    type: 'load_scenario',
    map,
    controller: state.controller,
    seed: scene.seed,
    parameters: scene.parameters,
  });
}
