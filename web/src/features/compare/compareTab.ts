import { lazyTab } from '../../lab/panel';

export const COMPARE_TAB = lazyTab(
  'compare',
  'Compare',
  async () => (await import('./ComparePanel')).ComparePanel,
);
