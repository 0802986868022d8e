import { lazyTab } from '../../lab/panel';

export const RECOVERY_TAB = lazyTab(
  'recovery',
  'Recovery',
  async () => (await import('./RecoveryPanel')).RecoveryPanel,
);
