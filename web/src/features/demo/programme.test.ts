import { describe, expect, it } from 'vitest';
import { experimentFrom } from '../../lab/experimentLink';
import { sceneOf, stateAt } from '../../lab/testing';
import { phaseOf } from '../../lab/testingFacts';
import type { StateMessage } from '../../net/protocol.gen';
import {
  PART_MS,
  PROGRAMME,
  READ_MS,
  REST_MS,
  challengeOf,
  cued,
  homeOf,
  isOver,
  isVisitorKey,
  startOf,
  turned,
  type Place,
} from './programme';

const known = { ...sceneOf('colon'), maps: ['colon', 'posts'] };

/** After this cue of the first part. */
const after = (place: Place, index: number): Place => {
  return { ...place, cues: index + 1, waiting: PROGRAMME[0]?.cues[index] };
};

const carrying = stateAt(1, { phase: phaseOf('transporting'), mode: 2, leg_steps: 9 });

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
    expect(place.shown, 'its title').toBeUndefined();
    const captions: (string | undefined)[] = [];
    let now_ms = 0;
    const see = (state: StateMessage): void => {
      const next = cued(place, state);
      if (!next) return;
      place = turned(next.place, state, (now_ms += READ_MS));
      captions.push(place.shown?.caption);
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
      stateAt(7, { phase: phaseOf('approaching'), mode: 1, leg_steps: 61, disturbances: 1 }),
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
    const again = { ...carrying, disturbances: 1 };
    expect(cued(pulled, again)?.place.cues, 'a pull that was not carried out').toBe(4);
    const delivered = stateAt(2, { phase: phaseOf('delivered'), mode: 2, deliveries: 1 });
    for (const place of [startOf(0, 0), pulled]) {
      const next = cued(place, delivered)?.place ?? place;
      expect(next.cues).toBe(5);
      const last = turned(next, delivered, READ_MS);
      const end_ms = 2 * READ_MS + REST_MS + 1;
      expect(isOver(turned(last, delivered, 2 * READ_MS), end_ms)).toBe(true);
    }
  });

  it('leaves each caption its time while it is true, then shows the newest one', () => {
    const [one, two, three] = PROGRAMME[0]?.cues ?? [];
    let place = after(startOf(0, 0), 0);
    expect(turned(place, carrying, READ_MS - 1).shown).toBeUndefined();
    place = turned(place, carrying, READ_MS);
    expect(place.shown).toBe(one);
    place = turned(after(place, 1), carrying, READ_MS + 1);
    expect(place.shown).toBe(one);
    expect(turned(place, carrying, 2 * READ_MS).shown).toBe(two);
    const fetching = { ...carrying, mode: 1 };
    expect(turned(after(place, 2), fetching, READ_MS + 2).shown).toBe(three);
  });

  it('pulls no bead away that was delivered', () => {
    const late = stateAt(1, { phase: phaseOf('settling'), mode: 2, leg_steps: 90 });
    expect(cued(startOf(0, 0), late)).toBeUndefined();
  });

  it('leaves a part that does not get on', () => {
    expect(isOver(startOf(0, 0), PART_MS)).toBe(false);
    expect(isOver(startOf(0, 0), PART_MS + 1)).toBe(true);
  });

  it('begins again after the last part', () => {
    expect(startOf(PROGRAMME.length, 0).part).toBe(0);
  });
});

it('has the easy challenge of the day', () => {
  expect(challengeOf(new Date('2026-11-26T23:30:00Z'))).toBe('easy-2026-11-26');
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
