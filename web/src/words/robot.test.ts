import { describe, expect, it } from 'vitest';
import {
  clientMotionWords,
  clientsWords,
  connectionWords,
  doubtWords,
  robotMotionWords,
} from './robot';
import type { DoubtFact, RobotStanding, TwinStanding } from '../net/protocol.gen';

const twin: TwinStanding = {
  address: '192.168.0.5',
  allows_motion: true,
  trouble: null,
  model: null,
  doubt: null,
  robot_mode: 7,
  safety_mode: 1,
  is_held: false,
  is_driven: false,
  stopped: null,
};
const idle: RobotStanding = { clients: [], program: null, command: null, stop: null, refused: [] };

describe('the words about a robot client', () => {
  it('names each address once, with what it speaks', () => {
    const clients = [
      { from: '127.0.0.1:5000', speech: 'RTDE' },
      { from: '127.0.0.1:5001', speech: 'URScript' },
      { from: '127.0.0.1:5002', speech: 'RTDE' },
      { from: '[::1]:7', speech: 'dashboard' },
    ];
    expect(clientsWords({ ...idle, clients })).toEqual([
      '127.0.0.1: 3 connections (RTDE, URScript)',
      '[::1]: 1 connection (dashboard)',
    ]);
    expect(clientsWords(idle)).toEqual([]);
  });

  it('says what moves the arm, and first of all that it is stopped', () => {
    expect(clientMotionWords(idle)).toBe('No program runs: the arm rests.');
    const running = { ...idle, program: 'rtde_control' };
    expect(clientMotionWords(running)).toBe('The program rtde_control runs; the arm rests.');
    expect(clientMotionWords({ ...running, command: 'movel' })).toBe(
      'The program rtde_control moves the arm: movel.',
    );
    expect(
      clientMotionWords({ ...running, stop: { code: 'refused', detail: 'too low', text: '' } }),
    ).toBe('Protective stop: too low.');
  });
});

describe('the words about a mirrored robot', () => {
  it('say whether it is there, and in what state', () => {
    expect(connectionWords(twin)).toBe('Robot 192.168.0.5: running, safety: normal.');
    expect(connectionWords({ ...twin, robot_mode: 3, safety_mode: 12 })).toBe(
      'Robot 192.168.0.5: power off, safety: safety mode 12.',
    );
    expect(connectionWords({ ...twin, model: 'UR3' })).toContain('192.168.0.5 (UR3): running');
    const pose = [0.1, -0.3, 0.2, 0, 3.1416, 0] as const;
    const apart = { reported: [...pose], computed: [...pose], distance_m: 0.0104, angle_rad: 0.1 };
    expect(doubtWords({ code: 'flange', ...apart } as DoubtFact)).toContain(
      'its flange is at p[0.1000, −0.3000, 0.2000, 0.0000, 3.1416, 0.0000] by the robot',
    );
    expect(doubtWords({ code: 'tool', ...apart } as DoubtFact)).toContain('10.4 mm and 5.7° apart');
    expect(
      connectionWords({
        ...twin,
        trouble: { code: 'failed', detail: 'port 30004: refused', text: '' },
      }),
    ).toBe('Robot 192.168.0.5 is not connected: port 30004: refused.');
  });

  it('say who moves it', () => {
    expect(robotMotionWords(twin)).toBe('The robot rests, or something else moves it.');
    expect(robotMotionWords({ ...twin, is_held: true })).toContain('begins');
    expect(robotMotionWords({ ...twin, is_held: true, is_driven: true })).toContain(
      'follows Ferry',
    );
    expect(
      robotMotionWords({ ...twin, stopped: { code: 'safety', safety_mode: 3, text: '' } }),
    ).toBe(
      'The robot does not follow: its safety must be normal or reduced, and is: protective stop.',
    );
    expect(robotMotionWords({ ...twin, allows_motion: false })).toContain('--enable-motion');
  });
});
