import { describe, expect, it } from 'vitest';
import { twinOf } from '../../lab/testingTwin';
import { connectionWords, doubtWords, motionWords } from './words';

const twin = twinOf();

describe('the words about a mirrored robot', () => {
  it('say whether it is there, and in what state', () => {
    expect(connectionWords(twin)).toBe('Robot 192.168.0.5: running, safety: normal.');
    expect(connectionWords({ ...twin, robot_mode: 3, safety_mode: 12 })).toBe(
      'Robot 192.168.0.5: power off, safety: safety mode 12.',
    );
    expect(connectionWords({ ...twin, model: 'UR3' })).toContain('192.168.0.5 (UR3): running');
    expect(doubtWords('its tool is elsewhere')).toBe(
      'Ferry’s places may not be the robot’s: its tool is elsewhere.',
    );
    expect(connectionWords({ ...twin, trouble: 'port 30004: refused' })).toBe(
      'Robot 192.168.0.5 is not connected: port 30004: refused.',
    );
  });

  it('say who moves it', () => {
    expect(motionWords(twin)).toBe('The robot rests, or something else moves it.');
    expect(motionWords({ ...twin, is_held: true })).toContain('begins');
    expect(motionWords({ ...twin, is_held: true, is_driven: true })).toContain('follows Ferry');
    expect(motionWords({ ...twin, stopped: 'too fast' })).toBe(
      'The robot does not follow: too fast.',
    );
    expect(motionWords({ ...twin, allows_motion: false })).toContain('--enable-motion');
  });
});
