import { describe, expect, it } from 'vitest';
import { clientsWords, motionWords } from './words';
import type { RobotStanding } from '../../net/protocol.gen';

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
    expect(motionWords(idle)).toBe('No program runs: the arm rests.');
    const running = { ...idle, program: 'rtde_control' };
    expect(motionWords(running)).toBe('The program rtde_control runs; the arm rests.');
    expect(motionWords({ ...running, command: 'movel' })).toBe(
      'The program rtde_control moves the arm: movel.',
    );
    expect(motionWords({ ...running, stop: 'too low' })).toBe('Protective stop: too low.');
  });
});
