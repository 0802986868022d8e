// The actions of a policy: steps along an axis, in the order of the network's outputs.

export const ACTIONS = [
  { id: 'plus-x', arrow: '→', name: '+x', word: 'right', along: [1, 0] },
  { id: 'minus-x', arrow: '←', name: '−x', word: 'left', along: [-1, 0] },
  { id: 'plus-y', arrow: '↑', name: '+y', word: 'up', along: [0, 1] },
  { id: 'minus-y', arrow: '↓', name: '−y', word: 'down', along: [0, -1] },
] as const;
