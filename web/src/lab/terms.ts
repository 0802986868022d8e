// Explanations of terms, for tooltips. They are those of docs/glossary.md.

export const TERMS = {
  mode: 'The active sub-controller: 1 fetches, 2 transports.',
  phase:
    'What a trial does at the moment: holding, approaching, transporting, settling, delivered, lifted off, or stopped by a limit.',
  holding:
    'The arm does not move: no goal is set, a step was refused, or a limit was reached. Also: the hand holds the bead.',
  'sub-controller 1': 'Flies to the bead (fetch).',
  'sub-controller 2': 'Carries the bead to the goal by one of three transports.',
} as const;
