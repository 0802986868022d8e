import { lazyTab } from '../../lab/panel';

export const MAGNET_TAB = lazyTab(
  'magnet',
  'Magnet',
  async () => (await import('./MagnetPanel')).MagnetPanel,
);
