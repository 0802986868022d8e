import { lazyTab } from '../../lab/panel';

export const LESSONS_TAB = lazyTab(
  'lessons',
  'Lessons',
  async () => (await import('./LessonsPanel')).LessonsPanel,
);
