import { describe, expect, it } from 'vitest';
import { experimentFrom } from '../../lab/experimentLink';
import { sceneOf, stateAt } from '../../lab/testing';
import {
  PART_MS,
  PROGRAMME,
  READ_MS,
  REST_MS,
  afterCue,
  isOver,
  nextCue,
  startOf,
  turned,
} from './programme';

const known = { ...sceneOf('colon'), maps: ['colon', 'posts'] };

describe('the programme', () => {
  it.each(PROGRAMME)('“$title” opens an experiment with a goal', ({ link }) => {
    const read = experimentFrom(link, known);
    expect(read.kind === 'experiment' && read.experiment.goal_m).toBeTruthy();
  });

  it('follows its cues in order', () => {
    let place = startOf(0, 0);
    expect(place.caption).toBe(PROGRAMME[0]?.title);
    expect(nextCue(place, stateAt(1))).toBeUndefined();
    const carrying = stateAt(2, { phase: 'transporting', mode: 2, leg_steps: 80 });
    const captions: string[] = [];
    let now_ms = 0;
    for (const state of [
      carrying,
      carrying,
      carrying,
      stateAt(3, { phase: 'approaching', mode: 1 }),
      carrying,
      stateAt(4, { deliveries: 1 }),
    ]) {
      const cue = nextCue(place, state);
      if (!cue) break;
      place = turned(afterCue(place, cue), (now_ms += READ_MS));
      captions.push(place.caption);
    }
    expect(captions).toEqual(PROGRAMME[0]?.cues.map(({ caption }) => caption));
    expect(captions.at(-1)).toBe('Delivered.');
    expect(isOver(place, now_ms)).toBe(false);
    expect(isOver(place, now_ms + 1 + REST_MS)).toBe(true);
  });

  it('leaves each caption its time', () => {
    const cue = { when: () => true, caption: 'one' };
    let place = afterCue(afterCue(startOf(0, 0), cue), { ...cue, caption: 'two' });
    expect(turned(place, READ_MS - 1).caption).toBe(PROGRAMME[0]?.title);
    place = turned(place, READ_MS);
    expect(place.caption).toBe('one');
    place = turned(place, READ_MS + 1);
    expect(place.caption).toBe('one');
    expect(turned(place, 2 * READ_MS).caption).toBe('two');
  });

  it('leaves a part that does not get on', () => {
    expect(isOver(startOf(0, 0), PART_MS)).toBe(false);
    expect(isOver(startOf(0, 0), PART_MS + 1)).toBe(true);
  });

  it('begins again after the last part', () => {
    expect(startOf(PROGRAMME.length, 0).part).toBe(0);
  });
});
