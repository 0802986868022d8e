// The experiment that the page's address asks for: loaded once, and only by the operator.

import {
  createEffect,
  createMemo,
  createSignal,
  onCleanup,
  untrack,
  type Accessor,
} from 'solid-js';
import {
  type Experiment,
  experimentFrom,
  linkOf,
  loadMessage,
  type Reading,
} from './experimentLink';
import type { Notices, Session, Trial } from './slices';
import { takeControl } from './takeControl';

export interface PageExperiment {
  /** What the address asks for and has not got: a viewer may not load it. */
  readonly asked: Accessor<Experiment | undefined>;
  /** Why what it asks for is no experiment. */
  readonly broken: Accessor<string | undefined>;
  /** The link of what is on the page now. */
  readonly now: Accessor<string | undefined>;
  /** Loads what is asked for, with control taken first where that is possible. */
  load(): void;
  /** Loads a link of this page's own. */
  open(link: string): void;
  /** The question is not to be asked again. */
  forget(): void;
}

export function createPageExperiment(lab: Session & Trial & Notices, page: Window): PageExperiment {
  const [hash, setHash] = createSignal(page.location.hash);
  /** Whether it is to be loaded as soon as this browser may. */
  const [wanted, setWanted] = createSignal(false);
  const onChange = (): void => {
    setHash(page.location.hash);
    setWanted(lab.canOperate());
  };
  page.addEventListener('hashchange', onChange);
  onCleanup(() => {
    page.removeEventListener('hashchange', onChange);
  });

  // Controllers and defaults stay as they are while the server runs; maps come and go.
  const known = createMemo(() => lab.scene(), undefined, {
    equals: (a, b) => a?.maps.join() === b?.maps.join(),
  });
  const reading = createMemo<Reading>(() => {
    const scene = known();
    return scene ? experimentFrom(hash(), scene) : { kind: 'none' };
  });
  const asked = createMemo(() => {
    const now = reading();
    return now.kind === 'experiment' ? now.experiment : undefined;
  });
  const forget = (): void => {
    setHash('');
    setWanted(false);
  };
  const send = (experiment: Experiment): void => {
    const scene = untrack(lab.scene);
    if (scene) lab.send(loadMessage(experiment, scene.defaults));
  };

  // Who opens the page with a link, as its operator, wants it loaded; afterwards it is no question any more.
  let isFirst = true;
  createEffect(() => {
    const experiment = asked();
    if (!lab.scene() || lab.connection().kind !== 'live' || !lab.hello()) return;
    const may = lab.canOperate();
    if (experiment && may && (isFirst || wanted())) {
      send(experiment);
      forget();
    }
    isFirst = false;
  });

  const now = createMemo(() => {
    const [scene, state] = [lab.scene(), lab.state()];
    return scene && state && linkOf(scene, state);
  });
  return {
    asked,
    broken: () => {
      const now = reading();
      return now.kind === 'broken' ? now.why : undefined;
    },
    now,
    load() {
      setWanted(true);
      if (lab.canOperate()) return;
      takeControl(lab);
    },
    open(link) {
      const scene = lab.scene();
      if (!scene) return;
      const read = experimentFrom(link, scene);
      if (read.kind === 'experiment') send(read.experiment);
      else if (read.kind === 'broken') lab.notify('playback', read.why);
    },
    forget,
  };
}
