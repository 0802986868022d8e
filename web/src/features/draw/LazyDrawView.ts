// The view's code is loaded when the view is opened: the eraser's geometry is a quarter of the page's code.

import { lazyView } from '../../ui/lazyPart';
import type { DrawProps } from './DrawView';

export const LazyDrawView = lazyView<DrawProps>(async () => (await import('./DrawView')).DrawView);
