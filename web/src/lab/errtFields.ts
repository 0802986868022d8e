// The parameters of ERRT.

import { type Field, number } from './parameters';

export const ERRT_FIELDS: readonly Field[] = [
  number(
    'errt_goal_probability',
    'Goal probability',
    [0, 90, 1],
    '%',
    100,
    'Share of the extensions that go toward the goal. Takes from the share toward waypoints.',
  ),
  {
    ...number(
      'errt_waypoint_probability',
      'Waypoint probability',
      [0, 90, 1],
      '%',
      100,
      'Share that go toward a waypoint of an earlier way. At most what the goal leaves.',
    ),
    atMost: ({ errt_goal_probability }) => 1 - errt_goal_probability,
  },
  number(
    'errt_waypoints',
    'Waypoints',
    [0, 1000, 10],
    '',
    1,
    'How many of the earlier ways are remembered; 0 is without.',
  ),
  number(
    'errt_beta_most',
    'Most β',
    [0, 0.95, 0.01],
    '',
    1,
    'What β, the weight of the way from the root, grows to; 0 is the plain nearest neighbour.',
  ),
  number('errt_step_m', 'Edge length', [5, 100, 1], 'mm', 1000, 'Longest edge of the tree.'),
  number(
    'errt_clearance_m',
    'Clearance',
    [4, 30, 0.5],
    'mm',
    1000,
    'Distance that ways keep from walls where there is room.',
  ),
  number(
    'errt_ways',
    'Ways compared',
    [1, 20, 1],
    '',
    1,
    'Planned before the shortest is followed; the publication follows the first.',
  ),
  number(
    'errt_unseen_weight',
    'Weight of the unseen',
    [1, 10, 0.1],
    '',
    1,
    'How many times a length through the unseen counts when ways are compared.',
  ),
  number(
    'errt_nodes_per_step',
    'Edges per step',
    [10, 20_000, 10],
    '',
    1,
    'Tried at one control step at most; then the arm holds, and the search goes on at the next.',
  ),
  {
    kind: 'flag',
    name: 'errt_shortcut',
    label: 'Cut short',
    help: 'Whether corners of a way are cut where there is room.',
  },
];
