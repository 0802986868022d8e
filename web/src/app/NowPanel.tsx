// Who steers, what it sees, why it moves as it does, and which sub-controller is on.

import type { JSX } from 'solid-js';
import { ControllerPanel } from '../features/controller/ControllerPanel';
import { TwinFacts } from '../features/twin/TwinFacts';
import type { PanelProps } from '../lab/panel';
import { ControllerFacts } from './ControllerFacts';

export function NowPanel(props: PanelProps): JSX.Element {
  return (
    <>
      <TwinFacts lab={props.lab} />
      <ControllerPanel lab={props.lab}>
        <ControllerFacts lab={props.lab} />
      </ControllerPanel>
    </>
  );
}
