import { describe, expect, it } from 'vitest';
import { experimentFrom } from '../../lab/experimentLink';
import { sceneOf, stateAt } from '../../lab/testing';
import { phaseOf } from '../../lab/testingFacts';
import type { AttemptStanding, ControllerName, StateMessage } from '../../net/protocol.gen';
import {
  PART_MS,
  PROGRAMME,
  READ_MS,
  REST_MS,
  challengeOf,
  cued,
  homeOf,
  invitation,
  isOver,
  isVisitorKey,
  playedCaption,
  startOf,
  turned,
  type Place,
  visitorCaption,
} from './programme';

const known = { ...sceneOf('colon'), maps: ['colon', 'posts'] };

/** After this cue of the first part. */
const after = (place: Place, index: number): Place => {
  const caption = PROGRAMME[0]?.cues[index]?.caption ?? '';
  return { ...place, cues: index + 1, waiting: [...place.waiting, caption] };
};

describe('the programme', () => {
  const links = PROGRAMME.flatMap(({ title, link }) =>
    link === undefined ? [] : [{ title, link }],
  );

  it.each(links)('“$title” opens an experiment with a goal', ({ link }) => {
    const read = experimentFrom(link, known);
    expect(read.kind === 'experiment' && read.experiment.goal_m).toBeTruthy();
  });

  it('follows its cues in order', () => {
    let place = startOf(0, 0);
    expect(place.caption).toBe(PROGRAMME[0]?.title);
    const captions: string[] = [];
    let now_ms = 0;
    const see = (state: StateMessage): void => {
      const next = cued(place, state);
      if (!next) return;
      place = turned(next.place, (now_ms += READ_MS));
      captions.push(place.caption);
    };
    const first = { phase: phaseOf('transporting'), mode: 2 };
    const pulled = { ...first, disturbances: 1 };
    for (const state of [
      // The first fetch is not one of a lost bead.
      stateAt(1, { phase: phaseOf('approaching') }),
      stateAt(2, first),
      stateAt(3, { ...first, leg_steps: 18 }),
      stateAt(4, { ...first, leg_steps: 48 }),
      stateAt(5, { ...first, leg_steps: 60 }),
      // The loss is noticed later.
      stateAt(6, { ...pulled, leg_steps: 61 }),
      stateAt(7, { phase: phaseOf('approaching'), leg_steps: 61, disturbances: 1 }),
      stateAt(8, { ...pulled, leg_steps: 1 }),
      stateAt(9, { ...pulled, leg_steps: 70 }),
      stateAt(10, { ...pulled, phase: phaseOf('delivered'), deliveries: 1 }),
    ]) {
      see(state);
    }
    expect(captions).toEqual(PROGRAMME[0]?.cues.map(({ caption }) => caption));
    expect(captions.at(-1)).toBe('Delivered.');
    expect(isOver(place, now_ms)).toBe(false);
    expect(isOver(place, now_ms + 1 + REST_MS)).toBe(true);
  });

  it('goes on after a missed cue', () => {
    const pulled = after(startOf(0, 0), 2);
    const carrying = stateAt(1, {
      phase: phaseOf('transporting'),
      mode: 2,
      leg_steps: 9,
      disturbances: 1,
    });
    expect(cued(pulled, carrying)?.place.cues, 'a pull that was not carried out').toBe(4);
    const delivered = stateAt(2, { phase: phaseOf('delivered'), mode: 2, deliveries: 1 });
    for (const place of [startOf(0, 0), pulled]) {
      const next = cued(place, delivered)?.place ?? place;
      expect(next.cues).toBe(5);
      const last = turned(next, READ_MS);
      expect(isOver(turned(last, 2 * READ_MS), 2 * READ_MS + REST_MS + 1)).toBe(true);
    }
  });

  it('leaves each caption its time, then shows the newest one', () => {
    const [one, two, three] = PROGRAMME[0]?.cues ?? [];
    let place = after(startOf(0, 0), 0);
    expect(turned(place, READ_MS - 1).caption).toBe(PROGRAMME[0]?.title);
    place = turned(place, READ_MS);
    expect(place.caption).toBe(one?.caption);
    place = turned(after(after(place, 1), 2), READ_MS + 1);
    expect(place.caption).toBe(one?.caption);
    expect(two?.caption).not.toBe(three?.caption);
    expect(turned(place, 2 * READ_MS).caption).toBe(three?.caption);
  });

  it('pulls no bead away that was delivered', () => {
    const late = stateAt(1, { phase: phaseOf('settling'), mode: 2, leg_steps: 90 });
    expect(cued(startOf(0, 0), late)).toBeUndefined();
  });

  it.each([
    [{ hand_m: [0, 0] }, 'Pull'],
    [{ mode: 1 }, 'The bead is lost'],
    [{ phase: phaseOf('delivered') }, 'Delivered'],
    [{}, 'You are in control'],
  ] as const)('tells a visitor what happens: %j', (change, words) => {
    const state = stateAt(1, { mode: 2, phase: phaseOf('transporting'), hand_m: null });
    expect(visitorCaption({ ...state, ...change } as StateMessage)).toContain(words);
  });

  it('leaves a part that does not get on', () => {
    expect(isOver(startOf(0, 0), PART_MS)).toBe(false);
    expect(isOver(startOf(0, 0), PART_MS + 1)).toBe(true);
  });

  it('begins again after the last part', () => {
    expect(startOf(PROGRAMME.length, 0).part).toBe(0);
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

  it('is the easy one of the day', () => {
    expect(challengeOf(new Date('2026-11-26T23:30:00Z'))).toBe('easy-2026-11-26');
  });

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
    expect(playedCaption({ ...attempt, ...change }, ghosts)).toContain(words);
  });
});

describe('the page', () => {
  const NO_MODIFIER = { ctrlKey: false, altKey: false, metaKey: false };

  it.each(['a', ' ', 'ä', 'Enter', 'Tab', 'ArrowLeft', 'PageUp'])(
    'takes “%s” for a visitor',
    (key) => {
      expect(isVisitorKey({ ...NO_MODIFIER, key })).toBe(true);
    },
  );

  it.each(['F11', 'F5', 'Shift', 'Control', 'Alt', 'Meta', 'CapsLock', 'AudioVolumeUp', 'Escape'])(
    'takes “%s” for no visitor',
    (key) => {
      expect(isVisitorKey({ ...NO_MODIFIER, key })).toBe(false);
    },
  );

  it('takes shortcuts of the browser for no visitor', () => {
    expect(isVisitorKey({ ...NO_MODIFIER, key: 'r', ctrlKey: true })).toBe(false);
    expect(isVisitorKey({ ...NO_MODIFIER, key: 'Tab', altKey: true })).toBe(false);
    expect(isVisitorKey({ ...NO_MODIFIER, key: 'h', metaKey: true })).toBe(false);
  });

  it.each([
    ['', '/'],
    ['#/', '/'],
    ['#/s/anna', '/s/anna'],
    ['#/s/main', '/'],
    ['#//evil.example', '/'],
    ['#/s/anna/../..', '/'],
    ['#https://evil.example/s/anna', '/'],
    ['#javascript:alert(1)', '/'],
  ])('with “%s” returns to %s', (hash, home) => {
    expect(homeOf(hash)).toBe(home);
  });
});
