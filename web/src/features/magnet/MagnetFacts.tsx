// What the magnet can do at the current height.

import type { JSX } from 'solid-js';
import { fixed, millimetres } from '../../ui/format';
import { breakaway, captureWords, rolls, type Side, speedWords, weightWords } from './magnet';
import type { Parameters, PullCurve, ReachCurve } from '../../net/protocol.gen';
import { Fact } from '../../ui/Fact';

export function MagnetFacts(props: {
  parameters: Parameters;
  side: Side;
  pull: PullCurve | undefined;
  reach: ReachCurve | undefined;
}): JSX.Element {
  const lifted = (): boolean => props.pull?.is_lifted[0] ?? false;
  return (
    <dl class="facts">
      <Fact
        name="Weight left below"
        help="Share of the bead's weight that still presses on the table right below the magnet; friction acts on it"
        testid="magnet-weight"
        value={props.pull ? weightWords(props.pull) : '–'}
        alarm={lifted()}
      />
      <Fact
        name={props.side === 'bead' ? 'Captures toward it' : `Captures along ${props.side}`}
        help="Distances to the side at which the pull is stronger than friction"
        testid="magnet-capture"
        value={props.pull ? captureWords(props.pull.capture_m) : '–'}
        alarm={props.pull?.capture_m === null}
      />
      <Fact
        name="Lifts off below"
        help="Height of the block's lower face below which the bead jumps to it"
        testid="magnet-lift-off"
        value={props.reach ? millimetres(props.reach.lift_off_m, 1) : '–'}
        alarm={lifted()}
      />
      <Fact
        name="Bead follows up to"
        help="Largest speed at which the pull can overcome friction and viscous drag"
        testid="magnet-speed"
        value={props.reach ? speedWords(props.reach, props.parameters) : '–'}
        alarm={props.reach?.largest_speed_m_s[0] === null}
      />
      <Fact
        name={`Breakaway, ${rolls(props.parameters) ? 'rolling' : 'sliding'}`}
        help="Pull at which a resting bead starts to move, as a multiple of its weight left on the table"
        testid="magnet-breakaway"
        value={`${fixed(breakaway(props.parameters), 3)} × load`}
      />
    </dl>
  );
}
