// Sends the user's drawings to the server, and keeps what it says about the last one.

import { createSignal, type Accessor } from 'solid-js';
import { loadMap } from '../../lab/loadMap';
import type { Notices, Session, Trial } from '../../lab/slices';
import type { MapReport } from '../../net/protocol.gen';
import { addMap, isOutOfReach } from './maps';

interface Added {
  readonly file: File;
  readonly report: MapReport;
}

export interface MapOpener {
  readonly isBusy: Accessor<boolean>;
  /** The new map, until it is dismissed or another map is chosen. */
  readonly added: Accessor<Added | undefined>;
  /** Adds a drawing and starts a trial on it. `fit` moves it into the arm's reach. Says why if it cannot. */
  open(file: File, fit?: boolean): Promise<void>;
  dismiss(): void;
}

export function createMapOpener(lab: Session & Trial & Notices): MapOpener {
  const [isBusy, setBusy] = createSignal(false);
  const [added, setAdded] = createSignal<Added>();
  const say = (text: string): void => {
    lab.notify('playback', text);
  };
  return {
    isBusy,
    added: () => {
      const now = added();
      // A map that is out of reach may not have been loaded.
      const stays = now && (isOutOfReach(now.report) || now.report.name === lab.scene()?.map);
      return stays ? now : undefined;
    },
    async open(file, fit = false) {
      if (!lab.canOperate()) {
        say('Take control to open a map.');
        return;
      }
      if (isBusy()) {
        say('Another map is being opened. Try again when it is there.');
        return;
      }
      setBusy(true);
      try {
        const report = await addMap(file, fit);
        setAdded({ file, report });
        loadMap(lab, report.name);
      } catch (reason) {
        say(reason instanceof Error ? reason.message : String(reason));
      }
      setBusy(false);
    },
    dismiss: () => setAdded(undefined),
  };
}
