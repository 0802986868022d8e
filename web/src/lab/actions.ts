// The actions of a policy: steps along an axis, in the order of the network's outputs.

export const ACTIONS = [
  { id: 'plus-x', arrow: '→', name: '+x', along: [1, 0] },
  { id: 'minus-x', arrow: '←', name: '−x', along: [-1, 0] },
  { id: 'plus-y', arrow: '↑', name: '+y', along: [0, 1] },
  { id: 'minus-y', arrow: '↓', name: '−y', along: [0, -1] },
] as const;
