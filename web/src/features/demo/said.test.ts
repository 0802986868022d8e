import { describe, expect, it } from 'vitest';
import { History } from '../../lab/history';
import { stateAt } from '../../lab/testing';
import { phaseOf, stoppedBy } from '../../lab/testingFacts';
import type { AttemptStanding, ControllerName, StateMessage } from '../../net/protocol.gen';
import { CARRIERS } from '../../ui/controllers';
import { PROGRAMME, startOf } from './programme';
import {
  badgeOf,
  invitation,
  plainSentence,
  playedSentence,
  programmeSentence,
  visitorSentence,
} from './said';

const FETCHES = /flies|is lost/;
const CARRIES = /carries (on|the bead)|steers|plans|bend|looks again|will be pulled|Delivered/;
const NAMES: readonly (readonly [RegExp, ControllerName])[] = [
  [/\bRL\b|network/, 'rl'],
  [/ERRT|planner/, 'errt'],
  [/Attractor/, 'attractor'],
];

/** Each state that a course can have, with each controller. */
const STATES: readonly StateMessage[] = [1, 2].flatMap((mode) =>
  ['holding', 'approaching', 'transporting', 'settling', 'delivered', 'stopped'].flatMap((code) =>
    ['rl', 'errt', 'attractor', 'you'].flatMap((controller) =>
      [0, 1].map((disturbances) =>
        stateAt(1, {
          mode,
          phase: code === 'stopped' ? stoppedBy('settle') : phaseOf(code as 'holding'),
          controller: controller as ControllerName,
          disturbances,
          deliveries: code === 'delivered' ? 1 : 0,
          goal_m: [0, 0, 0],
        }),
      ),
    ),
  ),
);

function contradiction(sentence: string, state: StateMessage): string | undefined {
  const badge = badgeOf(state, false);
  const why = (words: string): string =>
    `${words}: “${sentence}” beside “${badge.text}”, ${JSON.stringify(state.phase)}`;
  if (badge.of === 'fetch' && CARRIES.test(sentence)) return why('it fetches');
  if (badge.of !== 'fetch' && FETCHES.test(sentence)) return why('it carries');
  if (sentence.startsWith('Delivered') && state.phase.code !== 'delivered')
    return why('not delivered');
  if (badge.of === 'fetch') return undefined;
  const named = NAMES.find(([words]) => words.test(sentence))?.[1];
  return named && named !== badge.of ? why('another controller') : undefined;
}

describe('badge and sentence', () => {
  it('agree in each state of the programme, whichever cue is shown', () => {
    const faults = PROGRAMME.flatMap(({ link, cues }, part) => {
      const own = /controller=(\w+)/.exec(link ?? '')?.[1] ?? 'you';
      return STATES.filter(({ controller }) => controller === own).flatMap((state) =>
        [undefined, ...cues].map((shown) =>
          contradiction(programmeSentence({ ...startOf(part, 0), shown }, state), state),
        ),
      );
    });
    expect(faults.filter(Boolean)).toEqual([]);
  });

  it('agree without the programme', () => {
    const faults = STATES.flatMap((state) => [
      contradiction(plainSentence(state), state),
      contradiction(visitorSentence(state), state),
    ]);
    expect(faults.filter(Boolean)).toEqual([]);
    expect(new Set(STATES.map(plainSentence)).size).toBeGreaterThan(8);
  });

  it('name what the trail has at its end', () => {
    for (const state of STATES) {
      const history = new History();
      history.push(state);
      const { mode, controller } = history.window(0, 1);
      const carrier = mode[0] === 1 ? 'fetch' : CARRIERS[controller[0] ?? NaN];
      expect(carrier).toBe(badgeOf(state, false).of);
    }
  });

  it('tell ghosts from a visitor', () => {
    const [alone, steered] = [null, [0, 0] as [number, number]].map((steer_m) =>
      stateAt(1, { mode: 2, controller: 'you', goal_m: [0, 0, 0], steer_m }),
    );
    if (!alone || !steered) throw new Error('two states');
    expect([badgeOf(alone, false).text, plainSentence(alone)]).toEqual([
      'Ghosts',
      'Ghosts of earlier attempts race to the goal.',
    ]);
    expect(badgeOf(alone, true).text).toBe('A visitor');
    expect([badgeOf(steered, false).text, plainSentence(steered)]).toEqual([
      'A visitor',
      'A visitor carries the bead to its goal.',
    ]);
  });

  it.each([
    [{ hand_m: [0, 0] }, 'Pull'],
    [{ mode: 1 }, 'The bead is lost'],
    [{ phase: phaseOf('delivered') }, 'Delivered'],
    [{}, 'You are in control'],
  ] as const)('tells a visitor what happens: %j', (change, words) => {
    const state = stateAt(1, { mode: 2, phase: phaseOf('transporting'), hand_m: null });
    expect(visitorSentence({ ...state, ...change } as StateMessage)).toContain(words);
  });
});

describe('the challenge', () => {
  const trace = { tool_m: [], bead_m: [], mishaps: [] };
  const ghost = (controller: ControllerName, player: string | null, total_s: number | null) => ({
    controller,
    player,
    score: null,
    total_s,
    trace,
  });
  const controllers = {
    sample_s: 0.2,
    ghosts: [ghost('rl', null, 15), ghost('errt', null, 9), ghost('attractor', null, null)],
  };
  const people = { ...controllers, ghosts: [...controllers.ghosts, ghost('you', 'Ada', 12.5)] };
  const attempt: AttemptStanding = {
    walls: 0,
    lost_beads: 0,
    total_s: 11,
    is_delivered: true,
    is_time_up: false,
    void: null,
  };

  it('invites to beat the best person, or the fastest controller', () => {
    expect(invitation(people)).toContain('Ada needs 12.5 s.');
    expect(invitation(controllers)).toContain('ERRT needs 9.0 s.');
    expect(invitation(undefined)).toMatch(/^Touch/);
  });

  it.each([
    [{}, people, 'You are faster than Ada'],
    [{ total_s: 13 }, people, 'Ada needs 12.5 s'],
    [{ is_delivered: false }, people, 'green circle: 11.0 s'],
    [{ is_delivered: false, is_time_up: true }, undefined, 'Time is up'],
  ] as const)('tells a visitor how it goes: %j', (change, ghosts, words) => {
    expect(playedSentence({ ...attempt, ...change }, ghosts)).toContain(words);
  });
});
