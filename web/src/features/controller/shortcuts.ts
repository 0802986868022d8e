import { CONTROLLERS, CONTROLLER_LABELS } from '../../lab/parameters';
import type { FeatureShortcuts } from '../../lab/shortcuts';
import type { Session, Trial } from '../../lab/slices';

export const CONTROLLER_SHORTCUTS: FeatureShortcuts<Session & Trial> = (lab, operate) =>
  CONTROLLERS.map((controller, index) => ({
    group: 'Controller',
    keys: [String(index + 1)],
    does: CONTROLLER_LABELS[controller],
    run: operate(() => {
      if (lab.scene()?.controllers.includes(controller)) {
        void lab.send('controller', { type: 'select_controller', controller });
      }
    }),
  }));
