import { lazyTab } from '../../lab/panel';

export const CHALLENGE_TAB = lazyTab(
  'challenge',
  'Challenge',
  async () => (await import('./ChallengePanel')).ChallengePanel,
);
