// The view's code is loaded when the view is opened.

import { lazyView } from '../../ui/lazyPart';
import type { TrainProps } from './TrainView';

export const LazyTrainView = lazyView<TrainProps>(
  async () => (await import('./TrainView')).TrainView,
);
