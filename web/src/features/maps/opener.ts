// Sends the user's drawings to the server, and keeps what it says about the last one.

import { createSignal, getOwner, runWithOwner } from 'solid-js';
import { loadTrial } from '../../lab/loadTrial';
import type { Notices, Session, Trial } from '../../lab/slices';
import type { MapReport } from '../../net/protocol.gen';
import { addMap, isOutOfReach } from '../../lab/maps';
import type { PolicyTrials } from './policyTrials';
import { reasonText } from '../../net/problem';

interface Opening {
  readonly fit?: boolean;
  readonly start_m?: [number, number];
  readonly goal_m?: [number, number];
}

interface Added {
  readonly file: File;
  readonly report: MapReport;
}

export function createMapOpener(lab: Session & Trial & Notices) {
  const [isBusy, setBusy] = createSignal(false);
  const [added, setAdded] = createSignal<Added>();
  /** Of the shipped policies on the new map. */
  const [trials, setTrials] = createSignal<PolicyTrials>();
  const owner = getOwner();
  /** Their code is loaded for the first map. */
  const tryPolicies = async (map: string): Promise<void> => {
    const { createPolicyTrials } = await import('./policyTrials');
    const make = (): PolicyTrials => createPolicyTrials(lab.catalog, lab.session);
    const made = trials() ?? runWithOwner(owner, make);
    setTrials(() => made);
    made?.start(map);
  };
  const say = (text: string): void => {
    lab.notify('playback', text);
  };
  return {
    isBusy,
    trials,
    /** The new map, until it is dismissed or another map is chosen. */
    added: (): Added | undefined => {
      const now = added();
      // A map that is out of reach may not have been loaded.
      const stays = now && (isOutOfReach(now.report) || now.report.name === lab.scene()?.map);
      return stays ? now : undefined;
    },
    /**
     * Adds a drawing and starts a trial on it, with a start and a goal if they are given. `fit` moves it into the arm's
     * reach. Returns whether it was added, and says why if it was not.
     */
    open: async (file: File, { fit = false, ...places }: Opening = {}): Promise<boolean> => {
      if (!lab.canOperate()) {
        say('Take control to open a map.');
        return false;
      }
      if (isBusy()) {
        say('Another map is being opened. Try again when it is there.');
        return false;
      }
      setBusy(true);
      try {
        const report = await addMap(file, fit);
        setAdded({ file, report });
        const answer = await loadTrial(lab, 'playback', { map: report.name, ...places });
        if (answer?.kind === 'done') await tryPolicies(report.name);
        return true;
      } catch (reason) {
        say(reasonText(reason));
        return false;
      } finally {
        setBusy(false);
      }
    },
    dismiss: (): void => {
      trials()?.stop();
      setAdded(undefined);
    },
  };
}

export type MapOpener = ReturnType<typeof createMapOpener>;
