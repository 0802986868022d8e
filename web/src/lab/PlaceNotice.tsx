// The notice at one place of the page.

import type { JSX } from 'solid-js';
import { NoticeBar } from '../ui/NoticeBar';
import type { Place } from './places';
import type { Notices } from './slices';

export function PlaceNotice(props: { lab: Notices; place: Place }): JSX.Element {
  return (
    <NoticeBar
      notice={props.lab.notices()[props.place]}
      // Browser tests find it by this name.
      place={props.place === 'playback' ? 'transport' : props.place}
      onDismiss={(id) => {
        props.lab.dismiss(props.place, id);
      }}
    />
  );
}
