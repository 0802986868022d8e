import { expect, test } from 'vitest';
import type { JudgementLayer } from '../net/protocol.gen';
import { momentOf } from './testing';
import { eventTitle, marginWords, sentence, whatItSaw } from './eventStory';

test('a title has the kind and the time', () => {
  expect(eventTitle({ kind: 'lift_off', sim_time_s: 12.34 })).toBe('Lift-off at 12.3 s');
});

test('a text becomes a sentence, and a sentence stays unchanged', () => {
  expect(sentence('bead lost: 3 mm')).toBe('Bead lost: 3 mm.');
  expect(sentence('Why not?')).toBe('Why not?');
});

test('a margin has a distance and a side', () => {
  const over = momentOf({ error_m: 0.142, threshold_m: 0.1 });
  expect(marginWords(over)).toBe('4.2 cm over the limit');
  const within = momentOf({ error_m: 0.008, threshold_m: 0.01 });
  expect(marginWords(within)).toBe('0.2 cm within the limit');
});

test('the explanation of a sub-controller names its inputs', () => {
  const fetching = whatItSaw(momentOf({ mode: 1, bead_m: [0.1, 0], bead_tracked_m: [0.101, 0] }));
  expect(fetching).toContain('(0.101, 0.000) m, 1.0 mm from its true position');
  expect(fetching).toContain('Sub-controller 1 flies to the bead');
  expect(whatItSaw(momentOf({ mode: 2, goal_m: null }))).toContain('does not move the arm');
  const carrying = momentOf({ mode: 2, goal_m: [0.3, 0], tool_m: [0, 0], controller: 'attractor' });
  expect(whatItSaw(carrying)).toContain('Attractor sensed 0 obstacles in the image.');
  expect(whatItSaw(carrying)).toContain('The goal was 30.0 cm away.');
  expect(whatItSaw({ ...carrying, controller: 'errt' })).toContain('had no path yet');
  expect(whatItSaw({ ...carrying, refusal: { code: 'closed', text: '' } })).toMatch(
    /did not move: A segment .*\.$/,
  );
});

test('the explanation of a policy names its action and the value', () => {
  const chosen = momentOf({ mode: 2, goal_m: [0.3, 0], controller: 'rl' });
  const judgement: JudgementLayer = {
    policy: 'explorer',
    quantiles: [[], [], [], []],
    values: [0.1, 0.25, 0.9, 0],
    taken: 2,
    is_shortcut: false,
    trained_on: [],
    has_memory: false,
  };
  const story = whatItSaw({ ...chosen, overlay: { ...chosen.overlay, judgement } });
  expect(story).toContain('RL chose ↑ +y with a value of 0.90 (expected return).');
  const straight = { ...judgement, is_shortcut: true };
  const longer = whatItSaw({ ...chosen, overlay: { ...chosen.overlay, judgement: straight } });
  expect(longer).toContain('(expected return), and went straight over the next cells.');
});
