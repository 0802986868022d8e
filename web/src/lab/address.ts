// The page's address below its session: `/s/NAME/VIEW`, or `/s/NAME/learn/LESSON` for the laboratory with a lesson.

import { createSignal, onCleanup } from 'solid-js';
import { addressOf, pathOf } from '../net/base';
import type { View as OtherView } from '../net/protocol.gen';
import { sessionOf } from '../net/session';

export type View = 'laboratory' | OtherView;

export const VIEWS: Readonly<Record<View, string>> = {
  laboratory: 'Lab',
  draw: 'Draw',
  train: 'Train',
  recordings: 'Recordings',
  evaluate: 'Evaluate',
};

interface Place {
  readonly view: View;
  /** The open lesson. It stays open while another view is shown. */
  readonly lesson: string | undefined;
}

const isView = (text: string | undefined): text is View =>
  text !== undefined && Object.hasOwn(VIEWS, text);

function placeOf(pathname: string, lesson?: string): Place {
  const [, , , view, named] = pathOf(pathname).split('/');
  if (isView(view) && view !== 'laboratory') return { view, lesson };
  return { view: 'laboratory', lesson: view === 'learn' ? named : undefined };
}

export type Address = ReturnType<typeof createAddress>;

export function createAddress(page: Window) {
  const { location, history } = page;
  const [place, setPlace] = createSignal(placeOf(location.pathname));
  const session = `/s/${sessionOf(location)}`;
  const onPop = (): void => {
    setPlace(placeOf(location.pathname, place().lesson));
  };
  page.addEventListener('popstate', onPop);
  onCleanup(() => page.removeEventListener('popstate', onPop));
  const addressAt = ({ view, lesson }: Place): string => {
    if (view !== 'laboratory') return addressOf(`${session}/${view}`);
    return addressOf(lesson === undefined ? session : `${session}/learn/${lesson}`);
  };
  const go = (to: Partial<Place>): void => {
    const next = { ...place(), ...to };
    const [before, after] = [addressAt(place()), addressAt(next)];
    if (before !== after) history.pushState(null, '', after);
    setPlace(next);
  };
  return {
    view: () => place().view,
    lesson: () => place().lesson,
    /** The address that a view has. */
    of: (view: View) => addressAt({ ...place(), view }),
    show: (view: View) => go({ view }),
    /** Opens a lesson, or closes the open one. */
    learn: (lesson: string | undefined) => go({ lesson }),
  };
}

/** Takes what follows `#` or `?` out of the address, without a new entry in the browser's history. */
export function leaveAddress(page: Window, part: 'hash' | 'search'): void {
  const url = new URL(page.location.href);
  url[part] = '';
  page.history.replaceState(page.history.state, '', url);
}
