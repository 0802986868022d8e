// The experiment link in the page's address: loaded once, and only by the operator.

import { createEffect, createMemo, createSignal, untrack } from 'solid-js';
import {
  type Experiment,
  experimentFrom,
  linkOf,
  loadMessage,
  type Reading,
} from './experimentLink';
import { leaveAddress } from './address';
import { drawnMap } from './drawingLink';
import { knownBy } from './known';
import { listen } from '../ui/listen';
import type { Notices, Session, Trial } from './slices';
import { reasonText } from '../net/problem';

export type PageExperiment = ReturnType<typeof createPageExperiment>;

export function createPageExperiment(lab: Session & Trial & Notices, page: Window) {
  const [hash, setHash] = createSignal(page.location.hash);
  /** Whether to load it as soon as this browser is the operator. */
  const [wanted, setWanted] = createSignal(false);
  listen('hashchange', () => {
    setHash(page.location.hash);
    setWanted(lab.canOperate());
  });

  // Controllers and defaults do not change while the server runs, but maps do.
  const known = createMemo(() => knownBy(lab), undefined, {
    equals: (a, b) => a?.maps.join() === b?.maps.join(),
  });
  const reading = createMemo<Reading>(() => {
    const now = known();
    return now ? experimentFrom(hash(), now) : { kind: 'none' };
  });
  const requested = createMemo(() => {
    const now = reading();
    return now.kind === 'experiment' ? now.experiment : undefined;
  });
  /** Offers the experiment of the address no longer. */
  const settle = (): void => {
    setHash('');
    setWanted(false);
  };
  /** Whether the experiment was loaded. */
  const send = async (experiment: Experiment): Promise<boolean> => {
    const now = untrack(known);
    if (!now) return false;
    try {
      const { drawing } = experiment;
      const map =
        drawing === null ? experiment.map : await drawnMap(experiment.map, drawing, now.maps);
      const message = loadMessage({ ...experiment, map }, now.defaults);
      return (await lab.send('playback', message)).kind === 'done';
    } catch (reason) {
      lab.notify('playback', `The map of this link could not be added: ${reasonText(reason)}`);
      return false;
    }
  };
  /** The experiment leaves the address, so that a reload goes on with what the user has done since. */
  const sendOnce = async (experiment: Experiment): Promise<void> => {
    settle();
    if (await send(experiment)) leaveAddress(page, 'hash');
  };

  // An operator who opens the page with a link wants to load it. The link is not offered again later.
  let isFirst = true;
  createEffect(() => {
    const experiment = requested();
    if (!known() || lab.connection().kind !== 'live' || !lab.hello()) return;
    const may = lab.canOperate();
    // A reloaded page may be a viewer for a moment.
    if (experiment && may && (isFirst || lab.isReturning() || wanted())) {
      void sendOnce(experiment);
    }
    isFirst = false;
  });

  const now = createMemo(() => {
    const [scene, state] = [lab.scene(), lab.state()];
    return scene && state && linkOf(scene, state);
  });
  return {
    /** The experiment of the address that is not loaded yet, because a viewer may not load it. */
    requested,
    /** The link as it is in the address. */
    hash,
    /** Why the link is not valid. */
    broken: () => {
      const now = reading();
      return now.kind === 'broken' ? now.why : undefined;
    },
    /** The link of the page's present experiment. */
    now,
    /** Loads the experiment of the address. Takes control first if possible. */
    load: () => {
      setWanted(true);
      if (lab.canOperate()) return;
      void lab.send('session', { type: 'take_control' });
    },
    /** Loads a link from this page, such as a preset. */
    open: async (link: string) => {
      const now = known();
      if (!now) return;
      const read = experimentFrom(link, now);
      if (read.kind === 'experiment') await send(read.experiment);
      else if (read.kind === 'broken') lab.notify('playback', read.why);
    },
    /** Dismisses the notice. */
    forget: () => {
      leaveAddress(page, 'hash');
      settle();
    },
  };
}
