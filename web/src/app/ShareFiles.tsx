// The files in *Share*: the trial as a test case, and the recording of the session.

import type { JSX } from 'solid-js';
import { CaseLink } from '../features/events/CaseLink';
import { RecordingLinks } from '../features/recordings/RecordingLinks';
import type { Session, Trial } from '../lab/slices';

export default function ShareFiles(props: { lab: Session & Trial }): JSX.Element {
  return (
    <>
      <CaseLink lab={props.lab}>Test case</CaseLink>
      <RecordingLinks session={props.lab.session} />
    </>
  );
}
