// Who steers: one of Ferry's own controllers, or a program.

import { Show, createMemo, type JSX } from 'solid-js';
import { CONTROLLER_HELP, CONTROLLER_LABELS } from '../../lab/parameters';
import { createPrograms } from '../../lab/programs';
import type { Notices, Session, Trial } from '../../lab/slices';
import type { ControllerName } from '../../net/protocol.gen';
import { Glyph } from '../../ui/Glyph';
import { shownName } from '../../ui/name';
import { createPending } from '../../ui/pending';
import { Segmented, type Segment } from '../../ui/Segmented';
import './SteeredBy.css';

interface Choice {
  readonly controller: ControllerName;
  readonly program?: string;
}

const keyOf = ({ controller, program }: Choice): string => program ?? controller;

export function SteeredBy(props: { lab: Session & Trial & Notices }): JSX.Element {
  const { lab } = props;
  const program = createMemo(() => {
    const state = lab.state();
    return state?.controller === 'program' ? state.program?.name : undefined;
  });
  const programs = createPrograms(lab.catalog, program);
  const chosen = createPending<Choice>(
    () => {
      const [controller, name] = [lab.state()?.controller ?? 'rl', program()];
      return name === undefined ? { controller } : { controller, program: name };
    },
    (choice) => lab.send('controller', { type: 'select_controller', ...choice }),
  );
  // A memo, so that the segments stay when a state comes.
  const isRobot = createMemo(() => lab.state()?.controller === 'robot');
  const choices = createMemo((): readonly Choice[] => [
    ...(lab.scene()?.controllers ?? []).map((controller) => ({ controller })),
    // It takes the arm by itself; a choice only takes it back.
    ...(isRobot() ? [{ controller: 'robot' as const }] : []),
    ...programs().map((name) => ({ controller: 'program' as const, program: name })),
  ]);
  const segments = createMemo(() =>
    choices().map((choice): Segment<string> => ({
      value: keyOf(choice),
      help: CONTROLLER_HELP[choice.controller],
      label: (
        <>
          <Glyph of={choice.controller} />
          {shownName(choice.program ?? CONTROLLER_LABELS[choice.controller])}
        </>
      ),
    })),
  );
  return (
    <div class="steered-by">
      <span aria-hidden="true">Steered by</span>
      <Show when={lab.scene()}>
        <Segmented
          label="Controller"
          name="controller"
          value={keyOf(chosen.value())}
          segments={segments()}
          disabled={!lab.canOperate()}
          isBusy={chosen.isPending()}
          onChoose={(key) => {
            const choice = choices().find((one) => keyOf(one) === key);
            if (choice) chosen.choose(choice);
          }}
        />
      </Show>
    </div>
  );
}
