// The view's code is loaded when the view is opened.

import { lazyView } from '../../ui/lazyPart';
import type { EvaluateProps } from './EvaluateView';

export const LazyEvaluateView = lazyView<EvaluateProps>(
  async () => (await import('./EvaluateView')).EvaluateView,
);
