// The view's code is loaded when the view is opened.

import { lazyView } from '../../ui/lazyPart';
import type { RecordingsProps } from './RecordingsView';

export const LazyRecordingsView = lazyView<RecordingsProps>(
  async () => (await import('./RecordingsView')).RecordingsView,
);
