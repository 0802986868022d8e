// What the controller You needs: how to steer, what is shown, and who fetches the bead.

import { Show, type JSX } from 'solid-js';
import type { ByHand, Panels } from '../../lab/slices';
import { SIGHTS, type Sight } from '../../lab/sight';
import { IS_TOUCH } from '../../ui/touch';
import { followGamepads } from './pollGamepad';
import { ChoiceField } from '../../ui/fields/fields';
import { SmallButton } from '../../ui/SmallButton';
import './steer.css';

const PUSH = { right: 'to the right', up: 'up', left: 'to the left', down: 'down' } as const;

export function YouFacts(props: { lab: ByHand & Panels }): JSX.Element {
  const { lab } = props;
  const gamepad = followGamepads(lab);
  const padHelp = (): string => {
    const pad = gamepad.pad();
    if (!pad) return 'Gamepad: press a button to connect it.';
    return pad.asks === undefined
      ? 'Gamepad: stick or cross; the first button stops the tool.'
      : `Gamepad with an unknown layout: push the stick or the cross ${PUSH[pad.asks]}, and release it.`;
  };
  const help = (): string => SIGHTS.find(([name]) => name === lab.sight())?.[2] ?? '';
  const how = (): string => {
    if (!lab.steering.isActive()) return 'Only the operator steers.';
    return IS_TOUCH
      ? 'Press the map and move the finger: the tool follows.'
      : 'Press the map and move the pointer: the tool follows. Or focus the map and hold the arrow keys.';
  };
  return (
    <section class="you stack" aria-label="Steering">
      <p class="hint" data-testid="steer-how">
        {how()}
      </p>
      <Show when={lab.steering.isActive()}>
        <p class="hint" data-testid="gamepad">
          {padHelp()}
        </p>
        <Show when={gamepad.pad()?.isKnown === false}>
          <SmallButton
            title="Forget which stick or cross steers, and ask again"
            onClick={gamepad.relearn}
          >
            Choose the stick again
          </SmallButton>
        </Show>
      </Show>
      <label class="you-approach">
        <input
          type="checkbox"
          checked={lab.steering.approach()}
          disabled={!lab.steering.isActive()}
          onChange={(event) => lab.steering.setApproach(event.currentTarget.checked)}
        />
        Fetch a lost bead by hand, too
      </label>
      <ChoiceField<Sight>
        label="What you see"
        value={lab.sight()}
        options={SIGHTS.map(([name, label]) => [name, label] as const)}
        onChoose={(sight) => lab.setSight(sight)}
      />
      <p class="hint">{help()}</p>
      <button
        type="button"
        title="Race the controllers on a trial of the day"
        onClick={() => lab.showPanel('play')}
      >
        Challenges…
      </button>
    </section>
  );
}
