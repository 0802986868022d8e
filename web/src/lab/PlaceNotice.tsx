// The notice of one place of the page.

import type { JSX } from 'solid-js';
import { NoticeBar } from '../ui/NoticeBar';
import type { Lab } from './lab';
import type { Place } from './model';

export function PlaceNotice(props: { lab: Lab; place: Place }): JSX.Element {
  return (
    <NoticeBar
      notice={props.lab.notices()[props.place]}
      place={props.place}
      onDismiss={(id) => {
        props.lab.dismiss(props.place, id);
      }}
    />
  );
}
